# Gmsh's, MEDIT's, TetGen's and SU2's files: what goes out comes back, with names and types or a
# note; other cells; .gz and .zst.
source "${BASH_SOURCE%/*}/common.bash"

tetstream generate ball --cells 1000 mesh.tets
cells=$(cells_in mesh.tets)
expect 0 convert mesh.tets direct.vtu --quiet
expect 0 convert direct.vtu direct.sva --order none --quiet

# The same cells, values, types and names.
for way in "--encoding binary" "--encoding text" "--msh-version 2.2" \
  "--msh-version 2.2 --encoding text"; do
  # shellcheck disable=SC2086
  expect 0 convert mesh.tets way.msh $way --quiet
  expect 0 convert way.msh back.sva --order none --quiet
  cmp direct.sva back.sva || fail "msh $way does not give back the mesh"
done
for format in mesh meshb; do
  expect 0 convert mesh.tets "way.$format"
  contains "$err" "fields and cell data are written to way.sol"
  contains "$err" '"density"'
  expect 0 info "way.$format" --json
  [[ $(member "$out" cells) == "$cells" ]] || fail "$format has other cells"
  contains "$out" '"sol1"'
  expect 0 convert "way.$format" "back-$format.msh" --order none --quiet
done

# Through pipes, where the format can be streamed; .sol has no place there.
tetstream convert - - --format-in msh --format meshb --quiet <way.msh |
  tetstream convert - piped.msh --format-in meshb --quiet
[[ $(cells_in piped.msh) == "$cells" ]] || fail "pipes lose cells"
expect_error 6 "two files" convert - none.tets --format-in tetgen <mesh.tets

# gzip and zstd: by the name when written, by the first bytes when read.
kinds=gz
expect 0 --version
[[ $out == *zstd* ]] && kinds="gz zst"
expect 0 convert mesh.tets beside.mesh --quiet
gzip beside.sol && mv beside.sol.gz beside.sol
expect 0 info beside.mesh
contains "$out" "field"
rm beside.*
for kind in $kinds; do
  for format in sva msh mesh vtu tets; do
    expect 0 convert mesh.tets "packed.$format.$kind" --quiet
    (($(stat -c %s "packed.$format.$kind") > 100)) || fail "packed.$format.$kind is empty"
    [[ $(cells_in "packed.$format.$kind") == "$cells" ]] || fail "$format.$kind loses cells"
    mv "packed.$format.$kind" "named.$format"
    [[ $(cells_in "named.$format") == "$cells" ]] || fail "$kind under another name"
    rm "named.$format"
  done
  # What a file names, and what lies beside it, may be wrapped as well.
  expect 0 convert mesh.tets "piece.vtu.$kind" --quiet
  printf '<VTKFile type="Collection"><Collection><DataSet timestep="0" file="piece.vtu.%s"/>%s' \
    "$kind" '</Collection></VTKFile>' >one.pvd
  [[ $(cells_in one.pvd) == "$cells" ]] || fail "a piece in $kind is not read"
  rm one.pvd "piece.vtu.$kind"
  expect 0 convert mesh.tets "cut.sva.$kind" --quiet
  head -c 1000 "cut.sva.$kind" >short.sva
  expect_error 2 "ends within its compressed data" convert short.sva none.tets
done
[[ ! -e none.tets ]] || fail "a damaged input left a file"

# Every way of the formats is listed.
expect 0 --version
for name in msh mesh meshb tetgen su2 exodus xdmf pvd; do contains "$out" $'\n'"  $name "; done

# Cells that are no tetrahedra.
cat >prism.mesh <<'END'
MeshVersionFormatted 2
Dimension 3
Vertices 7
0 0 0 0
1 0 0 0
0 1 0 0
0 0 1 0
1 0 1 0
0 1 1 0
0 0 2 0
Prisms 1
1 2 3 4 5 6 3
Tetrahedra 1
4 5 6 7 5
Quadrilaterals 1
1 2 5 4 8
End
END
expect_error 6 "prism.mesh: line 12: cell 1 is a prism" convert prism.mesh none.tets
expect 0 convert prism.mesh split.tets --split
contains "$err" "1 cells that are no tetrahedra are split"
[[ $(cells_in split.tets) == 4 ]] || fail "a prism and a tetrahedron are not four"
expect 0 info prism.mesh --split
expect 0 simplify prism.mesh split.msh --split --cells 4 --quiet

# TetGen's and SU2's, which are only read.
printf '4 3 1 0\n0 0 0 0 5\n1 1 0 0 6\n2 0 1 0 7\n3 0 0 1 8\n' >one.node
printf '1 4 1\n0 0 1 2 3 4\n' >one.ele
expect 0 info one.ele --json
contains "$out" '"attribute0"'
contains "$out" '"region"'
expect 0 info one.node
printf 'NDIME= 3\nNELEM= 1\n10 0 1 2 3\nNPOIN= 4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n' >one.su2
[[ $(cells_in one.su2) == 1 ]] || fail "one cell of SU2"
expect_error 6 "read, but not written" convert mesh.tets none.su2
expect_error 6 "does not tell the format, and none is given (--format, --format-in); there are tets, vtu, vtk, " convert mesh.tets none.stl
contains_not "$err" "su2"
expect_error 6 "read, but not written" convert mesh.tets none.ele

