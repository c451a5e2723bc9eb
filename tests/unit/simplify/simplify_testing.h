// tests: one simplification of a small mesh, and what came of it.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "mesh_facts.h"
#include "shapes.h"
#include "simplifier.h"
#include "status.h"
#include "test_mesh.h"
#include "thrown_by.h"
#include "vector3.h"

namespace tetstream::test {

constexpr ScalarType k32 = ScalarType::kFloat32, k64 = ScalarType::kFloat64;

using Place = std::array<double, 3>;

inline Place placeOf(const TestMesh& mesh, int64_t v) {
  const auto row = static_cast<size_t>(v);
  return {mesh.position(row, 0), mesh.position(row, 1), mesh.position(row, 2)};
}

struct Result {
  Recorder out;
  Report report;
};

inline Result simplified(const TestMesh& mesh, const SimplifyOptions& options,
                         const Cut& cut = {}) {
  Result result;
  Simplifier simplifier(options, result.out, {});
  MeshStream stream(mesh, cut);
  copyStream(stream, simplifier);
  result.report = simplifier.report();
  return result;
}

// What is promised is promised for every mode; the first is the default.
constexpr Mode kModes[] = {Mode::kSweep, Mode::kPaper, Mode::kQueue};

inline SimplifyOptions inMode(Mode mode) {
  SimplifyOptions options;
  options.mode = mode;
  return options;
}

inline SimplifyOptions toRatio(double ratio, int64_t window = 0,
                               Mode mode = SimplifyOptions().mode) {
  SimplifyOptions options = inMode(mode);
  options.ratio = ratio;
  options.window_cells = window;
  return options;
}

// With windows that leave so many times the target, which is simplified further at the end.
inline SimplifyOptions parking(SimplifyOptions options, double times = 2) {
  options.parked_times = times;
  return options;
}

// Without signs.
inline double volumeOf(const TestMesh& mesh) {
  double volume = 0;
  for (size_t c = 0; c < mesh.cellCount(); ++c) volume += cellVolume(mesh, c);
  return volume;
}

// What holds for every result: it is a stream, and the report says what is in it.
inline void expectSound(const TestMesh& in, const Result& result) {
  EXPECT_EQ(result.out.problem, "");
  EXPECT_TRUE(result.out.finished);
  EXPECT_TRUE(result.out.exact_finalization);
  EXPECT_TRUE(result.out.compact);
  const Report& report = result.report;
  EXPECT_EQ(report.cells_in, static_cast<int64_t>(in.cellCount()));
  EXPECT_EQ(report.vertices_in, static_cast<int64_t>(in.vertexCount()));
  EXPECT_EQ(report.cells_out, static_cast<int64_t>(result.out.mesh.cellCount()));
  EXPECT_EQ(report.vertices_out, static_cast<int64_t>(result.out.mesh.vertexCount()));
  EXPECT_NEAR(report.volume_in, volumeOf(in), 1e-5 * volumeOf(in));
  EXPECT_NEAR(report.volume_out, volumeOf(result.out.mesh), 1e-9 * volumeOf(result.out.mesh));
  EXPECT_EQ(report.limited_by.empty(), report.cells_out <= report.target_cells)
      << report.limited_by;
}

// Not above the target, and at most 0.2 % and 10 cells below.
inline void expectReached(const Result& result) {
  const Report& report = result.report;
  EXPECT_LE(report.cells_out, report.target_cells) << report.limited_by;
  EXPECT_GE(report.cells_out,
            report.target_cells - std::max<int64_t>(report.target_cells / 500, 10));
}

// A slab whose faces go up and down by a part of a cube from one vertex to the next, or do not,
// with a field that hardly bends; so many cubes thick.
inline TestMesh roughSlab(int n, double roughness, int thick = 4) {
  const TestMesh grid = fullGrid(n, n, thick);
  std::vector<double> positions;
  for (size_t v = 0; v < grid.vertexCount(); ++v) {
    double x[3];
    for (int i = 0; i < 3; ++i) x[i] = grid.position(v, i);
    const bool on_face = x[2] < 0.5 || x[2] > thick - 0.5;
    x[2] += on_face ? roughness * std::sin(7 * x[0] + 11 * x[1] + 3 * x[0] * x[1]) : 0;
    positions.insert(positions.end(), x, x + 3);
  }
  TestMesh mesh = makeMesh(k64, positions, grid.cells);
  addPositionField(mesh, {"f", 1, k64}, [n](double x, double y, double z) {
    return std::sin(3 * x / n) + std::cos(2 * y / n) + 0.2 * std::sin(z / 2);
  });
  return mesh;
}

// Of the cells with this label in the first array of cell data.
inline double regionVolume(const TestMesh& mesh, int64_t label) {
  double volume = 0;
  for (size_t c = 0; c < mesh.cellCount(); ++c) {
    if (mesh.cellInteger(0, c) != label) continue;
    double e[3][3];
    for (size_t k = 0; k < 3; ++k)
      for (size_t i = 0; i < 3; ++i)
        e[k][i] = mesh.position(static_cast<size_t>(mesh.cells[4 * c + k + 1]), i) -
                  mesh.position(static_cast<size_t>(mesh.cells[4 * c]), i);
    volume += std::fabs(determinant(e[0], e[1], e[2])) / 6;
  }
  return volume;
}

}  // namespace tetstream::test
