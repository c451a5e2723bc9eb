#!/usr/bin/env bash
# bash long.sh BUILD CORPUS MINUTES [TARGET...]: fuzzes with libFuzzer, one target after another, at
# low priority. CORPUS/TARGET keeps what was found to be new, and is where the next run goes on;
# CORPUS/seeds holds the seeds (seeds.bash). Prints one row per target.
set -u
here=$(cd "$(dirname "$0")" && pwd)
build=$(realpath "$1") corpus=$(realpath "$2") minutes=$3
shift 3
targets=("$@")
(($#)) || targets=(tets vtu pvtu pvd vtk vtkhdf exodus xdmf sva svb msh mesh meshb tetgen su2 wrapped push)
export LSAN_OPTIONS=suppressions=$here/../support/leaks.supp,print_suppressions=0
cd "$corpus" || exit 1

printf '%-8s %12s %8s %9s %6s %9s  %s\n' target executions edges features files seconds result
for target in "${targets[@]}"; do
  dictionaries=()
  [[ -e $here/$target.dict ]] && dictionaries=(-dict="$here/$target.dict")
  [[ $target == *vtu || $target == pvd ]] && dictionaries=(-dict="$here/xml.dict")
  known=()
  [[ -d $here/found/$target ]] && known=("$here/found/$target")
  # libhdf5 believes some sizes that a file claims: they are denied.
  limit=80 of_hdf5=
  [[ $target =~ ^(vtkhdf|exodus|xdmf)$ ]] &&
    limit=500 of_hdf5=:max_allocation_size_mb=400:suppressions=$here/libhdf5.supp
  mkdir -p "$target"
  begin=$SECONDS
  ASAN_OPTIONS=allocator_may_return_null=1$of_hdf5 nice -n 10 "$build/tests/fuzz/fuzz.$target" \
    -max_total_time=$((minutes * 60)) -timeout=20 -malloc_limit_mb=$limit -rss_limit_mb=2000 -artifact_prefix="$corpus/$target-" \
    -print_final_stats=1 "${dictionaries[@]}" "$target" "seeds/$target" "${known[@]}" 2>"$target.log"
  code=$?
  last=$(grep -E '^#[0-9]+.*cov: ' "$target.log" | tail -n 1)
  value() { sed -E "s/.*$1: ([0-9]+).*/\1/" <<<"$last"; }
  printf '%-8s %12s %8s %9s %6s %9s  %s\n' "$target" \
    "$(sed -nE 's/^stat::number_of_executed_units: //p' "$target.log")" "$(value cov)" "$(value ft)" \
    "$(find "$target" -type f | wc -l)" $((SECONDS - begin)) \
    "$( ((code == 0)) && echo nothing found || grep -m 1 -oE 'not so.*|runtime error.*|ERROR: .*' "$target.log")"
done
