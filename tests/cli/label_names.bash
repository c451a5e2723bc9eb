# Names of labels: from file to file through every command that writes a mesh, shown by info, told
# where a format has no place for them.
source "${BASH_SOURCE%/*}/common.bash"

printf '%s\n' '$MeshFormat' '2.2 0 8' '$EndMeshFormat' '$PhysicalNames' 3 '1 7 "edge"' \
  '2 9 "outer wall"' '3 4 "steel"' '$EndPhysicalNames' '$Nodes' 5 '1 0 0 0' '2 1 0 0' '3 0 1 0' \
  '4 0 0 1' '5 1 1 1' '$EndNodes' '$Elements' 3 '1 2 2 9 1 1 2 3' '2 4 2 4 1 1 2 3 4' \
  '3 4 2 5 2 2 3 4 5' '$EndElements' >in.msh

expect 0 info in.msh
contains "$out" 'cell label    4, steel'
contains "$out" 'face label    9, 1 faces, outer wall'
contains "$err" '1 names of physical groups that label no cells or faces are left out'

expect 0 simplify in.msh a.tets --ratio 1 --quiet
tetstream layout a.tets - --order breadth-first --quiet --format tets |
  tetstream convert - b.tets --format-in tets --quiet || fail "a pipe of layout and convert"
expect 0 convert b.tets c.msh --msh-version 2.2 --encoding text
contains_not "$err" note
contains "$(<c.msh)" $'$PhysicalNames\n2\n2 9 "outer wall"\n3 4 "steel"\n$EndPhysicalNames'
expect 0 info c.msh --json
contains "$out" '"cell_array": null'
contains "$out" '"name": "outer wall"'
contains "$out" '"cell_array": "gmsh:physical"'
contains "$out" '"name": "steel"'

expect 0 convert c.msh d.vtu
contains "$err" '.vtu has no names of labels; they are left out: faces 9 "outer wall", "gmsh:physical" 4 "steel"'

# Exodus has blocks and side sets.
expect 0 convert c.msh e.exo
contains_not "$err" 'left out: faces'
expect 0 info e.exo
contains "$out" 'cell label    4, steel'
contains "$out" 'face label    9, 1 faces, outer wall'
expect 0 convert e.exo f.msh --encoding text --msh-version 2.2 --quiet
contains "$(<f.msh)" $'$PhysicalNames\n2\n2 9 "outer wall"\n3 4 "steel"\n$EndPhysicalNames'

# Compared, labels have their names.
expect 0 compare b.tets b.tets "${less_boundary[@]}"
contains "$out" $'\n  volume of 4, steel '
contains "$out" $'\n  area of 9, outer wall '
expect 0 compare b.tets b.tets --report json --quiet "${less_boundary[@]}"
contains "$(tr -d ' \n' <<<"$out")" '"label":9,"name":"outerwall",'
contains "$(tr -d ' \n' <<<"$out")" '"label":5,"name":null,'
