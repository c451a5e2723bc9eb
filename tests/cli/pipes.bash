# Commands chained by pipes give what they give by files.
source "${BASH_SOURCE%/*}/common.bash"
set -o pipefail

tetstream generate fluid --cells 3000 - >piped.tets
tetstream generate fluid --cells 3k named.tets
[[ $(cells_in piped.tets) == 3000 ]] || fail "wrong number of cells"
[[ $(cells_in named.tets) == 3000 ]] || fail "wrong number of cells"
[[ $(tetstream generate fluid --cells 3e3 - | cells_in -) == 3000 ]] || fail "wrong number of cells"

tetstream generate fluid --cells 3000 - |
  tetstream simplify - - --ratio 0.5 --report json 2>"$logs/report" |
  tetstream convert - small.vtu
written=$(member "$(<"$logs/report")" cells_out)
[[ $(cells_in small.vtu) == "$written" ]] || fail "the report and the output differ"
((written <= 1500 && written > 0)) || fail "the target was 1500, $written came out"

# From a pipe and from a file: the same mesh.
cat named.tets | tetstream simplify - a.tets --ratio 0.5 --quiet
tetstream simplify named.tets b.tets --ratio 0.5 --quiet
[[ $(bytes_of a.tets) == "$(bytes_of b.tets)" ]] || fail "pipe and file give different output"

# An empty standard input is bad data, not an empty mesh.
code=0
tetstream simplify - none.tets --ratio 0.5 </dev/null 2>"$logs/err" || code=$?
[[ $code == 2 ]] || fail "empty input: exit code $code"
# A closed one is an error of reading, a closed output one of writing.
code=0
tetstream info - <&- >"$logs/out" 2>"$logs/err" || code=$?
[[ $code == 3 ]] || fail "closed input: exit code $code"
code=0
tetstream convert named.tets - >&- 2>"$logs/err" || code=$?
[[ $code == 3 ]] || fail "closed output: exit code $code"
# So is one that is open for reading alone, whatever name it has.
for name in - /dev/stdout; do
  code=0
  tetstream convert named.tets "$name" --format vtu 1<named.tets 2>"$logs/err" || code=$?
  [[ $code == 3 ]] || fail "output to what is read, $name: exit code $code"
done
# An output that somebody else has made one that does not wait is waited for all the same.
if [[ -n ${TETSTREAM_PYTHON:-} ]]; then
  "$TETSTREAM_PYTHON" - <<'PYTHON' || fail "what does not fit into a pipe at once is lost"
import fcntl, os, subprocess, time
command = [os.environ["TETSTREAM_COMMAND"], "simplify", "--help"]
ours, theirs = os.pipe()
fcntl.fcntl(theirs, 1031, 4096)  # F_SETPIPE_SZ: less than the help
fcntl.fcntl(theirs, fcntl.F_SETFL, fcntl.fcntl(theirs, fcntl.F_GETFL) | os.O_NONBLOCK)
run = subprocess.Popen(command, stdout=theirs)
os.close(theirs)
time.sleep(0.3)
with os.fdopen(ours, "rb") as pipe:
    text = pipe.read()
assert run.wait() == 0 and len(text) > 4096, (run.returncode, len(text))
assert text == subprocess.run(command, capture_output=True).stdout
PYTHON
fi
only_files a.tets b.tets named.tets piped.tets small.vtu
