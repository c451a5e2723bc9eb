#!/usr/bin/env bash
# bash seeds.bash COMMAND EXODUS_SEEDS FOLDER: makes the seeds of the fuzz targets, small files of
# every format, with the tetstream command. The formats that it does not write are written here, or
# by the program exodus_seeds.
set -eu
command=$(realpath "$1") exodus_seeds=$(realpath "$2") folder=$3
rm -rf "$folder"
mkdir -p "$folder"/{tets,vtu,pvtu,pvd,vtk,vtkhdf,exodus,xdmf,sva,svb,msh,mesh,meshb,tetgen,su2}
mkdir -p "$folder"/{wrapped,push,work}
cd "$folder/work"

convert() { "$command" convert --quiet "$@"; }
has() { "$command" --version | grep -q "^  $1 "; }

"$command" generate fluid --cells 24 small.tets --quiet
"$command" generate ball+stress --cells 60 ball.tets --quiet

cp small.tets ball.tets ../tets
convert small.tets ../tets/plain.tets --compress no
"$command" simplify --quiet ball.tets ../tets/simplified.tets --ratio 0.5 >report || true
convert small.tets ../vtu/small.vtu
convert small.tets ../vtu/plain.vtu --compress no
convert small.tets ../vtk/small.vtk
if has vtkhdf; then
  convert small.tets ../vtkhdf/small.vtkhdf --compress no
  convert small.tets ../vtkhdf/packed.vtkhdf
fi
for format in sva svb; do
  convert small.tets ../$format/pre.$format --vertex-order pre
  convert small.tets ../$format/post.$format --vertex-order post
done
for version in 4.1 2.2; do
  for encoding in text binary; do
    convert small.tets ../msh/$version-$encoding.msh --msh-version $version --encoding $encoding
  done
done

# Several files, with a line between them.
join() {
  local name=$1 first=$2
  shift 2
  cp "$first" "$name"
  for file; do
    printf '\n@@@@\n' >>"$name"
    cat "$file" >>"$name"
  done
}
convert small.tets m.mesh
convert small.tets m.meshb
join ../mesh/fields m.mesh m.sol
join ../meshb/fields m.meshb m.solb
cp m.mesh ../mesh/alone
cp m.meshb ../meshb/alone

cat >../vtk/text.vtk <<'END'
# vtk DataFile Version 3.0
two cells
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 5 float
0 0 0  1 0 0  0 1 0  0 0 1  1 1 1
CELLS 3 14
4 0 1 2 3
4 1 2 3 4
3 0 1 2
CELL_TYPES 3
10 10 5
CELL_DATA 3
SCALARS region int 1
LOOKUP_TABLE default
1 2 3
POINT_DATA 5
VECTORS v float
0 0 0 1 1 1 2 2 2 3 3 3 4 4 4
FIELD more 1
s 1 5 double
1 2 3 4 5
END

cat >../vtu/text.vtu <<'END'
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="5" NumberOfCells="2">
<PointData><DataArray type="Float32" Name="s" format="ascii">1 2 3 4 5</DataArray></PointData>
<CellData><DataArray type="Int32" Name="region" format="ascii">1 2</DataArray></CellData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 0 1 0 0 0 1 1 1 1</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3 1 2 3 4</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4 8</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10 10</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>
END
cat >p.pvtu <<'END'
<VTKFile type="PUnstructuredGrid" version="0.1" byte_order="LittleEndian">
<PUnstructuredGrid GhostLevel="0"><PPointData><PDataArray type="Float32" Name="s"/></PPointData>
<PPoints><PDataArray type="Float64" NumberOfComponents="3"/></PPoints>
<Piece Source="0.vtu"/><Piece Source="1.vtu"/></PUnstructuredGrid></VTKFile>
END
sed 's/0 0 0 1 0 0 0 1 0 0 0 1 1 1 1/1 0 0 0 1 0 0 0 1 1 1 1 2 2 2/' ../vtu/text.vtu >1.vtu
join ../pvtu/two p.pvtu ../vtu/text.vtu 1.vtu
join ../pvtu/packed p.pvtu ../vtu/small.vtu ../vtu/plain.vtu
cat >steps.pvd <<'END'
<?xml version="1.0"?>
<VTKFile type="Collection" version="0.1" byte_order="LittleEndian"><Collection>
<DataSet timestep="0" group="" part="0" file="0.vtu"/>
<DataSet timestep="0.5" group="" part="0" file="0.vtu"/>
<DataSet timestep="0.5" group="" part="1" file="1.vtu"/>
</Collection></VTKFile>
END
join ../pvd/steps steps.pvd ../vtu/text.vtu 1.vtu
join ../pvd/packed steps.pvd ../vtu/small.vtu ../vtu/plain.vtu
sed 's/0.5\(.*\)file="0.vtu"/1\1file="a.pvtu"/' steps.pvd >pieces.pvd
join ../pvd/pieces pieces.pvd ../vtu/text.vtu 1.vtu p.pvtu

