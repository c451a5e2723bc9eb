// Triangles among the tetrahedra of a .vtu file: labelled faces.
#include <gtest/gtest.h>

#include "status.h"
#include "vtk_format.h"
#include "vtu_encode.h"
#include "vtu_mesh_testing.h"

namespace tetstream {
namespace {

using namespace test;

const std::vector<VtuStyle> kFaceStyles = {{},
                                           {VtuCoding::kAscii, true},
                                           {VtuCoding::kInline},
                                           {VtuCoding::kInline, true, true},
                                           {VtuCoding::kAppendedBase64, true, false, 32, 16},
                                           {VtuCoding::kAppendedRaw},
                                           {VtuCoding::kAppendedRaw, true, false, 64, 16}};

// The two cells, and triangles in front, between and behind.
VtuTestPiece mixedPiece() {
  VtuTestPiece piece = twoCellPiece();
  piece.cells = 6;
  piece.cell_data = {{"Float64", "heat", 1, {9, 9, 0.5, 9, 0.25, 9}, {}},
                     {"Int32", "region", 1, {}, {-3, 40, 7, 41, -7, 42}}};
  piece.cells_element = {{"Int64", "connectivity", 1, {}, {0, 1, 2, 0, 1, 3, 0, 1, 2, 3,
                                                           0, 2, 3, 1, 2, 3, 4, 2, 3, 4}},
                         {"Int64", "offsets", 1, {}, {3, 6, 10, 13, 17, 20}},
                         {"UInt8", "types", 1, {}, {5, 5, 10, 5, 10, 5}}};
  return piece;
}

TEST(VtuFaces, AreTrianglesLabelledByTheArrayOfRegions) {
  for (const VtuStyle& style : kFaceStyles)
    for (size_t step : {1, 1000}) {
      const VtuMesh mesh = readVtu(makeVtu({mixedPiece()}, style), step);
      EXPECT_EQ(mesh.schema.cell_count, 2);
      EXPECT_EQ(mesh.schema.face_count, 4);
      EXPECT_EQ(mesh.cells, (std::vector<int64_t>{0, 1, 2, 3, 1, 2, 3, 4}));
      EXPECT_EQ(mesh.faces, (std::vector<int64_t>{0, 1, 2, 0, 1, 3, 0, 2, 3, 2, 3, 4}));
      EXPECT_EQ(mesh.face_labels, (std::vector<int64_t>{-3, 40, 41, 42}));
      ASSERT_EQ(mesh.cell_data.size(), 2u);
      EXPECT_EQ(valuesAs<double>(mesh.cell_data[0]), (std::vector<double>{0.5, 0.25}));
      EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[1]), (std::vector<int32_t>{7, -7}));
      ASSERT_EQ(mesh.notes.size(), 1u);
      EXPECT_TRUE(
          has(mesh.notes[0], "4 triangles are labelled faces, by the cell array \"region\""))
          << mesh.notes[0];
    }
}

// As ParaView's and parallel programs' files have them beside labels, and before.
TEST(VtuFaces, AreNotLabelledByIdsOrRanks) {
  VtuTestPiece piece = twoCellPiece();
  std::vector<int64_t> points = {0, 1, 2, 3, 1, 2, 3, 4}, ends = {4, 8}, types = {10, 10};
  for (int i = 0; i < 40; ++i) {
    points.insert(points.end(), {0, 1, 2});
    ends.push_back(ends.back() + 3);
    types.push_back(5);
  }
  piece.cells = types.size();
  std::vector<int64_t> ids, ranks, labels;
  for (int64_t i = 0; i < 42; ++i)
    ids.push_back(100 + i), ranks.push_back(i % 2), labels.push_back(i % 3);
  piece.cells_element = {{"Int64", "connectivity", 1, {}, points},
                         {"Int64", "offsets", 1, {}, ends},
                         {"UInt8", "types", 1, {}, types}};
  piece.cell_data = {{"Int64", "vtkOriginalCellIds", 1, {}, ids},
                     {"Int32", "mpi_rank", 1, {}, ranks},
                     {"Int32", "wall", 1, {}, labels}};
  VtuMesh mesh = readVtu(makeVtu({piece}, {}));
  EXPECT_TRUE(hasNote(mesh, "by the cell array \"wall\""));
  EXPECT_EQ(mesh.face_labels, std::vector<int64_t>(labels.begin() + 2, labels.end()));
  piece.cell_data.pop_back();
  mesh = readVtu(makeVtu({piece}, {}));
  EXPECT_TRUE(hasNote(mesh, "40 triangles are left out"));
  EXPECT_EQ(mesh.schema.face_count, 0);
}

