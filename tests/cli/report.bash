# The closing report: where it goes, what it says, that its JSON is JSON.
source "${BASH_SOURCE%/*}/common.bash"

tetstream generate fluid --cells 6000 in.tets

expect 0 simplify in.tets out.tets --ratio 0.5
for row in cells vertices time memory window front collapses rejected error "quadric error" \
  regions reached; do
  contains $'\n'"$out" $'\n'"$row"
done
contains "$out" " -> $(cells_in out.tets), ratio 0."
[[ $out == *$'\nreached       ratio' ]] || fail "the last row is not the target: $out"
[[ -z $err ]] || fail "a report on standard output is enough: $err"
contains_not "$out" "caution"
expect 0 simplify in.tets coarse.tets --cells 30
contains "$out" $'\ncaution       the error is large'

# Two blocks at nearly the same place, and two values there: no limit on the error can be held.
awk 'function at(b, x, y, z) { return ((b * 6 + x) * 6 + y) * 6 + z }
  function corners(k) { return substr("421412142124241214", 3 * k + 1, 3) }
  BEGIN {
    print "# vtk DataFile Version 3.0\ntwo\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 432 float"
    for (b = 0; b < 2; ++b) for (x = 0; x < 6; ++x) for (y = 0; y < 6; ++y) for (z = 0; z < 6; ++z)
      print x + 0.3 * b, y, z
    print "CELLS 1500 7500"
    for (b = 0; b < 2; ++b) for (x = 0; x < 5; ++x) for (y = 0; y < 5; ++y) for (z = 0; z < 5; ++z)
      for (k = 0; k < 6; ++k) {
        line = "4 " at(b, x, y, z)
        for (bits = j = 0; j < 3; ++j) {
          bits += substr(corners(k), j + 1, 1)
          line = line " " at(b, x + (bits >= 4), y + (int(bits / 2) % 2), z + bits % 2)
        }
        print line
      }
    print "CELL_TYPES 1500"
    for (c = 0; c < 1500; ++c) print 10
    print "POINT_DATA 432\nSCALARS f float 1\nLOOKUP_TABLE default"
    for (v = 0; v < 432; ++v) print (v >= 216) + v % 6 / 10
  }' >twice.vtk
expect 0 simplify twice.vtk twice.tets --error 1
contains "$out" $'\ncaution       the error is above the 1 % that it may have: '

# The front is the input's: where no windows have met it, and the stream does not tell its cells, they are
# not known.
expect 0 convert in.tets in.sva
expect 0 simplify in.sva small.tets --ratio 0.5
[[ $out == *$'\nfront         width '*', cells not known'* ]] || fail "the front of in.sva: $out"
rm in.sva

# The volume is told where it is another, as where a ball becomes coarse as the paper has it.
expect 0 generate ball --cells 6000 ball.tets
expect 0 simplify ball.tets small.tets --ratio 0.05
contains_not "$out" $'\nvolume'
expect 0 simplify ball.tets small.tets --ratio 0.05 --mode paper
contains "$out" $'\nvolume '
contains "$out" ' % less than in the input'
expect 0 simplify ball.tets small.tets --ratio 0.05 --mode paper --quiet --report json
volumes="$(member "$out" volume_in) $(member "$out" volume_out)"
expect 0 compare ball.tets small.tets --report json "${less_boundary[@]}"
[[ $(grep -oE '"volume": [0-9.e+-]+' <<<"$out" | grep -oE '[0-9.]+$' | xargs printf '%.6f ') == \
  "$(printf '%.6f ' $volumes)" ]] || fail "compare finds other volumes than $volumes: $out"

# To standard error if the mesh goes to standard output, by whatever name.
code=0
tetstream simplify in.tets - --ratio 0.5 >piped.tets 2>"$logs/err" || code=$?
[[ $code == 0 ]] || fail "exit code $code"
contains "$(<"$logs/err")" "collapses"
[[ $(bytes_of piped.tets) == "$(bytes_of out.tets)" ]] || fail "the report went into the mesh"
tetstream simplify in.tets /dev/stdout --format tets --ratio 0.5 2>"$logs/err" |
  cat >by-device.tets
contains "$(<"$logs/err")" "collapses"
[[ $(cells_in by-device.tets) == "$(cells_in out.tets)" ]] || fail "/dev/stdout is not the same"

