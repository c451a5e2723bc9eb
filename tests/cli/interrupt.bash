# SIGINT and SIGTERM end a run in good order: exit code 7 and no file left, also while it waits for
# a pipe or if several come together; one that comes later ends it even where the first cannot.
source "${BASH_SOURCE%/*}/common.bash"

# start ARGUMENTS...: in the background, as $pid. Shells without job control start commands that
# ignore SIGINT; env undoes that.
env --default-signal=INT true 2>"$logs/env" || not_run "env has no --default-signal"
start() {
  env --default-signal=INT ${TETSTREAM_LAUNCHER:-} "$TETSTREAM_COMMAND" "$@" <&0 2>"$logs/err" &
  pid=$!
}

# until_true COMMAND...: within a minute.
until_true() {
  for ((i = 0; i < 3000; ++i)); do
    if "$@"; then return; fi
    sleep 0.02
  done
  fail "in vain: $*"
}

# ended CODE: the process ends within five minutes (memcheck is slow), with that code.
ended() {
  local code=0 i
  for ((i = 0; i < 15000; ++i)); do
    if ! kill -0 "$pid" 2>"$logs/kill"; then break; fi
    sleep 0.02
  done
  if ((i == 15000)); then kill -KILL "$pid"; fi
  wait "$pid" || code=$?
  [[ $code == "$1" ]] || fail "exit code $code, not $1"
}

has_temporary() { compgen -G "$1.*-*" >/dev/null; }
waits_in_read() {
  # The state of a process that sleeps; a program under a launcher needs some time to get there.
  [[ -r /proc/$pid/stat && $(<"/proc/$pid/stat") == *") S "* ]]
}

# In the middle of work.
for signal in INT TERM; do
  start generate fluid --cells 1e9 out.tets
  until_true has_temporary out.tets
  kill -s "$signal" "$pid"
  ended 7
  contains "$(<"$logs/err")" "tetstream: cancelled"
  only_files
done

# Several that come together are one: the output's temporary file is gone before a later one counts.
for ((try = 0; try < 5; ++try)); do
  start generate fluid --cells 1e9 out.tets
  until_true has_temporary out.tets
  kill -HUP "$pid"
  kill -TERM "$pid"
  kill -TERM "$pid"
  ended 7
  only_files
done

# In the middle of a simplification, of a long stream and of an indexed mesh; what was there
# stays.
mkfifo pipe
echo precious >out.tets
tetstream generate fluid --cells 2e7 - >pipe 2>"$logs/producer" &
producer=$!
start simplify pipe out.tets --format-in tets --ratio 0.1 --threads 3
until_true has_temporary out.tets
sleep 0.5
kill -INT "$pid"
ended 7
wait "$producer" || true
only_files pipe out.tets
cells=1e6
is_slow && cells=2e5
tetstream generate fluid --cells $cells in.vtu --compress no
start simplify in.vtu out.tets --ratio 0.1 --threads 3
until_true has_temporary out.tets
kill -INT "$pid"
ended 7
only_files in.vtu pipe out.tets
[[ $(<out.tets) == precious ]] || fail "the old file was changed"
rm in.vtu out.tets

# In the middle of a comparison, whose rows are in temporary files and which would draw.
mkdir spool
tetstream generate ball --cells 200000 ball.tets
start compare ball.tets ball.tets --memory 8M --tmpdir spool --picture page.svg --progress
until_true grep -q compare "$logs/err"
kill -INT "$pid"
ended 7
contains "$(<"$logs/err")" "cancelled"
[[ -z $(ls -A spool) ]] || fail "left in the temporary folder: $(ls -A spool)"
only_files ball.tets pipe spool
rm -r ball.tets spool

# While it waits for input that does not come.
exec 3<>pipe
start simplify - out.tets --ratio 0.1 --threads 3 <pipe
until_true has_temporary out.tets
until_true waits_in_read
sleep 0.5
kill -INT "$pid"
ended 7
only_files pipe

# While another of its threads waits for more.
tetstream generate fluid --cells 1e6 - | head -c 3000000 >part
start simplify - out.tets --ratio 0.1 --threads 3 <pipe
cat part >pipe
until_true has_temporary out.tets
until_true waits_in_read
sleep 0.5
kill -INT "$pid"
ended 7
rm part
only_files pipe

# While it waits for somebody to take its output.
start generate fluid --cells 1e9 - >pipe
sleep 0.5
until_true waits_in_read
kill -INT "$pid"
ended 7
exec 3>&-

# While it waits for the header of what comes through a named pipe.
exec 3<>pipe
start simplify pipe out.tets --format-in tets --ratio 0.1
until_true has_temporary out.tets
until_true waits_in_read
sleep 0.5
kill -INT "$pid"
ended 7
exec 3>&-
only_files pipe

# A named pipe is written by the library alone: there the first signal waits until somebody takes
# what is there, one that comes later does not.
# Memory of a process that ends like that is not given back, which memcheck would count.
if [[ -n ${TETSTREAM_LAUNCHER:-} ]]; then exit 0; fi
exec 3<>pipe
start generate fluid --cells 1e9 pipe --format tets
until_true waits_in_read
sleep 0.5
kill -INT "$pid"
kill -TERM "$pid"
sleep 0.7
kill -0 "$pid" || fail "a signal that came with another one ended it at once"
kill -INT "$pid"
ended 7
exec 3>&-
only_files pipe
