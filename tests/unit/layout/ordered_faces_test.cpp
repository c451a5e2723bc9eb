// Labelled faces of an indexed mesh, in whatever order it is streamed.
#include "ordered_faces.h"

#include <gtest/gtest.h>

#include "faces.h"
#include "memory_source.h"
#include "ordered_source.h"
#include "shapes.h"
#include "spooled_mesh.h"
#include "status.h"

namespace tetstream::test {
namespace {

// Sides labelled 1 to 6, and some faces inside 7; in any order. Vertices have their numbers.
FacedMesh labelledGrid(int nx, int ny, int nz) {
  const int n[3] = {nx, ny, nz};
  TestMesh mesh = shuffled(fullGrid(n[0], n[1], n[2]), 3);
  mesh.addIntegerField("number", [](size_t v) { return static_cast<int64_t>(v); });
  FaceLabels labels = sidesOf(mesh, n);
  size_t count = 0;
  for (const auto& [face, cells] : facesOf(mesh.cells))
    if (cells == 2 && ++count % 9 == 0) labels[face] = 7;
  return FacedMesh(mesh, labels);
}

// As the mesh had numbered them.
FaceLabels facesOfOriginal(const Recorder& out) {
  FaceLabels found;
  for (const auto& [face, label] : out.faces) {
    Face original;
    for (size_t j = 0; j < 3; ++j)
      original[j] = out.mesh.fieldInteger(0, static_cast<size_t>(face[j]));
    std::sort(original.begin(), original.end());
    found[original] = label;
  }
  return found;
}

FaceLabels expectedOf(const FacedMesh& faced) {
  FaceLabels labels;
  for (size_t i = 0; i < faced.labels.size(); ++i)
    labels[{faced.corners[3 * i], faced.corners[3 * i + 1], faced.corners[3 * i + 2]}] =
        faced.labels[i];
  return labels;
}

void expectFaces(IndexedSource& source, const OrderOptions& options, const FaceLabels& expected) {
  SCOPED_TRACE(options.order + ", memory " + std::to_string(options.memory_bytes));
  OrderedSource ordered(source, options);
  EXPECT_EQ(ordered.schema().face_count, static_cast<int64_t>(expected.size()));
  const std::unique_ptr<Source> again = ordered.again(Part::kAll);
  for (Source* reading : {static_cast<Source*>(&ordered), again.get()}) {
    Recorder out;
    copyStream(*reading, out);
    EXPECT_EQ(out.problem, "");
    EXPECT_TRUE(facesOfOriginal(out) == expected);
  }
}

// In messages faces have the numbers that the input gave them, however often they were ordered.
void expectNumbers(IndexedSource& source, const OrderOptions& options, const FacedMesh& faced) {
  SCOPED_TRACE(options.order + ", memory " + std::to_string(options.memory_bytes));
  OrderedSource ordered(source, options);
  std::vector<int64_t> originals;
  size_t seen = 0;
  for (BatchView batch; ordered.next(batch); seen += batch.face_count) {
    for (size_t i = 0; i < batch.vertex_count; ++i)
      originals.push_back(static_cast<const int64_t*>(batch.fields[0])[i]);
    for (size_t i = 0; i < batch.face_count; ++i) {
      const auto number = static_cast<size_t>(batch.face_origins[i]);
      ASSERT_LT(number, faced.labels.size());
      Face face, wanted;
      for (size_t j = 0; j < 3; ++j) {
        face[j] = originals[static_cast<size_t>(batch.faces[3 * i + j])];
        wanted[j] = faced.corners[3 * number + j];
      }
      std::sort(face.begin(), face.end());
      std::sort(wanted.begin(), wanted.end());
      ASSERT_EQ(face, wanted);
    }
  }
  EXPECT_EQ(seen, faced.labels.size());
}

TEST(OrderedFaces, KeepTheirNumbers) {
  FacedMesh faced = labelledGrid(5, 6, 8);
  MemorySource memory(faced.mesh.schema, faced.view());
  for (const char* order : {"none", "hilbert", "breadth-first", "spectral"})
    for (size_t memory_bytes : {0, 1}) {
      OrderOptions options;
      options.order = order;
      options.memory_bytes = memory_bytes;
      expectNumbers(memory, options, faced);
    }
}

// From arrays, and from a spool.
TEST(OrderedFaces, ComeWithTheirVerticesInEveryOrder) {
  FacedMesh faced = labelledGrid(5, 6, 8);
  const FaceLabels expected = expectedOf(faced);
  EXPECT_GT(expected.size(), 400u);
  MemorySource memory(faced.mesh.schema, faced.view());
  SpooledMesh spooled(faced.mesh.schema, "");
  spooled.put(faced.view());
  spooled.finish();
  for (const char* order :
       {"auto", "none", "spatial", "brick", "z-order", "hilbert", "breadth-first", "spectral"})
    for (size_t memory_bytes : {0, 1}) {
      OrderOptions options;
      options.order = order;
      options.memory_bytes = memory_bytes;
      expectFaces(memory, options, expected);
      expectFaces(spooled, options, expected);
    }
}

TEST(OrderedFaces, MayBeMoreThanTheMemoryHolds) {
  const int n = slowRun() ? 10 : 14;
  FacedMesh faced = labelledGrid(n, n, n);
  MemorySource source(faced.mesh.schema, faced.view());
  OrderOptions options;
  options.memory_bytes = 1;
  const OrderedSource with_faces(source, options);
  FacedMesh bare(faced.mesh, {});
  MemorySource without(bare.mesh.schema, bare.view());
  EXPECT_GT(with_faces.diskBytes(), OrderedSource(without, options).diskBytes());
  EXPECT_GE(plannedDisk(source.schema(), options), with_faces.diskBytes());
  expectFaces(source, options, expectedOf(faced));
}

std::pair<Status, std::string> refusal(const int64_t (&face)[3]) {
  FacedMesh faced(oneCell(), {});
  // A point that no cell has.
  const double lonely[3] = {3, 3, 3};
  faced.mesh.positions.append(lonely, 1, sizeof lonely);
  faced.corners.assign(face, face + 3);
  faced.labels = {1};
  SpooledMesh source(faced.mesh.schema, "");
  source.put(faced.view());
  source.finish();
  try {
    OrderedSource ordered(source, {});
  } catch (const Error& error) {
    return {error.status(), error.text()};
  }
  return {Status::kOk, ""};
}

TEST(OrderedFaces, OfPointsThatNoCellHasAreRefused) {
  ASSERT_EQ(oneCell().schema.position_type, ScalarType::kFloat64);
  EXPECT_EQ(refusal({1, 2, 3}).first, Status::kOk);
  for (const int64_t point : {-1, 5}) {
    const auto [status, text] = refusal({0, 1, point});
    EXPECT_EQ(status, Status::kBadData);
    EXPECT_NE(text.find("labelled face 0: point"), std::string::npos) << text;
  }
  const auto [status, text] = refusal({0, 1, 4});
  EXPECT_EQ(status, Status::kBadData);
  EXPECT_EQ(text, "labelled face 0: no cell has its point 4");
}

}  // namespace
}  // namespace tetstream::test
