# --memory: a window that is little wider than the front is planned so that all else fits, too; less
# is refused in a sentence.
source "${BASH_SOURCE%/*}/common.bash"

tetstream generate ball --cells 1e5 ball.tets
for budget in 1200000 1300000 1500000; do
  expect 0 simplify ball.tets out.tets --ratio 0.1 --memory "$budget"
done
expect_error 4 'too small: at least' simplify ball.tets none.tets --ratio 0.1 --memory 400000
[[ ! -e none.tets ]] || fail "none.tets is there"
