// What a user wants to stay: ridges, the labels of faces with the curves between them, locks.
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "simplify_testing.h"

namespace tetstream::test {
namespace {

// What is promised holds in every mode, and where cells are flipped, too.
struct Way {
  Mode mode;
  Shape shape;
  SimplifyOptions toRatio(double ratio, int64_t window = 0) const {
    SimplifyOptions options = test::toRatio(ratio, window, mode);
    options.shape = shape;
    return options;
  }
};
constexpr Way kWays[] = {{Mode::kSweep, Shape::kField},
                         {Mode::kSweep, Shape::kSolver},
                         {Mode::kPaper, Shape::kField},
                         {Mode::kQueue, Shape::kField}};

using Place = std::array<double, 3>;
using Face = std::array<int64_t, 3>;

Place placeOf(const TestMesh& mesh, int64_t v) {
  const auto row = static_cast<size_t>(v);
  return {mesh.position(row, 0), mesh.position(row, 1), mesh.position(row, 2)};
}

// A full grid has its sides at 0 and at its numbers of cubes.
struct Box {
  int n[3];
  int sidesAt(const Place& p, double tolerance) const {
    int sides = 0;
    for (size_t i = 0; i < 3; ++i)
      sides += std::fabs(p[i]) <= tolerance || std::fabs(p[i] - n[i]) <= tolerance;
    return sides;
  }
  // 1 to 6; 0 for a face that lies in no side.
  int64_t sideOf(const Place (&corners)[3], double tolerance) const {
    for (size_t i = 0; i < 3; ++i)
      for (int high = 0; high < 2; ++high) {
        int on = 0;
        for (const Place& p : corners) on += std::fabs(p[i] - (high ? n[i] : 0)) <= tolerance;
        if (on == 3) return static_cast<int64_t>(2 * i + 1) + high;
      }
    return 0;
  }
};

// A full grid with its inside shaken, so that flips have something to do.
TestMesh shakenInside(int n) {
  const TestMesh grid = fullGrid(n, n, n), shaken = fullGrid(n, n, n, 0.25);
  std::vector<double> positions;
  for (size_t v = 0; v < grid.vertexCount(); ++v) {
    const bool outside = Box{{n, n, n}}.sidesAt(placeOf(grid, static_cast<int64_t>(v)), 0) > 0;
    for (int i = 0; i < 3; ++i) positions.push_back((outside ? grid : shaken).position(v, i));
  }
  return makeMesh(ScalarType::kFloat64, positions, grid.cells);
}

// Flips take place where shapes come first, and nowhere else.
void expectFlips(const Report& report, const Way& way) {
  if (way.shape == Shape::kSolver)
    EXPECT_GT(report.flips, 0);
  else
    EXPECT_EQ(report.flips, 0);
}

// The faces of one cell, each with its sorted vertices.
std::map<Face, int> facesOf(const std::vector<int64_t>& cells) {
  std::map<Face, int> faces;
  for (size_t c = 0; c < cells.size() / 4; ++c)
    for (size_t j = 0; j < 4; ++j) {
      Face f;
      for (size_t k = 0; k < 3; ++k) f[k] = cells[4 * c + (j + 1 + k) % 4];
      std::sort(f.begin(), f.end());
      ++faces[f];
    }
  return faces;
}

// Each batch of a stream with the labelled faces of its cells, and edges of them that are locked.
class FacedStream final : public Source {
 public:
  FacedStream(const TestMesh& mesh, const Cut& cut, std::map<Face, int64_t> labels)
      : stream_(mesh, cut), labels_(std::move(labels)) {}
  const Schema& schema() const override { return stream_.schema(); }
  bool next(BatchView& batch) override {
    if (!stream_.next(batch)) return false;
    faces_.clear();
    values_.clear();
    const std::vector<int64_t> cells(batch.cells, batch.cells + 4 * batch.cell_count);
    for (const auto& [face, count] : facesOf(cells)) {
      const auto found = labels_.find(face);
      if (found == labels_.end()) continue;
      faces_.insert(faces_.end(), face.begin(), face.end());
      values_.push_back(found->second);
      labels_.erase(found);
    }
    locks_.assign(values_.size(), 0);
    for (size_t i = 0; i < values_.size(); ++i) locks_[i] = values_[i] == locked_label;
    batch.face_count = values_.size();
    batch.faces = faces_.data();
    batch.face_labels = values_.data();
    batch.face_locks = locks_.data();
    return true;
  }
  int64_t locked_label = -1;

