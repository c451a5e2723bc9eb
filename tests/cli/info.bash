# info tells what stands in a file that can be read by eye.
source "${BASH_SOURCE%/*}/common.bash"

# Two cells that share a face: four vertices are active at once, and after the first cell that cell
# still touches three of them.
cat >two.sva <<'END'
# svtype tet
# nverts 5
# ncells 2
# v_pnum_f 4
# c_pnum_i 1
v 0 0 0 0.5
v 1 0 0 -1.5
v 0 1 0 0.5
v 0 0 1 0.5
c -4 2 3 4 10
v 1 1 2 2.25
c -4 -3 -2 -1 20
END
expect 0 info two.sva
for row in "vertices      5" "cells         2" "box           0 .. 1, 0 .. 1, 0 .. 2" \
  "1 x float32, -1.5 .. 2.25" "1 x int32" "front width   4 vertices" "front cells   1"; do
  contains "$out" "$row"
done
expect 0 info --json - --format sva <two.sva
json=$out
expect 0 info --report json - --format sva <two.sva
[[ $out == "$json" ]] || fail "info --report json is not info --json"
for pair in indexed:false vertices:5 cells:2 front_width:4 front_cells:1 components:1 \
  mean_width:4 mean_span:4 mean_life:1.6 longest_life:2 window_cells:64; do
  [[ $(member "$json" "${pair%:*}") == "${pair#*:}" ]] || fail "${pair%:*} is not ${pair#*:}"
done
if [[ -n ${TETSTREAM_PYTHON:-} ]]; then
  "$TETSTREAM_PYTHON" -m json.tool >/dev/null <"$logs/out" || fail "info --json is no JSON"
fi

# An indexed mesh says so; its counts stay.
tetstream convert two.sva two.vtu
expect 0 info two.vtu
contains "$out" "indexed"
[[ $(cells_in two.vtu) == 2 ]] || fail "wrong number of cells"