// What labels tetrahedra alone is filled up with zeros, by meshio for one, and may come first.
TEST(VtuFaces, AreLabelledByAnArrayThatIsNotZeroForAllIfThereIsOne) {
  VtuTestPiece piece = mixedPiece();
  piece.cell_data.insert(piece.cell_data.begin(), {"Int32", "material", 1, {}, {0, 0, 5, 0, 6, 0}});
  EXPECT_EQ(readVtu(makeVtu({piece}, {})).face_labels, (std::vector<int64_t>{-3, 40, 41, 42}));
  piece.cell_data.pop_back();
  const VtuMesh mesh = readVtu(makeVtu({piece}, {}));
  EXPECT_EQ(mesh.face_labels, std::vector<int64_t>(4));
  EXPECT_TRUE(hasNote(mesh, "by the cell array \"material\""));
}

TEST(VtuFaces, OfSeveralPiecesAreReadEndToEnd) {
  VtuTestPiece plain = twoCellPiece(), empty = twoCellPiece();
  plain.cell_data.insert(plain.cell_data.begin(), {"Float64", "heat", 1, {1, 2}, {}});
  empty.points = empty.cells = 0;
  for (auto* arrays :
       {&empty.point_data, &empty.cell_data, &empty.points_element, &empty.cells_element})
    for (VtuTestArray& array : *arrays) array.reals.clear(), array.integers.clear();
  for (const VtuStyle& style : {VtuStyle{}, VtuStyle{VtuCoding::kAppendedRaw}}) {
    const VtuMesh mesh = readVtu(makeVtu({mixedPiece(), plain, empty, mixedPiece()}, style), 3);
    EXPECT_EQ(mesh.cells, (std::vector<int64_t>{0, 1, 2, 3, 1,  2,  3,  4,  5,  6,  7,  8,
                                                6, 7, 8, 9, 10, 11, 12, 13, 11, 12, 13, 14}));
    EXPECT_EQ(mesh.face_labels, (std::vector<int64_t>{-3, 40, 41, 42, -3, 40, 41, 42}));
    ASSERT_EQ(mesh.faces.size(), 24u);
    EXPECT_EQ(mesh.faces[12], 10);
    EXPECT_EQ(valuesAs<double>(mesh.cell_data[0]),
              (std::vector<double>{0.5, 0.25, 1, 2, 0.5, 0.25}));
  }
}

TEST(VtuFaces, AreLabelledByAnArrayOfTheirOwnIfThereIsOne) {
  VtuTestPiece piece = mixedPiece();
  piece.cell_data.push_back({"Int64", "face_label", 1, {}, {1, 2, 0, int64_t{1} << 40, 0, 4}});
  const VtuMesh mesh = readVtu(makeVtu({piece}, {}));
  EXPECT_EQ(mesh.face_labels, (std::vector<int64_t>{1, 2, int64_t{1} << 40, 4}));
  EXPECT_EQ(mesh.cell_data.size(), 2u);  // of cells it says nothing
  ASSERT_EQ(mesh.schema.cell_data.size(), 2u);
  EXPECT_EQ(mesh.schema.cell_data[1].name, "region");
  EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[1]), (std::vector<int32_t>{7, -7}));
}

TEST(VtuFaces, WithoutLabelsAreLeftOutWithANote) {
  VtuTestPiece piece = mixedPiece();
  piece.cell_data.pop_back();
  piece.cell_data.push_back({"Int32", "pairs", 2, {}, std::vector<int64_t>(12)});
  const VtuMesh mesh = readVtu(makeVtu({piece}, {}));
  EXPECT_EQ(mesh.schema.face_count, 0);
  EXPECT_EQ(mesh.cells, (std::vector<int64_t>{0, 1, 2, 3, 1, 2, 3, 4}));
  ASSERT_EQ(mesh.notes.size(), 1u);
  EXPECT_TRUE(has(mesh.notes[0], "4 triangles are left out")) << mesh.notes[0];
}