expect 0 simplify in.tets out.tets --ratio 0.5 --quiet
[[ -z $out$err ]] || fail "--quiet is not quiet: $out$err"
expect 0 simplify in.tets out.tets --ratio 0.5 --quiet --report json
json=$out
[[ $(member "$json" status) == '"TETSTREAM_OK"' ]] || fail "wrong status"
[[ $(member "$json" cells_in) == "$(cells_in in.tets)" ]] || fail "wrong cells_in"
[[ $(member "$json" cells_out) == "$(cells_in out.tets)" ]] || fail "wrong cells_out"
(($(member "$json" collapses) > 0)) || fail "no collapses"
[[ $(member "$json" estimated_error) =~ ^[0-9]\.[0-9]+$ ]] || fail "wrong estimated_error"
[[ $(member "$json" reached) == '"ratio"' ]] || fail "wrong reached"
(($(member "$json" peak_resident_bytes) > 0)) || fail "no peak memory"

# Where nothing is measured there is no error to tell, or to ask for.
expect 0 simplify in.tets out.tets --ratio 0.5 --field density:0 --quiet --report json
[[ $(member "$out" estimated_error) == null ]] || fail "an error of nothing: $out"
expect 0 simplify in.tets out.tets --ratio 0.5 --field density:0
contains "$out" "no field is measured"
expect 1 simplify in.tets out.tets --error 1 --field density:0
contains "$err" "no field is measured; the stream has: density"

# The target that was reached first is named.
expect 0 simplify in.tets out.tets --ratio 0.5 --cells 1000 --quiet --report json
[[ $(member "$out" reached) == '"ratio"' ]] || fail "the ratio was reached first: $out"
expect 0 simplify in.tets out.tets --ratio 0.1 --cells 4000 --quiet --report json
[[ $(member "$out" reached) == '"cells"' ]] || fail "the cells were reached first: $out"
expect 0 simplify in.tets out.tets --ratio 0.1 --error 0.1 --quiet --report json
[[ $(member "$out" reached) == '"error"' ]] || fail "the error was reached first: $out"
(($(cells_in out.tets) > 600)) || fail "the error bound has no effect"
# An error alone is no number of cells.
expect 0 simplify in.tets out.tets --error 1
contains_not "$out" ", target"
[[ $out == *$'\nreached       error' ]] || fail "the last row is not the target: $out"

# Every member of the public struct is in it.
struct=$(members_of report)
count=0
while [[ $struct =~ (int64_t|uint64_t|double|char)\ \*?([a-z_0-9,\ ]+)\; ]]; do
  struct=${struct#*"${BASH_REMATCH[0]}"}
  for name in ${BASH_REMATCH[2]//,/ }; do
    member "$json" "$name" >/dev/null
    count=$((count + 1))
  done
done
((count >= 24)) || fail "found only $count members in the header"

# A name that needs escapes, in both kinds of JSON: quote, backslash, tabulator, a byte that is no
# UTF-8.
odd=$'a"b\\c\td\xff.tets'
cp in.tets "$odd"
expect 0 info --json "$odd"
contains "$out" '"file": "a\"b\\c\u0009d\ufffd.tets"'
if [[ -n ${TETSTREAM_PYTHON:-} ]]; then
  "$TETSTREAM_PYTHON" -m json.tool >/dev/null <"$logs/out" || fail "info --json is no JSON"
  printf '%s' "$json" | "$TETSTREAM_PYTHON" -m json.tool >/dev/null || fail "no JSON: $json"
fi
expect_error 1 "--report" simplify in.tets out.tets --ratio 0.5 --report xml
expect 0 simplify in.tets out.tets --ratio 0.5 --json
member "$out" "cells_out" >/dev/null
expect_error 1 "--json" simplify in.tets out.tets --ratio 0.5 --json --report text

# What reader and writer left out is told to programs, too, with or without --quiet.
printf '%s\n' '# vtk DataFile Version 3.0' two ASCII 'DATASET UNSTRUCTURED_GRID' 'POINTS 5 float' \
  '0 0 0 1 0 0 0 1 0 0 0 1 1 1 1' 'CELLS 3 13' '4 0 1 2 3' '4 1 2 3 4' '2 0 1' 'CELL_TYPES 3' 10 10 3 \
  >line.vtk
expect 0 info line.vtk
[[ $err == "tetstream: note: "* ]] || fail "no note of the line: $err"
note=${err#tetstream: note: }
for words in "simplify line.vtk a.tets --ratio 1" "layout line.vtk b.tets" "compare line.vtk line.vtk"; do
  expect 0 $words --report json
  contains "$err" "$note"
  expect 0 $words --quiet --report json
  [[ -z $err ]] || fail "--quiet is not quiet: $err"
  contains "$out" $'"notes": [\n    "'"$note"
done
expect 0 layout b.tets c.tets --quiet --report json
contains "$out" '"notes": []'
