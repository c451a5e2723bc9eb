# Triangles of a .vtu file are labelled faces, and stay so through every format that holds them.
source "${BASH_SOURCE%/*}/common.bash"

# Two cells that share a face; the first one's outer faces are 11, 11 and 12, one of the second 13.
cat >two.vtu <<'END'
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="5" NumberOfCells="6">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 0 1 0 0 0 1 1 1 1</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">
0 1 2 0 1 2 3 0 1 3 0 2 3 1 2 3 4 2 3 4</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3 7 10 13 17 20</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5 10 5 5 10 5</DataArray></Cells>
<CellData><DataArray type="Int32" Name="part" format="ascii">11 1 11 12 2 13</DataArray></CellData>
</Piece></UnstructuredGrid></VTKFile>
END

labels() {
  tetstream info "$1" --json --quiet | tr -d ' \n' | grep -o '"face_labels":\[[^]]*\]'
}
wanted='"face_labels":[{"label":11,"faces":2},{"label":12,"faces":1},{"label":13,"faces":1}]'
[[ $(labels two.vtu) == "$wanted" ]] || fail "wrong labels: $(labels two.vtu)"
expect 0 info two.vtu
contains "$out" "faces         4, labelled"
contains "$out" "11, 2 faces"
contains "$err" '4 triangles are labelled faces, by the cell array "part"'

# Converted there and back, laid out, and through a pipe.
tetstream convert two.vtu two.tets --quiet
tetstream convert two.tets back.vtu --quiet
tetstream convert two.tets back.vtk --quiet
tetstream layout back.vtu laid.tets --order breadth-first --quiet
tetstream convert two.vtu - --quiet >piped.tets
for file in two.tets back.vtu back.vtk laid.tets piped.tets; do
  [[ $(labels "$file") == "$wanted" ]] || fail "$file has other labels: $(labels "$file")"
done
expect 0 info back.vtu
contains "$err" 'by the cell array "face_label"'
contains_not "$out" "cell array    face_label"

# A mesh with labels, simplified: compare tells the areas.
expect 0 compare two.vtu back.vtu
contains "$out" "labels of faces: 3, 0 lost"
contains "$out" "area of 12"
contains "$out" "  0 %"
expect 0 simplify two.vtu out.vtu --ratio 1 --quiet
[[ $(labels out.vtu) == "$wanted" ]] || fail "simplified, it has other labels: $(labels out.vtu)"

# What has no place for faces says so; what is no face is refused, with its place.
expect 0 convert two.vtu two.sva
contains "$err" "the labels of boundary faces are left out"
sed 's/^0 1 2 0 1 2 3/0 1 4 0 1 2 3/' two.vtu >stray.vtu
expect_error 2 "stray.vtu: labelled face 0 is the face of no cell" simplify stray.vtu out.vtu --ratio 1 --quiet
sed 's/ 0 2 3 1 2 3 4 2 3 4</ 0 1 3 1 2 3 4 2 3 4</' two.vtu >twice.vtu
expect_error 2 "labelled faces 1 and 2 have the same vertices" simplify twice.vtu out.vtu --ratio 1 --quiet
[[ $(labels out.vtu) == "$wanted" ]] || fail "the output was touched"
sed 's/^0 1 2 0 1 2 3/0 1 5 0 1 2 3/' two.vtu >broken.vtu
expect_error 2 "cell 0 uses point 5, there are 5" simplify broken.vtu out.vtu --ratio 1 --quiet