"$exodus_seeds" ../exodus

# Labels with names.
cat >../msh/names.msh <<'END'
$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
2 9 "wall"
3 4 "steel"
$EndPhysicalNames
$Nodes
5
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 1 1 1
$EndNodes
$Elements
4
1 2 2 0 3 2 3 4
2 2 2 9 1 1 2 3
3 4 2 4 1 1 2 3 4
4 4 2 5 1 2 3 4 5
$EndElements
END
convert ../msh/names.msh ../tets/names.tets --compress no
convert ../msh/names.msh ../exodus/names.exo

# XDMF: values in its text, in an HDF5 file, of which VTKHDF is one, and steps that share a mesh.
cat >mesh.xdmf <<'END'
<?xml version="1.0"?>
<!DOCTYPE Xdmf SYSTEM "Xdmf.dtd" []>
<Xdmf Version="3.0" xmlns:xi="http://www.w3.org/2001/XInclude"><Domain>
<Grid Name="mesh" GridType="Uniform">
<Topology TopologyType="Tetrahedron" NumberOfElements="2"><DataItem Dimensions="2 4"
 NumberType="Int" Format="XML">0 1 2 3 1 2 3 4</DataItem></Topology>
<Geometry GeometryType="XYZ"><DataItem Dimensions="5 3" NumberType="Float" Precision="8"
 Format="XML">0 0 0 1 0 0 0 1 0 0 0 1 1 1 1</DataItem></Geometry>
<Attribute Name="rho" AttributeType="Scalar" Center="Cell"><DataItem Dimensions="2 1"
 Format="XML">7 8</DataItem></Attribute>
