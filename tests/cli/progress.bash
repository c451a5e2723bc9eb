# --progress tells of a slow run even where there is no terminal, at most once a second; without it
# nothing is told there.
source "${BASH_SOURCE%/*}/common.bash"

# Half of a file, and the rest two seconds later.
slowly() {
  local half=$(($(stat -c %s "$1") / 2))
  head -c "$half" "$1"
  sleep 2
  tail -c +$((half + 1)) "$1"
}

# All at the same time: without progress, with it, and of text, which is read when it is opened.
tetstream generate fluid --cells 100000 in.tets
tetstream convert in.tets in.mesh 2>"$logs/notes"
slowly in.tets | tetstream convert - quiet.tets 2>"$logs/quiet" &
quiet=$!
slowly in.mesh | tetstream convert - text.tets --format-in mesh --progress 2>"$logs/text" &
text=$!
slowly in.tets | tetstream convert - out.tets --progress 2>"$logs/err"
wait "$quiet" || fail "a slow run without progress fails"
wait "$text" || fail "a slow run on text fails"

lines=$(wc -l <"$logs/err")
((lines >= 1 && lines <= 60)) || fail "$lines lines of progress"
contains "$(<"$logs/err")" " cells"
contains_not "$(<"$logs/err")" $'\r'
[[ $(cells_in out.tets) == "$(cells_in in.tets)" ]] || fail "convert loses cells"
contains "$(<"$logs/text")" "tetstream: open"
contains_not "$(<"$logs/text")" "open 0 cells"
[[ ! -s $logs/quiet ]] || fail "progress where nobody asked for it"
