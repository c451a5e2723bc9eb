#include "generate.h"

#include <cmath>
#include <cstdlib>
#include <string_view>

#include "lattice_source.h"
#include "status.h"

namespace tetstream {

namespace {

// Beyond, float32 positions would no longer tell a mesh's vertices well apart.
constexpr int64_t kMostCells = 1'000'000'000'000'000;

// One row per kind of mesh. A lattice of side n has kCubeCells * layers * n^3 cells.
struct Kind {
  const char* name;
  int64_t layers;  // cubes along z / cubes along x
  int64_t step;    // n is a multiple of it
  LatticeMesh mesh;
  double box_min[3], box_max[3];
  // At most, and exactly from n = 3 on. Width: a layer of vertices and a row. Span: two layers, as
  // the first two come interleaved. Cells: six per cube of a layer, plus what of the layer before
  // waits for the row that is being read.
  int64_t (*front_width)(int64_t n);
  int64_t (*front_span)(int64_t n);
  int64_t (*front_cells)(int64_t n);
};

int64_t squared(int64_t n) {
  return n * n;
}

const Kind kKinds[] = {
    {"fluid",
     4,
     1,
     {{}, false, placeInBox, {0, 0, 2}, false},
     {0, 0, 0},
     {1, 1, 4},
     [](int64_t n) { return squared(n + 1) + n + 2; },
     [](int64_t n) { return 2 * squared(n + 1) + 2 * n - 1; },
     [](int64_t n) { return 6 * squared(n) + 3 * n + 5; }},
    {"ball",
     1,
     2,
     {{}, true, placeInBall, {-0.37f, -0.21f, 0}, false},
     {-1, -1, -1},
     {1, 1, 1},
     [](int64_t n) { return squared(n + 1) + n + 3; },
     [](int64_t n) { return 2 * squared(n + 1) + 2 * n + 1; },
     [](int64_t n) { return 6 * squared(n) + 6 * n + 12; }},
};

int64_t cellsOf(const Kind& kind, int64_t n) {
  return kCubeCells * kind.layers * n * n * n;
}

// The n whose count is nearest to `cells`; of two that are equally near, the smaller one.
int64_t nearestSide(const Kind& kind, int64_t cells) {
  const double per_cube = static_cast<double>(kCubeCells * kind.layers);
  const auto root = static_cast<int64_t>(std::cbrt(static_cast<double>(cells) / per_cube));
  // note: cbrt may differ in its last bit between machines; two steps around it make that harmless.
  int64_t best = kind.step;
  const int64_t near = root / kind.step * kind.step;
  for (int64_t n = near - kind.step; n <= near + 2 * kind.step; n += kind.step)
    if (n > best && std::abs(cellsOf(kind, n) - cells) < std::abs(cellsOf(kind, best) - cells))
      best = n;
  return best;
}

constexpr std::string_view kWithStress = "+stress";  // behind the name

// Of the mesh that a name without kWithStress says; `asked` is what was given.
const Kind& needKind(std::string_view name, const std::string& asked) {
  std::string known;
  for (const Kind& kind : kKinds) {
    if (name == kind.name) return kind;
    known += std::string(known.empty() ? "" : ", ") + kind.name;
  }
  fail(Status::kBadArgument,
       "there is no mesh \"%s\" to generate; there are: %s; and each with \"%s\" behind it",
       asked.c_str(), known.c_str(), kWithStress.data());
}

}  // namespace

std::unique_ptr<Source> generate(const std::string& kind_name, int64_t cells, int64_t seed) {
  const bool with_stress = kind_name.ends_with(kWithStress);
  const size_t length = kind_name.size() - (with_stress ? kWithStress.size() : 0);
  const Kind& kind = needKind(std::string_view(kind_name).substr(0, length), kind_name);
  if (cells < 1 || cells > kMostCells)
    fail(Status::kBadArgument, "cannot generate %lld cells, 1 to %lld are possible",
         static_cast<long long>(cells), static_cast<long long>(kMostCells));
  const int64_t n = nearestSide(kind, cells);
  LatticeMesh mesh = kind.mesh;
  mesh.lattice = {n, n * kind.layers};
  mesh.with_stress = with_stress;
  Schema schema;
  schema.front_width = kind.front_width(n);
  schema.front_span = kind.front_span(n);
  schema.front_cells = kind.front_cells(n);
  schema.box_min.assign(kind.box_min, kind.box_min + 3);
  schema.box_max.assign(kind.box_max, kind.box_max + 3);
  return std::make_unique<LatticeSource>(mesh, static_cast<uint64_t>(seed), schema);
}

}  // namespace tetstream
