# Every format into every format, by name and through standard input and output.
source "${BASH_SOURCE%/*}/common.bash"
set -o pipefail

formats=(tets vtu vtk sva svb)
expect 0 --version
[[ $out == *", hdf5,"* ]] && formats+=(vtkhdf)
tetstream generate ball --cells 1000 mesh.tets
cells=$(cells_in mesh.tets)
for format in "${formats[@]:1}"; do
  tetstream convert mesh.tets "mesh.$format" 2>"$logs/err"
  [[ $(cells_in "mesh.$format") == "$cells" ]] || fail "$format has other cells"
done

# Endings as other systems write them.
expect 0 convert mesh.tets UPPER.VTU
[[ $(cells_in UPPER.VTU) == "$cells" ]] || fail "an ending in capitals is not known"
expect 0 convert mesh.tets UPPER.VTK.GZ
[[ $(head -c 2 UPPER.VTK.GZ | od -An -tx1) == " 1f 8b" ]] || fail "nor .GZ"
[[ $(cells_in UPPER.VTK.GZ) == "$cells" ]] || fail "nor .GZ where it is read"

# Those that share everything with .vtu but their bytes: into and out of .tets is enough.
for in in "${formats[@]}"; do
  for out_format in "${formats[@]}"; do
    [[ $in == tets || $out_format == tets || $in$out_format != *vtk* ]] || continue
    expect 0 convert "mesh.$in" "$in-named.$out_format"
    [[ $(cells_in "$in-named.$out_format") == "$cells" ]] || fail "$in to $out_format loses cells"
    tetstream convert - - --format-in "$in" --format "$out_format" --quiet <"mesh.$in" |
      tetstream convert - "$in-piped.$out_format" --format "$out_format" --quiet
    [[ $(cells_in "$in-piped.$out_format") == "$cells" ]] ||
      fail "$in to $out_format loses cells in pipes"
  done
done

# What a format cannot hold is said, and not said with --quiet.
expect 0 convert mesh.tets lossy.svb
contains "$err" "tetstream: note: "
contains "$err" "velocity"
expect 0 convert mesh.tets lossy.svb --quiet
[[ -z $err ]] || fail "--quiet is not quiet: $err"

# --format is for "-"; with two names for OUT, against its extension.
expect 0 convert mesh.vtu odd.name --format tets
[[ $(cells_in odd.name --format tets) == "$cells" ]] || fail "--format does not set OUT's format"
tetstream convert - named.vtu --format sva <mesh.sva
[[ $(cells_in named.vtu) == "$cells" ]] || fail "--format changed OUT's format though IN is -"

tetstream convert - told.name --format-in sva --format tets <mesh.sva
[[ $(cells_in told.name --format tets) == "$cells" ]] ||
  fail "--format is not of OUT where --format-in is of -"

# Properties of the writer.
expect 0 convert mesh.tets post.sva --vertex-order post
[[ $(cells_in post.sva) == "$cells" ]] || fail "post-order loses cells"
[[ $(bytes_of post.sva) != "$(bytes_of mesh.sva)" ]] || fail "--vertex-order post changes nothing"
expect 0 convert mesh.tets plain.vtu --compress no
(($(stat -c %s plain.vtu) > $(stat -c %s mesh.vtu))) || fail "--compress no changes nothing"
expect_error 1 "the format vtu has no --vertex-order" convert mesh.tets none.vtu --vertex-order post
expect_error 1 "the format tets has no --msh-version" convert mesh.vtu none.tets --msh-version 4.0
expect_error 1 '--msh-version: "4.0" is neither "4.1" nor "2.2"' convert mesh.vtu none.msh --msh-version 4.0
expect_error 1 '--compress: "perhaps" is neither "yes" nor "no"' convert mesh.tets none.vtu --compress perhaps
[[ ! -e none.vtu ]] || fail "a refused property left a file"
