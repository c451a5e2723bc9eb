# What the tests of the examples share, on top of what those of the command have.
# Environment: EXAMPLES, the folder of the programs, and that of tests/cli.
source "${BASH_SOURCE%/*}/../cli/common.bash"
bracket=$TETSTREAM_SOURCE/tests/data/bracket/bracket.vtu

# Under memcheck the examples are, not the command, which has tests of its own; there, and with
# sanitizers, what they do is small.
launcher=${TETSTREAM_LAUNCHER:-}
TETSTREAM_LAUNCHER=
mesh=$bracket
if is_slow; then
  mkdir "$logs/mesh"
  mesh=$logs/mesh/ball.vtu
  expect 0 generate ball "$mesh" --cells 3000
fi

# example CODE NAME ARGUMENTS...: runs an example, which must end with that code. Its words are then in
# $out and $err.
example() {
  local wanted=$1 name=$2 code=0
  shift 2
  $launcher "$EXAMPLES/$name" "$@" >"$logs/out" 2>"$logs/err" || code=$?
  out=$(<"$logs/out") err=$(<"$logs/err")
  [[ $code == "$wanted" ]] || fail "$name $*: exit code $code, not $wanted"
}

# near A B PART: |A - B| is at most PART of |B|.
near() {
  awk -v a="$1" -v b="$2" -v part="$3" 'BEGIN {
    exit !((a - b) ^ 2 <= (part * b) ^ 2 && a "" != "" && b "" != "") }' ||
    fail "$1 is not within $3 of $2"
}

# line NAME: what follows NAME in $out.
line() {
  local text
  text=$(sed -n "s/^$1  *//p" <<<"$out")
  [[ -n $text ]] || fail "no line $1 in: $out"
  printf '%s' "$text"
}
