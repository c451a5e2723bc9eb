# Meshes as their authors wrote them: what they hold is known from others' readers. "not run" without
# the folder TETSTREAM_MESHES.
source "${BASH_SOURCE%/*}/common.bash"
meshes=${TETSTREAM_MESHES:-}/native
[[ -n ${TETSTREAM_MESHES:-} && -d $meshes ]] || not_run "no TETSTREAM_MESHES"

# holds FILE VERTICES CELLS WORDS...: the counts, and words in the notes or the text.
holds() {
  local file=$1 vertices=$2 cells=$3
  shift 3
  expect 0 info "$meshes/$file" --json
  [[ $(member "$out" cells) == "$cells" ]] || fail "$file has $(member "$out" cells) cells"
  [[ $(member "$out" vertices) == "$vertices" ]] || fail "$file: $(member "$out" vertices) vertices"
  for word in "$@"; do contains "$out$err" "$word"; done
}

holds palace_ring_disk.msh 14120 84177 'gmsh:physical' '"farfield"' '"domain"'
holds pylith_strikeslip_tet.msh 3713 18425 'gmsh:physical' '"material-id:1"' \
  '233 lines are left out'
holds mmg_tinyBoxt.mesh 11866 63434 'medit:ref' '"sol"' 'mmg_tinyBoxt.sol' \
  'the section Normals is left out'
holds refine_cube_sphere.meshb 5062 26260 'the section Edges is left out'
holds HumanWedgeMesh.node 18411 97200 'region'
holds su2_pipe.su2 9919 41402 'zone' '"component_sidewall_4"'

holds 3D_Ridgecrest_mesh_tri.exo 9847 49982 'block_id' '"elastic_ypos"' \
  '12 node sets are left out'

# Each simplified into each format that is written, and back. The antenna of the first one is made of
# sheets of labelled faces inside a region. In a slow run each into two formats, others each time.
formats=(msh mesh meshb vtu tets exo)
few=${#formats[@]}
is_slow && few=2
for file in palace_ring_disk.msh mmg_tinyBoxt.mesh 3D_Ridgecrest_mesh_tri.exo; do
  rm -f small.*  # the .sol file of another mesh
  for format in "${formats[@]:0:few}"; do
    expect 0 simplify "$meshes/$file" "small.$format" --ratio 0.1 --report json --quiet
    cells=$(member "$out" cells_out)
    [[ $(cells_in "small.$format") == "$cells" ]] || fail "$file as $format: not $cells cells"
  done
  formats=("${formats[@]:few}" "${formats[@]:0:few}")
done
