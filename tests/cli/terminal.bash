# On a terminal: no mesh is written to it or read from it, and progress is one line, removed at the
# end. script(1) makes the terminal.
source "${BASH_SOURCE%/*}/common.bash"
type script >/dev/null 2>&1 || not_run "script(1) is not here"
script -qec true /dev/null >/dev/null 2>&1 </dev/null || not_run "script(1) makes no terminal"

# on_terminal CODE COMMAND: what the terminal showed is then in $shown.
on_terminal() {
  local code=0
  script -qec "$2" "$logs/shown" >/dev/null </dev/null || code=$?
  shown=$(tr -d '\0' <"$logs/shown")
  [[ $code == "$1" ]] || fail "$2: exit code $code, not $1"
}
command="${TETSTREAM_LAUNCHER:-} $TETSTREAM_COMMAND"

on_terminal 1 "$command generate fluid --cells 1000 -"
contains "$shown" "not written to a terminal"
on_terminal 1 "$command generate fluid --cells 1000 /dev/tty --format sva"
contains "$shown" "not written to a terminal"
tetstream generate fluid --cells 1000 in.tets
on_terminal 1 "$command simplify in.tets - --ratio 0.5"
contains "$shown" "not written to a terminal"
on_terminal 1 "$command info - < /dev/tty"
contains "$shown" "not read from a terminal"

many=3e6  # more than a second
is_slow && many=1e6
on_terminal 0 "$command generate fluid --cells $many out.tets"
contains "$shown" "cells, "
contains "$shown" "ETA "
# Redrawn in its place, and blanked in the end.
contains "$shown" $' \r'
on_terminal 0 "$command generate fluid --cells $many out.tets --quiet"
contains_not "$shown" "ETA"
# In a chain only the last command draws.
on_terminal 0 "$command generate fluid --cells $many - | $command info -"
contains "$shown" "ETA"
contains_not "$shown" "convert"
