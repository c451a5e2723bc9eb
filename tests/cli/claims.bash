# A hundred bytes that claim 2^60 points or cells are refused at once: what a file says of its size
# is checked against the bytes that are there before memory or disk are taken for it.
source "${BASH_SOURCE%/*}/common.bash"

most=1152921504606846976
mkdir tmp
export TMPDIR=$PWD/tmp

# Little memory, where nothing else needs much of it for itself.
if [[ -z ${TETSTREAM_LAUNCHER:-} && ${TETSTREAM_SANITIZED:-} != 1 ]]; then
  ulimit -v 400000 # KB
fi
ulimit -f 2000 # KB

# refuses FILE TEXT: the text of printf as the file, which is bad data.
refuses() {
  # shellcheck disable=SC2059
  printf "$2" >"$1"
  ((${#2} < 700)) || fail "$1 is no small file"
  begin=$(date +%s%N)
  expect_error 2 "$1" convert "$1" out.tets
  took=$((($(date +%s%N) - begin) / 1000000)) # ms
  [[ -n ${TETSTREAM_LAUNCHER:-} ]] || ((took < 3000)) || fail "$1: $took ms for a small file"
  [[ ! -e out.tets && -z $(ls -A tmp) ]] || fail "$1: files are left"
}

points='0 0 0\n1 0 0\n0 1 0\n0 0 1\n'
refuses points.mesh "MeshVersionFormatted 2\nDimension 3\nVertices\n$most\n$points"
refuses cells.mesh "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0
0 0 1 0\nTetrahedra\n$most\n1 2 3 4 0\nEnd\n"
refuses points.su2 "NDIME= 3\nNELEM= 1\n10 0 1 2 3 0\nNPOIN= $most\n$points"
refuses cells.su2 "NDIME= 3\nNELEM= $most\n10 0 1 2 3 0\nNPOIN= 4\n$points"
refuses points.msh "\$MeshFormat\n2.2 0 8\n\$EndMeshFormat\n\$Nodes\n$most\n1 0 0 0\n"
refuses cells.msh "\$MeshFormat\n2.2 0 8\n\$EndMeshFormat\n\$Nodes\n1\n1 0 0 0\n\$EndNodes
\$Elements\n$most\n1 4 2 1 1 1 2 3 4\n"
refuses new.msh "\$MeshFormat\n4.1 0 8\n\$EndMeshFormat\n\$Nodes\n1 $most 1 $most\n3 1 0 $most\n1\n0 0 0\n"
refuses binary.msh "\$MeshFormat\n4.1 1 8\n\1\0\0\0\n\$EndMeshFormat\n\$Nodes
\0\0\0\0\0\0\0\20\0\0\0\0\0\0\0\20\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\20"
refuses points.meshb '\1\0\0\0\3\0\0\0\3\0\0\0\24\0\0\0\0\0\0\0\3\0\0\0\4\0\0\0\377\377\377\177\0\0\0\0\377\377\377\177'
refuses points.vtk "# vtk DataFile Version 3.0\nx\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS $most float\n0 0 0\n"
refuses text.vtk "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS $most float\n0 0 0\n"
refuses cells.vtk "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n$points
CELLS $most 4611686018427387904\n4 0 1 2 3\n"
refuses cells.vtu '<VTKFile type="UnstructuredGrid" header_type="UInt64"><UnstructuredGrid>
<Piece NumberOfPoints="1152921504606846976" NumberOfCells="1152921504606846976"><Points>
<DataArray type="Float32" NumberOfComponents="3" format="appended" offset="0"/></Points><Cells>
<DataArray type="Int64" Name="connectivity" format="appended" offset="0"/>
<DataArray type="Int64" Name="offsets" format="appended" offset="0"/>
<DataArray type="UInt8" Name="types" format="appended" offset="0"/></Cells></Piece>
</UnstructuredGrid><AppendedData encoding="raw">_\0\0\0\0\0\0\0\20abc</AppendedData></VTKFile>'
refuses cells.sva "# svtype tet\n# nverts $most\n# ncells $most\n# v_pnum_f 0\nv 0 0 0\n"
refuses cells.svb '\4\0\0\0\0\0\0\0\377\377\377\177\377\377\377\177\4\0\0\0\0\0\0\0'
printf '4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n' >cells.node
refuses cells.ele "$most 4 0\n1 1 2 3 4\n"
printf '1 4 0\n1 1 2 3 4\n' >points.ele
refuses points.node "$most 3 0 0\n1 0 0 0\n"
