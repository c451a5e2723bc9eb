# A reader of the output that goes away is an error of writing, with its words and its exit code.
source "${BASH_SOURCE%/*}/common.bash"

{ tetstream generate fluid --cells 1e7 - 2>"$logs/err" && echo 0 >code || echo $? >code; } |
  head -c 1000 >/dev/null
[[ $(<code) == 3 ]] || fail "exit code $(<code), not 3"
contains "$(<"$logs/err")" "tetstream: standard output: cannot write: "
