# Each command has a page, which shows in SYNOPSIS the flags and arguments that its --help shows, and no
# others; each of them is described there or in a page that it refers to, once.
source "${BASH_SOURCE%/*}/common.bash"
pages=$TETSTREAM_SOURCE/man/man1
common=$(<"$pages/tetstream.1")

# The flags that each page describes, one a line.
declare -A described
for path in "$pages"/*.1; do
  name=$(basename "$path" .1)
  described[$name]=$(sed -nE 's/^\.It Fl -([a-z][a-z-]*)( .*)?$/\1/p' "$path")
done

# has_line TEXT LINE
has_line() {
  [[ $'\n'$1$'\n' == *$'\n'"$2"$'\n'* ]]
}

# flags_of TEXT PATTERN: what follows the pattern, sorted, each once.
flags_of() {
  grep -oE -- "$2[a-z][a-z-]*" <<<"$1" | sed -E "s/^$2//" | sort -u
}

count=0
for command in simplify info convert layout generate diagram compare completion; do
  expect 0 "$command" --help
  page=$(<"$pages/tetstream-$command.1")
  synopsis=$(sed -n '/^\.Sh SYNOPSIS/,/^\.Sh DESCRIPTION/p' <<<"$page")
  shown=$(flags_of "$out" "--" | grep -vx help || true)
  written=$(flags_of "$synopsis" "Fl -" || true)
  [[ $shown == "$written" ]] ||
    fail "$command: --help has ${shown//$'\n'/ }; the page ${written//$'\n'/ }"

  # The pages that may describe its flags: its own first.
  referred=$(sed -n 's/^\.Xr \(tetstream[a-z-]*\) 1.*/\1/p' <<<"$page" | sort -u)
  for flag in $shown; do
    own=${described[tetstream-$command]} places=0
    if has_line "$own" "$flag"; then
      places=1
    else
      for name in $referred; do
        has_line "${described[$name]}" "$flag" && places=$((places + 1))
      done
    fi
    ((places == 1)) || fail "$command: --$flag is described in $places pages"
    # A flag that is described in the page of all commands has the same meaning everywhere.
    if has_line "$own" "$flag" && has_line "${described[tetstream]}" "$flag" &&
      [[ $command/$flag != info/format ]]; then
      fail "$command: --$flag is described in tetstream(1), too"
    fi
    count=$((count + 1))
  done

  # Nothing is described that is not there.
  for flag in $(flags_of "$page" "^\.It Fl -" || true); do
    has_line "$shown" "$flag" || fail "tetstream-$command(1) describes --$flag"
  done
  for word in $(sed -n 's/^usage:.*\[options\] //p' <<<"$out"); do
    word=$(tr '[:upper:]' '[:lower:]' <<<"$word")
    [[ $command == diagram && $word == out ]] && word=picture
    grep -qE "^\.Ar (.* )?$word( |$)" <<<"$synopsis" || fail "$command: the page has no $word"
  done
done
((count >= 100)) || fail "only $count flags were found"

# In tetstream(1) stands what several commands have, and the two flags that it has itself.
for flag in $(flags_of "$common" "\.It Fl -"); do
  case $flag in help | version) continue ;; esac
  users=$(grep -lE -- "^\.(Op )?Fl -$flag( |$)" "$pages"/tetstream-*.1 | wc -l)
  ((users >= 2)) || fail "tetstream(1) describes --$flag, which $users commands have"
done
