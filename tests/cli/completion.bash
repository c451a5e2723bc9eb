# `tetstream completion SHELL`: what each shell offers, and that it is all that --help names.
source "${BASH_SOURCE%/*}/common.bash"

commands="simplify info convert layout generate diagram compare help completion"
for shell in bash zsh fish; do
  expect 0 completion "$shell"
  cp "$logs/out" "script.$shell"
done
expect_error 1 "no completion for \"tcsh\"" completion tcsh
expect_error 1 "SHELL" completion

# ------------------------------------------------------------------------------------------- bash
source ./script.bash
[[ $(complete -p tetstream) == *_tetstream* ]] || fail "bash does not complete tetstream"

# offers WORD...: what bash offers for the last word, sorted, on one line.
offers() {
  COMP_WORDS=(tetstream "$@") COMP_CWORD=$#
  _tetstream || true  # compopt works on a command line alone
  local sorted
  sorted=$(printf '%s\n' "${COMPREPLY[@]}" | sort | tr '\n' ' ')
  found=${sorted% }
}

# offered WANTED WORD...
offered() {
  local wanted=$1
  shift
  offers "$@"
  [[ $found == "$wanted" ]] || fail "after \"tetstream $*\" bash offers \"$found\", not \"$wanted\""
}

mkdir "a folder" && : >"a mesh.vtu" && : >b.vtu
offered "simplify" si
offered "--help --version -h" -
offered "paper queue sweep" simplify --mode ""
offered "paper" simplify --mode p
offered "paper" simplify --mode = p
offered "sweep" simplify --ratio 0.5 in.vtu --mode s
offered "vtk vtkhdf vtu" simplify --format vt
offered "" convert --format xd
offered "xdmf" convert --format-in xd
offered "tetgen" compare --format tetg
offered "pvd pvtu" info --format pv
offered "" simplify --ratio ""
offered "b.vtu" simplify b
offered "a folder a mesh.vtu" simplify --ratio 0.1 in.vtu a
offered "a folder" info --tmpdir a
offered "no yes" convert a b --compress ""
offered "fluid fluid+stress" generate --cells 100 fl
offered "b.vtu" generate fluid b
offered "compare completion convert" help co
offered "bash" completion b
offered "json text" layout --report ""
offered "--json" info --js

offers ""
offered_commands=$found
for command in $commands; do
  contains " $offered_commands " " $command "
  expect 0 "$command" --help
  offers "$command" -
  rest=$out count=0
  while [[ $rest =~ (^|[[:space:],])(--[a-z][a-z-]*) ]]; do
    rest=${rest#*"${BASH_REMATCH[0]}"}
    contains " $found " " ${BASH_REMATCH[2]} "
    count=$((count + 1))
  done
  ((count >= 1)) || fail "$command --help shows no flags"
done

# ------------------------------------------------------------------------------------------- fish
if command -v fish >/dev/null; then
  # fish_offers LINE: what fish offers at its end, without descriptions.
  fish_offers() {
    HOME=$folder fish --no-config -c 'source script.fish; complete -C $argv[1]' "$1" | cut -f1 | sort |
      tr '\n' ' '
  }
  [[ $(fish_offers "tetstream simplify --mode ") == "paper queue sweep " ]] || fail "fish: --mode"
  [[ $(fish_offers "tetstream si") == "simplify " ]] || fail "fish: commands"
  [[ $(fish_offers "tetstream generate ba") == "ball ball+stress " ]] || fail "fish: kinds"
  [[ $(fish_offers "tetstream simplify b") == "b.vtu " ]] || fail "fish: files"
  [[ $(fish_offers "tetstream info --js") == "--json " ]] || fail "fish: flags"
else
  echo "fish is not here: not run"
fi

# -------------------------------------------------------------------------------------------- zsh
if command -v zsh >/dev/null; then
  cp script.zsh _tetstream
  # zsh_shows LINE WANTED: a zsh at a terminal shows that when the tabulator is pressed twice at the
  # line's end; it does not end by itself where it does not.
  zsh_shows() {
    HOME=$folder timeout 20 zsh -f -c '
      zmodload zsh/zpty
      zpty shell "zsh -f -i"
      zpty -w shell "PROMPT= fpath=($PWD \$fpath); autoload -U compinit; compinit -u -D"
      zpty -w shell "LISTMAX=1000; stty columns 200; echo rea\"\"dy"
      zpty -r -m shell line "*ready*"
      zpty -w -n shell "$1"$'"'\\t\\t'"'
      zpty -r -m shell line "*$2*"' zsh "$1" "$2" >/dev/null || fail "zsh shows no $2 after \"$1\""
  }
  zsh_shows "tetstream " "generate"
  zsh_shows "tetstream simplify --mode=" "queue"
  zsh_shows "tetstream generate f" "fluid"
  zsh_shows "tetstream simplify b" "b.vtu"
  zsh_shows "tetstream info --js" "--json"
else
  echo "zsh is not here: not run"
fi
