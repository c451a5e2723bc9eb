# What the tests of the command share. Sourced first: it puts the test into an empty folder that is
# gone at the end. Uses bash and coreutils only.
set -eu

test_name=${0##*/}
folder=$(mktemp -d)
logs=$(mktemp -d)
trap 'rm -rf "$folder" "$logs"' EXIT
cd "$folder"

fail() {
  echo "$test_name: $*" >&2
  for log in "$logs"/*; do echo "--- ${log##*/}" && cat "$log"; done >&2
  exit 1
}

not_run() {
  echo "$test_name: not run: $*" >&2
  exit 77
}

# The command, under memcheck if that is asked for. Words of the launcher hold no blanks.
tetstream() {
  ${TETSTREAM_LAUNCHER:-} "$TETSTREAM_COMMAND" "$@"
}

# expect CODE ARGUMENTS...: runs the command, which must end with that code. Its words are then in
# $logs/out and $logs/err, and in $out and $err.
expect() {
  local wanted=$1 code=0
  shift
  tetstream "$@" >"$logs/out" 2>"$logs/err" || code=$?
  out=$(tr -d '\0' <"$logs/out") err=$(<"$logs/err")
  [[ $code == "$wanted" ]] || fail "tetstream $*: exit code $code, not $wanted"
}

# expect_error CODE TEXT ARGUMENTS...: as expect, and standard error is one line of ours with TEXT.
expect_error() {
  local wanted=$1 text=$2
  shift 2
  expect "$wanted" "$@"
  [[ $err == "tetstream: "* && $err != *$'\n'* ]] || fail "tetstream $*: not one line of ours: $err"
  contains "$err" "$text"
}

contains() {
  [[ $1 == *"$2"* ]] || fail "\"$2\" is not in: $1"
}

contains_not() {
  [[ $1 != *"$2"* ]] || fail "\"$2\" is in: $1"
}

# Where the command is many times slower than usual, under memcheck or with sanitizers, meshes are
# smaller and rounds fewer. Exact comparisons take a third of the time there: their boundaries are
# sampled less; and pictures a tenth: with less memory the cuts they show have fewer pixels.
is_slow() { [[ -n ${TETSTREAM_SLOW:-} ]]; }
less_boundary=() less_pixels=()
if is_slow; then
  less_boundary=(--boundary-samples 20000)
  less_pixels=("${less_boundary[@]}" --memory 3M)
fi

# The value of a member of a JSON text of ours: member TEXT NAME.
member() {
  [[ $1 =~ \"$2\":\ (\"[^\"]*\"|[^,\ $'\n']*) ]] || fail "no member $2 in: $1"
  printf '%s' "${BASH_REMATCH[1]}"
}

# The members of a public struct, tetstream_NAME, as they stand in the header.
members_of() {
  sed -n "/^typedef struct tetstream_$1 {/,/^} tetstream_$1;/{//!p}" \
    "$TETSTREAM_SOURCE/include/tetstream/tetstream.h"
}

# The number of cells in a file: cells_in FILE [--format NAME].
cells_in() {
  local json
  json=$(tetstream info --json "$@" 2>/dev/null) || fail "info $* failed"
  member "$json" cells
}

# The manual's program that carries the field density of small.vtu back, by small.tetmap.
carrying_back() {
  sed -n '/^\.Ss Carrying a field back/,/^\.Ed/p' "$TETSTREAM_SOURCE/man/man5/tetstream-formats.5" |
    sed -n '/^\.Bd/,/^\.Ed/{/^\./d;p}'
}

bytes_of() {
  cksum <"$1"
}

# Nothing but these files is in the test's folder, hidden ones included.
only_files() {
  local wanted found
  wanted=$(printf '%s\n' "$@" | sort)
  found=$(ls -A | sort)
  [[ $found == "$wanted" ]] || fail "files here: ${found//$'\n'/ }; wanted: $*"
}
