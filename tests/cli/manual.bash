# The manual page and --help name the same flags.
source "${BASH_SOURCE%/*}/common.bash"

manual=$(<"$TETSTREAM_SOURCE/man/man1/tetstream.1")
help=
for command in simplify info convert layout generate diagram compare completion; do
  expect 0 "$command" --help
  help+=$out$'\n'
done
expect 0 --help
help+=$out

known=" "
rest=$help
while [[ $rest =~ (^|[[:space:],])--([a-z][a-z-]*) ]]; do
  rest=${rest#*"${BASH_REMATCH[0]}"}
  known+="${BASH_REMATCH[2]} "
  contains "$manual" ".It Fl -${BASH_REMATCH[2]}"
done

count=0
rest=$manual
while [[ $rest =~ \.It\ Fl\ -([a-z][a-z-]*) ]]; do
  rest=${rest#*"${BASH_REMATCH[0]}"}
  contains "$known" " ${BASH_REMATCH[1]} "
  count=$((count + 1))
done
((count >= 20)) || fail "found only $count flags in the manual"
