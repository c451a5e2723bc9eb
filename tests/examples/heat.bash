# The solver of the heat equation, on a box, where the answer is known, and on a part with fillets and
# holes: heat.bash heat, in C, and heat.bash heat_fortran.
source "${BASH_SOURCE%/*}/common.bash"
program=$1

# The time that a file tells.
time_in() {
  expect 0 info "$1" --json
  sed -n 's/^ *"time": \([^,]*\),\{0,1\}$/\1/p' <<<"$out"
}

# solve NAME MESH STEPS EVERY: runs it and checks what must hold on any mesh.
solve() {
  local name=$1 mesh=$2 steps=$3 every=$4 all contents first count=0 cells last
  example 0 "$program" "$mesh" "$name" "$steps" "$every"
  [[ -z $err ]] || fail "$name: not silent"
  cp "$logs/out" "$name.table"
  all=$(cells_in "$mesh")
  first=$(awk '$1 == 0 { print $3 }' "$name.table")
  last=$(time_in "$name-$(printf %03d "$steps").tets")
  awk -v t="$last" 'BEGIN { exit !(t > 0) }' || fail "$name: the time of the last state is $last"
  while read -r number _ contents _ cells; do
    near "$contents" "$first" 1e-8
    ((cells * 10 <= all && cells * 11 > all)) || fail "$name: $cells of $all cells after $number steps"
    file=$name-$(printf %03d "$number").tets
    [[ $(cells_in "$file") == "$cells" ]] || fail "$file: not $cells cells"
    near "$(time_in "$file")" "$(awk -v t="$last" -v n="$number" -v all="$steps" \
      'BEGIN { printf "%.17g", t * n / all }')" 1e-12
    example 0 05_writer "$file"
    near "$(line u)" "$contents" 0.01
    count=$((count + 1))
  done < <(grep -v '^#' "$name.table")
  ((count == steps / every + 1)) || fail "$name: $count states"
  only=$(ls "$name"-*)
  (($(wc -l <<<"$only") == count)) || fail "$name: files $only"
}

expect 0 generate fluid box.tets --cells 20000
if is_slow; then steps=4 every=2; else steps=40 every=10; fi
solve box box.tets $steps $every
# The cosine is an eigenfunction on a box: a step divides it by 1 + pi^2 dt / L^2, and by a little more or
# less on a mesh. Time itself would make it exp(-pi^2 t / L^2).
grep -v '^#' box.table | while read -r number time _ amplitude _; do
  factor=$(awk -v n="$number" 'BEGIN { print (1 + 0.001 * atan2(0, -1) ^ 2) ^ -n }')
  near "$amplitude" "$factor" 0.01
  near "$amplitude" "$(awk -v t="$time" 'BEGIN { print exp(-t * atan2(0, -1) ^ 2) }')" 0.02
done

# Twice as many steps of half the length end at the same time.
example 0 "$program" box.tets half $((2 * steps)) $((2 * steps)) 0.0005
[[ $(tail -1 <<<"$out" | cut -d ' ' -f 2) == $(tail -1 box.table | cut -d ' ' -f 2) ]] ||
  fail "another time: $out"

# The same again gives the same bytes.
example 0 "$program" box.tets again $steps $steps
last=$(printf %03d $steps).tets
cmp box-$last again-$last || fail "the second run gives other bytes"

example 1 "$program" nothing.vtu out
contains "$err" "nothing.vtu: cannot open"
example 1 "$program" box.tets out 10 0
contains "$err" "usage: "
example 1 "$program" box.tets nowhere/out 0
contains "$err" "nowhere/out-000.tets"
printf '%s\n' "# vtk DataFile Version 3.0" flat ASCII "DATASET UNSTRUCTURED_GRID" "POINTS 4 double" \
  "0 0 0  1 0 0  0 1 0  1 1 0" "CELLS 1 5" "4 0 1 2 3" "CELL_TYPES 1" 10 >flat.vtk
example 1 "$program" flat.vtk out
contains "$err" "flat"
if ! is_slow; then
  (
    trap '' XFSZ
    ulimit -f 8 # no file may have more than 8 KB
    example 1 "$program" box.tets out 0
    contains "$err" ": out-000.tets: "
    [[ -z $out || $out == "# "* ]] || fail "a step that was not written is told: $out"
  )
fi
[[ -z $(ls out* 2>/dev/null) ]] || fail "files of a run that failed"

if ! is_slow; then  # an indexed mesh, ordered on the way
  solve bracket "$bracket" 4 2
fi