TEST(VtuFaces, ThatAreBrokenAreNamed) {
  for (const VtuStyle& style : kFaceStyles) {
    VtuTestPiece piece = mixedPiece();
    piece.cells_element[1].integers[3] = 14;
    EXPECT_TRUE(has(vtuFailure(makeVtu({piece}, style)),
                    "cell 3 is a triangle with a wrong number of points"));
    piece = mixedPiece();
    piece.cells_element[0].integers[12] = 5;
    EXPECT_TRUE(has(vtuFailure(makeVtu({piece}, style)), "cell 3 uses point 5, there are 5"));
    piece = mixedPiece();
    piece.cells_element[2].integers[4] = 12;
    EXPECT_TRUE(has(vtuFailure(makeVtu({piece}, style)),
                    "UNSUPPORTED: test.vtu: cell 4 has VTK's "
                    "type 12"));
    piece = mixedPiece();  // one value too few
    piece.cells_element[0].integers.pop_back();
    EXPECT_TRUE(has(vtuFailure(makeVtu({piece}, style)), "BAD_DATA: test.vtu"));
  }
}

TEST(VtuFaces, AloneAreNoMesh) {
  VtuTestPiece piece = twoCellPiece();
  piece.cells_element = {{"Int64", "connectivity", 1, {}, {0, 1, 2, 1, 2, 3}},
                         {"Int64", "offsets", 1, {}, {3, 6}},
                         {"UInt8", "types", 1, {}, {5, 5}}};
  EXPECT_TRUE(has(vtuFailure(makeVtu({piece}, {})),
                  "there are faces, the first of them cell 0, but no cells"));
}

// What `write` puts into a file, and the notes.
template <class Write>
std::string written(const Schema& schema, const WriteOptions& options, Write write) {
  std::vector<unsigned char> out;
  const std::unique_ptr<Sink> sink = createVtu(createMemory(out), options);
  sink->begin(schema);
  write(*sink);
  sink->finish();
  return std::string(out.begin(), out.end());
}

// Faces come with any batch, before the last cells.
TEST(VtuFaces, AreWrittenAfterTheCellsAndComeBack) {
  const VtuMesh mesh = readVtu(makeVtu({mixedPiece()}, {}));
  for (bool compress : {false, true}) {
    WriteOptions options;
    options.compress = compress;
    const std::string file = written(mesh.schema, options, [&](Sink& sink) {
      const void* fields[1] = {mesh.fields[0].data()};
      BatchView batch;
      batch.vertex_count = 5;
      batch.positions = mesh.positions.data();
      batch.fields = fields;
      for (size_t cell = 0; cell < 2; ++cell) {
        const void* data[2] = {mesh.cell_data[0].data() + 8 * cell,
                               mesh.cell_data[1].data() + 4 * cell};
        batch.cell_count = 1;
        batch.cells = mesh.cells.data() + 4 * cell;
        batch.cell_data = data;
        batch.face_count = 2;
        batch.faces = mesh.faces.data() + 6 * cell;
        batch.face_labels = mesh.face_labels.data() + 2 * cell;
        sink.put(batch);
        batch = BatchView();
        batch.first_vertex = 5;
      }
    });
    const VtuMesh back = readVtu(file);
    EXPECT_TRUE(back == mesh);
    EXPECT_TRUE(has(file, "NumberOfCells=\"6\""));
    ASSERT_EQ(back.notes.size(), 1u);
    EXPECT_TRUE(has(back.notes[0], "by the cell array \"face_label\"")) << back.notes[0];
  }
}

// An array of that name, which is no label of faces here, is kept; faces go, with a note.
TEST(VtuFaces, DoNotTakeTheirArrayFromCells) {
  Schema schema;
  schema.cell_data = {{"face_label", 1, ScalarType::kInt32}};
  std::vector<std::string> notes;
  WriteOptions options;
  options.note = [&](const std::string& note) { notes.push_back(note); };
  const float positions[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const int64_t cell[4] = {0, 1, 2, 3}, label = 3, unknown[3] = {0, 1, 4};
  const int32_t value = 17;
  const void* data[1] = {&value};
  BatchView batch;
  batch.vertex_count = 4;
  batch.positions = positions;
  batch.cell_count = 1;
  batch.cells = cell;
  batch.cell_data = data;
  batch.face_count = 1;
  batch.faces = cell;
  batch.face_labels = &label;
  const VtuMesh mesh = readVtu(written(schema, options, [&](Sink& sink) { sink.put(batch); }));
  EXPECT_EQ(mesh.schema.face_count, 0);
  ASSERT_EQ(mesh.cell_data.size(), 1u);
  EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[0]), (std::vector<int32_t>{17}));
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_TRUE(has(notes[0], "labelled faces are left out")) << notes[0];
  batch.faces = unknown;
  batch.cell_data = nullptr;
  EXPECT_THROW(written(Schema(), {}, [&](Sink& sink) { sink.put(batch); }), Error);
}

}  // namespace
}  // namespace tetstream
