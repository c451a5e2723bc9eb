#!/usr/bin/env bash
# bash tests/demo.sh: from a bare Debian 12 to a simplified mesh. Installs what is needed (as root),
# builds the release into build/demo, takes the example mesh to a tenth of its cells, prints the
# report, compares the two and draws in which order the mesh went by. The results are
# build/bracket-10.vtu, build/bracket-compare.png, build/bracket-layout.svg, build/bracket-sweep.png.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

echo "== packages"
bash tests/setup.sh g++ cmake ninja-build pkgconf zlib1g-dev libexpat1-dev libzstd-dev \
  libcairo2-dev libcli11-dev

echo "== build"
cmake -S . -B build/demo -G Ninja -DCMAKE_BUILD_TYPE=Release -DTETSTREAM_BUILD_TESTS=OFF \
  -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=0
cmake --build build/demo

echo "== tetstream simplify tests/data/bracket/bracket.vtu build/bracket-10.vtu --ratio 0.1" \
  "--field von_mises"
build/demo/bindings/cli/tetstream simplify tests/data/bracket/bracket.vtu build/bracket-10.vtu \
  --ratio 0.1 --field von_mises

echo "== tetstream compare tests/data/bracket/bracket.vtu build/bracket-10.vtu --field von_mises" \
  "--picture build/bracket-compare.png"
build/demo/bindings/cli/tetstream compare tests/data/bracket/bracket.vtu build/bracket-10.vtu \
  --field von_mises --picture build/bracket-compare.png

echo "== tetstream diagram tests/data/bracket/bracket.vtu build/bracket-layout.svg"
build/demo/bindings/cli/tetstream diagram tests/data/bracket/bracket.vtu build/bracket-layout.svg
build/demo/bindings/cli/tetstream diagram tests/data/bracket/bracket.vtu build/bracket-sweep.png \
  --sweep