<Attribute Name="u" AttributeType="Vector" Center="Node"><DataItem Dimensions="5 3" Format="XML">
0 1 2 3 4 5 6 7 8 9 10 11 12 13 14</DataItem></Attribute></Grid>
END
{ cat mesh.xdmf; printf '</Domain></Xdmf>\n'; } >../xdmf/text
step() {
  cat <<END
<Grid Name="$1" GridType="Uniform"><xi:include
 xpointer="xpointer(//Grid[@Name=&quot;mesh&quot;]/*[self::Topology or self::Geometry])"/>
<Time Value="$2"/><Attribute Name="$1" AttributeType="Scalar" Center="Node"><DataItem
 Dimensions="5 1" Format="XML">$3</DataItem></Attribute></Grid>
END
}
{
  cat mesh.xdmf
  for name in p q; do
    printf '<Grid Name="%s" GridType="Collection" CollectionType="Temporal">\n' $name
    step $name 0 '1 2 3 4 5'
    step $name 0.5 '6 7 8 9 10'
    printf '</Grid>\n'
  done
  printf '</Domain></Xdmf>\n'
} >../xdmf/steps
# A function of FEniCS's checkpoints, on an equal mesh.
{
  cat mesh.xdmf
  sed -e 's/.*<Grid Name="mesh"/<Grid Name="f"/' -e '/<Attribute/,$d' -e '1,3d' mesh.xdmf
  printf '<Attribute ItemType="FiniteElementFunction" ElementFamily="CG" ElementDegree="1"'
  printf ' ElementCell="tetrahedron" Name="f" Center="Other" AttributeType="Scalar">'
  for item in '8 UInt 3 0 4 1 0 4 1 2' '5 Float 11 13 14 10 12' '3 UInt 0 4 8'; do
    read -r count type values <<<"$item"
    printf '<DataItem Dimensions="%s 1" NumberType="%s">%s</DataItem>' "$count" "$type" "$values"
  done
  printf '</Attribute></Grid></Domain></Xdmf>\n'
} >../xdmf/function
# Grids of cells and of faces on the same points; entities and references.
{
  cat mesh.xdmf
  for shape in 'Tetrahedron 1 4' 'Triangle 1 3'; do
    read -r type rows nodes <<<"$shape"
    printf '<Grid Name="%s"><xi:include xpointer="xpointer(/Xdmf/Domain/Grid/Geometry)"/>' "$type"
    printf '<Topology TopologyType="%s"><DataItem Dimensions="%s %s" NumberType="Int">' $shape
    seq -s ' ' 1 "$nodes"
    printf '</DataItem></Topology><Attribute Name="%s" Center="Cell"><DataItem Dimensions="%s">' \
      "$type" "$rows"
    printf '7</DataItem></Attribute></Grid>\n'
  done
  printf '</Domain></Xdmf>\n'
} >../xdmf/beside
cat >../xdmf/named <<'END'
<!DOCTYPE Xdmf SYSTEM "Xdmf.dtd" [<!ENTITY Two "1 2">]>
<Xdmf Version="2.0"><Domain><DataItem Name="points" Dimensions="5 3" Format="XML">0 0 0 1 0 0 0 1 0
0 0 1 1 1 1</DataItem><DataItem Name="cells" Dimensions="2 4" NumberType="Int">0 1 2 3 1 2 3 4
</DataItem><Grid><Topology TopologyType="Tetrahedron"><DataItem Reference="XML">
/Xdmf/Domain/DataItem[@Name="cells"]</DataItem></Topology><Geometry><DataItem Reference="XML">
/Xdmf/Domain/DataItem[@Name="points"]</DataItem></Geometry><Attribute Name="p" Center="Cell">
<DataItem ItemType="HyperSlab" Dimensions="2"><DataItem Dimensions="3 1">0 1 2</DataItem><DataItem
Dimensions="4">&Two; 3 4</DataItem></DataItem></Attribute></Grid></Domain></Xdmf>
END
cat >../xdmf/mixed <<'END'
<Xdmf Version="2.0"><Domain><Grid Name="all" GridType="Collection" CollectionType="Spatial">
<Grid Name="a"><Topology TopologyType="Mixed"><DataItem Dimensions="22" NumberType="Int"
 Format="XML">6 0 1 2 3  4 0 1 2  7 0 1 2 3 4  2 2 0 1  1 1 0</DataItem></Topology>
<Geometry Type="X_Y_Z"><DataItem Dimensions="5" Format="XML">0 1 0 0 1</DataItem><DataItem
 Dimensions="5" Format="XML">0 0 1 0 1</DataItem><DataItem Dimensions="5" Format="XML">0 0 0 1 1
</DataItem></Geometry></Grid>
<Grid Name="b"><Topology Type="Tet_10"><DataItem Dimensions="1 10" NumberType="UInt" Precision="8"
 Format="XML">0 1 2 3 4 4 4 4 4 4</DataItem></Topology>
<Geometry><DataItem Dimensions="5 3" Format="XML">1 0 0 2 0 0 1 1 0 1 0 1 1 1 1</DataItem>
</Geometry></Grid></Grid></Domain></Xdmf>
END
cat >raw.xdmf <<'END'
<Xdmf Version="3.0"><Domain><Grid Name="mesh"><Topology TopologyType="Tetrahedron"><DataItem
 Dimensions="1 4" NumberType="UChar" Format="Binary" Seek="2">a.bin</DataItem></Topology>
<Geometry GeometryType="XYZ"><DataItem ItemType="HyperSlab" Dimensions="4 3"><DataItem
 Dimensions="3 2">0 1 1 1 4 3</DataItem><DataItem Dimensions="4 4" NumberType="Short" Precision="2"
 Endian="Big" Format="Binary" Seek="6">a.bin</DataItem></DataItem></Geometry><Attribute Name="p"
 Center="Node"><DataItem ItemType="HyperSlab" Dimensions="4"><DataItem Dimensions="3 1">1 2 4
