# --progress tells of a slow run even where there is no terminal, at most once a second; without it
# nothing is told there.
source "${BASH_SOURCE%/*}/common.bash"

tetstream generate fluid --cells 100000 in.tets
half=$(($(stat -c %s in.tets) / 2))
slowly() {
  head -c "$half" in.tets
  sleep 2
  tail -c +$((half + 1)) in.tets
}

slowly | tetstream convert - out.tets --progress 2>"$logs/err"
lines=$(wc -l <"$logs/err")
((lines >= 1 && lines <= 60)) || fail "$lines lines of progress"
contains "$(<"$logs/err")" " cells"
contains_not "$(<"$logs/err")" $'\r'
[[ $(cells_in out.tets) == "$(cells_in in.tets)" ]] || fail "convert loses cells"

# Text that is read when it is opened tells of that.
tetstream convert in.tets in.mesh
half=$(($(stat -c %s in.mesh) / 2))
{
  head -c "$half" in.mesh
  sleep 2
  tail -c +$((half + 1)) in.mesh
} | tetstream convert - out.tets --format-in mesh --progress 2>"$logs/err"
contains "$(<"$logs/err")" "tetstream: open"
contains_not "$(<"$logs/err")" "open 0 cells"
half=$(($(stat -c %s in.tets) / 2))

slowly | tetstream convert - out.tets 2>"$logs/err"
[[ ! -s $logs/err ]] || fail "progress where nobody asked for it"
