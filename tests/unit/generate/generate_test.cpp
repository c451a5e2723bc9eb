// The generated meshes are what their schema says: counts, box, front, by brute force on meshes
// small enough to be held.
#include "generate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <new>
#include <set>
#include <tuple>

#include "arithmetic.h"
#include "lattice.h"
#include "slow_run.h"
#include "status.h"

// Counts what this program allocates, to see that large meshes cost no more than small ones.
static size_t allocated_bytes = 0;

// note: not inlined, as the compiler would then take the pair malloc and delete for a mistake.
__attribute__((noinline)) void* operator new(size_t size) {
  allocated_bytes += size;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
__attribute__((noinline)) void operator delete(void* p) noexcept {
  std::free(p);
}
__attribute__((noinline)) void operator delete(void* p, size_t) noexcept {
  std::free(p);
}

namespace tetstream {
namespace {

using Vector = std::array<double, 3>;

struct Mesh {
  Schema schema;
  std::vector<float> positions, density, velocity;
  std::vector<int64_t> cells;
  std::vector<uint8_t> last_uses;
  size_t vertexCount() const { return positions.size() / 3; }
  size_t cellCount() const { return cells.size() / 4; }
  Vector position(int64_t v) const {
    const float* p = &positions[3 * static_cast<size_t>(v)];
    return {p[0], p[1], p[2]};
  }
};

template <class T>
void append(std::vector<T>& to, const void* from, size_t count) {
  const T* values = static_cast<const T*>(from);
  to.insert(to.end(), values, values + count);
}

// The whole mesh; each vertex must come in the batch of the first cell that uses it.
Mesh collect(const std::string& kind, int64_t cells, int64_t seed = 1) {
  const std::unique_ptr<Source> source = generate(kind, cells, seed);
  Mesh mesh;
  mesh.schema = source->schema();
  BatchView batch;
  while (source->next(batch)) {
    EXPECT_EQ(batch.first_vertex, mesh.vertexCount());
    append(mesh.positions, batch.positions, 3 * batch.vertex_count);
    append(mesh.density, batch.fields[0], batch.vertex_count);
    append(mesh.velocity, batch.fields[1], 3 * batch.vertex_count);
    append(mesh.cells, batch.cells, 4 * batch.cell_count);
    append(mesh.last_uses, batch.last_uses, batch.cell_count);
    const std::set<int64_t> used(batch.cells, batch.cells + 4 * batch.cell_count);
    EXPECT_GE(*used.begin(), 0);
    EXPECT_EQ(*used.rbegin(), static_cast<int64_t>(mesh.vertexCount()) - 1);
    for (size_t v = 0; v < batch.vertex_count; ++v)
      EXPECT_EQ(used.count(static_cast<int64_t>(batch.first_vertex + v)), 1u);
    EXPECT_EQ(batch.finalized_count + batch.face_count, 0u);
  }
  EXPECT_FALSE(source->next(batch));
  return mesh;
}

int64_t fluidCells(int64_t n) {
  return 24 * n * n * n;
}
int64_t ballCells(int64_t n) {
  return 6 * n * n * n;
}

// A kind and the n of its lattice, for tests that hold for all of them.
struct Example {
  std::string kind;
  int64_t n;
  Mesh collect(int64_t seed = 1) const {
    return tetstream::collect(kind, kind == "fluid" ? fluidCells(n) : ballCells(n), seed);
  }
};

const Example kExamples[] = {{"fluid", 1}, {"fluid", 2}, {"fluid", 3}, {"fluid", 4}, {"fluid", 7},
                             {"ball", 2},  {"ball", 4},  {"ball", 6},  {"ball", 10}};

Vector minus(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double sixVolumes(const Mesh& mesh, size_t cell) {
  const int64_t* v = &mesh.cells[4 * cell];
  const Vector o = mesh.position(v[0]);
  return dot(cross(minus(mesh.position(v[1]), o), minus(mesh.position(v[2]), o)),
             minus(mesh.position(v[3]), o));
}

// In degrees, the smallest of the six angles between two faces of the cell.
double smallestAngle(const Mesh& mesh, size_t cell) {
  double smallest = 180;
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) {
      Vector p[4] = {};
      int others = 2;
      for (int k = 0; k < 4; ++k) {
        const int at = k == i ? 0 : k == j ? 1 : others++;
        p[at] = mesh.position(mesh.cells[4 * cell + static_cast<size_t>(k)]);
      }
      const Vector edge = minus(p[1], p[0]);
      const Vector s = cross(edge, minus(p[2], p[0])), t = cross(edge, minus(p[3], p[0]));
      const double cosine = dot(s, t) / std::sqrt(dot(s, s) * dot(t, t));
      smallest = std::min(smallest, std::acos(cosine) * 180 / 3.14159265358979);
    }
  }
  return smallest;
}

// How many cells have each face, by its sorted vertices.
std::map<std::array<int64_t, 3>, int> facesOf(const Mesh& mesh) {
  std::map<std::array<int64_t, 3>, int> faces;
  for (size_t c = 0; c < mesh.cellCount(); ++c) {
    for (size_t left_out = 0; left_out < 4; ++left_out) {
      std::array<int64_t, 3> face = {};
      for (size_t j = 0; j < 3; ++j) face[j] = mesh.cells[4 * c + (left_out + 1 + j) % 4];
      std::sort(face.begin(), face.end());
      ++faces[face];
    }
  }
  return faces;
}

struct Front {
  int64_t width = 0, span = 0, cells = 0;
};

// Looks after each cell, before the finalizations that it carries. A vertex is active from its
// first use to its last one.
Front bruteFront(const Mesh& mesh) {
  std::vector<size_t> last(mesh.vertexCount());
  for (size_t i = 0; i < mesh.cells.size(); ++i) last[static_cast<size_t>(mesh.cells[i])] = i / 4;
  std::set<int64_t> active;
  std::multiset<size_t> open;  // per open cell, when the last of its vertices is finalized
  Front front;
  for (size_t c = 0; c < mesh.cellCount(); ++c) {
    const int64_t* v = &mesh.cells[4 * c];
    active.insert(v, v + 4);
    size_t closed_by = 0;
    for (int j = 0; j < 4; ++j) closed_by = std::max(closed_by, last[static_cast<size_t>(v[j])]);
    open.insert(closed_by);
    front.width = std::max(front.width, static_cast<int64_t>(active.size()));
    front.span = std::max(front.span, *active.rbegin() - *active.begin() + 1);
    front.cells = std::max(front.cells, static_cast<int64_t>(open.size()));
    open.erase(c);
    for (int j = 0; j < 4; ++j)
      if (last[static_cast<size_t>(v[j])] == c) active.erase(v[j]);
  }
  return front;
}

// FNV-1a over everything that a stream gives, whatever its batches.
uint64_t checksum(const Mesh& mesh) {
  uint64_t sum = 0xcbf29ce484222325u;
  const auto add = [&sum](const void* data, size_t bytes) {
    for (size_t i = 0; i < bytes; ++i)
      sum = (sum ^ static_cast<const unsigned char*>(data)[i]) * 0x100000001b3u;
  };
  add(mesh.positions.data(), mesh.positions.size() * sizeof(float));
  add(mesh.density.data(), mesh.density.size() * sizeof(float));
  add(mesh.velocity.data(), mesh.velocity.size() * sizeof(float));
  add(mesh.cells.data(), mesh.cells.size() * sizeof(int64_t));
  add(mesh.last_uses.data(), mesh.last_uses.size());
  return sum;
}

Status statusOf(const std::string& kind, int64_t cells) {
  try {
    generate(kind, cells, 1);
    return Status::kOk;
  } catch (const Error& error) {
    EXPECT_FALSE(error.text().empty());
    return error.status();
  }
}

TEST(Generate, CountsAreTheSchemas) {
  for (const Example& e : kExamples) {
    const Mesh mesh = e.collect();
    EXPECT_EQ(mesh.schema.vertex_count, static_cast<int64_t>(mesh.vertexCount()));
    EXPECT_EQ(mesh.schema.cell_count, static_cast<int64_t>(mesh.cellCount()));
    EXPECT_EQ(mesh.cellCount(),
              static_cast<size_t>(e.kind == "fluid" ? fluidCells(e.n) : ballCells(e.n)));
    EXPECT_NO_THROW(checkSchema(mesh.schema));
  }
}

TEST(Generate, GivesTheCountNearestToTheOneAskedFor) {
  for (const auto& [kind, factor, step] : {std::tuple("fluid", 24, 1), std::tuple("ball", 6, 2)}) {
    for (int64_t asked = 1; asked < 20000;
         asked += asked < 100 ? 1 : static_cast<int64_t>(131 * test::oneIn(7))) {
      int64_t nearest = INT64_MAX;
      for (int64_t n = step; n < 20; n += step)
        nearest = std::min(nearest, std::abs(factor * n * n * n - asked));
      const int64_t given = generate(kind, asked, 1)->schema().cell_count;
      ASSERT_EQ(std::abs(given - asked), nearest) << kind << " " << asked;
    }
  }
}

// A cube's volume is the unit; see placement.h for the least that the jitter leaves.
TEST(Generate, CellsAreFarFromFlatAndAllPositive) {
  for (const Example& e : kExamples) {
    for (int64_t seed = 1; seed <= 3; ++seed) {
      const Mesh mesh = e.collect(seed);
      const double spacing = (e.kind == "fluid" ? 1.0 : 2.0) / static_cast<double>(e.n);
      const double cube = spacing * spacing * spacing;
      for (size_t c = 0; c < mesh.cellCount(); ++c)
        ASSERT_GT(sixVolumes(mesh, c), 0.1 * cube) << e.kind << " " << e.n << " cell " << c;
    }
  }
}

TEST(Generate, FacesConformAndTheBoundaryIsASphere) {
  for (const Example& e : kExamples) {
    const Mesh mesh = e.collect();
    std::set<int64_t> vertices;
    std::map<std::array<int64_t, 2>, int> edges;
    int64_t boundary_faces = 0;
    for (const auto& [face, cells] : facesOf(mesh)) {
      ASSERT_LE(cells, 2);
      if (cells == 2) continue;
      ++boundary_faces;
      vertices.insert(face.begin(), face.end());
      ++edges[{face[0], face[1]}];
      ++edges[{face[0], face[2]}];
      ++edges[{face[1], face[2]}];
    }
    for (const auto& edge : edges) ASSERT_EQ(edge.second, 2);
    EXPECT_EQ(
        static_cast<int64_t>(vertices.size()) - static_cast<int64_t>(edges.size()) + boundary_faces,
        2);
  }
}

TEST(Generate, EachVertexIsFinalizedOnceByItsLastUse) {
  for (const Example& e : kExamples) {
    const Mesh mesh = e.collect();
    std::vector<int> finalized(mesh.vertexCount(), 0);
    for (size_t c = 0; c < mesh.cellCount(); ++c) {
      for (size_t j = 0; j < 4; ++j)
        ASSERT_EQ(finalized[static_cast<size_t>(mesh.cells[4 * c + j])], 0) << "used again";
      for (size_t j = 0; j < 4; ++j)
        finalized[static_cast<size_t>(mesh.cells[4 * c + j])] += mesh.last_uses[c] >> j & 1;
      ASSERT_EQ(mesh.last_uses[c] >> 4, 0);
    }
    // Never finalized twice, as it would have been used again; never left, as all are 1. That it
    // is the last use follows, as nothing was used afterwards.
    EXPECT_EQ(std::count(finalized.begin(), finalized.end(), 1),
              static_cast<std::ptrdiff_t>(mesh.vertexCount()));
  }
}

TEST(Generate, FrontIsAsTold) {
  for (const Example& e : kExamples) {
    const Mesh mesh = e.collect();
    const Front front = bruteFront(mesh);
    EXPECT_LE(front.width, mesh.schema.front_width);
    EXPECT_LE(front.span, mesh.schema.front_span);
    EXPECT_LE(front.cells, mesh.schema.front_cells);
    if (e.n < 3) continue;
    EXPECT_EQ(front.width, mesh.schema.front_width) << e.kind << " " << e.n;
    EXPECT_EQ(front.span, mesh.schema.front_span) << e.kind << " " << e.n;
    EXPECT_EQ(front.cells, mesh.schema.front_cells) << e.kind << " " << e.n;
  }
}

TEST(Generate, FluidsFrontIsAtMostSixAndAHalfCellsPerCubeOfALayer) {
  const Mesh mesh = collect("fluid", fluidCells(8));
  EXPECT_LE(2 * bruteFront(mesh).cells, 13 * 8 * 8);
  for (const int64_t n : {8, 9, 20, 100, 1000, 10000}) {
    const Schema schema = generate("fluid", fluidCells(n), 1)->schema();
    EXPECT_LE(2 * schema.front_cells, 13 * n * n);
    EXPECT_LE(schema.front_width, n * n + 3 * n + 3);
  }
}

TEST(Generate, BoxEnclosesPositionsTightlyAndFields) {
  for (const Example& e : kExamples) {
    for (int64_t seed = 1; seed <= 3; ++seed) {
      const Mesh mesh = e.collect(seed);
      ASSERT_TRUE(mesh.schema.hasBox());
      std::vector<double> low(7, 1e30), high(7, -1e30);
      for (size_t v = 0; v < mesh.vertexCount(); ++v) {
        for (size_t i = 0; i < 7; ++i) {
          const double value = i < 3    ? mesh.positions[3 * v + i]
                               : i == 3 ? mesh.density[v]
                                        : mesh.velocity[3 * v + i - 4];
          low[i] = std::min(low[i], value);
          high[i] = std::max(high[i], value);
        }
      }
      for (size_t i = 0; i < 7; ++i) {
        EXPECT_GE(low[i], mesh.schema.box_min[i]);
        EXPECT_LE(high[i], mesh.schema.box_max[i]);
        if (i >= 3) continue;
        EXPECT_EQ(low[i], mesh.schema.box_min[i]);
        EXPECT_EQ(high[i], mesh.schema.box_max[i]);
      }
    }
  }
}

TEST(Generate, FieldBoundsAreNotWide) {
  const Mesh mesh = collect("fluid", fluidCells(20));
  const auto [low, high] = std::minmax_element(mesh.density.begin(), mesh.density.end());
  EXPECT_LT(*low, 1.1f);
  EXPECT_GT(*high, 2.9f);
  for (size_t axis = 0; axis < 3; ++axis) {
    double least = 0, most = 0;
    for (size_t v = 0; v < mesh.vertexCount(); ++v) {
      least = std::min<double>(least, mesh.velocity[3 * v + axis]);
      most = std::max<double>(most, mesh.velocity[3 * v + axis]);
    }
    EXPECT_GT(most - least, (mesh.schema.box_max[4 + axis] - mesh.schema.box_min[4 + axis]) * 0.6);
  }
}

// A vertex off its face of the box would take volume away or add some.
TEST(Generate, FluidFillsItsBox) {
  for (const int64_t n : {1, 3, 6}) {
    const Mesh mesh = collect("fluid", fluidCells(n));
    double volume = 0;
    for (size_t c = 0; c < mesh.cellCount(); ++c) volume += sixVolumes(mesh, c) / 6;
    EXPECT_NEAR(volume, 4, 1e-6);
  }
}

TEST(Generate, BallsBoundaryLiesOnTheUnitSphere) {
  for (const int64_t n : {2, 4, 8}) {
    const Mesh mesh = collect("ball", ballCells(n));
    for (const auto& [face, cells] : facesOf(mesh)) {
      if (cells == 2) continue;
      for (const int64_t v : face) ASSERT_NEAR(dot(mesh.position(v), mesh.position(v)), 1, 1e-6);
    }
    double volume = 0;
    for (size_t c = 0; c < mesh.cellCount(); ++c) volume += sixVolumes(mesh, c) / 6;
    const double ball = 4.18879, nn = static_cast<double>(n * n);
    EXPECT_LT(volume, ball);
    EXPECT_GT(volume, ball * (1 - 3 / nn));
  }
}

TEST(Generate, BallsCellsAreWellShapedAlsoWhereTheCubesEdgesWere) {
  for (const int64_t n : {2, 4, 8, 12}) {
    const Mesh mesh = collect("ball", ballCells(n));
    const auto faces = facesOf(mesh);
    for (size_t c = 0; c < mesh.cellCount(); ++c) {
      ASSERT_GT(smallestAngle(mesh, c), 15) << "n " << n << " cell " << c;
      int on_boundary = 0;
      for (size_t left_out = 0; left_out < 4; ++left_out) {
        std::array<int64_t, 3> face = {};
        for (size_t j = 0; j < 3; ++j) face[j] = mesh.cells[4 * c + (left_out + 1 + j) % 4];
        std::sort(face.begin(), face.end());
        on_boundary += faces.at(face) == 1;
      }
      ASSERT_LE(on_boundary, 1);
    }
  }
}

TEST(Generate, HeavyLiesAboveLightAndLightRises) {
  for (const std::string kind : {"fluid", "ball"}) {
    const Mesh mesh = collect(kind, 100000);
    const double middle = kind == "fluid" ? 2 : 0;
    double light_up = 0, heavy_up = 0;
    int64_t light = 0, heavy = 0;
    for (size_t v = 0; v < mesh.vertexCount(); ++v) {
      const double height = mesh.positions[3 * v + 2] - middle, density = mesh.density[v];
      if (height > 0.95) {
        ASSERT_GT(density, 2.5);
      }
      if (height < -0.95) {
        ASSERT_LT(density, 1.5);
      }
      if (std::fabs(height) > 0.3) continue;
      (density < 1.5 ? light_up : heavy_up) +=
          density < 1.5 || density > 2.5 ? mesh.velocity[3 * v + 2] : 0;
      light += density < 1.5;
      heavy += density > 2.5;
    }
    ASSERT_GT(light, 100);
    ASSERT_GT(heavy, 100);
    EXPECT_GT(light_up / static_cast<double>(light), 0.05);
    EXPECT_LT(heavy_up / static_cast<double>(heavy), -0.05);
  }
}

// The recorded sums hold on every processor, with every compiler and at every level of
// optimisation; they change only if the meshes are meant to change.
TEST(Generate, SameArgumentsGiveTheSameBytesEverywhere) {
  EXPECT_EQ(checksum(collect("fluid", 10000, 1)), 4092429278626663255u);
  EXPECT_EQ(checksum(collect("ball", 10000, 1)), 3256286197399684012u);
  EXPECT_EQ(checksum(collect("fluid", 3000, 7)), checksum(collect("fluid", 3000, 7)));
}

TEST(Generate, AnotherSeedGivesOtherPositionsAndFields) {
  for (const std::string kind : {"fluid", "ball"}) {
    const Mesh one = collect(kind, 3000, 1), other = collect(kind, 3000, -1);
    EXPECT_EQ(one.cells, other.cells);
    EXPECT_NE(one.positions, other.positions);
    EXPECT_NE(one.density, other.density);
    EXPECT_NE(one.velocity, other.velocity);
  }
}

TEST(Generate, OneCellIsTheSmallestMesh) {
  EXPECT_EQ(collect("fluid", 1).cellCount(), 24u);
  EXPECT_EQ(collect("ball", 1).cellCount(), 48u);
}

TEST(Generate, RefusesAbsurdArguments) {
  for (const std::string kind : {"fluid", "ball"}) {
    for (const int64_t cells : {INT64_MIN, int64_t{-1}, int64_t{0}, INT64_MAX})
      EXPECT_EQ(statusOf(kind, cells), Status::kBadArgument);
    EXPECT_EQ(statusOf(kind, 1'000'000'000'000'000), Status::kOk);
  }
  EXPECT_EQ(statusOf("", 100), Status::kBadArgument);
  EXPECT_EQ(statusOf("Fluid", 100), Status::kBadArgument);
}

TEST(Generate, TheLargestMeshesTakeTheMemoryOfASmallOne) {
  for (const std::string kind : {"fluid", "ball"}) {
    const size_t before = allocated_bytes;
    const std::unique_ptr<Source> source = generate(kind, 1'000'000'000'000, 1);
    EXPECT_NEAR(static_cast<double>(source->schema().cell_count), 1e12, 2e9);
    BatchView batch;
    for (int i = 0; i < 20; ++i) {
      ASSERT_TRUE(source->next(batch));
      EXPECT_LE(batch.cell_count, kBatchCells);
    }
    EXPECT_LT(allocated_bytes - before, size_t{4} << 20);
  }
}

TEST(Lattice, RanksCoverAllNumbersAlsoWhereTheyAreLarge) {
  const Lattice large = {34668, 4 * 34668};
  const VertexLine line = lineAt(large, large.side, large.depth);
  EXPECT_EQ(line.first_rank + line.stride * large.side, large.vertexCount() - 1);
  const Lattice small = {3, 5};
  std::set<int64_t> ranks;
  for (int64_t c = 0; c <= small.depth; ++c)
    for (int64_t b = 0; b <= small.side; ++b)
      for (int64_t a = 0; a <= small.side; ++a)
        ranks.insert(lineAt(small, b, c).first_rank + lineAt(small, b, c).stride * a);
  EXPECT_EQ(static_cast<int64_t>(ranks.size()), small.vertexCount());
  EXPECT_EQ(*ranks.rbegin(), small.vertexCount() - 1);
}

TEST(Arithmetic, SineAndTangentAreCloseToTheLibrarys) {
  for (int i = -4000; i <= 4000; ++i) {
    const float t = static_cast<float>(i) * 0.00771f;
    ASSERT_NEAR(sineOfTurns(t), std::sin(6.283185307179586 * t), 1e-6);
    ASSERT_NEAR(hyperbolicTangent(t), std::tanh(static_cast<double>(t)), 2e-4);
    ASSERT_LE(std::fabs(hyperbolicTangent(t)), 1.0f);
  }
}

}  // namespace
}  // namespace tetstream
