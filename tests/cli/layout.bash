# layout: every order gives the same mesh as a stream, whatever the memory, and says what it is.
source "${BASH_SOURCE%/*}/common.bash"

tetstream generate ball --cells 20000 mesh.tets
tetstream convert mesh.tets mesh.vtu 2>"$logs/err"
cells=$(cells_in mesh.tets)
for order in auto none spatial brick z-order hilbert breadth-first spectral; do
  for in in mesh.tets mesh.vtu; do
    expect 0 layout "$in" "$order.tets" --order "$order" --memory 4M
    contains "$out" "order "
    contains "$out" "front "
    [[ $(cells_in "$order.tets") == "$cells" ]] || fail "$order loses cells of $in"
  done
  [[ $order == auto ]] || contains "$out" "$order"
done

# By an axis; and the same bytes in other memory.
expect 0 layout mesh.vtu a.tets --order spatial --axis y
contains "$out" "along y"
expect 0 layout mesh.vtu b.tets --order spatial --axis y --memory 64k
cmp a.tets b.tets || fail "the memory changes the bytes"

# What is told in JSON; the narrowest order by itself, as far as the memory goes.
expect 0 layout mesh.vtu best.tets --report json
[[ $(member "$out" front_width) == $(member "$(tetstream info --json best.tets)" front_width) ]] ||
  fail "another front is told than the file has"
[[ $(member "$out" order) == *"spectral"* ]] || fail "not the narrowest order: $out"
expect 0 layout mesh.vtu best.tets --memory 64k
contains "$out" "spatial"
expect 0 layout mesh.vtu best.tets --order spectral --memory 64k
contains "$out" "by clusters"

# A wide stream is seen as it is, and laid out again only by commands that need a narrow one.
many=200000
is_slow && many=50000
tetstream generate ball --cells $many large.vtu
expect 0 layout large.vtu wide.tets --order z-order
wide=$(member "$(tetstream info --json wide.tets)" front_width)
expect 0 convert wide.tets copy.tets
[[ $(member "$(tetstream info --json copy.tets)" front_width) == "$wide" ]] || fail "convert orders"

# A stream stays as it is, unless another order is asked for.
expect 0 layout mesh.tets same.tets
contains "$out" "as it was"
expect 0 layout mesh.tets other.tets --order hilbert --quiet
[[ -z $out$err ]] || fail "--quiet is not quiet: $out$err"

# The report goes where the mesh does not.
tetstream layout mesh.vtu - --order brick 2>"$logs/err" >piped.tets
contains "$(<"$logs/err")" "brick"
[[ $(cells_in piped.tets) == "$cells" ]] || fail "a pipe loses cells"

expect_error 1 "zigzag" layout mesh.vtu refused.tets --order zigzag
expect_error 3 "nowhere" layout mesh.vtu refused.tets --memory 64k --tmpdir /nowhere
[[ ! -e refused.tets ]] || fail "a failed run left a file"

# simplify lays out on the way, and says so.
expect 0 simplify mesh.vtu tenth.tets --ratio 0.1 --order hilbert
contains "$out" "hilbert"
expect 0 simplify mesh.tets tenth.tets --ratio 0.1
contains "$out" "as it was"
