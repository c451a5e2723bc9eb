# A run that does nothing stays under 6 MB of resident memory.
source "${BASH_SOURCE%/*}/common.bash"

timer=$(type -P time) || not_run "time(1) is not here"
[[ -z ${TETSTREAM_LAUNCHER:-} && ${TETSTREAM_SANITIZED:-0} == 0 ]] ||
  not_run "not the plain program"
"$timer" -f %M -o "$logs/peak" "$TETSTREAM_COMMAND" --version >"$logs/out" ||
  not_run "time(1) does not tell the peak"
(($(<"$logs/peak") < 6 * 1024)) || fail "$(<"$logs/peak") KB"
