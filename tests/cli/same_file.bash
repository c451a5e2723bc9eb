# Input and output may be the same file.
source "${BASH_SOURCE%/*}/common.bash"

tetstream generate fluid --cells 6000 mesh.tets
tetstream simplify mesh.tets other.tets --ratio 0.5 --quiet
tetstream simplify mesh.tets mesh.tets --ratio 0.5 --quiet
[[ $(bytes_of mesh.tets) == "$(bytes_of other.tets)" ]] || fail "in place gives another mesh"

tetstream convert mesh.tets mesh.vtu
before=$(cells_in mesh.vtu)
tetstream convert mesh.vtu ./mesh.vtu
[[ $(cells_in mesh.vtu) == "$before" ]] || fail "convert in place loses cells"
only_files mesh.tets mesh.vtu other.tets
