// Labels of faces, with the curves between them, and locked faces and edges.
#include "faces.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "ways_testing.h"

namespace tetstream::test {
namespace {

// A grid of n^3 cubes whose sides are labelled.
struct Labelled {
  explicit Labelled(int cubes)
      : n{cubes, cubes, cubes},
        mesh(inStreamOrder(shakenInside(cubes))),
        labels(sidesOf(mesh, n)) {}
  Labelled only(int64_t side) const {
    Labelled some = *this;
    std::erase_if(some.labels, [side](const auto& face) { return face.second != side; });
    return some;
  }
  int n[3];
  TestMesh mesh;
  FaceLabels labels;
};

struct Faced {
  Recorder out;
  Report report;
};

Faced simplified(const Labelled& in, const SimplifyOptions& options, size_t batch_cells) {
  Cut cut;
  cut.batch_cells = batch_cells;
  Faced result;
  Simplifier simplifier(options, result.out, {});
  FacedStream stream(in.mesh, cut, in.labels);
  copyStream(stream, simplifier);
  result.report = simplifier.report();
  EXPECT_EQ(result.out.problem, "");
  return result;
}

// The cells are all of one region: what comes out is labelled by its side, all of it is, and no
// side has grown or shrunk.
void expectLabelsKept(int64_t window, const Way& way, size_t batch_cells) {
  const Labelled in(slowRun() ? 5 : 6);
  const Faced result = simplified(in, way.toRatio(0.25, window), batch_cells);
  expectFlips(result.report, way);
  EXPECT_EQ(result.report.limited_by, "");
  const FaceLabels& labels = result.out.faces;
  std::set<int64_t> sides;
  for (const auto& [face, cells] : facesOf(result.out.mesh.cells)) {
    const auto found = labels.find(face);
    EXPECT_EQ(found != labels.end(), cells == 1);
    if (found == labels.end()) continue;
    sides.insert(found->second);
    EXPECT_EQ(found->second, sideOf(result.out.mesh, face, in.n, 1e-3));
  }
  EXPECT_EQ(sides.size(), 6u);
  EXPECT_LT(labels.size(), in.labels.size());
}
TEST(SimplifierFaces, KeepTheirLabels) {
  for (const Way& way : kWays)
    for (int64_t window : {0, 700})
      for (size_t batch : {size_t{64}, size_t{4096}}) expectLabelsKept(window, way, batch);
}

// Of one side only, so that the labels of the last one come when much of the mesh is gone already.
// Whether they come with their cells or long before makes no difference, also where other curves,
// those of an interface, are there from the beginning.
TEST(SimplifierFaces, GiveTheSameBytesWhateverTheBatches) {
  Labelled all(6);
  all.mesh.addIntegerCellData("region", [&all](size_t cell) {
    double sum = 0;
    for (size_t j = 0; j < 4; ++j)
      sum += all.mesh.position(static_cast<size_t>(all.mesh.cells[4 * cell + j]), 1);
    return sum < 12 ? 1 : 2;
  });
  for (int64_t side : {2, 4, 6}) {
    const Labelled in = all.only(side);
    const auto bytes = [&](size_t batch_cells) {
      return simplified(in, toRatio(0.25, 700), batch_cells).out.allBytes();
    };
    const std::vector<unsigned char> first = bytes(100000);
    for (size_t batch_cells : {7, 64, 1000}) EXPECT_TRUE(bytes(batch_cells) == first) << side;
  }
}

// Two regions with a bent interface, whose rim crosses the curves between the labels of faces, to
// fewer cells than can be had: where whatever was legal was collapsed, half of a region was lost,
// and vertices left the cube by half its width.
TEST(SimplifierFaces, CostRegionsNoVolumeWhereFewCellsAreLeft) {
  const int n = 6;
  Labelled in(n);
  in.mesh.addIntegerCellData("region", [&in](size_t cell) {
    double x = 0, z = 0;
    for (size_t j = 0; j < 4; ++j) {
      const auto v = static_cast<size_t>(in.mesh.cells[4 * cell + j]);
      x += in.mesh.position(v, 0) / 4;
      z += in.mesh.position(v, 2) / 4;
    }
    return x + 2 * std::sin(z) < 3 ? 1 : 2;
  });
  for (double ratio : {0.1, 0.02}) {
    const Faced result = simplified(in, toRatio(ratio), 4096);
    EXPECT_EQ(result.report.regions, "by region");  // and no word of volumes
    EXPECT_NEAR(result.report.volume_out, n * n * n, 1e-3 * n * n * n);
    for (size_t v = 0; v < result.out.mesh.vertexCount(); ++v)
      for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(result.out.mesh.position(v, i), n / 2, 0.6 * n);
  }
}

// A ball, whose curves are bent, without regions: 3.6 % of it were lost.
TEST(SimplifierFaces, CostTheBodyNoVolumeWhereFewCellsAreLeft) {
  const int n = 6;
  Labelled in(n);
  std::vector<double> places;
  for (size_t v = 0; v < in.mesh.vertexCount(); ++v) {
    double x[3], largest = 0, square = 0;
    for (size_t i = 0; i < 3; ++i) {
      x[i] = in.mesh.position(v, i) - n / 2;
      largest = std::max(largest, std::fabs(x[i]));
      square += x[i] * x[i];
    }
    for (double at : x) places.push_back(square > 0 ? at * largest / std::sqrt(square) : 0);
  }
  in.mesh = makeMesh(ScalarType::kFloat64, places, in.mesh.cells);
  for (double ratio : {0.1, 0.05, 0.02}) {
    const Report report = simplified(in, toRatio(ratio), 4096).report;
    EXPECT_NEAR(report.volume_out, report.volume_in, 1e-2 * report.volume_in);
  }
}

// A long rod whose round side is labelled by quarters: what goes into the curves between them takes
// a little of the rod each time, 5 % in all.
TEST(SimplifierFaces, CostALongRodLittleVolume) {
  const int n[3] = {2, 2, 40};
  const TestMesh bar = fullGrid(n[0], n[1], n[2]);
  std::vector<double> places;
  for (size_t v = 0; v < bar.vertexCount(); ++v) {
    const double x = bar.position(v, 0) - 1, y = bar.position(v, 1) - 1;
    const double square = x * x + y * y, largest = std::max(std::fabs(x), std::fabs(y));
    const double times = square > 0 ? 0.6 * largest / std::sqrt(square) : 0;
    places.insert(places.end(), {x * times, y * times, 2 * bar.position(v, 2)});
  }
  FacedMesh in(makeMesh(ScalarType::kFloat64, places, bar.cells), sidesOf(bar, n));
  for (const double ratio : {0.3, 0.1}) {
    Recorder out;
    Simplifier simplifier(toRatio(ratio), out, {});
    simplifier.begin(in.mesh.schema);
    simplifier.put(in.view());
    simplifier.finish();
    const Report report = simplifier.report();
    EXPECT_NEAR(report.volume_out, report.volume_in, 0.03 * report.volume_in);
  }
}

// The status and the sentence of a stream whose batches of `batch_cells` cells are changed on their
// way: change(number, batch).
template <class Change>
std::pair<Status, std::string> refusal(const TestMesh& mesh, size_t batch_cells, Change change) {
  return thrownBy([&] {
    Recorder out;
    Cut cut;
    cut.batch_cells = batch_cells;
    MeshStream stream(mesh, cut);
    Simplifier simplifier(toRatio(0.3, 64), out, {});
    simplifier.begin(stream.schema());
    BatchView batch;
    for (int number = 0; stream.next(batch); ++number) {
      change(number, batch);
      simplifier.put(batch);
    }
    simplifier.finish();
  });
}

void expectStrange(const std::pair<Status, std::string>& refused, const char* words) {
  EXPECT_EQ(refused.first, Status::kBadData);
  EXPECT_NE(refused.second.find(words), std::string::npos) << refused.second;
}

// Also where the vertices are gone from the window long before the end.
TEST(SimplifierFaces, OfNoCellAreRefused) {
  const TestMesh mesh = inStreamOrder(fullGrid(4, 4, 12));
  const auto last =
      static_cast<int64_t>(mesh.vertexCount()) - 1;  // others are gone before it comes
  for (size_t batch_cells : {size_t{64}, mesh.cellCount()})
    for (int64_t far : {int64_t{16}, int64_t{24}, last}) {
      if (far == last && batch_cells == 64) continue;
      const int64_t stray[3] = {0, 1, far}, label = 7;
      ASSERT_FALSE(facesOf(mesh.cells).count({stray[0], stray[1], stray[2]}));
      expectStrange(refusal(mesh, batch_cells,
                            [&](int number, BatchView& batch) {
                              if (number > 0) return;
                              ASSERT_GT(batch.vertex_count, static_cast<size_t>(far));
                              batch.face_count = 1;
                              batch.faces = stray;
                              batch.face_labels = &label;
                            }),
                    "labelled face 0 is the face of no cell");
    }
  // Of a mesh that was put into an order, when the vertices are gone: by the number in the input.
  const int64_t gone[3] = {0, 1, 2}, origin = 40;
  expectStrange(refusal(mesh, 64,
                        [&](int number, BatchView& batch) {
                          if (number != 10) return;
                          batch.face_count = 1;
                          batch.faces = gone;
                          batch.face_labels = batch.face_origins = &origin;
                        }),
                "labelled face 40 is the face of no cell");
  const int64_t unknown[3] = {0, 1, static_cast<int64_t>(mesh.vertexCount())}, label = 7;
  expectStrange(refusal(mesh, mesh.cellCount(),
                        [&](int, BatchView& batch) {
                          batch.face_count = 1;
                          batch.faces = unknown;
                          batch.face_labels = &label;
                        }),
                "not declared");
}

// In one batch, and in two of which the second comes when the first one's label has its place.
// A face that three cells share is non-manifold: it stays as it is, with its label.
TEST(SimplifierFaces, OfThreeCellsKeepTheirLabels) {
  Labelled in(1);
  in.mesh = makeMesh(ScalarType::kFloat64,
                     {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.3, 0.3, 1, 0.3, 0.3, -1, 0.3, 0.3, -2},
                     {0, 1, 2, 3, 0, 1, 2, 4, 0, 1, 2, 5});
  in.labels = {{{0, 1, 2}, 5}};
  const Faced result = simplified(in, toRatio(1), 100);
  EXPECT_EQ(result.out.mesh.cellCount(), 3u);
  EXPECT_EQ(result.out.faces, in.labels);
}

TEST(SimplifierFaces, ThatComeTwiceAreRefused) {
  const TestMesh mesh = inStreamOrder(fullGrid(4, 4, 12));
  const int64_t* c = mesh.cells.data();
  const int64_t twice[6] = {c[0], c[1], c[2], c[2], c[0], c[1]}, labels[2] = {7, 7};
  expectStrange(refusal(mesh, 64,
                        [&](int number, BatchView& batch) {
                          if (number > 0) return;
                          batch.face_count = 2;
                          batch.faces = twice;
                          batch.face_labels = labels;
                        }),
                "labelled faces 0 and 1 have the same vertices");
  // The last face of all whose vertices are alive to the end: every batch may bring it again.
  Face last{};
  for (const auto& [face, cells] : facesOf(mesh.cells)) last = std::max(last, face);
  expectStrange(refusal(mesh, 1,
                        [&](int number, BatchView& batch) {
                          const auto cells = static_cast<int>(mesh.cellCount());
                          if (number < cells - 2) return;
                          batch.face_count = 1;
                          batch.faces = last.data();
                          batch.face_labels = labels;
                        }),
                "labelled face");
}

TEST(SimplifierFaces, AreAsManyAsAnnounced) {
  Labelled in(2);
  FacedMesh faced(in.mesh, in.labels);
  for (int64_t more : {0, 1}) {
    faced.mesh.schema.face_count = static_cast<int64_t>(in.labels.size()) + more;
    const auto [status, text] = thrownBy([&] {
      Recorder out;
      Simplifier simplifier(toRatio(0.5), out, {});
      simplifier.begin(faced.mesh.schema);
      simplifier.put(faced.view());
      simplifier.finish();
    });
    EXPECT_EQ(status, more ? Status::kBadData : Status::kOk) << text;
  }
}

// A budget bounds what curves and labels take, too, and leaves enough for the target: the window is
// smaller for them.
TEST(SimplifierFaces, AndRidgesFitTheMemory) {
  Labelled in(16), bare = in;
  bare.labels.clear();
  in.mesh.schema.face_count = static_cast<int64_t>(in.labels.size());
  SimplifyOptions options = toRatio(0.2);
  options.memory_bytes = 1200 << 10;
  int64_t before = simplified(bare, options, 4096).report.window_cells;
  EXPECT_LT(before, static_cast<int64_t>(in.mesh.cellCount()));
  options.feature_angle = 45;
  for (const Labelled& more : {bare, in}) {
    const Report report = simplified(more, options, 4096).report;
    EXPECT_LE(report.peak_window_bytes, static_cast<size_t>(options.memory_bytes));
    EXPECT_LT(report.window_cells, before);
    EXPECT_EQ(report.limited_by, "");
    before = report.window_cells;
  }
}

// The curve between an inlet and the walls has corners of its own, which are those of the body.
TEST(SimplifierFaces, OfADuctMeetAtItsCorners) {
  Labelled in(slowRun() ? 6 : 8);
  for (auto& [face, label] : in.labels) label = std::min<int64_t>(label, 3);
  for (const double ratio : {0.3, 0.1}) {
    const Faced result = simplified(in, toRatio(ratio), 4096);
    int corners = 0;
    for (size_t v = 0; v < result.out.mesh.vertexCount(); ++v) {
      int on = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const double x = result.out.mesh.position(v, axis), end = x > 1 ? in.n[0] : 0;
        if (std::fabs(x - end) > 1e-3) continue;
        EXPECT_EQ(x, end);
        ++on;
      }
      corners += on == 3;
    }
    EXPECT_EQ(corners, 8);
  }
}

// Of a face's area as a vector the part along x.
double alongX(const TestMesh& mesh, const int64_t* face) {
  const auto edge = [&](size_t k, int axis) {
    return mesh.position(static_cast<size_t>(face[k]), axis) -
           mesh.position(static_cast<size_t>(face[0]), axis);
  };
  return 0.5 * (edge(1, 1) * edge(2, 2) - edge(1, 2) * edge(2, 1));
}

// What comes out, with the faces as they are wound.
class WoundFaces final : public Sink {
 public:
  void begin(const Schema& schema) override { kept.begin(schema); }
  void put(const BatchView& batch) override {
    kept.put(batch);
    for (size_t i = 0; i < batch.face_count; ++i)
      area[batch.face_labels[i]] += alongX(kept.mesh, &batch.faces[3 * i]);
  }
  void finish() override { kept.finish(); }
  Recorder kept;
  std::map<int64_t, double> area;  // along x, by label
};

// Two sheets inside look to either side; a side of the boundary, which came both ways, outwards.
TEST(SimplifierFaces, LookWhereTheyDid) {
  const int n = 6;
  FacedMesh in(inStreamOrder(fullGrid(n, n, n)), {});
  for (const auto& [face, cells] : facesOf(in.mesh.cells)) {
    Face wound = face;
    std::set<double> x;
    for (const int64_t v : face) x.insert(in.mesh.position(static_cast<size_t>(v), 0));
    if (x.size() > 1 || (*x.begin() != 0 && *x.begin() != 2 && *x.begin() != 4)) continue;
    const bool looks_up = *x.begin() == 4 || (*x.begin() == 0 && in.labels.size() % 2 == 0);
    if ((alongX(in.mesh, face.data()) > 0) != looks_up) std::swap(wound[1], wound[2]);
    in.corners.insert(in.corners.end(), wound.begin(), wound.end());
    in.labels.push_back(static_cast<int64_t>(*x.begin()));
  }
  for (const Way& way : kWays)
    for (const double ratio : {1.0, 0.3}) {
      WoundFaces out;
      Simplifier simplifier(way.toRatio(ratio, 700), out, {});
      simplifier.begin(in.mesh.schema);
      simplifier.put(in.view());
      simplifier.finish();
      EXPECT_EQ(out.kept.problem, "");
      ASSERT_EQ(out.area.size(), 3u);
      EXPECT_NEAR(out.area[0], -n * n, 1e-3);
      EXPECT_NEAR(out.area[2], -n * n, 1e-3);
      EXPECT_NEAR(out.area[4], n * n, 1e-3);
    }
}

// Those of a large batch come with their cells: the vertices of all would fill the window.
TEST(SimplifierFaces, WaitInTheBatchForTheirVertices) {
  const Labelled in(slowRun() ? 8 : 12);
  const auto peak = [&in](size_t batch_cells) {
    return static_cast<double>(
        simplified(in, toRatio(0.2, 700), batch_cells).report.peak_window_bytes);
  };
  EXPECT_LT(peak(in.mesh.cellCount()), 1.1 * peak(64));
}

std::set<std::pair<Place, Place>> edgesOf(const TestMesh& mesh) {
  std::set<std::pair<Place, Place>> edges;
  for (size_t c = 0; c < mesh.cellCount(); ++c)
    for (size_t i = 0; i < 4; ++i)
      for (size_t j = 0; j < 4; ++j)
        edges.emplace(placeOf(mesh, mesh.cells[4 * c + i]), placeOf(mesh, mesh.cells[4 * c + j]));
  return edges;
}

// Faces of one side, and edges inside, are locked: they are where they were.
TEST(SimplifierLocks, KeepFacesAndEdges) {
  const int n[3] = {5, 5, 5};
  const TestMesh mesh = shakenInside(5);
  FaceLabels low;
  for (const auto& [face, cells] : facesOf(mesh.cells))
    if (cells == 1 && sideOf(mesh, face, n) == 5) low[face] = 4;
  EXPECT_EQ(low.size(), 50u);
  FacedMesh faced(mesh, low);
  faced.locks.assign(low.size(), 1);
  std::vector<int64_t> edges;
  for (size_t c = 0; c < mesh.cellCount(); c += 25)
    edges.insert(edges.end(), {mesh.cells[4 * c], mesh.cells[4 * c + 1]});
  BatchView batch = faced.view();
  batch.edge_count = edges.size() / 2;
  batch.locked_edges = edges.data();
  for (const Way& way : kWays) {
    Recorder out;
    Simplifier simplifier(way.toRatio(0.3), out, {});
    simplifier.begin(mesh.schema);
    simplifier.put(batch);
    simplifier.finish();
    EXPECT_EQ(out.faces.size(), low.size());
    std::set<Place> left;
    for (size_t v = 0; v < out.mesh.vertexCount(); ++v)
      left.insert(placeOf(out.mesh, static_cast<int64_t>(v)));
    for (int64_t v : faced.corners) EXPECT_TRUE(left.count(placeOf(mesh, v)));
    const auto edges_left = edgesOf(out.mesh);
    for (size_t i = 0; i < edges.size(); i += 2)
      EXPECT_TRUE(edges_left.count({placeOf(mesh, edges[i]), placeOf(mesh, edges[i + 1])})) << i;
    EXPECT_GT(simplifier.report().collapses, 50);
    expectFlips(simplifier.report(), way);
  }
}

}  // namespace
}  // namespace tetstream::test
