# The isosurface that is made while a mesh is being simplified has the triangles of VTK's contours of the
# mesh that the command writes.
source "${BASH_SOURCE%/*}/common.bash"
judge=${BASH_SOURCE%/*}/isosurface.py

# same MESH FIELD VALUE RATIO LEAST: as many triangles, at least LEAST, and as large an area.
same() {
  local mesh=$1 field=$2 value=$3 ratio=$4 least=$5 made
  expect 0 simplify "$mesh" small.vtu --ratio "$ratio" --quiet
  example 0 isosurface "$mesh" "$field" "$value" surface.obj "$ratio"
  made=${out%% *}
  "$TETSTREAM_PYTHON" "$judge" same small.vtu "$field" "$value" surface.obj >"$logs/judge" 2>&1 ||
    fail "$mesh, $field = $value, ratio $ratio"
  [[ $(<"$logs/judge") == "$made" && $made -ge $least ]] || fail "$mesh: $made triangles"
}

expect 0 generate ball ball.tets --cells 30000
expect 0 generate fluid fluid.tets --cells 60000
"$TETSTREAM_PYTHON" "$judge" grid grid.vtk
same ball.tets density 1.5 0.1 1000
same fluid.tets density 2 0.1 1000
same "$bracket" von_mises 20 0.1 1000
same grid.vtk field 5 1 132 # through vertices
same grid.vtk field 12 1 0  # at the highest value, which one vertex has
