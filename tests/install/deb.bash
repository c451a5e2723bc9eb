# install.deb: makes the Debian packages and plays the user of a system that has them and not the build
# tree: they are installed by dpkg below a folder, whose database is a copy of this system's, so that
# dependencies are those of this Debian; used; and removed without a trace.
# Environment: BUILD, WORK, CC, FC, PYTHON, VERSION, MULTIARCH, SOURCE, PACKAGES (the names that are to be
# there, blank-separated).
set -eu

fail() {
  echo "install.deb: $*" >&2
  exit 1
}

as_root=
((EUID == 0)) || as_root=fakeroot
rm -rf "$WORK"
mkdir -p "$WORK" && cd "$WORK"
cpack -G DEB -B "$WORK/made" --config "$BUILD/CPackConfig.cmake" >cpack.log 2>&1 ||
  fail "cpack: $(tail -20 cpack.log)"

# ----------------------------------------------------------------------------- what the packages say
architecture=$(dpkg --print-architecture)
wanted=$(for name in $PACKAGES; do echo "${name}_$VERSION-1_$architecture.deb"; done | sort)
found=$(cd made && printf '%s\n' *.deb | sort)
[[ $found == "$wanted" ]] || fail "packages: $found; wanted: $wanted"

# says PACKAGE FIELD TEXT...: each TEXT is in that field.
says() {
  local package=$1 field=$2 value text
  value=$(dpkg-deb -f "made/${package}_$VERSION-1_$architecture.deb" "$field")
  shift 2
  for text in "$@"; do
    [[ $value == *"$text"* ]] || fail "$package: \"$text\" is not in $field: $value"
  done
}
library=$(tr ' ' '\n' <<<"$PACKAGES" | grep -E '^libtetstream[0-9]+$')
says "$library" Depends "libc6 (>=" "libstdc++6 (>=" "zlib1g (>=" "libexpat1 (>="
says "$library" Section libs
dpkg-deb -I "made/${library}_$VERSION-1_$architecture.deb" triggers | grep -q "ldconfig" ||
  fail "$library does not tell the loader"
says libtetstream-dev Depends "$library (= $VERSION-1)" zlib1g-dev libexpat1-dev
says libtetstream-dev Section libdevel
says tetstream Depends "libc6 (>=" "libexpat1 (>="
if [[ " $PACKAGES " == *" python3-tetstream "* ]]; then
  says python3-tetstream Depends "python3 (>= 3." "python3 (<< 3." "python3-numpy (>="
fi
if [[ " $PACKAGES " == *" octave-tetstream "* ]]; then
  says octave-tetstream Depends "octave (>= " "octave (<< " "libc6 (>="
fi
if [[ " $PACKAGES " == *" libtetstream-fortran-dev "* ]]; then
  says libtetstream-fortran-dev Depends "libtetstream-dev (= $VERSION-1)"
  says libtetstream-fortran-dev Section libdevel
fi
for package in $PACKAGES; do
  says "$package" Description "simplifies tetrahedral meshes"
  says "$package" Maintainer "@"
done

