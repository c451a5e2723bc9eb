# Damage in the middle of a stream, found after much was written, leaves no output.
source "${BASH_SOURCE%/*}/common.bash"

tetstream generate fluid --cells 50000 whole.tets
size=$(stat -c %s whole.tets)

# refuses ARGUMENTS...: exit code 2, one line, and no file but the two inputs.
refuses() {
  expect_error 2 "tets" "$@"
  only_files broken.tets whole.tets
}

# Cut off.
head -c $((size / 2)) whole.tets >broken.tets
refuses simplify broken.tets out.tets --ratio 0.1
refuses convert broken.tets out.vtu
refuses info broken.tets
head -c $((size - 1)) whole.tets >broken.tets
refuses simplify broken.tets out.tets --ratio 0.1

# Overwritten.
{
  head -c $((size / 2)) whole.tets
  printf 'damaged!'
  tail -c +$((size / 2 + 9)) whole.tets
} >broken.tets
[[ $(stat -c %s broken.tets) == "$size" ]] || fail "the test damages the wrong way"
refuses simplify broken.tets out.tets --ratio 0.1
refuses convert broken.tets out.sva

# The same from a pipe.
code=0
head -c $((size / 2)) whole.tets |
  tetstream simplify - out.tets --ratio 0.1 2>"$logs/err" || code=$?
[[ $code == 2 ]] || fail "a pipe that was cut off: exit code $code"
only_files broken.tets whole.tets