# Time steps, of .vtu and .pvtu files that a .pvd file names; each has its own cells.
for cells in 100 200 300; do expect 0 generate ball --cells $cells "step$cells.vtu"; done
cat >steps.pvtu <<'END'
<VTKFile type="PUnstructuredGrid"><PUnstructuredGrid><Piece Source="step300.vtu"/></PUnstructuredGrid></VTKFile>
END
cat >steps.pvd <<'END'
<VTKFile type="Collection"><Collection>
<DataSet timestep="0.5" part="0" file="steps.pvtu"/>
<DataSet timestep="0.25" part="0" file="step200.vtu"/>
<DataSet timestep="0" part="0" file="step100.vtu"/>
</Collection></VTKFile>
END
for way in 100:first 100:0 200:1 300:2 300:last; do
  expect 0 info steps.pvd --json --step "${way#*:}"
  step=$(member "$out" cells)
  [[ $step == $(cells_in "step${way%:*}.vtu") ]] || fail "--step ${way#*:} has $step cells"
done
sed 's/timestep="0"/timestep="nan"/' steps.pvd >step.nan.pvd
expect_error 2 "step.nan.pvd: byte 148: a timestep is no number" info step.nan.pvd
sed 's/timestep="0.5"/timestep="  +0.5D0 "/' steps.pvd >step.fortran.pvd
expect 0 info step.fortran.pvd
contains "$out" "time          0.5"
sed 's/timestep="[^"]*"//; /file="step[1-9]/d' steps.pvd >step.untold.pvd
expect 0 info step.untold.pvd --json
contains "$out" '"time": null'
expect 0 info steps.pvd
contains "$err" "of 3 time steps, 0 to 2, step 2 is read, at time 0.5"
contains "$out" "time          0.5"
expect_error 1 "there is no time step 3 (option step, --step): there are 0 to 2" \
  convert steps.pvd none.tets --step 3
# A step that one of several steps is not is an error in either mesh.
expect_error 1 "there is no time step 3" compare steps.pvd steps.pvd --step 3
sed '/file="step100/d' steps.pvd >step.two.pvd
expect_error 1 "there is no time step 2" compare steps.pvd step.two.pvd --step 2

# What was made of a step, of joined points or of cell arrays is compared with where it came from.
for name in step.tets step.vtu; do
  expect 0 simplify steps.pvd $name --step 1 --ratio 0.5 --cells-to-points --quiet
  expect 0 compare steps.pvd $name --step 1 --cells-to-points --join-points yes \
    "${less_boundary[@]}"
  contains "$out" "topology: kept"
done
for file in step100.vtu step.tets step.msh; do
  [[ $file == *.vtu ]] || expect 0 convert step100.vtu $file --quiet
  expect_error 6 "$file: there is no time step 1 (option step, --step): there are none" \
    info $file --step 1
  expect 0 info $file --step first
  expect 0 info $file --step 0
done
expect_error 1 '"next" is neither first nor last nor a number from 0' info steps.pvd --step next
rm -f step*

# Lies about sizes are found at once.
printf '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1152921504606846976\n1 0 0 0\n' >lie.msh
(
  [[ -n ${TETSTREAM_LAUNCHER:-} || $TETSTREAM_SANITIZED == 1 ]] || ulimit -v 4000000
  expect_error 2 "lie.msh: line 5: 1152921504606846976 nodes cannot be" info lie.msh
)
rm -f ./*.sol ./*.solb
only_files back.sva back-mesh.msh back-meshb.msh direct.sva direct.vtu lie.msh mesh.tets one.ele one.node \
  one.su2 piped.msh prism.mesh short.sva split.msh split.tets way.mesh way.meshb way.msh \
  $(for kind in $kinds; do echo "cut.sva.$kind"; done)

# What is there a thousand times and more costs neither time nor memory for each.
expect 0 convert mesh.tets few.msh --encoding text --msh-version 2.2 --quiet
{ cat few.msh; for ((i = 0; i < 1200; ++i)); do printf '$S%d\n$EndS%d\n' $i $i; done; } >sections.msh
expect 0 info sections.msh
contains "$err" "the section \$S998 is left out"
contains "$err" "further notes are left out"
[[ $err != *S999* ]] || fail "more notes than there should be"
{
  cat few.msh
  for ((i = 0; i < 16385; ++i)); do
    printf '$NodeData\n1\n"n%d"\n1\n0\n3\n0\n1\n0\n$EndNodeData\n' $i
  done
} >arrays.msh
expect_error 6 "there are more than 16384 arrays" info arrays.msh

# The largest integer, which .msh rounds to a double beyond it.
cat >largest.vtk <<'END_OF_FILE'
# vtk DataFile Version 3.0
one cell
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 4 double
0 0 0 1 0 0 0 1 0 0 0 1
CELLS 1 5
4 0 1 2 3
CELL_TYPES 1
10
CELL_DATA 1
SCALARS number long 1
LOOKUP_TABLE default
9223372036854775807
END_OF_FILE
expect 0 convert largest.vtk largest.msh --quiet
expect 0 convert largest.msh largest.sva --quiet
grep -q 9223372036854775807 largest.sva || fail "the largest integer is another one"
