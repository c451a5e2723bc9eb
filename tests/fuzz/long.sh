#!/usr/bin/env bash
# bash long.sh BUILD CORPUS MINUTES [TARGET...]: fuzzes with libFuzzer, one target after another, at
# low priority, each for MINUTES of the processor's time. CORPUS/TARGET keeps what was found to be new,
# and is where the next run goes on; CORPUS/seeds holds the seeds (seeds.bash). Prints one row per target.
set -u
here=$(cd "$(dirname "$0")" && pwd)
build=$(realpath "$1") corpus=$(realpath "$2") minutes=$3
shift 3
targets=("$@")
(($#)) || targets=(tets vtu pvtu pvd vtk vtkhdf exodus xdmf sva svb msh mesh meshb tetgen su2 wrapped push)
export LSAN_OPTIONS=suppressions=$here/../support/leaks.supp,print_suppressions=0
cd "$corpus" || exit 1

# fuzz SECONDS TARGET OPTIONS...: libFuzzer counts seconds of the clock. What it says goes to
# TARGET.log; adds to `executions` and `used`, the seconds of the processor.
fuzz() {
  local TIMEFORMAT='%U %S' code times
  times=$({ time nice -n 10 "$build/tests/fuzz/fuzz.$2" -max_total_time="$1" -timeout=20 -rss_limit_mb=2000 \
    -artifact_prefix="$corpus/$2-" -print_final_stats=1 "$2" "seeds/$2" "${@:3}" >"$2.log" 2>&1; } 2>&1)
  code=$?
  used=$(awk -v used="$used" '{print int(used + $1 + $2 + 1)}' <<<"$times")
  executions=$((executions + $(sed -nE 's/^stat::number_of_executed_units: //p' "$2.log" | grep . || echo 0)))
  return "$code"
}

# row TARGET RESULT
row() {
  local last
  last=$(grep -E '^#[0-9]+.*cov: ' "$1.log" | tail -n 1)
  value() { sed -E "s/.*$1: ([0-9]+).*/\1/" <<<"$last"; }
  printf '%-8s %12s %8s %9s %6s %9s  %s\n' "$1" "$executions" "$(value cov)" "$(value ft)" \
    "$(find "$1" -type f | wc -l)" "$used" "$2"
}

# is_theirs LOG: whether what failed, or took the memory, is libhdf5, itself or with what it called.
is_theirs() {
  grep -E '^ *#[0-9]+ ' "$1" | grep -vE '__interceptor| string/| in (malloc|calloc|realloc) |__sanitizer|fuzzer::|__asan' |
    head -n 1 | grep -q libhdf5
}

printf '%-8s %12s %8s %9s %6s %9s  %s\n' target executions edges features files seconds result
for target in "${targets[@]}"; do
  options=()
  [[ -e $here/$target.dict ]] && options=(-dict="$here/$target.dict")
  [[ $target == *vtu || $target == pvd ]] && options=(-dict="$here/xml.dict")
  # libhdf5 believes some sizes that a file claims: they are denied.
  limit=80 of_hdf5=
  # libzstd takes the window that a frame asks for, up to 128 MB; a .tets may be such a frame.
  [[ $target =~ ^(wrapped|tets)$ ]] && limit=140
  [[ $target =~ ^(vtkhdf|exodus|xdmf)$ ]] &&
    limit=500 of_hdf5=:max_allocation_size_mb=400:suppressions=$here/libhdf5.supp
  export ASAN_OPTIONS=allocator_may_return_null=1$of_hdf5
  options+=("-malloc_limit_mb=$limit")
  mkdir -p "$target"
  [[ -d $here/found/$target ]] && options+=("$here/found/$target")
  used=0 executions=0 theirs=0 result='nothing found'
  while ((used + 10 < minutes * 60)); do
    fuzz $((minutes * 60 - used)) "$target" "${options[@]}" && continue
    is_theirs "$target.log" && ((++theirs)) && continue
    result=$(grep -m 1 -oE 'not so.*|runtime error.*|ERROR: .*' "$target.log")
    break
  done
  ((theirs)) && result+=", ended $theirs times within libhdf5"
  row "$target" "$result"
done
