# Every exit code that can be provoked; after a failure nothing is left, and what was there stays.
source "${BASH_SOURCE%/*}/common.bash"

tetstream generate fluid --cells 6000 in.tets
echo "precious" >old.tets
before=$(bytes_of old.tets)

# refuses CODE TEXT ARGUMENTS...
refuses() {
  expect_error "$@"
  [[ -z $out ]] || fail "a failure writes to standard output"
  only_files in.tets old.tets
  [[ $(bytes_of old.tets) == "$before" ]] || fail "the old file was changed"
}

# 1: usage
refuses 1 "--ratio R" simplify in.tets old.tets
refuses 1 "--cells 0" simplify in.tets old.tets --cells 0
refuses 1 "--ratio 0" simplify in.tets old.tets --ratio 0 --error 1
refuses 1 "--error 0" simplify in.tets old.tets --error 0
refuses 1 "OUT" simplify in.tets --ratio 0.5
refuses 1 "ratio" simplify in.tets old.tets --ratio 1.5
refuses 1 "ratio" simplify in.tets old.tets --ratio nan
refuses 1 "error" simplify in.tets old.tets --error 101
refuses 1 "error" simplify in.tets old.tets --error -1
refuses 1 "error" simplify in.tets old.tets --error nan
refuses 1 "1%" simplify in.tets old.tets --error 1%
refuses 1 "abc" simplify in.tets old.tets --ratio abc
refuses 1 "seed" simplify in.tets old.tets --ratio 0.5 --seed 1.5
refuses 1 "mode" simplify in.tets old.tets --ratio 0.5 --mode nonsense
refuses 1 "release" simplify in.tets old.tets --ratio 0.5 --release nonsense
refuses 1 "--rato" simplify in.tets old.tets --rato 0.5
refuses 1 "extra" simplify in.tets old.tets extra --ratio 0.5
refuses 1 "nonsense" simplify in.tets old.tets --ratio 0.5 --field nonsense
refuses 1 "density" simplify in.tets old.tets --ratio 0.5 --field density:-1
refuses 1 "OUT: it is empty" simplify in.tets "" --ratio 0.5
refuses 1 "it is empty" simplify in.tets out.tets --ratio 0.5 --map ""
refuses 1 "it is empty" compare in.tets in.tets --picture ""
refuses 1 "IN: it is empty" simplify "" out.tets --ratio 0.5
refuses 1 "there is no option --ratoi" simplify --ratoi 0.5
refuses 1 "OUT is required" simplify --ratio 0.5 -- -x
refuses 1 "nonsense" generate nonsense --cells 1000 old.tets
refuses 1 "cells" generate fluid --cells -5 old.tets
refuses 1 "--cells" generate fluid old.tets

# 2: bad data
printf 'no mesh at all, but long enough to look at its first bytes' >in.tets
refuses 2 "in.tets" simplify in.tets old.tets --ratio 0.5
refuses 2 "in.tets" info in.tets
tetstream generate fluid --cells 6000 in.tets

# 3: the system
refuses 3 "absent.tets" simplify absent.tets old.tets --ratio 0.5
refuses 3 "absent/out.tets" simplify in.tets absent/out.tets --ratio 0.5
refuses 3 "absent/out.tets" convert in.tets absent/out.tets
refuses 3 "absent/out.tets" generate fluid --cells 1e12 absent/out.tets
refuses 3 "$folder" simplify in.tets "$folder" --format tets --ratio 0.5
if [[ -c /dev/full ]]; then
  refuses 3 "/dev/full" convert in.tets /dev/full --format tets
  code=0
  tetstream info in.tets >/dev/full 2>"$logs/err" || code=$?
  [[ $code == 3 ]] || fail "info to a full device: exit code $code"
fi

# 4: memory
refuses 4 "memory" simplify in.tets old.tets --ratio 0.5 --memory 4k

# 6: what cannot be done
refuses 6 "tets" simplify in.tets out.unknown --ratio 0.5
refuses 6 "nonsense" simplify in.tets old.tets --format-in nonsense --ratio 0.5
refuses 6 "nonsense" convert in.tets old.tets --format nonsense
refuses 6 "paper" simplify in.tets old.tets --error 1 --mode paper
refuses 6 "paper" simplify in.tets old.tets --error 1 --ratio 0.5 --mode paper
refuses 6 "queue" simplify in.tets old.tets --error 1 --mode queue

# 0: targets can be combined.
expect 0 simplify in.tets out.tets --ratio 0.5 --cells 100 --error 50 --quiet
rm out.tets

# 5: the target is out of reach, and the output is complete: two cells apart from each other cannot
# become one.
cat >in.tets <<'END'
# nverts 8
# ncells 2
# v_pnum_f 4
v 0 0 0 1
v 1 0 0 2
v 0 1 0 3
v 0 0 1 4
c -4 -3 -2 -1
v 5 0 0 1
v 6 0 0 2
v 5 1 0 3
v 5 0 1 4
c -4 -3 -2 -1
END
expect 5 simplify in.tets old.tets --format-in sva --cells 1
contains "$err" "tetstream: the target of 1 cells was missed, 2 are left"
contains "$out" "limited by"
[[ $(cells_in old.tets) == 2 ]] || fail "the output is not what the report says"
only_files in.tets old.tets
