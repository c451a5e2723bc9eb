# man.run: the commands of section 1 and the program of tetstream(3) do what they say, on a small mesh
# with the names that they use. A billion cells are some thousands here.
# Environment: TETSTREAM_COMMAND, CC, LIBRARY (the folder of the shared one), and cli's.
source "${BASH_SOURCE%/*}/../cli/common.bash"

mkdir "$logs/bin"
ln -s "$TETSTREAM_COMMAND" "$logs/bin/tetstream"
unset -f tetstream
PATH=$logs/bin:$PATH
tetstream generate fluid fluid.vtk --cells 20000 --quiet
LC_ALL=C sed 's/density/p/; s/velocity/u/' fluid.vtk >jet.vtk
tetstream convert jet.vtk jet.vtu --quiet
cp jet.vtu in.vtu
{
  echo '<VTKFile type="Collection"><Collection>'
  for step in {0..9}; do echo "<DataSet timestep='$step' file='jet.vtu'/>"; done
  echo '</Collection></VTKFile>'
} >jet.pvd

# ------------------------------------------------------------------------------------- the commands
count=0
while read -r line; do
  line=${line#'.Dl $ '}
  line=${line//1e9/3000}
  eval "set -o pipefail; $line" >"$logs/out" 2>"$logs/err" || fail "$line: $? $(<"$logs/err")"
  count=$((count + 1))
done < <(for page in tetstream-{simplify,info,convert,layout,generate,diagram,compare,completion} tetstream; do
  sed -n '/^\.Sh EXAMPLES/,/^\.Sh/{/^\.Dl /p}' "$TETSTREAM_SOURCE/man/man1/$page.1"
done)
((count >= 20)) || fail "only $count commands were found"
for file in jet-10.vtu small.vtu close.vtu out.tets report.json step-9.vtu out.tetmap jet.msh jet.tets.zst jet.tets \
  ball.vtu jet-layout.svg jet-sweep.png jet-10.png _tetstream; do
  [[ -s $file ]] || fail "$file was not made"
done

# ------------------------------------------------------------------------------------- the program
cp jet-10.vtu of-the-command.vtu
rm jet-10.vtu
sed -n '/^#include <stdio.h>/,/^\.Ed/p' "$TETSTREAM_SOURCE/man/man3/tetstream.3" |
  sed '/^\.Ed/,$d; s/\\e/\\/g' >program.c
"$CC" -std=c99 -Wall -Werror -I"$TETSTREAM_SOURCE/include" program.c -L"$LIBRARY" -ltetstream \
  -o program
LD_LIBRARY_PATH=$LIBRARY ./program || fail "the program of tetstream(3) failed"
[[ $(bytes_of jet-10.vtu) == "$(bytes_of of-the-command.vtu)" ]] ||
  fail "program and command do not give the same"
rm jet.vtu
LD_LIBRARY_PATH=$LIBRARY ./program 2>words && fail "the program did not fail without its mesh"
contains "$(<words)" "TETSTREAM_IO: jet.vtu"
