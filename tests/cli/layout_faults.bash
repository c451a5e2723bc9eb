# A layout that is killed, runs out of disk or fails to write leaves no output under its name and no
# temporary file; what a kill that cannot be caught leaves beside it, the next run removes.
source "${BASH_SOURCE%/*}/common.bash"

mkdir tmp out
many=100000
is_slow && many=70000
tetstream generate ball --cells $many mesh.tets
tetstream convert mesh.tets mesh.vtu 2>"$logs/err"
cells=$(cells_in mesh.tets)
words=(layout mesh.vtu out/mesh.tets --order hilbert --memory 1M --tmpdir tmp --quiet)
lay_out() {
  tetstream "${words[@]}"
}
nothing_left() {
  [[ -z $(ls -A tmp) ]] || fail "$1: left in tmp: $(ls -A tmp)"
  [[ -z $(ls -A out) ]] || fail "$1: left in out: $(ls -A out)"
}

# No space from the n-th write on, for more and more of them until there are enough.
if [[ -n ${TETSTREAM_FAIL_WRITE:-} ]]; then
  export ASAN_OPTIONS=${ASAN_OPTIONS:+$ASAN_OPTIONS:}verify_asan_link_order=0
  for ((n = 1; ; n += 1 + n / 4)); do
    code=0
    FAIL_WRITE=$n LD_PRELOAD=$TETSTREAM_FAIL_WRITE lay_out 2>"$logs/err" || code=$?
    [[ $code != 0 ]] || break
    [[ $code == 3 ]] || fail "write $n fails: exit code $code, not 3"
    contains "$(<"$logs/err")" "No space left on device"
    nothing_left "write $n fails"
  done
  ((n > 10)) || fail "only $n writes"
  rm out/mesh.tets
fi

# Files of more than 300 KB are refused.
code=0
(ulimit -f 300 && lay_out) 2>"$logs/err" || code=$?
[[ $code == 3 ]] || fail "too large a file: exit code $code, not 3"
nothing_left "too large a file"

# A small disk, where one can be mounted.
if [[ $(id -u) == 0 ]] && mount -t tmpfs -o size=1M none tmp 2>"$logs/mount"; then
  code=0
  lay_out 2>"$logs/err" || code=$?
  umount tmp
  [[ $code == 3 ]] || fail "full disk: exit code $code, not 3"
  nothing_left "full disk"
fi

# Killed at twenty moments, by signals that can be caught and that cannot.
begin=$(date +%s%N)
lay_out
rm out/mesh.tets
took=$((($(date +%s%N) - begin) / 1000000)) # ms
killed=0
for ((i = 0; i < 20; ++i)); do
  if ((i % 2)); then signal=KILL; else signal=TERM; fi
  # The signal is for the command, not for a shell round it, which would also clean up for us.
  (trap - EXIT && exec ${TETSTREAM_LAUNCHER:-} "$TETSTREAM_COMMAND" "${words[@]}") 2>"$logs/err" &
  pid=$!
  moment=$((RANDOM % took))
  sleep "$(printf '%d.%03d' $((moment / 1000)) $((moment % 1000)))"
  kill -s "$signal" "$pid" 2>"$logs/kill" || true
  code=0
  wait "$pid" 2>"$logs/wait" || code=$?
  if [[ $code == 0 ]]; then
    rm out/mesh.tets
    continue
  fi
  killed=$((killed + 1))
  if [[ -e out/mesh.tets ]]; then # it was on its way out: what is there is complete
    [[ $(cells_in out/mesh.tets) == "$cells" ]] || fail "$signal: there is half an output"
    rm out/mesh.tets
  fi
  if [[ $signal == TERM ]]; then
    [[ $code == 7 || $code == 143 ]] || fail "TERM: exit code $code"
    [[ -z $(ls -A tmp) ]] || fail "TERM: left in tmp: $(ls -A tmp)"
  fi
done
((killed > 3)) || fail "only $killed of 20 runs were killed"
lay_out
rm out/mesh.tets
nothing_left "after kills, and another run"
