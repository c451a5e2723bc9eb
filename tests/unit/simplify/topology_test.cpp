// The domain that comes out is the domain that went in: checked by brute force over simplices, for
// domains with everything that a domain can have, at all ratios and windows.
#include <array>
#include <cmath>
#include <map>

#include "random.h"
#include "simplify_testing.h"

namespace tetstream::test {
namespace {

double wave(double x, double y, double z) {
  return std::sin(0.9 * x) + 0.5 * std::cos(1.3 * y + 0.4 * z);
}

void expectTopologyKeptIn(Mode mode, const TestMesh& mesh, double volume_tolerance,
                          const char* name) {
  const MeshFacts before = factsOf(mesh);
  for (double ratio : {1.0, 0.5, 0.1, 0.02})
    for (int64_t window : {64, 512, 0}) {
      if (slowRun() && (window != 64 || ratio == 0.5 || ratio == 0.1)) continue;
      SCOPED_TRACE(textOf("%s, mode %d, ratio %g, window %lld", name, static_cast<int>(mode), ratio,
                          static_cast<long long>(window)));
      const Result result = simplified(mesh, toRatio(ratio, window, mode));
      expectSound(mesh, result);
      const MeshFacts after = factsOf(result.out.mesh);
      EXPECT_EQ(topologyChange(before, after), "");
      EXPECT_EQ(after.negative, before.negative == 0 ? 0 : after.negative);
      // Windows smaller than the front, or a few dozen cells, cannot keep the shape as well.
      if (window == 0 && ratio >= 0.1 && after.cells > 60) {
        EXPECT_NEAR(after.volume, before.volume, volume_tolerance * before.volume);
      }
      if (ratio == 1) {
        EXPECT_EQ(result.report.collapses, 0);
      }
    }
}

void expectTopologyKept(const TestMesh& mesh, double volume_tolerance, const char* name) {
  for (Mode mode : kModes) expectTopologyKeptIn(mode, mesh, volume_tolerance, name);
}

TestMesh withWave(TestMesh mesh) {
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64}, wave);
  return mesh;
}

TEST(SimplifierTopology, KeepsABall) {
  const int n = slowRun() ? 3 : 6;
  expectTopologyKept(withWave(fullGrid(n, n, 2 * n)), 0.01, "grid");
}
TEST(SimplifierTopology, KeepsAnUnevenBall) {
  const int n = slowRun() ? 3 : 6;
  expectTopologyKept(withWave(fullGrid(n, n, 2 * n, 0.1)), 0.2, "jittered grid");
  expectTopologyKept(withWave(fullGrid(n, n, n, 0.1, ScalarType::kFloat32)), 0.2, "float32 grid");
}
TEST(SimplifierTopology, KeepsASlit) {
  const TestMesh slit = withWave(slitGrid(6));
  // The crack is a second boundary, a sphere of volume zero.
  const MeshFacts facts = factsOf(slit);
  ASSERT_EQ(facts.boundary_components, 2);
  ASSERT_EQ(facts.boundary_euler, 4);
  ASSERT_TRUE(facts.manifold());
  expectTopologyKept(slit, 0.05, "slit");
}
TEST(SimplifierTopology, KeepsAVoid) {
  const TestMesh shell = withWave(shellGrid(5));
  ASSERT_EQ(factsOf(shell).boundary_components, 2);
  expectTopologyKept(shell, 0.15, "shell");
}
TEST(SimplifierTopology, KeepsATunnel) {
  const TestMesh ring = withWave(ringGrid(7));
  ASSERT_EQ(factsOf(ring).boundary_euler, 0);  // a torus
  expectTopologyKept(ring, 0.15, "ring");
}
TEST(SimplifierTopology, KeepsManyTunnels) {
  const TestMesh sponge = withWave(cubes(7, 7, 3, [](int x, int y, int z) {
    return (x % 2 == 0) + (y % 2 == 0) + (z % 2 == 0) >= 2;
  }));
  ASSERT_TRUE(factsOf(sponge).manifold());
  ASSERT_LT(factsOf(sponge).boundary_euler, -10);
  expectTopologyKept(sponge, 0.2, "sponge");
}
TEST(SimplifierTopology, KeepsPartsApart) {
  const TestMesh parts = withWave(apart(4));
  ASSERT_EQ(factsOf(parts).components, 2);
  expectTopologyKept(parts, 0.02, "parts");
}

