# diagram draws what its extension says, refuses before any work what it cannot draw, and leaves no
# part of a picture.
source "${BASH_SOURCE%/*}/common.bash"

tetstream generate ball --cells 6000 in.tets
begins() { [[ $(head -c "${#2}" "$1" | tr -d '\0') == "$2" ]] || fail "$1 does not begin with $2"; }

if [[ $(tetstream --version) == *"no cairo"* ]]; then
  expect_error 6 "cairo" diagram in.tets out.svg
  only_files in.tets
  exit 0
fi

# Nothing was read when these are refused: the input is not even there.
for name in out.gif out svg -; do
  expect_error 6 "ends in .svg or .png" diagram absent.tets "$name"
done
expect_error 3 "absent/out.svg" diagram absent.tets absent/out.svg
expect_error 1 "--columns" diagram absent.tets out.svg --columns 0
expect_error 1 "--rows" diagram absent.tets out.svg --rows 10000
expect_error 1 "OUT" diagram in.tets
expect_error 3 "absent.tets" diagram absent.tets out.svg
head -c 3000 in.tets >cut.tets
expect_error 2 "cut.tets" diagram cut.tets out.svg
if [[ -c /dev/full ]]; then
  ln -s /dev/full full.svg
  expect_error 3 "full.svg" diagram in.tets full.svg
  rm full.svg
fi
only_files in.tets cut.tets
rm cut.tets

for sweep in "" --sweep; do
  # shellcheck disable=SC2086  # no word, or one
  expect 0 diagram in.tets out.svg $sweep
  [[ -z $out$err ]] || fail "diagram says: $out$err"
  begins out.svg "<?xml"
  [[ $(tail -n 1 out.svg) == "</svg>" ]] || fail "out.svg does not end as SVG does"
  # shellcheck disable=SC2086
  expect 0 diagram in.tets out.png $sweep --title "A mesh" --columns 30 --rows 20
  begins out.png $'\x89PNG'
done
only_files in.tets out.svg out.png

# Where cairo cannot be loaded, that is said, before anything is read.
mkdir lib
echo "no library at all" >lib/libcairo.so.2
LD_LIBRARY_PATH=$PWD/lib expect_error 6 "cairo, which could not be loaded" diagram absent.tets a.svg
rm -r lib

# Standard input is a mesh like any other.
tetstream convert in.tets - | tetstream diagram - piped.svg || fail "no diagram from a pipe"
begins piped.svg "<?xml"

# After a failure what was there before is there.
before=$(bytes_of out.svg)
head -c 3000 in.tets >cut.tets
expect_error 2 "cut.tets" diagram cut.tets out.svg
[[ $(bytes_of out.svg) == "$before" ]] || fail "a failure changed the old picture"
only_files in.tets cut.tets out.svg out.png piped.svg
