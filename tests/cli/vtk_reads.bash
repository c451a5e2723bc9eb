# VTK reads what we write, and we what VTK writes, in every way it has, value for value.
source "${BASH_SOURCE%/*}/common.bash"

python=${TETSTREAM_PYTHON:-python3}
script=${BASH_SOURCE%/*}/vtk_reads.py
[[ -z ${TETSTREAM_LAUNCHER:-} ]] || not_run "not the plain program"
"$python" -c "import numpy, vtk" 2>"$logs/python" || not_run "Python has no module vtk"

# vtk_says ARGUMENTS...: the script, which must agree and be silent.
vtk_says() {
  "$python" "$script" "$@" >"$logs/vtk" 2>&1 || fail "$*: VTK does not agree"
  [[ ! -s $logs/vtk ]] || fail "$*: VTK is not silent"
}

expect 0 --version
version=$out
formats=(vtu vtk)
[[ $version == *", hdf5,"* ]] && formats+=(vtkhdf)

expect 0 generate ball --cells 300 mesh.vtu
vtk_says write .
pairs=()
for file in *-*.vtu *.vtk; do
  [[ $file == *-lz4-* && $version == *"no lz4"* ]] && continue
  [[ $file == *-lzma-* && $version == *"no lzma"* ]] && continue
  expect 0 convert "$file" "ours.$file.vtk"
  [[ -z $err ]] || fail "$file: not all of it is read: $err"
  pairs+=("$file" "ours.$file.vtk")
done
for format in "${formats[@]}"; do
  for compress in yes no; do
    [[ $format == vtk ]] && set -- || set -- --compress "$compress"
    expect 0 convert raw-none-32.vtu "$compress.$format" "$@"
    pairs+=(raw-none-32.vtu "$compress.$format")
  done
done
vtk_says same "${pairs[@]}"

# Cells of other shapes: VTK's mesh of all of them becomes tetrahedra that fill it face to face.
vtk_says shapes .
filled=()
for file in shapes.vtu shapes.vtk; do
  expect_error 6 "only tetrahedra are read, unless other cells are to be split into them (option split, --split)" \
    convert "$file" none.vtu
  expect 0 convert "$file" "filled.$file.vtu" --split
  contains "$err" "cells that are no tetrahedra are split"
  filled+=("filled.$file.vtu")
done
vtk_says fills "${filled[@]}"

# Exodus II.
vtk_says blocks .
expect 0 convert blocks.exo ours.blocks.vtu
vtk_says same blocks.vtu ours.blocks.vtu
expect 0 convert blocks.vtu ours.blocks.exo
vtk_says same blocks.vtu ours.blocks.exo