// Where two cubes touch at an edge or a vertex the boundary is no manifold: its vertices stay.
void expectTouchKept(const TestMesh& mesh, int n, int least) {
  ASSERT_FALSE(factsOf(mesh).manifold());
  expectTopologyKept(mesh, 0.02, "touching cubes");
  const Result result = simplified(mesh, toRatio(0.1, 0));
  int found = 0;
  for (size_t v = 0; v < result.out.mesh.vertexCount(); ++v)
    found += result.out.mesh.position(v, 0) == n && result.out.mesh.position(v, 1) == n;
  EXPECT_GE(found, least);
  EXPECT_EQ(factsOf(result.out.mesh).pinched_vertices, factsOf(mesh).pinched_vertices);
}
TEST(SimplifierTopology, KeepsCubesThatTouchAtAnEdge) {
  expectTouchKept(withWave(cubesAtEdge(3)), 3, 4);  // n + 1 vertices on the edge
}
TEST(SimplifierTopology, KeepsCubesThatTouchAtAVertex) {
  expectTouchKept(withWave(cubesAtVertex(3)), 3, 1);
}

// Meshes of the wild mix both orders of the corners: it says nothing, and the order is kept.
TEST(SimplifierTopology, KeepsMixedOrientation) {
  TestMesh mesh = withWave(fullGrid(4, 4, 6, 0.1));
  for (size_t c = 0; c < mesh.cellCount(); c += 3)
    std::swap(mesh.cells[4 * c], mesh.cells[4 * c + 1]);
  expectTopologyKept(mesh, 0.2, "mixed");
  const Result result = simplified(mesh, toRatio(0.5));
  const MeshFacts after = factsOf(result.out.mesh);
  EXPECT_GT(after.negative, after.cells / 6);
  EXPECT_GT(after.positive, after.cells / 3);
}

// Cells in order of their places: those of `in` that are found in `out` with the same corners.
size_t cellsFound(const TestMesh& in, const std::vector<size_t>& cells, const TestMesh& out) {
  size_t found = 0;
  for (size_t wanted : cells)
    for (size_t c = 0; c < out.cellCount(); ++c) {
      bool same = true;
      for (size_t j = 0; j < 4; ++j)
        for (int i = 0; i < 3; ++i)
          same = same && in.position(static_cast<size_t>(in.cells[4 * wanted + j]), i) ==
                             out.position(static_cast<size_t>(out.cells[4 * c + j]), i);
      if (same) {
        ++found;
        break;
      }
    }
  return found;
}

// A flat cell between four corners of an inner square, stuck in beside the cells that are there:
// its two pairs of faces are faces of cells, too, so that those have three cells.
TEST(SimplifierTopology, PassesFlatCellsOnUnchanged) {
  TestMesh mesh = withWave(fullGrid(5, 5, 5));
  const auto vertexAt = [&](double x, double y, double z) {
    for (size_t v = 0; v < mesh.vertexCount(); ++v)
      if (mesh.position(v, 0) == x && mesh.position(v, 1) == y && mesh.position(v, 2) == z)
        return static_cast<int64_t>(v);
    return int64_t{-1};
  };
  const size_t flat = mesh.cellCount() / 2;
  const int64_t square[4] = {vertexAt(2, 2, 2), vertexAt(3, 2, 2), vertexAt(3, 3, 2),
                             vertexAt(2, 3, 2)};
  mesh.cells.insert(mesh.cells.begin() + static_cast<std::ptrdiff_t>(4 * flat), square, square + 4);
  mesh = inStreamOrder(mesh);
  const MeshFacts before = factsOf(mesh);
  ASSERT_EQ(before.flat, 1);
  for (Mode mode : kModes)
    for (int64_t window : {64, 0})
      for (double ratio : {0.5, 0.1}) {
        if (slowRun() && ratio == 0.5) continue;
        const Result result = simplified(mesh, toRatio(ratio, window, mode));
        expectSound(mesh, result);
        EXPECT_EQ(factsOf(result.out.mesh).flat, 1);
        EXPECT_EQ(cellsFound(mesh, {flat}, result.out.mesh), 1u);
        EXPECT_EQ(result.report.locked_cells, 1);
      }
}

