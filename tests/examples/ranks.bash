# Parts of a mesh that are simplified by processes of their own still fit together: joined they are one
# mesh, of the topology and volume of the whole, which can be simplified across the seams.
# ranks.bash MPIEXEC FLAG: how processes are started, and what stands before their number.
source "${BASH_SOURCE%/*}/common.bash"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1
launcher="$1 $2"

# ranks CODE PROCESSES ARGUMENTS...
ranks() {
  local wanted=$1 launch=$launcher
  launcher="$launcher $2"
  example "$wanted" ranks "${@:3}"
  launcher=$launch
}

all=$(cells_in "$bracket")
for processes in 1 3; do
  ranks 0 $processes "$bracket" part 0.25
  [[ $(grep -c '^part' <<<"$out") == "$processes" ]] || fail "not $processes parts: $out"
  cells=$(awk '/^part/ { sum += $5 } END { print sum }' <<<"$out")
  ((cells * 4 <= all && cells * 5 > all)) || fail "$cells of $all cells are left"
  [[ $(cells_in part.pvtu) == "$cells" ]] || fail "other cells in the parts"
  expect 0 simplify part.pvtu whole.vtu --ratio 0.4
  ((processes == 1)) || contains "$err" "were joined"
  expect 0 compare "$bracket" whole.vtu
  contains "$out" "topology: kept"
done
[[ $(echo part* whole*) == "part-0.vtu part-1.vtu part-2.vtu part.pvtu whole.vtu" ]] ||
  fail "files: $(echo *)"

# Names of labels that the parts do not have.
printf '%s\n' '$MeshFormat' '4.1 0 8' '$EndMeshFormat' '$PhysicalNames' 1 '3 5 "steel"' '$EndPhysicalNames' \
  '$Entities' '0 0 0 1' '1 0 0 0 1 1 1 1 5 0' '$EndEntities' '$Nodes' '1 5 1 5' '3 1 0 5' 1 2 3 4 5 \
  '0 0 0' '1 0 0' '0 1 0' '0 0 1' '1 1 1' '$EndNodes' '$Elements' '1 2 1 2' '3 1 4 2' '1 1 2 3 4' \
  '2 2 3 4 5' '$EndElements' >named.msh
contains "$(tetstream info named.msh)" "steel"
ranks 0 2 named.msh named
[[ $(cells_in named.pvtu) == 2 ]] || fail "the mesh with names has other cells"

ranks 1 2 "$bracket" nowhere/part
contains "$err" "nowhere/part-"
ranks 1 2 nothing.vtu part
contains "$err" "nothing.vtu: cannot open"
ranks 1 2 "$bracket"
contains "$err" "usage: "
