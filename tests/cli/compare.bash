# compare tells what it measured, for people and as JSON, whatever the memory; draws; refuses.
source "${BASH_SOURCE%/*}/common.bash"

cells=10000
is_slow && cells=3000
tetstream generate ball --cells $cells in.tets
tetstream simplify in.tets out.vtu --ratio 0.2 --quiet

# A mesh is itself.
expect 0 compare in.tets in.tets --report json --quiet "${less_boundary[@]}"
[[ $(member "$out" topology_kept) == true ]] || fail "a mesh has another topology than itself"
[[ $(member "$out" outside_volume) == 0 ]] || fail "a mesh is outside itself: $out"
expect 0 compare in.tets out.vtu
for words in "topology: kept" "density" "velocity" "Euler characteristic" "simplified to original" \
  "least dihedral angle" "outside the simplified mesh" ", by about 200000 points and all vertices"; do
  contains "$out" "$words"
done
[[ -z $err ]] || fail "a report is enough: $err"
expect 0 compare in.tets out.vtu --quiet "${less_boundary[@]}"
[[ -z $out$err ]] || fail "--quiet is not quiet: $out$err"

# Every figure of the public structs is told, and little memory gives the same ones.
expect 0 compare in.tets out.vtu --quiet --report json "${less_boundary[@]}"
json=$out
count=0
for name in comparison_info mesh_figures field_comparison region_comparison; do
  [[ $name == region_comparison ]] && continue # there are none in this mesh
  struct=$(members_of $name)
  while [[ $struct =~ (int32_t|int64_t|uint64_t|double|char)\ \*?([a-z_0-9,\ ]+)(\[3\])?\; ]]; do
    struct=${struct#*"${BASH_REMATCH[0]}"}
    for word in ${BASH_REMATCH[2]//,/ }; do
      contains "$json" "\"$word\": "
      count=$((count + 1))
    done
  done
done
((count >= 50)) || fail "found only $count members in the header"
expect 0 compare in.tets out.vtu --quiet --report json --memory 3M "${less_boundary[@]}"
small=$out
(($(member "$small" peak_bytes) < 3 << 20)) || fail "--memory is passed: $small"
if [[ -n ${TETSTREAM_PYTHON:-} ]]; then
  printf '%s' "$json" >large.json
  printf '%s' "$small" >small.json
  "$TETSTREAM_PYTHON" - <<'PYTHON' || fail "--memory changes the figures"
import json, sys
def numbers(value, path=""):
    if isinstance(value, dict):
        for key, inner in value.items():
            if key not in ("seconds", "peak_bytes") and "place" not in key:
                yield from numbers(inner, path + "." + key)
    elif isinstance(value, list):
        for i, inner in enumerate(value):
            yield from numbers(inner, f"{path}[{i}]")
    else:
        yield path, value
large, small = (dict(numbers(json.load(open(f"{name}.json")))) for name in ("large", "small"))
bad = [(p, v, small[p]) for p, v in large.items()
       if v != small[p] and abs(v - small[p]) > 1e-9 * max(abs(v), 1e-6)]
print(bad, file=sys.stderr)
sys.exit(bool(bad) or large.keys() != small.keys())
PYTHON
fi

# By samples, about the same; one field alone; a pipe.
expect 0 compare in.tets out.vtu --quiet --report json --samples 20k --field density
[[ $(member "$out" is_exact) == false ]] || fail "samples are not exact"
[[ $(member "$out" field_count) == 1 ]] || fail "one field was asked for"
expect 0 compare in.tets out.vtu --samples 500
contains "$out" ", by about 500 points and all vertices"
expect 0 compare in.tets out.vtu --samples 500 --quiet --report json
awk -v few="$(member "$out" rms_distance)" -v many="$(member "$json" rms_distance)" \
  'BEGIN { exit few == many || few < 0.7 * many || few > 1.4 * many }' ||
  fail "a boundary at 500 points is not about that at 200000"
expect 0 compare in.tets out.vtu --boundary-samples 2000 --quiet --report json
[[ $(member "$out" is_exact) == true && $(member "$out" boundary_samples) == 2000 ]] ||
  fail "fields are no longer exact, or the boundary has other points: $out"
awk -v few="$(member "$out" rms_distance)" -v many="$(member "$json" rms_distance)" \
  'BEGIN { exit few == many || few < 0.8 * many || few > 1.2 * many }' ||
  fail "a boundary at 2000 points is not about that at 200000"
tetstream convert in.tets - |
  tetstream compare - out.vtu --quiet --report json "${less_boundary[@]}" >"$logs/piped" ||
  fail "no comparison of a pipe"
[[ $(member "$(<"$logs/piped")" distance) == "$(member "$json" distance)" ]] || fail "a pipe differs"

# Fields that only one of them has are told, unless fields were asked for.
{
  printf '%s\n' '# vtk DataFile Version 3.0' one ASCII 'DATASET UNSTRUCTURED_GRID' \
    'POINTS 4 double' '0 0 0 1 0 0 0 1 0 0 0 1' 'CELLS 1 5' '4 0 1 2 3' 'CELL_TYPES 1' 10
  printf '%s\n' 'POINT_DATA 4' 'FIELD f 4' 'same 1 4 double' '1 2 3 4' 'flat 1 4 double' '3 3 3 3'
} >one.vtk
cp one.vtk two.vtk
printf '%s\n' 'u 3 4 double' '1 2 3 4 5 6 7 8 9 1 2 3' 't:1 1 4 double' '1 2 3 4' >>one.vtk
printf '%s\n' 't:1 2 4 double' '1 2 3 4 5 6 7 8' >>two.vtk
printf '%s\n' 'v 1 4 double' '1 2 3 4' >>two.vtk
sed -i -e 's/^FIELD f 4/FIELD f 10/' -e 's/^3 3 3 3/3 3 3 4/' two.vtk
for i in 1 2 3 4 5 6; do printf '%s\n' "w$i 1 4 double" '1 2 3 4' >>two.vtk; done
expect 0 compare one.vtk two.vtk
contains "$out" $'\n  left out, only in the original: u\n'
contains "$out" $'\n  left out, only in the simplified mesh: v, w1, w2, w3, w4, w5 and 1 more\n'
contains "$out" $'\n  left out, with other components in the simplified mesh: t:1\n'
# Nor has a field of no range a ratio of it to its error, or the volume changed.
[[ $out =~ flat\ +[0-9.]+\ +[0-9.]+\ +none\  ]] || fail "a constant field has a CPSNR: $out"
[[ $out =~ volume\ +[0-9.]+\ +[0-9.]+\ +0\ % ]] || fail "the volume has changed: $out"
expect 0 compare one.vtk two.vtk --report json
contains "$(tr -d ' \n' <<<"$out")" \
  '"only_original":["u","t:1"],"only_simplified":["t:1","v","w1","w2","w3","w4","w5","w6"]'
[[ $(member "${out#*'"name": "flat"'}" cpsnr) == null ]] || fail "a constant field has a CPSNR: $out"
expect 0 compare one.vtk two.vtk --field same
contains_not "$out" "left out"
expect_error 1 'field "t:1" has 1 components in the original, 2 after' compare one.vtk two.vtk --field t:1

# What cannot be.
rm -f large.json small.json one.vtk two.vtk
expect_error 1 "standard input" compare - -
expect_error 1 "nothing" compare in.tets out.vtu --field nothing
expect_error 1 "--cut" compare in.tets out.vtu --cut x
expect_error 1 "x=0.3" compare in.tets out.vtu --picture a.svg --cut w=1
expect_error 1 "--cut none" compare in.tets out.vtu --picture a.svg --cut none
expect_error 1 "--title" compare in.tets out.vtu --title "Two balls"
for memory in 1 2 3 64; do
  expect_error 4 "too small" compare in.tets out.vtu --memory $memory
done
expect_error 6 ".svg or .png" compare in.tets out.vtu --picture a.gif
expect_error 3 "absent.tets" compare absent.tets out.vtu
head -c 9000 in.tets >cut.tets
expect_error 2 "cut.tets" compare in.tets cut.tets
expect_error 2 "cut.tets" compare cut.tets in.tets
expect_error 4 "" compare in.tets out.vtu --memory 100k
only_files in.tets out.vtu cut.tets
[[ $(tetstream --version) == *"no cairo"* ]] && exit 0
# In a plane of our choice a gap between two bodies is drawn; one that was named is refused.
printf 'MeshVersionFormatted 2 Dimension 3 Vertices 8\n%s\nTetrahedra 2 1 2 3 4 0 5 6 7 8 0 End\n' \
  "0 0 0 0 2 0 0 0 0 2 0 0 0 0 0.1 0 0 0 1 0 0 2 1 0 2 0 1 0 0 0 0.9 0" > gap.mesh
expect 0 compare gap.mesh gap.mesh --quiet --picture gap.svg "${less_pixels[@]}"
expect_error 1 "the cut at z = 0.5 meets no cell" compare gap.mesh gap.mesh --picture gap2.svg \
  --cut z=0.5 "${less_pixels[@]}"
rm gap.mesh gap.svg
for picture in a.svg a.png; do
  expect 0 compare in.tets out.vtu --quiet --picture $picture --cut z=0.1 --title "Two balls" \
    "${less_pixels[@]}"
done
expect_error 1 "the cut at x = 1e+09 meets no cell: the original lies in -1:1" compare in.tets \
  out.vtu --picture b.png --cut x=1e9 "${less_pixels[@]}"
[[ $(head -c 5 a.svg) == "<?xml" && $(tail -n 1 a.svg) == "</svg>" ]] || fail "a.svg is no SVG"
[[ $(head -c 4 a.png | tr -d '\0') == $'\x89PNG' ]] || fail "a.png is no PNG"
only_files in.tets out.vtu cut.tets a.svg a.png

# Labels in floats are regions where they are named, of a simplification and of its comparison.
printf '%s\n' '# vtk DataFile Version 3.0' halves ASCII 'DATASET UNSTRUCTURED_GRID' 'POINTS 5 float' \
  '0 0 0 1 0 0 0 1 0 0 0 1 1 1 1' 'CELLS 2 10' '4 0 1 2 3' '4 1 2 3 4' 'CELL_TYPES 2' 10 10 \
  'CELL_DATA 2' 'SCALARS part float 1' 'LOOKUP_TABLE default' 4 7 'SCALARS heat float 1' \
  'LOOKUP_TABLE default' 4 7.5 >halves.vtk
expect 0 simplify halves.vtk halves.tets --ratio 1 --regions part
contains "$out" $'\nregions       by part'
expect 0 compare halves.vtk halves.tets --regions part
contains "$out" "regions, by part: 2, 0 lost"
contains "$out" "volume of 7"
expect 0 compare halves.vtk halves.tets
contains "$out" "regions: none"
for command in "simplify halves.vtk no.tets --ratio 1" "compare halves.vtk halves.tets"; do
  expect 2 $command --regions heat
  contains "$err" 'cell 1 has 7.5 in "heat"'
done
[[ ! -e no.tets ]] || fail "what could not be made is there"

# A plate whose vertices all lie on the boundary: memory does not grow with them.
# (With sanitizers a smaller one, which fits either way.)
n=120
is_slow && n=40
awk -v n=$n 'function at(x, y, z) { return (x * (n + 1) + y) * 2 + z }
  BEGIN {
    count = 2 * (n + 1) * (n + 1)
    print "# vtk DataFile Version 3.0\nplate\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " count " float"
    for (x = 0; x <= n; ++x) for (y = 0; y <= n; ++y) for (z = 0; z < 2; ++z) print x, y, z / 2
    print "CELLS " 6 * n * n " " 30 * n * n
    split("421 412 142 124 241 214", axes, " ")
    for (x = 0; x < n; ++x) for (y = 0; y < n; ++y) for (k = 1; k <= 6; ++k) {
      line = "4 " at(x, y, 0)
      for (bits = j = 0; j < 3; ++j) {
        bits += substr(axes[k], j + 1, 1)
        line = line " " at(x + (bits >= 4), y + (int(bits / 2) % 2), bits % 2)
      }
      print line
    }
    print "CELL_TYPES " 6 * n * n
    for (c = 0; c < 6 * n * n; ++c) print 10
  }' >plate.vtk
expect 0 compare plate.vtk plate.vtk --boundary-samples 1000 --memory 2040000 --quiet --report json
(($(member "$out" peak_bytes) < 2040000)) || fail "--memory is passed: $out"
[[ $(member "$out" distance) =~ ^[0-9.]+e-|^0 ]] || fail "a plate is off itself: $out"

# Sizes of which areas are no numbers are refused; others are the same in every unit.
for scale in 1e-120 1e-67 1e67 1e110; do
  awk '/^POINTS/ { print $1, $2, "double"; on = 1; next } /^CELLS/ { on = 0 }
    on { print $1 s_of, $2 s_of, $3 s_of; next } { print }' s_of="${scale#1}" plate.vtk >scaled.vtk
  case $scale in
    *67) expect 0 compare scaled.vtk scaled.vtk --boundary-samples 1000 --quiet --report json ;;
    *)
      expect 6 compare scaled.vtk scaled.vtk --boundary-samples 1000
      contains "$err" "areas and volumes are numbers of float64 from 1e-70 to 1e+70 only"
      ;;
  esac
done
