# convert --recover makes a valid file of what is whole of a damaged one, and says what is missing.
source "${BASH_SOURCE%/*}/common.bash"

tetstream generate ball --cells 100000 whole.tets
size=$(stat -c %s whole.tets)

# A file of which the end is missing, as a killed process or a full disk leaves it.
head -c $((size / 2)) whole.tets >half.tets
expect_error 2 "ends at byte $((size / 2))" convert half.tets out.tets
expect 0 convert --recover half.tets out.tets
contains "$err" "note: half.tets: ends at byte $((size / 2)) inside chunk"
contains "$err" "the end is missing"
cells=$(cells_in out.tets)
((cells > 20000 && cells < 80000)) || fail "$cells cells of the first half"
expect 0 simplify out.tets small.vtu --ratio 0.1
expect 0 simplify --recover half.tets straight.vtu --ratio 0.1
expect 0 info --recover half.tets
rm small.vtu straight.vtu

# Damage in the middle: both sides of it are there.
{
  head -c $((size / 2)) whole.tets
  printf 'damaged!'
  tail -c +$((size / 2 + 9)) whole.tets
} >broken.tets
expect 0 convert --recover broken.tets out.tets
contains "$err" "the file is damaged"
contains "$err" "recovered"
((cells < $(cells_in out.tets))) || fail "nothing behind the damage was recovered"
expect 0 simplify out.tets out.vtu --ratio 0.1

# Of a whole file, everything; from a pipe, too.
expect 0 convert --recover whole.tets out.tets
contains "$err" "nothing is missing"
[[ $(cells_in out.tets) == $(cells_in whole.tets) ]] || fail "cells are missing"
expect 0 convert --recover - out.tets <half.tets
[[ $(cells_in out.tets) == "$cells" ]] || fail "a pipe gives other cells"

# Within a wrapping, up to where that ends.
gzip -k whole.tets
head -c $(($(stat -c %s whole.tets.gz) / 2)) whole.tets.gz >half.tets.gz
rm whole.tets.gz
expect_error 2 "the file ends within its compressed data" convert half.tets.gz out.tets
expect 0 convert --recover half.tets.gz out.tets
contains "$err" "the file ends within its compressed data"
contains "$err" "the end is missing"
(($(cells_in out.tets) > 20000)) || fail "little was recovered of a file that was wrapped"
rm half.tets.gz

# Where there is nothing to be recovered there is no output.
rm out.tets out.vtu
head -c 1000000 /dev/zero >zeros.tets
expect_error 2 "without a header nothing can be recovered" convert --recover zeros.tets out.tets
tetstream convert whole.tets whole.vtu
expect_error 6 "only .tets files can be recovered" convert --recover whole.vtu out.tets
only_files broken.tets half.tets whole.tets whole.vtu zeros.tets

# A process that is killed leaves what it had written beside the name of its output.
tetstream generate fluid --cells 1e9 killed.tets &
pid=$!
left() { compgen -G 'killed.tets.*' || true; }
for ((i = 0; i < 600; ++i)); do
  name=$(left)
  if [[ -n $name && $(stat -c %s "$name") -gt 4000000 ]]; then break; fi
  sleep 0.1
done
pid_of_it=$(pgrep -P $pid || true)
kill -KILL ${pid_of_it:+"$pid_of_it"} $pid
wait $pid 2>"$logs/wait" || true
[[ ! -e killed.tets ]] || fail "half an output has its name"
expect 0 convert --recover --format-in tets "$(left)" out.tets
contains "$err" "the end is missing"
(($(cells_in out.tets) > 100000)) || fail "little was recovered of what was left"
