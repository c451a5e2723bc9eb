# The shared problem with the command, as README.md states it: awk writes the mesh as text.
set -eu

awk -v boxes=12 'BEGIN {
  side = boxes + 1
  split("1 " side " " side * side, step, " ")
  split("1 2 3 1 3 2 2 1 3 2 3 1 3 1 2 3 2 1", way, " ")
  print "# vtk DataFile Version 3.0\nthe shared problem\nASCII\nDATASET UNSTRUCTURED_GRID"
  print "POINTS", side ^ 3, "double"
  for (p = 0; p < side ^ 3; p++) {
    x = p % side; y = int(p / side) % side; z = int(p / side / side)
    print x / 4, y / 4, z / 4
    pressure = pressure (x * x * y - 3 * z) "\n"
    velocity = velocity (y - z) " " (x * z) " " (x + y) "\n"
  }
  print "CELLS", 6 * boxes ^ 3, 30 * boxes ^ 3
  for (c = 0; c < 6 * boxes ^ 3; c++) {
    box = int(c / 6); x = box % boxes; y = int(box / boxes) % boxes; z = int(box / boxes / boxes)
    corner = x + side * (y + side * z)
    line = "4 " corner
    for (i = 1; i <= 3; i++) line = line " " (corner += step[way[c % 6 * 3 + i]])
    print line
    material = material (x < boxes / 2 ? 1 : 2) "\n"
    types = types "10\n"
  }
  printf "CELL_TYPES %d\n%s", 6 * boxes ^ 3, types
  printf "CELL_DATA %d\nSCALARS material int 1\nLOOKUP_TABLE default\n%s", 6 * boxes ^ 3, material
  printf "POINT_DATA %d\nSCALARS pressure double 1\nLOOKUP_TABLE default\n%s", side ^ 3, pressure
  printf "VECTORS velocity float\n%s", velocity
}' >problem.vtk

"$TETSTREAM_COMMAND" simplify problem.vtk command.tets --ratio 0.2 --boundary-weight 4 \
  --regions material --field pressure --field velocity:0.5