# ----------------------------------------------------------------------------------- installed by dpkg
root=$WORK/root
database=$root/var/lib/dpkg
mkdir -p "$database"/{info,updates,triggers}
cp /var/lib/dpkg/status "$database/status"
: >"$database/available"
on_root() {
  $as_root dpkg --root="$root" --force-script-chrootless --force-not-root --log=/dev/null "$@" \
    >dpkg.log 2>&1 || fail "dpkg $*: $(grep -v 'files list file' dpkg.log | tail -20)"
}
on_root --install made/*.deb
for package in $PACKAGES; do
  state=$(dpkg-query --admindir="$database" -W -f '${db:Status-Abbrev}' "$package")
  [[ $state == "ii " ]] || fail "$package is \"$state\""
  [[ -s $root/usr/share/doc/$package/copyright ]] || fail "$package has no licence"
done
for file in share/bash-completion/completions/tetstream share/zsh/site-functions/_tetstream \
  share/fish/vendor_completions.d/tetstream.fish share/man/man1/tetstream.1.gz share/man/man1/tetstream-simplify.1.gz \
  share/man/man3/tetstream_simplifier_run.3.gz \
  share/doc/tetstream/examples/tutorial/01_files.c "lib/$MULTIARCH/libtetstream.a"; do
  [[ -s $root/usr/$file ]] || fail "$file is not there"
done
if grep -rlIF -e "$BUILD" -e "$WORK" -- "$root/usr"; then
  fail "these name a place of the build"
fi

# ------------------------------------------------------------------------------------------------ used
elsewhere=$WORK/elsewhere
mkdir "$elsewhere" && cd "$elsewhere"
[[ $("$root/usr/bin/tetstream" --version) == "tetstream $VERSION"* ]] || fail "another version"
"$root/usr/bin/tetstream" generate fluid fluid.vtu --cells 3000 --quiet
"$root/usr/bin/tetstream" simplify fluid.vtu small.vtu --ratio 0.2 --quiet
[[ -s small.vtu ]] || fail "nothing was simplified"

export PKG_CONFIG_PATH=$root/usr/lib/$MULTIARCH/pkgconfig
cp "$SOURCE/tests/install/client.c" .
# shellcheck disable=SC2046  # the flags are words
"$CC" client.c $(pkg-config --cflags --libs tetstream) -o client
# shellcheck disable=SC2046
"$CC" client.c $(pkg-config --static --cflags --libs tetstream | sed 's/-ltetstream/-l:libtetstream.a/') \
  -o static_client
LD_LIBRARY_PATH=$root/usr/lib/$MULTIARCH ./client
./static_client
cmake -S "$SOURCE/tests/install/project" -B project -DCMAKE_PREFIX_PATH="$root/usr" -DLINKAGE=shared \
  >cmake.log 2>&1 || fail "$(tail cmake.log)"
cmake --build project >>cmake.log 2>&1 || fail "$(tail cmake.log)"
project/client_cpp

# A package of the client's would depend on ours.
mkdir debian && printf 'Source: client\n\nPackage: client\nArchitecture: any\n' >debian/control
needs=$(dpkg-shlibdeps -L"$database/info/$library.shlibs" -l"$root/usr/lib/$MULTIARCH" -O ./client)
[[ $needs == *"$library (>= $VERSION)"* ]] || fail "dpkg-shlibdeps finds for a client: $needs"

if [[ " $PACKAGES " == *" libtetstream-fortran-dev "* ]]; then
  [[ -s $root/usr/share/man/man3/tetstream-fortran.3.gz ]] || fail "tetstream-fortran(3) is not there"
  # shellcheck disable=SC2046
  "$FC" "$SOURCE/tests/install/client.f90" $(pkg-config --cflags --libs tetstream-fortran) -o fortran_client
  # shellcheck disable=SC2046
  "$FC" "$root"/usr/share/doc/*/examples/heat.f90 $(pkg-config --cflags --libs tetstream-fortran) -o heat
  export LD_LIBRARY_PATH=$root/usr/lib/$MULTIARCH
  ./fortran_client
  ./heat fluid.vtu fluid 2 2 >/dev/null
  unset LD_LIBRARY_PATH
  [[ -s fluid-002.tets ]] || fail "heat.f90 does not do what it should"
fi

if [[ " $PACKAGES " == *" python3-tetstream "* ]]; then
  PYTHONPATH=$root/usr/lib/python3/dist-packages PYTHONDONTWRITEBYTECODE=1 "$PYTHON" -c "
import tetstream
mesh = tetstream.read('fluid.vtu')
assert tetstream.__file__.startswith('$root'), tetstream.__file__
assert 0 < len(mesh.simplify(ratio=0.2).cells) < len(mesh.cells)"
fi

if [[ " $PACKAGES " == *" octave-tetstream "* ]]; then
  module=$(cd "$root/usr/lib" && find . -name tetstream_core.oct)
  octave-cli --no-init-file --no-site-file --path "$root/usr/share/octave/site/m/tetstream" \
    --path "$root/usr/lib/${module%/*}" --eval "mesh = tetstream_read ('fluid.vtu');
      assert (strncmp (which ('tetstream_read'), '$root', ${#root}));
      [P, T] = tetstream_simplify (mesh.points, mesh.cells, mesh.fields, 'ratio', 0.2);
      assert (rows (T) > 0 && rows (T) < rows (mesh.cells));"
fi

# --------------------------------------------------------------------------------------------- removed
# Programs need the library alone.
cd "$WORK"
others=()
for package in $PACKAGES; do
  [[ $package == "$library" ]] || others+=("$package")
done
on_root --purge "${others[@]}"
LD_LIBRARY_PATH=$root/usr/lib/$MULTIARCH "$elsewhere/client"
on_root --purge "$library"
left=$(find "$root" -path "$database" -prune -o -type f -print -o -type l -print)
[[ -z $left ]] || fail "left behind: $left"
cd / && rm -rf "$WORK"
