# Help and version are on standard output, complete, and agree with each other.
source "${BASH_SOURCE%/*}/common.bash"

expect 0 --version
contains "$out" "tetstream "
for format in tets vtu pvtu vtk sva svb; do contains "$out" "  $format "; done
[[ -z $err ]] || fail "--version writes to standard error"

expect 0 --help
for command in simplify info convert layout generate diagram compare help completion; do contains "$out" "  $command "; done
overview=$out
expect 0 help
[[ $out == "$overview" ]] || fail "help and --help differ"

for command in simplify info convert layout generate diagram compare completion; do
  expect 0 "$command" --help
  contains "$out" "usage: tetstream $command"
  contains "$out" "More: man tetstream-$command"
  text=$out
  expect 0 help "$command"
  [[ $out == "$text" ]] || fail "help $command and $command --help differ"
  [[ -z $err ]] || fail "help writes to standard error"
done

# Texts are broken between words, for the width that is told or else for 80 characters.
for columns in "" 60 200; do
  COLUMNS=$columns expect 0 simplify --help
  longest=$(grep -E '^ ' <<<"$out" | wc -L)
  ((longest <= ${columns:-80})) || fail "a line of $longest characters in ${columns:-80} columns"
  contains "$(tr -s ' \n' ' ' <<<"$out")" "cells out / cells in (above 0, at most 1)"
done

# The flags come from the library's table.
COLUMNS=1000 expect 0 simplify --help
for flag in ratio cells boundary-weight balance field-range regions feature-angle mode seed quadric candidates effort shape window memory tmpdir \
  axis field format-in format report quiet progress; do
  contains "$out" "  --$flag"
done
contains "$out" "determinant, garland-zhou; default determinant"
contains "$out" "cells out / cells in (above 0, at most 1)"

expect_error 1 "no command" help nonsense
expect_error 1 "which command" 
expect_error 1 'no command "smplify", but simplify, info, convert' smplify a.tets b.tets
expect_error 1 "there is no option --nonsense" --nonsense
expect_error 1 "options follow the command, but --quiet comes before it; see" --quiet info f.tets
expect_error 1 "one argument too many: --quiet" convert -- -in.tets out.tets --quiet
expect_error 1 "which k, M or G may follow" simplify a.tets b.tets --cells 16KiB
expect_error 1 "such as 64M or 1.5G" simplify a.tets b.tets --ratio 0.1 --memory 16MiBs
expect_error 1 "tetstream simplify --help" simplify --nonsense 1 a.tets b.tets --ratio 0.1
expect_error 1 "there is no option --memory;" generate ball --cells 100 --memory 3 x.tets
expect_error 1 "one argument too many: c.tets;" simplify a.tets b.tets c.tets --ratio 0.1