</DataItem><DataItem Dimensions="8" Format="XML">0 1 0 2 0 3 0 4</DataItem></DataItem></Attribute>
</Grid></Domain></Xdmf>
END
: >none
{
  printf '..\0\1\2\3'
  for row in '\0\0\0' '\1\0\0' '\0\1\0' '\0\0\1'; do
    for value in '\5' ${row//\\/ \\}; do printf "\\0$value"; done
  done
} >raw.bin
join ../xdmf/raw raw.xdmf none raw.bin

if has vtkhdf; then
  cat >hdf.xdmf <<'END'
<Xdmf Version="3.0"><Domain><Grid Name="mesh"><Topology TopologyType="Tetrahedron"><DataItem
 Dimensions="24 4" NumberType="Int" Format="HDF">a.h5:/VTKHDF/Connectivity</DataItem></Topology>
<Geometry GeometryType="XYZ"><DataItem Dimensions="20 3" Format="HDF">a.h5:/VTKHDF/Points</DataItem>
</Geometry><Attribute Name="density" Center="Node"><DataItem Dimensions="20" Format="HDF">
a.h5:/VTKHDF/PointData/density</DataItem></Attribute></Grid></Domain></Xdmf>
END
  join ../xdmf/hdf hdf.xdmf ../vtkhdf/small.vtkhdf
fi

cat >t.node <<'END'
5 3 1 1
1 0 0 0 1.5 0
2 1 0 0 2.5 0
3 0 1 0 3.5 1
4 0 0 1 4.5 1
5 1 1 1 5.5 1
END
printf '2 4 1\n1 1 2 3 4 7\n2 2 3 4 5 8\n' >t.ele
printf '2 1\n1 1 2 3 5\n2 2 3 5 6\n' >t.face
join ../tetgen/faces t.node t.ele t.face
join ../tetgen/cells t.node t.ele
sed 's/^5 3 1 1/5 3 0 0/; s/ [0-9.]* [01]$//' t.node >plain.node
join ../tetgen/plain plain.node t.ele

cat >../su2/two.su2 <<'END'
NDIME= 3
NELEM= 3
10 0 1 2 3 0
10 1 2 3 4 1
14 0 1 4 2 3 2
NPOIN= 5
0 0 0 0
1 0 0 1
0 1 0 2
0 0 1 3
1 1 1 4
NMARK= 1
MARKER_TAG= wall
MARKER_ELEMS= 2
5 0 1 2
5 2 3 4
END
cat >../msh/kinds.msh <<'END'
$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
3 7 "inside"
$EndPhysicalNames
$Nodes
8
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0 0 1
6 1 0 1
7 1 1 1
9 0 1 1
$EndNodes
$Elements
4
1 5 2 7 1 1 2 3 4 5 6 7 9
2 4 2 7 1 1 2 3 5
3 2 2 5 2 1 2 3
4 6 2 7 1 1 2 3 5 6 7
$EndElements
END
printf 'MeshVersionFormatted 2\nDimension 3\nVertices\n6\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 2\n1 0 1 2
0 1 1 2\nTetrahedra\n1\n1 2 3 4 3\nPrisms\n1\n1 2 3 4 5 6 1\nTriangles\n1\n1 2 3 9\nEnd\n' >../mesh/kinds

gzip -n9 <../sva/pre.sva >../wrapped/pre.sva.gz
gzip -n1 <../sva/post.sva >../wrapped/post.sva.gz
if command -v zstd >where; then zstd -q <../sva/pre.sva >../wrapped/pre.sva.zst; fi

# Choices of the target push: any bytes are some, compressed ones as good as random.
"$command" generate ball --cells 4000 choices.tets --quiet
for ((i = 1; i <= 8; ++i)); do
  head -c $((i * 2000)) choices.tets | tail -c $((i * 250)) >../push/$i
done
cd .. && rm -r work
