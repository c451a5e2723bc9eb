#!/usr/bin/env bash
# Takes the example in C and the one in shell out of README.md and runs both, in a folder of their
# own that has nothing but the example mesh.
set -euo pipefail

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# block LANGUAGE: what stands between ```LANGUAGE and ``` in README.md.
block() {
  sed -n "/^\`\`\`$1\$/,/^\`\`\`\$/p" "$TETSTREAM_SOURCE/README.md" | sed '/^```/d'
}

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
flags=(-std=c99 -pedantic -Wall -Wextra -Werror)

block c >program.c
[[ -s program.c ]] || fail "README.md has no example in C"
"$CC" "${flags[@]}" -I"$TETSTREAM_SOURCE/include" program.c -o program -L"$TETSTREAM_LIBRARY" \
  -ltetstream -Wl,-rpath,"$TETSTREAM_LIBRARY"

# Without the mesh it says why it fails, and leaves nothing behind.
if ./program 2>message; then fail "the example succeeds without its mesh"; fi
grep -q 'bracket\.vtu' message || fail "the message does not name the missing file: $(<message)"
[[ ! -e small.vtu ]] || fail "there is an output without an input"

cp "$TETSTREAM_SOURCE/tests/data/bracket/bracket.vtu" .
./program
ln -s "$TETSTREAM_COMMAND" tetstream
PATH=$PWD:$PATH
cells_of() {
  tetstream info --json --quiet "$1" | sed -n 's/^ *"cells": \([0-9]*\),$/\1/p'
}
whole=$(cells_of bracket.vtu)
small=$(cells_of small.vtu)
((small > whole / 11 && small <= whole / 10)) || fail "$whole cells became $small"

block sh >commands
[[ -s commands ]] || fail "README.md has no example in shell"
if [[ $(tetstream --version) == *"no cairo"* ]]; then sed -i '/^tetstream diagram /d' commands; fi
bash -e -o pipefail commands >told
[[ $(cells_of bracket-10.vtu) -le $((whole / 10)) && -s fluid-1.tets ]] ||
  fail "the commands did not do what README.md says"
drawn=$(sed -n 's/^tetstream diagram [^ ]* //p' commands)
[[ -z $drawn || $(head -c 5 "$drawn") == "<?xml" ]] || fail "$drawn is no picture"
close=$(cells_of bracket-close.vtu)
((close < whole / 2)) && grep -q '^reached  *error$' told ||
  fail "with a bound on the error $whole cells became $close: $(<told)"

# And what README.md says of the results is so.
sed -n 's/^    \(\(cells\|error\|reached\)  .*\)$/\1/p' "$TETSTREAM_SOURCE/README.md" >promised
[[ $(wc -l <promised) == 3 ]] || fail "README.md should show three lines of a report"
while read -r line; do
  grep -qFx -e "$line" told || fail "README.md promises \"$line\", but: $(<told)"
done <promised
share_below_10() {
  tetstream compare --samples 1000 bracket.vtu "$1" |
    sed -n 's/^ *cells below 10 deg .* \([0-9.e-]*\) %$/\1/p'
}
shapes="of the bracket's ([0-9]+) none has a dihedral angle below 10 degrees, "
shapes+="with the default ([0-9.]+) % have;"
[[ $(tr '\n' ' ' <"$TETSTREAM_SOURCE/README.md") =~ $shapes ]] || fail "README.md tells no shapes"
told_cells=${BASH_REMATCH[1]} told_share=${BASH_REMATCH[2]}
tetstream simplify bracket.vtu default.vtu --ratio 0.1 --quiet
[[ $(cells_of bracket-fe.vtu) == "$told_cells" && $(share_below_10 bracket-fe.vtu) == 0 &&
  $(printf %.1f "$(share_below_10 default.vtu)") == "$told_share" ]] ||
  fail "bracket-fe.vtu has $(cells_of bracket-fe.vtu) cells, $(share_below_10 bracket-fe.vtu) %" \
    "of them below 10 degrees; with the default $(share_below_10 default.vtu) %"

# The two commands that it promises are there.
sed -n 's/^    bash \(tests\/[a-z.]*\)$/\1/p' "$TETSTREAM_SOURCE/README.md" >scripts
[[ $(wc -l <scripts) == 2 ]] || fail "README.md should have two commands: $(<scripts)"
while read -r script; do
  [[ -f $TETSTREAM_SOURCE/$script ]] || fail "there is no $script"
done <scripts