 private:
  MeshStream stream_;
  std::map<Face, int64_t> labels_;
  std::vector<int64_t> faces_, values_;
  std::vector<uint8_t> locks_;
};

// Takes the faces, too.
class FaceRecorder final : public Sink {
 public:
  void begin(const Schema& schema) override { mesh.begin(schema); }
  void put(const BatchView& batch) override {
    mesh.put(batch);
    for (size_t i = 0; i < batch.face_count; ++i) {
      Face f = {batch.faces[3 * i], batch.faces[3 * i + 1], batch.faces[3 * i + 2]};
      std::sort(f.begin(), f.end());
      EXPECT_TRUE(labels.emplace(f, batch.face_labels[i]).second) << "a face came twice";
    }
  }
  void finish() override { mesh.finish(); }
  Recorder mesh;
  std::map<Face, int64_t> labels;
};

void expectRidgesStay(const TestMesh& mesh, const Box& box, const TestMesh& out) {
  std::set<Place> corners;
  for (size_t v = 0; v < out.vertexCount(); ++v) {
    const Place p = placeOf(out, static_cast<int64_t>(v));
    const int sides = box.sidesAt(p, 1e-3);
    EXPECT_EQ(box.sidesAt(p, 0) >= 2, sides >= 2) << "a vertex near an edge is not on it";
    if (box.sidesAt(p, 0) == 3) corners.insert(p);
  }
  EXPECT_EQ(corners.size(), 8u);
  EXPECT_LT(out.vertexCount(), mesh.vertexCount() / 2);
}

TEST(SimplifierFeatures, KeepCornersAndEdgesOfABoxExactly) {
  const int n = slowRun() ? 4 : 8;
  const TestMesh mesh = shakenInside(n);
  for (const Way& way : kWays)
    for (int64_t window : {0, 400}) {
      SimplifyOptions options = way.toRatio(0.1, window);
      options.feature_angle = 45;
      const Result result = simplified(mesh, options);
      expectSound(mesh, result);
      expectRidgesStay(mesh, {{n, n, n}}, result.out.mesh);
      expectFlips(result.report, way);
    }
}

// Sides labelled 1 to 6, the cells all of one region: what comes out is labelled by its side, all
// of it is, and no side has grown or shrunk.
void expectLabelsKept(int64_t window, const Way& way, size_t batch_cells) {
  const int n = slowRun() ? 4 : 6;
  const Box box{{n, n, n}};
  const TestMesh mesh = inStreamOrder(shakenInside(n));
  std::map<Face, int64_t> labels;
  for (const auto& [face, count] : facesOf(mesh.cells)) {
    if (count != 1) continue;
    const Place corners[3] = {placeOf(mesh, face[0]), placeOf(mesh, face[1]),
                              placeOf(mesh, face[2])};
    labels[face] = box.sideOf(corners, 0);
  }
  Cut cut;
  cut.batch_cells = batch_cells;
  FaceRecorder out;
  Simplifier simplifier(way.toRatio(0.25, window), out, {});
  FacedStream stream(mesh, cut, labels);
  copyStream(stream, simplifier);
  EXPECT_EQ(out.mesh.problem, "");
  EXPECT_EQ(simplifier.report().limited_by, "");
  expectFlips(simplifier.report(), way);
  std::map<int64_t, int64_t> count;
  for (const auto& [face, cells] : facesOf(out.mesh.mesh.cells)) {
    const auto found = out.labels.find(face);
    EXPECT_EQ(found != out.labels.end(), cells == 1);
    if (found == out.labels.end()) continue;
    ++count[found->second];
    const Place corners[3] = {placeOf(out.mesh.mesh, face[0]), placeOf(out.mesh.mesh, face[1]),
                              placeOf(out.mesh.mesh, face[2])};
    EXPECT_EQ(found->second, box.sideOf(corners, 1e-3));
  }
  EXPECT_EQ(count.size(), 6u);
  EXPECT_LT(out.labels.size(), labels.size());
}
TEST(SimplifierFaces, KeepTheirLabels) {
  for (const Way& way : kWays)
    for (int64_t window : {0, 700})
      for (size_t batch : {size_t{64}, size_t{4096}}) expectLabelsKept(window, way, batch);
}

TEST(SimplifierFaces, ThatAreNoFacesAreRefused) {
  const TestMesh mesh = inStreamOrder(fullGrid(2, 2, 2));
  TestMesh whole = mesh;
  BatchView batch = whole.view();
  const auto last = static_cast<int64_t>(mesh.vertexCount()) - 1;
  const int64_t stray[3] = {0, 1, last}, label = 7;
  batch.face_count = 1;
  batch.faces = stray;
  batch.face_labels = &label;
  const auto refusal = [&] {
    return thrownBy([&] {
      Recorder out;
      Simplifier simplifier(toRatio(0.5), out, {});
      simplifier.begin(mesh.schema);
      simplifier.put(batch);
      simplifier.finish();
    });
  };
  const auto [status, text] = refusal();
  EXPECT_EQ(status, Status::kBadData);
  EXPECT_NE(text.find("labelled face"), std::string::npos) << text;
  const int64_t unknown[3] = {0, 1, last + 1};
  batch.faces = unknown;
  const auto [second, sentence] = refusal();
  EXPECT_EQ(second, Status::kBadData);
  EXPECT_NE(sentence.find("not declared"), std::string::npos) << sentence;
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
  const TestMesh mesh = shakenInside(5);
  TestMesh whole = mesh;
  BatchView batch = whole.view();
  std::vector<int64_t> faces, labels;
  for (const auto& [face, count] : facesOf(mesh.cells)) {
    if (count != 1 ||
        placeOf(mesh, face[0])[2] + placeOf(mesh, face[1])[2] + placeOf(mesh, face[2])[2] > 0.5)
      continue;
    faces.insert(faces.end(), face.begin(), face.end());
    labels.push_back(4);
  }
  const std::vector<uint8_t> locks(labels.size(), 1);
  std::vector<int64_t> edges;
  for (size_t c = 0; c < mesh.cellCount(); c += 25)
    edges.insert(edges.end(), {mesh.cells[4 * c], mesh.cells[4 * c + 1]});
  batch.face_count = labels.size();
  batch.faces = faces.data();
  batch.face_labels = labels.data();
  batch.face_locks = locks.data();
  batch.edge_count = edges.size() / 2;
  batch.locked_edges = edges.data();
  for (const Way& way : kWays) {
    FaceRecorder out;
    Simplifier simplifier(way.toRatio(0.3), out, {});
    simplifier.begin(mesh.schema);
    simplifier.put(batch);
    simplifier.finish();
    EXPECT_EQ(out.labels.size(), labels.size());
    std::set<Place> left;
    for (size_t v = 0; v < out.mesh.mesh.vertexCount(); ++v)
      left.insert(placeOf(out.mesh.mesh, static_cast<int64_t>(v)));
    for (int64_t v : faces) EXPECT_TRUE(left.count(placeOf(mesh, v)));
    const auto edges_left = edgesOf(out.mesh.mesh);
    for (size_t i = 0; i < edges.size(); i += 2)
      EXPECT_TRUE(edges_left.count({placeOf(mesh, edges[i]), placeOf(mesh, edges[i + 1])})) << i;
    EXPECT_GT(simplifier.report().collapses, 50);
    expectFlips(simplifier.report(), way);
  }
}

}  // namespace
}  // namespace tetstream::test
