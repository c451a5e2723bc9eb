# What breaks the rules of a mesh is told with the file and the place in it, also where it is found out
# only once the file is read, or in another order.
source "${BASH_SOURCE%/*}/common.bash"

# medit FILE LAST: cells around an edge, the last of them LAST, its points counted from 1.
medit() {
  printf 'MeshVersionFormatted 2\nDimension 3\nVertices 6\n0 0 0 0\n0 0 1 0\n1 0 0 0\n' >"$1"
  printf '0 1 0 0\n-1 0 0 0\n0 -1 0 0\nTetrahedra 4\n1 2 3 4 0\n1 2 4 5 0\n1 2 5 6 0\n%s 0\nEnd\n' "$2" >>"$1"
}
medit good.mesh "1 2 6 3"
medit twice.mesh "1 6 6 3"
printf '# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\n' >nan.vtk
printf 'CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\nPOINT_DATA 4\nSCALARS f float\nLOOKUP_TABLE default\n0 1 nan 3\n' >>nan.vtk
tetstream convert good.mesh good.vtk

# refuses TEXT ARGUMENTS...: nothing is left.
refuses() {
  expect_error 2 "$@"
  only_files good.mesh twice.mesh good.vtk nan.vtk
}
twice="twice.mesh: cell 3: point 5 is there twice"
refuses "$twice" convert twice.mesh out.tets
refuses "$twice" convert twice.mesh out.tets --order none
for name in e.vtu e.exo e.mesh e.xdmf e.tets; do
  : >"$name"
  expect_error 2 "$name: is empty" info "$name"
  rm "$name"
done
cp twice.mesh tetstream_mesh
expect_error 2 "tetstream_mesh: cell 3" info tetstream_mesh --format mesh
rm tetstream_mesh
refuses "$twice" convert twice.mesh out.tets --order spectral
refuses "$twice" simplify twice.mesh out.tets --ratio 0.5
refuses "$twice" info twice.mesh
refuses "$twice" compare twice.mesh good.vtk
refuses "$twice" compare good.vtk twice.mesh
refuses "nan.vtk: point 2: its f is not finite" simplify nan.vtk out.tets --ratio 0.5
refuses "nan.vtk: point 2: its f is not finite" compare nan.vtk nan.vtk --field f