// The vertex at (3, 3, 3) of a lattice goes to (4.6, 3.1, 3.2): past its neighbours, so that some
// of its cells turn over.
TestMesh foldedGrid(std::vector<size_t>* folded) {
  TestMesh mesh = fullGrid(6, 6, 6);
  for (size_t v = 0; v < mesh.vertexCount(); ++v)
    if (mesh.position(v, 0) == 3 && mesh.position(v, 1) == 3 && mesh.position(v, 2) == 3) {
      const double place[3] = {4.6, 3.1, 3.2};
      std::memcpy(mesh.positions.bytes.data() + v * sizeof place, place, sizeof place);
    }
  for (size_t c = 0; c < mesh.cellCount(); ++c)
    if (cellSign(mesh, c) < 0) folded->push_back(c);
  return withWave(mesh);
}

TEST(SimplifierTopology, PassesFoldedCellsOnUnchanged) {
  std::vector<size_t> folded;
  const TestMesh mesh = foldedGrid(&folded);
  const MeshFacts before = factsOf(mesh);
  ASSERT_GT(folded.size(), 2u);
  ASSERT_GT(before.folded, 2);
  for (Mode mode : kModes)
    for (int64_t window : {64, 200, 0})
      for (double ratio : {0.5, 0.1}) {
        if (slowRun() && (window == 200 || ratio == 0.5)) continue;
        SCOPED_TRACE(textOf("ratio %g, window %lld", ratio, static_cast<long long>(window)));
        const Result result = simplified(mesh, toRatio(ratio, window, mode));
        expectSound(mesh, result);
        EXPECT_EQ(topologyChange(before, factsOf(result.out.mesh)), "");
        EXPECT_EQ(factsOf(result.out.mesh).folded, before.folded);
        EXPECT_EQ(cellsFound(mesh, folded, result.out.mesh), folded.size());
        EXPECT_GE(result.report.locked_cells, static_cast<int64_t>(folded.size()));
      }
}

// Cells taken out of a grid at random, in random order, some the other way round: holes, tunnels,
// loose pieces, non-manifold edges and vertices everywhere.
TestMesh randomPart(uint64_t seed) {
  Random r(seed);
  TestMesh mesh = shuffled(fullGrid(4, 4, 4, 0.1), seed);
  const uint32_t kept = 55 + r.below(44), turned = r.below(3);
  std::vector<int64_t> cells;
  for (size_t c = 0; c < mesh.cellCount(); ++c) {
    if (r.below(100) >= kept) continue;
    int64_t* cell = &mesh.cells[4 * c];
    if (turned == 2 && r.below(2)) std::swap(cell[0], cell[3]);
    cells.insert(cells.end(), cell, cell + 4);
  }
  mesh.cells = cells;
  return withWave(inStreamOrder(mesh));
}

void expectTopologyKept(const TestMesh& mesh, const MeshFacts& before,
                        const SimplifyOptions& options) {
  SCOPED_TRACE(textOf("window %d, mode %d, %g times the target are parked",
                      static_cast<int>(options.window_cells), static_cast<int>(options.mode),
                      options.parked_times));
  const Result result = simplified(mesh, options);
  expectSound(mesh, result);
  EXPECT_EQ(topologyChange(before, factsOf(result.out.mesh)), "");
}

// Far below what the mesh has, through windows of a part of it and of all.
void expectTopologyKept(const TestMesh& mesh) {
  const MeshFacts before = factsOf(mesh);
  for (int64_t window : {64, 150, 0}) {
    for (Mode mode : kModes) expectTopologyKept(mesh, before, toRatio(0.05, window, mode));
    if (window > 0) expectTopologyKept(mesh, before, parking(toRatio(0.05, window)));
  }
}

TEST(SimplifierTopology, KeepsWhateverThereIs) {
  for (uint64_t seed = 1; seed < (slowRun() ? 2u : 25u); ++seed) {
    SCOPED_TRACE(textOf("seed %d", static_cast<int>(seed)));
    expectTopologyKept(randomPart(seed));
  }
}

