# The isosurface of a bar whose field depends on x alone is a plane: its area is known, where it runs
# through cells and where it runs along their faces. (That it is VTK's: isosurface_vtk.bash.)
source "${BASH_SOURCE%/*}/common.bash"

# area_of FILE: of the triangles of an OBJ, each of which comes after its points.
area_of() {
  awk '$1 == "v" { ++n; for (k = 0; k < 3; ++k) p[n, k] = $(k + 2) }
    $1 == "f" {
      if ($2 > n || $3 > n || $4 > n) exit 1
      for (k = 0; k < 3; ++k) { a[k] = p[$3, k] - p[$2, k]; b[k] = p[$4, k] - p[$2, k] }
      x = a[1] * b[2] - a[2] * b[1]; y = a[2] * b[0] - a[0] * b[2]; z = a[0] * b[1] - a[1] * b[0]
      sum += sqrt(x * x + y * y + z * z) / 2
    }
    END { print sum + 0 }' "$1"
}

if is_slow; then length=48 cells=20000; else length=200 cells=200000; fi
example 0 04_reader $length bar.tets
for value in 0.2 0.25; do  # 0.25 is at points: x = 1/2
  example 0 isosurface bar.tets heat $value plane.obj
  near "$(area_of plane.obj)" "$((length / 8))" 0.01
  example 0 isosurface bar.tets heat $value plane.obj 1
  near "$(area_of plane.obj)" "$((length / 8))" 0.001
done

# What is in core is the front and a batch, not the mesh.
expect 0 generate fluid fluid.tets --cells $cells
example 0 isosurface fluid.tets density 2 fluid.obj 1
[[ $out =~ ([0-9]+)\ triangles,\ ([0-9]+)\ points,\ at\ most\ ([0-9]+)\ of\ ([0-9]+)\ vertices ]] ||
  fail "not these words: $out"
((BASH_REMATCH[1] > 500)) || fail "$out"
is_slow || ((BASH_REMATCH[3] * 10 < BASH_REMATCH[4])) || fail "$out"
(($(grep -c ^f fluid.obj) == BASH_REMATCH[1] && $(grep -c ^v fluid.obj) == BASH_REMATCH[2])) ||
  fail "not as many are in the file: $out"

# No surface, and failures, which leave no file.
example 0 isosurface fluid.tets density 99 none.obj
[[ $out == "0 triangles, 0 points, "* && ! -s none.obj ]] || fail "a surface where there is none"
example 1 isosurface fluid.tets pressure 2 out.obj
contains "$err" "no such field"
example 1 isosurface fluid.tets velocity 2 out.obj
contains "$err" "no such field of one float"
example 1 isosurface fluid.tets density 2 out.obj 7
contains "$err" "ratio"
example 1 isosurface nothing.tets density 2 out.obj
contains "$err" "nothing.tets"
[[ ! -e out.obj ]] || fail "a failed run leaves a file"
