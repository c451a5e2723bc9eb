# The cells that a map names are those of the output's file, whatever its format: also where they stand
# in blocks, or with labelled faces, as in the manual's example.
source "${BASH_SOURCE%/*}/common.bash"

python=${TETSTREAM_PYTHON:-python3}
script=${BASH_SOURCE%/*}/map_formats.py
[[ -z ${TETSTREAM_LAUNCHER:-} ]] || not_run "not the plain program"
"$python" -c "import numpy, vtk" 2>"$logs/python" || not_run "Python has no module vtk"

expect 0 --version
outputs=(tets vtu vtk sva svb msh mesh meshb exo)
[[ $out == *", hdf5,"* ]] && outputs+=(vtkhdf)

# simplified OUT [FLAG...]: with a map beside it.
simplified() {
  expect 0 simplify labelled.vtu "$1" --ratio 0.2 --regions none --map "${1%.*}.tetmap" "${@:2}"
}

# with_map FILE MAP [OF]: to be looked at at the end, all at once: Python takes long to start.
with_maps=()
with_map() {
  with_maps+=("$1" "$2" "${3:-}")
}

tetstream generate fluid mesh.vtu --cells 6000 --quiet
"$python" "$script" labels mesh.vtu labelled.vtu

# By VTK, if it reads that, and as we read it, in the file's order.
checked() {
  simplified "$@"
  local map=${1%.*}.tetmap numbered=()
  [[ $1 == *.exo || ($1 == *.msh && $* != *2.2*) ]] && numbered=("$1")
  case $1 in
    *.vtu | *.vtk | *.vtkhdf | *.exo) with_map "$1" "$map" "${numbered[@]}" ;;
  esac
  expect 0 convert "$1" "read $1.vtu" --order none
  with_map "read $1.vtu" "$map" "${numbered[@]}"
}
for format in "${outputs[@]}"; do
  checked "$format.$format"
done
checked text.msh --encoding text
checked old.msh --msh-version 2.2
checked "old text.msh" --msh-version 2.2 --encoding text
# We read cells of post-order in the order in which their vertices have come.
simplified post.sva --vertex-order post
with_map post.sva post.tetmap
"$python" "$script" agrees labelled.vtu "${with_maps[@]}" >"$logs/agrees" 2>&1 ||
  fail "a file and its map do not agree"

# A note tells of blocks, if there is a map.
simplified told.msh
told=$err
expect 0 info told.msh
[[ $out =~ faces\ +([0-9]+), ]] || fail "told.msh has no faces"
contains "$told" "told.msh: cells stand in blocks: cell N of the map is the element with the tag N + $((BASH_REMATCH[1] + 1))"
expect 0 simplify labelled.vtu told.msh --ratio 0.2 --regions none
contains_not "$err" "the tag N"
words="cells stand in blocks: cell N of the map is the element that elem_num_map numbers N + 1"
simplified told.exo
contains "$err" "told.exo: $words"
expect 0 simplify labelled.vtu told.exo --ratio 0.2 --regions none
contains_not "$err" "elem_num_map"
expect 0 info told.exo
contains_not "$out" "num_map"

simplified small.vtu
carrying_back >example.py
"$python" example.py >"$logs/example" 2>&1 || fail "the manual's example does not run"
"$python" "$script" carried labelled.vtu fine.npy >"$logs/carried" 2>&1 ||
  fail "a linear field is carried back as another"
