# compare --box: parts that fill the mesh add up to the whole; topology and shapes are of all;
# little memory and pipes change nothing.
source "${BASH_SOURCE%/*}/common.bash"

cells=10000
is_slow && cells=600
tetstream generate ball --cells $cells in.tets --quiet
tetstream simplify in.tets out.tets --ratio 0.2 --quiet

# name by name: what the parts are to be added to, or the largest of
field() { # field TEXT NAME: of the first field
  member "${1#*'"fields": ['}" "$2"
}
expect 0 compare in.tets out.tets --quiet --report json "${less_boundary[@]}"
whole=$out
[[ $(member "$whole" compared_cells) == $(member "$whole" cells) ]] || fail "the whole is not all"
parts=
for box in ":0.1,:-0.05,:" ":0.1,-0.05:,:0" ":0.1,-0.05:,0:" "0.1:,:,:"; do
  expect 0 compare in.tets out.tets --quiet --report json --box "$box" "${less_boundary[@]}"
  for name in cells euler components volume topology_kept diagonal range; do
    [[ $(member "$out" $name) == $(member "$whole" $name) ]] || fail "$name is that of a part: $box"
  done
  parts+="$(member "$out" compared_cells) $(member "$out" compared_volume) "
  parts+="$(member "$out" outside_volume) $(field "$out" cmse) $(field "$out" largest) "
  parts+="$(member "$out" distance) $(member "$out" distance_back)"$'\n'
done
awk -v cells="$(member "$whole" cells)" -v volume="$(member "$whole" compared_volume)" \
  -v outside="$(member "$whole" outside_volume)" -v cmse="$(field "$whole" cmse)" \
  -v largest="$(field "$whole" largest)" -v there="$(member "$whole" distance)" \
  -v back="$(member "$whole" distance_back)" '
  function differs(a, b, share) { return a - b > share * b || b - a > share * b }
  function most(a, b) { return a > b ? a : b }
  {
    c += $1; v += $2; o += $3; s += $4 * $2
    l = most(l, $5); t = most(t, $6); b = most(b, $7)
    if ($1 == 0 || $4 == 0) bad = "a part is empty"
  }
  END {
    if (c != cells) bad = "cells " c " of " cells
    if (differs(v, volume, 1e-9)) bad = "volume " v " of " volume
    if (differs(o, outside, 1e-6)) bad = "outside " o " of " outside
    if (differs(s, cmse * volume, 1e-6)) bad = "squares " s " of " cmse * volume
    if (differs(l, largest, 1e-9)) bad = "largest " l ", of all " largest
    if (differs(t, there, 0.1) || differs(b, back, 0.1)) bad = "distances " t ", " b
    if (bad) print bad
    exit bad != ""
  }' <<<"${parts%$'\n'}" >"$logs/sums" || fail "parts do not add up to the whole: $(<"$logs/sums")"

# For people; by samples; from a pipe with little memory.
box=-0.3:0.4,-0.3:0.4,-0.3:0.4
expect 0 compare in.tets out.tets --box $box
contains "$out" "of a part of"
contains "$out" "of the part's volume"
contains "$out" "by about 200000 points"
contains "$out" $'original to simplified  none in the box\n'
contains "$out" $'simplified to original  none in the box\n'
expect 0 compare in.tets out.tets --quiet --report json --box $box "${less_boundary[@]}"
inner=$out
[[ $(member "$inner" outside_volume) == 0 ]] || fail "inside something is outside: $inner"
for name in distance rms_distance distance_back rms_distance_back distance_place \
  distance_back_place; do
  [[ $(member "$inner" $name) == null ]] || fail "$name of no boundary: $inner"
done
expect 0 compare in.tets out.tets --quiet --report json --box $box --samples 4000
awk -v few="$(field "$out" rms)" -v exact="$(field "$inner" rms)" \
  'BEGIN { exit few < 0.8 * exact || few > 1.2 * exact }' || fail "samples of a part: $out"
tetstream convert in.tets - --quiet |
  tetstream compare - out.tets --quiet --report json --box $box --memory 3M \
    "${less_boundary[@]}" >"$logs/piped" ||
  fail "no comparison of a pipe"
[[ $(field "$(<"$logs/piped")" rms_percent) == $(field "$inner" rms_percent) ]] ||
  fail "a pipe's part differs: $(<"$logs/piped")"

# A box that is the mesh's own has all of its boundary: a face on any side of a box is in it.
cat >cube.mesh <<'END'
MeshVersionFormatted 2
Dimension 3
Vertices 8
0 0 0 0
1 0 0 0
0 1 0 0
1 1 0 0
0 0 1 0
1 0 1 0
0 1 1 0
1 1 1 0
Tetrahedra 6
1 2 4 8 1
1 4 3 8 1
1 3 7 8 1
1 7 5 8 1
1 5 6 8 1
1 6 2 8 1
End
END
sed 's/^\([01] [01]\) 1 0$/\1 1.1 0/' cube.mesh >taller.mesh
for own in :,:,: 0:1,0:1,0:1 :,:,0.6:1; do
  expect 0 compare cube.mesh taller.mesh --quiet --report json --box $own "${less_boundary[@]}"
  awk -v there="$(member "$out" distance)" 'BEGIN { exit there < 0.0999 || there > 0.1001 }' ||
    fail "the side at 1 is not in $own: $out"
done
rm cube.mesh taller.mesh

# What cannot be.
expect_error 1 'not "0:1"' compare in.tets out.tets --box 0:1
expect_error 1 "it lies in -1:1,-1:1,-1:1" compare in.tets out.tets --box 5:6,:,:
expect_error 1 "--box" simplify in.tets a.tets --ratio 0.5 --box :,:,:
only_files in.tets out.tets
[[ $(tetstream --version) == *"no cairo"* ]] && exit 0
expect 0 compare in.tets out.tets --quiet --picture part.svg --box $box "${less_pixels[@]}"
expect 0 compare in.tets out.tets --quiet --picture whole.svg "${less_pixels[@]}"
cmp -s part.svg whole.svg && fail "the picture of a part is that of the whole"
expect_error 1 "the cut at z = 0.9 meets no cell: the part of the original lies in " compare \
  in.tets out.tets --quiet --picture part.png "${less_pixels[@]}" --box $box --cut z=0.9
only_files in.tets out.tets part.svg whole.svg
