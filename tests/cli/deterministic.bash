# The same seed gives the same bytes; where choices are random, another seed gives another mesh.
source "${BASH_SOURCE%/*}/common.bash"

tetstream generate ball --cells 5000 a.tets --seed 3
tetstream generate ball --cells 5000 b.tets --seed 3
tetstream generate ball --cells 5000 c.tets --seed 4
[[ $(bytes_of a.tets) == "$(bytes_of b.tets)" ]] || fail "generate: same seed, other bytes"
[[ $(bytes_of a.tets) != "$(bytes_of c.tets)" ]] || fail "generate: other seed, same bytes"

simplified() {
  tetstream simplify a.tets out.tets --ratio 0.3 --quiet "$@"
  bytes_of out.tets
}
first=$(simplified)
[[ $first == "$(simplified)" ]] || fail "simplify: two runs, different bytes"
[[ $first == "$(simplified --seed 1)" ]] || fail "simplify: the default seed is not 1"
paper=$(simplified --mode paper)
[[ $first != "$paper" ]] || fail "simplify: both modes give the same bytes"
[[ $paper == "$(simplified --mode paper)" ]] || fail "simplify: two runs, different bytes"
[[ $paper == "$(simplified --mode paper --seed 1)" ]] || fail "simplify: the default seed is not 1"
queue=$(simplified --mode queue)
[[ $queue != "$paper" && $queue != "$first" ]] || fail "simplify: two modes give the same bytes"
[[ $queue == "$(simplified --mode queue --seed 2)" ]] || fail "simplify: the queue takes a seed"
dearest=$(simplified --release error --window 2000)
[[ $dearest != "$(simplified --window 2000)" ]] || fail "simplify: both releases, same bytes"
[[ $dearest == "$(simplified --release error --window 2000)" ]] || fail "simplify: two runs, different bytes"
[[ $paper != "$(simplified --mode paper --seed -77)" ]] || fail "simplify: other seed, same bytes"

# Any number of threads gives the same bytes: held whole, through windows, with regions, in text.
cells=40000
is_slow && cells=12000
tetstream generate ball --cells $cells many.tets --seed 5
with_threads() {
  tetstream simplify many.tets out.tets --ratio 0.2 --quiet "$@"
  bytes_of out.tets
}
for options in "" "--window 8000" "--regions none" "--feature-angle 40"; do
  # shellcheck disable=SC2086  # words, or none
  one=$(with_threads --threads 1 $options)
  for threads in 2 3 4 8 0; do
    # shellcheck disable=SC2086
    [[ $one == "$(with_threads --threads $threads $options)" ]] || fail "$threads threads $options: other bytes"
  done
done
expect_error 1 "threads" simplify many.tets none.tets --ratio 0.2 --threads -1
expect_error 1 "threads" simplify many.tets none.tets --ratio 0.2 --threads 1025
