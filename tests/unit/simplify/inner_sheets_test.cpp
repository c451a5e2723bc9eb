// Labelled faces inside a region: sheets that end there, cross, meet the boundary or close, are
// kept as interfaces are.
#include <algorithm>
#include <cmath>
#include <set>

#include "faces.h"
#include "groups.h"
#include "mesh_facts.h"
#include "ways_testing.h"

namespace tetstream::test {
namespace {

using Middle = std::array<double, 3>;  // of a face, in cubes from the middle of the grid
using Label = std::function<int64_t(const Middle&)>;

// A grid of n^3 cubes, n even, of one region. `label` tells the labels of faces inside, 0: none, of
// those in a plane between cubes; `bend` then moves vertices, from their places to others.
struct Sheeted {
  Sheeted(int cubes, const Label& label, const std::function<void(double*)>& bend = {})
      : n(cubes), mesh(inStreamOrder(fullGrid(n, n, n))) {
    std::vector<double> places;
    for (size_t v = 0; v < mesh.vertexCount(); ++v)
      for (int i = 0; i < 3; ++i) places.push_back(mesh.position(v, i) - n / 2);
    for (const auto& [face, cells] : facesOf(mesh.cells)) {
      Middle middle{};
      bool in_plane = false;
      for (size_t i = 0; i < 3; ++i) {
        const auto at = [&places, &face = face, i](size_t k) {
          return places[3 * static_cast<size_t>(face[k]) + i];
        };
        middle[i] = (at(0) + at(1) + at(2)) / 3;
        in_plane |= at(0) == at(1) && at(0) == at(2);
      }
      if (const int64_t l = in_plane && cells == 2 ? label(middle) : 0) labels[face] = l;
    }
    for (size_t v = 0; bend && v < mesh.vertexCount(); ++v) bend(&places[3 * v]);
    mesh = makeMesh(ScalarType::kFloat64, places, mesh.cells);
  }
  int n;
  TestMesh mesh;
  FaceLabels labels;
};

bool inSquare(double a, double b, double half) {
  return std::fabs(a) < half && std::fabs(b) < half;
}

// By brute force: of the faces of each label, the boundary's others being 0, and of the edges at
// which faces of the same labels meet, but two of one: parts, and the Euler characteristic.
struct Pattern {
  std::map<std::vector<int64_t>, std::pair<size_t, int64_t>> sheets, curves;
  bool operator==(const Pattern&) const = default;
};

using Simplices = std::vector<std::vector<int64_t>>;

std::pair<size_t, int64_t> partsAndEuler(const Simplices& simplices) {
  std::set<int64_t> vertices;
  std::set<std::vector<int64_t>> edges;
  std::map<std::vector<int64_t>, size_t> first;  // that has this part of its rim
  Groups parts(simplices.size());
  for (size_t s = 0; s < simplices.size(); ++s)
    for (size_t j = 0; j < simplices[s].size(); ++j) {
      std::vector<int64_t> side = simplices[s];
      vertices.insert(side[j]);
      side.erase(side.begin() + static_cast<std::ptrdiff_t>(j));
      edges.insert(side);
      parts.join(first.emplace(side, s).first->second, s);
    }
  std::set<size_t> found;
  for (size_t s = 0; s < simplices.size(); ++s) found.insert(parts.find(s));
  const auto count = [](size_t n) { return static_cast<int64_t>(n); };
  const bool flat = !simplices.empty() && simplices[0].size() == 3;
  return {found.size(), flat
                            ? count(vertices.size()) - count(edges.size()) + count(simplices.size())
                            : count(vertices.size()) - count(simplices.size())};
}

Pattern patternOf(const TestMesh& mesh, const FaceLabels& labels) {
  std::map<std::vector<int64_t>, Simplices> sheets, curves;
  std::map<std::vector<int64_t>, std::vector<int64_t>> round;  // an edge
  for (const auto& [face, cells] : facesOf(mesh.cells)) {
    const auto found = labels.find(face);
    if (found == labels.end() && cells == 2) continue;
    const int64_t label = found != labels.end() ? found->second : 0;
    sheets[{label}].push_back({face[0], face[1], face[2]});
    for (size_t j = 0; j < 3; ++j) round[{face[j == 0], face[j == 2 ? 1 : 2]}].push_back(label);
  }
  for (auto& [edge, met] : round) {
    std::sort(met.begin(), met.end());
    if (met.size() != 2 || met[0] != met[1]) curves[met].push_back(edge);
  }
  Pattern pattern;
  for (const auto& [key, faces] : sheets) pattern.sheets[key] = partsAndEuler(faces);
  for (const auto& [key, edges] : curves) pattern.curves[key] = partsAndEuler(edges);
  return pattern;
}

std::map<int64_t, double> areasOf(const TestMesh& mesh, const FaceLabels& labels) {
  std::map<int64_t, double> areas;
  for (const auto& [face, label] : labels) {
    double e[2][3], square = 0;
    for (size_t k = 0; k < 2; ++k)
      for (int i = 0; i < 3; ++i)
        e[k][i] = mesh.position(static_cast<size_t>(face[k + 1]), i) -
                  mesh.position(static_cast<size_t>(face[0]), i);
    for (size_t i = 0; i < 3; ++i) {
      const double c =
          e[0][(i + 1) % 3] * e[1][(i + 2) % 3] - e[0][(i + 2) % 3] * e[1][(i + 1) % 3];
      square += c * c;
    }
    areas[label] += std::sqrt(square) / 2;
  }
  return areas;
}

// Of the cells that labelled faces close off from the boundary.
double enclosedVolume(const TestMesh& mesh, const FaceLabels& labels) {
  std::map<Face, size_t> first;
  Groups parts(mesh.cellCount() + 1);  // the outside is the last
  const auto faceOf = [&](size_t c, size_t j) {
    Face f;
    for (size_t k = 0; k < 3; ++k) f[k] = mesh.cells[4 * c + (j + 1 + k) % 4];
    std::sort(f.begin(), f.end());
    return f;
  };
  for (size_t c = 0; c < mesh.cellCount(); ++c)
    for (size_t j = 0; j < 4; ++j) {
      const Face face = faceOf(c, j);
      if (labels.count(face)) continue;
      const auto [other, is_new] = first.emplace(face, c);
      if (!is_new) parts.join(other->second, c);
    }
  for (const auto& [face, cells] : facesOf(mesh.cells))
    if (cells == 1 && !labels.count(face)) parts.join(first[face], mesh.cellCount());
  double volume = 0;
  for (size_t c = 0; c < mesh.cellCount(); ++c)
    if (parts.find(c) != parts.find(mesh.cellCount())) volume += cellVolume(mesh, c);
  return volume;
}

struct KeptSheets {
  TestMesh mesh;
  FaceLabels labels;
  Report report;
};

KeptSheets simplified(const Sheeted& in, const SimplifyOptions& options) {
  Recorder out;
  Simplifier simplifier(options, out, {});
  FacedStream stream(in.mesh, {}, in.labels);
  copyStream(stream, simplifier);
  EXPECT_EQ(out.problem, "");
  EXPECT_EQ(simplifier.report().limited_by, "");
  return {out.mesh, out.faces, simplifier.report()};
}

// Labels, parts, rims and the curves where sheets meet are as they were; there are fewer faces.
void expectSheetsKept(const Sheeted& in, const KeptSheets& out, double area_off) {
  const auto all = facesOf(out.mesh.cells);
  for (const auto& [face, label] : out.labels) EXPECT_TRUE(all.count(face));
  EXPECT_TRUE(patternOf(in.mesh, in.labels) == patternOf(out.mesh, out.labels));
  EXPECT_EQ(topologyChange(factsOf(in.mesh), factsOf(out.mesh)), "");
  EXPECT_LT(10 * out.labels.size(), 9 * in.labels.size());
  const auto before = areasOf(in.mesh, in.labels), after = areasOf(out.mesh, out.labels);
  for (const auto& [label, area] : before)
    EXPECT_NEAR(after.at(label), area, area_off * area) << "label " << label;
}

// In core, and in a window of two fronts and a bit.
template <class Check>
void forAllWays(const Sheeted& in, double area_off, Check check) {
  for (const Way& way : kWays)
    for (int64_t window : {int64_t{0}, int64_t{14} * in.n * in.n}) {
      const KeptSheets out = simplified(in, way.toRatio(0.2, window));
      expectSheetsKept(in, out, area_off);
      check(out);
      if (slowRun()) return;
    }
}

// Corners of labelled faces lie in one of these planes, so far.
std::function<void(const KeptSheets&)> lieInPlanes(std::initializer_list<int> axes) {
  return [axes = std::vector<int>(axes)](const KeptSheets& out) {
    for (const auto& [face, label] : out.labels)
      for (int64_t v : face)
        EXPECT_NEAR(out.mesh.position(static_cast<size_t>(v), axes[static_cast<size_t>(label - 1)]),
                    0, 1e-3);
  };
}

// A square that ends all round inside, with a hole.
TEST(InnerSheets, KeepTheirRims) {
  const Sheeted in(8, [](const Middle& m) {
    return m[2] == 0 && inSquare(m[0], m[1], 3) && !inSquare(m[0], m[1], 1);
  });
  EXPECT_EQ(in.labels.size(), 64u);
  forAllWays(in, 1e-3, lieInPlanes({2}));
}

// They cross along a line that ends inside at both ends, where the one is done and the other goes
// on.
TEST(InnerSheets, CrossEachOther) {
  const Sheeted in(8, [](const Middle& m) -> int64_t {
    if (m[2] == 0 && inSquare(m[0], m[1], 3)) return 1;
    return m[0] == 0 && inSquare(m[1], m[2], 2) ? 2 : 0;
  });
  forAllWays(in, 1e-3, lieInPlanes({2, 0}));
}

// Two labels side by side, a third one that stands on the curve between them.
TEST(InnerSheets, MeetAtACurve) {
  const Sheeted in(8, [](const Middle& m) -> int64_t {
    if (m[2] == 0 && inSquare(m[0], m[1], 3)) return m[0] < 0 ? 1 : 2;
    return m[0] == 0 && m[2] > 0 && inSquare(m[1], m[2], 3) ? 3 : 0;
  });
  forAllWays(in, 1e-3, lieInPlanes({2, 2, 0}));
}

// A sheet that reaches the boundary on three sides, bent like the ground.
TEST(InnerSheets, EndAtTheBoundary) {
  const Sheeted in(
      8, [](const Middle& m) { return m[2] == 0 && m[0] < 1; },
      [](double* x) { x[2] += 0.04 * (16 - x[2] * x[2]) * std::cos(0.5 * x[0]) / 4; });
  forAllWays(in, 1e-2, [](const KeptSheets&) {});
}

// A box that becomes a ball nearly; it neither shrinks nor loses a face.
TEST(InnerSheets, CloseInsideARegion) {
  const Sheeted in(
      10,
      [](const Middle& m) {
        return std::max({std::fabs(m[0]), std::fabs(m[1]), std::fabs(m[2])}) == 3;
      },
      [](double* x) {
        const double largest = std::max({std::fabs(x[0]), std::fabs(x[1]), std::fabs(x[2])});
        const double length = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
        for (int i = 0; length > 0 && i < 3; ++i) x[i] *= 0.4 + 0.6 * largest / length;
      });
  const double volume = enclosedVolume(in.mesh, in.labels);
  EXPECT_GT(volume, 100);
  forAllWays(in, 3e-2, [&](const KeptSheets& out) {
    EXPECT_NEAR(enclosedVolume(out.mesh, out.labels), volume, 1e-2 * volume);
  });
}

// A disk with a round rim, and one with another label in its middle: neither grows nor shrinks.
TEST(InnerSheets, KeepTheAreasOfRoundParts) {
  const Sheeted in(
      12,
      [](const Middle& m) -> int64_t {
        if (m[2] != 0 || !inSquare(m[0], m[1], 5)) return 0;
        return inSquare(m[0], m[1], 3) ? 2 : 1;
      },
      [](double* x) {  // squares become circles
        const double largest = std::max(std::fabs(x[0]), std::fabs(x[1]));
        const double length = std::sqrt(x[0] * x[0] + x[1] * x[1]);
        for (int i = 0; length > 0 && i < 2; ++i) x[i] *= 0.3 + 0.7 * largest / length;
      });
  forAllWays(in, 1e-2, lieInPlanes({2, 2}));
}

// Whether their faces come with their cells or long before makes no difference.
TEST(InnerSheets, GiveTheSameBytesWhateverTheBatches) {
  const Sheeted in(8, [](const Middle& m) { return m[2] == 1 && inSquare(m[0], m[1], 3); });
  const auto bytes = [&](size_t batch_cells) {
    Recorder out;
    Cut cut;
    cut.batch_cells = batch_cells;
    Simplifier simplifier(toRatio(0.25, 700), out, {});
    FacedStream stream(in.mesh, cut, in.labels);
    copyStream(stream, simplifier);
    return out.allBytes();
  };
  const std::vector<unsigned char> first = bytes(100000);
  for (size_t batch_cells : {7, 64, 1000}) EXPECT_TRUE(bytes(batch_cells) == first);
}

}  // namespace
}  // namespace tetstream::test
