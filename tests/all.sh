#!/usr/bin/env bash
# bash tests/all.sh: sets up and runs all tests, in stages; `bash tests/all.sh STAGE...` runs only
# those named. Every stage runs, also after one that failed; the last one is the main layer.
#   build      release, with compiler warnings as errors, into build/release
#   format     clang-format finds nothing to change
#   lint       clang-tidy finds nothing to say about the library and the command, and no file of the
#              library uses what it does not include
#   sanitize   another build, by Clang, with its warnings as errors, AddressSanitizer and
#              UndefinedBehaviorSanitizer, and its tests, with smaller meshes
#   memcheck   unit, API and Fortran tests of the release, the shared problem, and streams through Python
#              and Octave, under Valgrind
#   tests      the quick layer of the release
# Not among them without being named:
#   full       the long layer: real meshes at every ratio
# Tests on real meshes need TETSTREAM_MESHES and TETSTREAM_JUDGE (tests/CMakeLists.txt); those that
# lack something say "not run". The judge needs python3-scipy and python3-vtk9, examples.ranks
# libopenmpi-dev.
# shellcheck disable=SC2317  # the stages are called by their names
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

jobs=$(nproc)
# Each room is compiled in one piece.
by_room=(-DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=0)
stages=("$@")
(($#)) || stages=(build format lint sanitize memcheck tests)
failed=()

# The Python of the distribution has the modules that some tests need; another may come first.
python=python3
[[ -x /usr/bin/python3 ]] && python=/usr/bin/python3

configure() {
  cmake -S . -B "$1" -G Ninja "-DPython3_EXECUTABLE=$(command -v "$python")" "${@:2}" >/dev/null
}

# Only what goes wrong is shown. With large pages Clang takes a tenth less time.
build() {
  GLIBC_TUNABLES=glibc.malloc.hugetlb=1 cmake --build "$1" -- --quiet
}

# ctest tells what it runs; what failed shows its output.
check() {
  ctest --test-dir "$1" -j "$jobs" --output-on-failure --no-tests=error "${@:2}"
}

# The public header is laid out by hand.
sources() {
  find lib bindings tests \( -name '*.h' -o -name '*.c' -o -name '*.cpp' -o -name '*.inl' \)
}

# The prefix is that of the Debian packages, which a test makes. Rooms in one piece take seven tenths
# of the time and give the same bytes; to build after each change, -DCMAKE_UNITY_BUILD=OFF is faster.
stage_build() {
  configure build/release -DCMAKE_BUILD_TYPE=Release -DTETSTREAM_WARNINGS_AS_ERRORS=ON \
    -DCMAKE_INSTALL_PREFIX=/usr "${by_room[@]}" &&
    build build/release
}

stage_format() {
  sources | xargs clang-format --dry-run --Werror
}

# A second compiler, which with sanitizers takes half the time of gcc. -O1 builds twice as fast as -O3,
# and without debug information, which would only name lines of the stack, it takes five sixths of the
# time. Kernels once: those of v3 are the same source. Octave does not run in it, and Fortran is
# memcheck's.
configure_sanitize() {
  configure build/sanitize -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_BUILD_TYPE=RelWithDebInfo -DTETSTREAM_SANITIZE=ON -DTETSTREAM_WARNINGS_AS_ERRORS=ON \
    -DTETSTREAM_OCTAVE=OFF -DTETSTREAM_FORTRAN=OFF -DTETSTREAM_V3_KERNELS=OFF \
    "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g0" "${by_room[@]}"
}

# What is compiled of the library, the command and the bindings, as the build itself lists it; but
# not what SWIG writes.
compiled() {
  sed -n 's/^  "file": "\(.*\)",\?$/\1/p' build/sanitize/compile_commands.json |
    grep -E "^$PWD/(build/sanitize/)?(lib|bindings)/.*\.(cpp|cxx)$" | grep -v '_wrap\.cxx$'
}

stage_lint() {
  local result=0
  "$python" tests/includes.py || result=1
  configure_sanitize || return
  compiled | xargs -P "$jobs" -n 1 clang-tidy --quiet -p build/sanitize 2>&1 |
    sed '/warnings\? generated\.$/d' || result=1
  return "$result"
}

stage_sanitize() {
  configure_sanitize && build build/sanitize && check build/sanitize
}

# The same programs as those of the release; only how ctest starts them is another.
stage_memcheck() {
  configure build/release -DTETSTREAM_MEMCHECK=ON && check build/release -R '^(unit|api|abi|fortran|languages|python|octave)\.'
  local result=$?
  configure build/release -DTETSTREAM_MEMCHECK=OFF && return "$result"
}

stage_tests() {
  check build/release
}

stage_full() {
  configure build/release -DTETSTREAM_FULL_TESTS=ON && check build/release
  local result=$?
  configure build/release -DTETSTREAM_FULL_TESTS=OFF && return "$result"
}

echo "== packages"
bash tests/setup.sh g++ cmake ninja-build pkgconf zlib1g-dev libexpat1-dev libzstd-dev liblz4-dev \
  liblzma-dev libdeflate-dev libhdf5-dev libcairo2-dev libcli11-dev libeigen3-dev libgtest-dev \
  clang libclang-rt-dev clang-format clang-tidy valgrind mandoc python3 python3-dev python3-numpy \
  swig abigail-tools dpkg-dev file zsh fish octave-dev gfortran python3-scipy \
  libopenmpi-dev ${TETSTREAM_JUDGE:+python3-vtk9} || exit 1
for stage in "${stages[@]}"; do
  echo "== $stage"
  begin=$SECONDS
  if "stage_$stage"; then
    [[ $stage == tests ]] || echo "-- $stage: passed in $((SECONDS - begin)) s"
  else
    failed+=("$stage")
    echo "-- $stage: FAILED"
  fi
done
((${#failed[@]})) || exit 0
echo "failed: ${failed[*]}"
exit 1
