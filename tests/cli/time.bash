# The time of values: from file to file through every command that writes a mesh, shown by info, told
# where a format has no place for it.
source "${BASH_SOURCE%/*}/common.bash"

printf '%s\n' '$MeshFormat' '2.2 0 8' '$EndMeshFormat' '$Nodes' 5 '1 0 0 0' '2 1 0 0' '3 0 1 0' \
  '4 0 0 1' '5 1 1 1' '$EndNodes' '$Elements' 2 '1 4 2 4 1 1 2 3 4' '2 4 2 5 2 2 3 4 5' \
  '$EndElements' '$NodeData' 1 '"T"' 1 0.1 3 7 1 5 '1 1' '2 2' '3 3' '4 4' '5 5' '$EndNodeData' >in.msh

expect 0 info in.msh
contains "$out" 'time          0.1'
expect 0 info in.msh --json
contains "$out" '"time": 0.1'

# Each of the formats that hold it, after the other.
expect 0 simplify in.msh a.tets --ratio 1 --quiet
tetstream layout a.tets - --order breadth-first --quiet --format tets |
  tetstream convert - b.vtu --format-in tets --quiet || fail "a pipe of layout and convert"
contains "$(<b.vtu)" 'Name="TimeValue" NumberOfTuples="1" format="ascii">0.1</DataArray>'
expect 0 convert b.vtu c.exo
contains_not "$err" 'time'
expect 0 convert c.exo d.msh --encoding text --msh-version 2.2
contains "$(<d.msh)" $'$NodeData\n1\n"T"\n1\n0.1\n3\n'
expect 0 convert d.msh e.msh
expect 0 info e.msh
contains "$out" 'time          0.1'

formats=(vtk)
expect 0 --version
[[ $out == *", hdf5,"* ]] && formats+=(vtkhdf)
for format in "${formats[@]}"; do
  expect 0 convert d.msh "f.$format"
  contains_not "$err" 'time'
  expect 0 info "f.$format"
  contains "$out" 'time          0.1'
done

expect 0 convert d.msh f.sva
contains "$err" '.sva has no time of its values; it is left out: 0.1'

# It stands beside data.
sed '/NodeData/,$d' in.msh >bare.msh
expect 0 convert bare.msh bare.vtu --quiet
sed 's|<Piece|<FieldData><DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">0.1\
</DataArray></FieldData><Piece|' bare.vtu >timed.vtu
expect 0 convert timed.vtu bare.msh
contains "$err" 'without data there is no time, either; it is left out: 0.1'

# Of a .pvd that of the step counts, or else that of its file.
for step in 'timestep="7" 7' ' 0.1'; do
  echo "<VTKFile type=\"Collection\"><Collection><DataSet ${step% *} file=\"timed.vtu\"/></Collection></VTKFile>" >one.pvd
  expect 0 info one.pvd --json
  contains "$out" "\"time\": ${step##* },"
done

# Of two times nobody knows which counts.
{ cat in.msh && sed -n '/NodeData/,$p' in.msh | sed 's/"T"/"U"/; s/ 0.1 3 / 0.2 3 /; s/^0.1$/0.2/'; } >two.msh
expect 0 info two.msh --json
contains "$out" '"time": null'
contains "$out" '"U"'

# 0 is what is written where none is known.
sed 's/^0.1$/0/' d.msh >zero.msh
expect 0 info zero.msh --json
contains "$out" '"time": null'
expect 0 convert zero.msh g.vtu --quiet
contains_not "$(<g.vtu)" 'TimeValue'
