#!/usr/bin/env bash
# By hand, as root, with debootstrap and the network (some minutes, 1.5 GB):
#   bash tests/install/bare.sh BUILD FOLDER
# makes the Debian packages of a build tree whose prefix is /usr, makes a bare Debian in FOLDER unless
# one is there, and plays a user in it, who has the packages and nothing of the build: apt installs
# them with what they depend on; strangers' programs in C, C++ and Fortran are built in a folder of
# their own, through pkg-config and CMake; Python, Octave, the command and the manual are used; all is
# removed without a trace. install.deb does as much as goes without a system of its own.
set -euo pipefail
build=$(realpath "$1") root=$(realpath -m "$2")
here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")

if [[ ! -x $root/usr/bin/apt-get ]]; then
  mkdir -p "$root"
  debootstrap --variant=minbase bookworm "$root" http://deb.debian.org/debian >"$root.log" 2>&1
fi
rm -rf "$root/packages" "$root/strangers"
mkdir "$root/packages" "$root/strangers"
cpack -G DEB -B "$root/packages" --config "$build/CPackConfig.cmake" >/dev/null
cp -r "$here"/client.* "$here"/project "$here"/project_fortran "$root/strangers"

cat >"$root/strangers/play.sh" <<'PLAY'
set -euo pipefail
trap 'echo "failed in line $LINENO: $BASH_COMMAND" >&2' ERR
export DEBIAN_FRONTEND=noninteractive
quietly() { "$@" >/tmp/words 2>&1 || { tail -30 /tmp/words >&2; return 1; }; }
quietly apt-get update
# The library and the command alone, with what they depend on; then all, and what a programmer has.
quietly apt-get install -y --no-install-recommends /packages/libtetstream0_*.deb /packages/tetstream_*.deb
cd /strangers
tetstream generate fluid fluid.vtu --cells 3000 --quiet
tetstream simplify fluid.vtu small.vtu --ratio 0.1 --quiet
tetstream info small.vtu --quiet >/dev/null
echo "command: $(tetstream --version | head -1)"
quietly apt-get install -y --no-install-recommends /packages/*.deb gcc g++ gfortran libc6-dev pkgconf \
  cmake make man-db
mkdir own && cd own
cc ../client.c $(pkg-config --cflags --libs tetstream) -o c
echo "C: $(./c)"
c++ ../client.cpp $(pkg-config --cflags --libs tetstream) -o cpp
echo "C++: $(./cpp)"
gfortran ../client.f90 $(pkg-config --cflags --libs tetstream-fortran) -o fortran
echo "Fortran: $(./fortran)"
for linkage in shared static any; do
  quietly cmake -S ../project -B "project_$linkage" -DLINKAGE=$linkage
  quietly cmake --build "project_$linkage"
  echo "CMake, $linkage: $("project_$linkage/client_c"), $("project_$linkage/client_cpp")"
done
quietly cmake -S ../project_fortran -B project_fortran -DLINKAGE=any
quietly cmake --build project_fortran
echo "CMake, Fortran: $(project_fortran/client_fortran)"
examples=/usr/share/doc/tetstream/examples
for source in "$examples"/*.c "$examples"/tutorial/*.c; do
  cc "$source" $(pkg-config --cflags --libs tetstream) -lm -o "example_$(basename "$source" .c)"
done
gfortran "$examples/heat.f90" $(pkg-config --cflags --libs tetstream-fortran) -o heat_fortran
./example_heat ../fluid.vtu c 2 2 >c.table
./heat_fortran ../fluid.vtu f 2 2 >f.table
echo "examples: $(ls example_* | wc -l) built; heat in C and in Fortran: $(tail -1 c.table)"
python3 -c 'import tetstream; print("Python:", tetstream.read("../fluid.vtu").simplify(ratio=0.1))'
octave-cli --eval 'mesh = tetstream_read ("../fluid.vtu");
  [P, T] = tetstream_simplify (mesh.points, mesh.cells, mesh.fields, "ratio", 0.1);
  printf ("Octave: %d cells\n", rows (T));' 2>/dev/null
for page in tetstream tetstream-simplify tetstream_simplifier_run tetstream-formats tetstream-abi \
  tetstream-python tetstream-octave tetstream-fortran; do
  man "$page" >/tmp/page
  [[ $(wc -l </tmp/page) -gt 20 ]]
done
quietly apt-get purge -y '*tetstream*'
left=$(find / -xdev \( -path /strangers -o -path /packages -o -path /tmp -o -path /proc -o -path /var/cache \) -prune \
  -o -name '*tetstream*' -print)
[[ -z $left ]] || { echo "left behind: $left" >&2; exit 1; }
echo "removed without a trace"
PLAY
env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 chroot "$root" bash /strangers/play.sh