// Random points of a grid thrown far off: many folded cells, some flat ones, all passed on.
TEST(SimplifierTopology, KeepsTangles) {
  for (uint64_t seed = 1; seed < (slowRun() ? 2u : 25u); ++seed) {
    Random r(seed);
    TestMesh mesh = fullGrid(4, 4, 4);
    for (size_t v = 0; v < mesh.vertexCount(); ++v) {
      if (r.below(12) != 0) continue;
      const double place[3] = {r.below(9) / 2.0, r.below(9) / 2.0, r.below(9) / 2.0};
      std::memcpy(mesh.positions.bytes.data() + v * sizeof place, place, sizeof place);
    }
    SCOPED_TRACE(textOf("seed %d", static_cast<int>(seed)));
    expectTopologyKept(withWave(mesh));
  }
}

// The cubes of an octree of side 16 that has those of 1 at a sphere and those of 4 away from it:
// where smaller ones meet a larger one, some of their vertices hang beside its faces and edges, and
// no face is shared.
TestMesh hangingNodes() {
  const auto sideAt = [](double x, double y, double z) {
    for (double side = 16;; side /= 2) {
      double square = 0;
      for (double at : {x, y, z}) {
        const double centre = (std::floor(at / side) + 0.5) * side;
        square += (centre - 8) * (centre - 8);
      }
      const bool is_near = std::fabs(std::sqrt(square) - 4.8) < 0.75 * side;
      if (side <= 4 && (side <= 1 || !is_near)) return side;
    }
  };
  std::map<std::array<double, 3>, int64_t> known;
  std::vector<double> positions;
  std::vector<int64_t> cells;
  for (const double side : {4, 2, 1}) {
    const int n = static_cast<int>(16 / side);
    const TestMesh level = cubes(n, n, n, [&](int x, int y, int z) {
      return sideAt((x + 0.5) * side, (y + 0.5) * side, (z + 0.5) * side) == side;
    });
    for (int64_t v : level.cells) {
      std::array<double, 3> place;
      for (int i = 0; i < 3; ++i)
        place[static_cast<size_t>(i)] = side * level.position(static_cast<size_t>(v), i);
      const auto [at, is_new] = known.try_emplace(place, static_cast<int64_t>(known.size()));
      if (is_new) positions.insert(positions.end(), place.begin(), place.end());
      cells.push_back(at->second);
    }
  }
  TestMesh mesh = makeMesh(ScalarType::kFloat64, positions, cells);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64}, [](double x, double y, double z) {
    return std::tanh(2 * (std::hypot(x - 8, y - 8, z - 8) - 4.8));
  });
  return mesh;
}

// The larger cubes' edges are no edges of the smaller ones, which have the same ends: a flip made
// them such.
TEST(SimplifierTopology, IsKeptBesideHangingNodes) {
  const TestMesh mesh = hangingNodes();
  const MeshFacts before = factsOf(mesh);
  for (Shape shape : {Shape::kField, Shape::kSolver})
    for (double ratio : {0.35, 0.3}) {
      SCOPED_TRACE(textOf("shape %d, ratio %g", static_cast<int>(shape), ratio));
      SimplifyOptions options = toRatio(ratio);
      options.shape = shape;
      const Result result = simplified(mesh, options);
      EXPECT_GT(result.report.flips, 0);
      expectSound(mesh, result);
      EXPECT_EQ(topologyChange(before, factsOf(result.out.mesh)), "");
    }
}

// Every cell twice: each face has four cells or two. Nothing can be made of it, only worse.
TEST(SimplifierTopology, MakesAMeshThatIsThereTwiceNoWorse) {
  TestMesh mesh = fullGrid(6, 6, 6);
  const std::vector<int64_t> once = mesh.cells;
  mesh.cells.clear();
  for (size_t c = 0; c < once.size() / 4; ++c)
    for (int again = 0; again < 2; ++again)
      mesh.cells.insert(mesh.cells.end(), &once[4 * c], &once[4 * c] + 4);
  for (Mode mode : kModes) {
    const Result result = simplified(mesh, toRatio(0.1, 0, mode));
    expectSound(mesh, result);
    EXPECT_EQ(topologyChange(factsOf(mesh), factsOf(result.out.mesh)), "");
    EXPECT_EQ(factsOf(result.out.mesh).duplicates * 2,
              static_cast<int64_t>(result.out.mesh.cellCount()));
  }
}

}  // namespace
}  // namespace tetstream::test
