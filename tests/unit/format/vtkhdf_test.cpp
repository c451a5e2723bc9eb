// VTKHDF files: written and read back, in partitions, and with claims that are lies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "hdf5_testing.h"
#include "slow_run.h"
#include "status.h"
#include "vtu_encode.h"
#include "vtu_mesh_testing.h"

namespace tetstream {
namespace {

using namespace test;

template <class T>
void add(Hdf5File& file, const std::string& path, ValueType type, int components,
         const std::vector<T>& values) {
  addColumn(file, "VTKHDF/" + path, type, components, values);
}

struct Parts {
  std::string type = "UnstructuredGrid";
  std::vector<int64_t> points = {4, 4}, cells = {1, 2}, ids = {4, 7};
  std::vector<int64_t> connectivity = {0, 1, 2, 3, 0, 1, 2, 3, 2, 1, 0};
  std::vector<int64_t> offsets = {0, 4, 0, 4, 7};
  std::vector<uint8_t> types = {10, 10, 5};
  std::vector<float> fields = {1, 2, 3, 4, 1, 2, 3, 5};
  std::vector<int64_t> labels = {7, 8, 9};
  std::vector<double> positions = {0, 0, 0, 0, 1, 0, 0, 0, 1, -1, 0, 0,
                                   0, 0, 0, 0, 1, 0, 0, 0, 1, 1,  0, 0};
};

// Two tetrahedra that share a face, in two partitions, and a triangle.
std::string makeVtkHdf(const Parts& parts, const std::function<void(Hdf5File&)>& more = nullptr) {
  std::string bytes;
  Hdf5File file(std::make_unique<MemoryStorage>(bytes), "made", true);
  {
    const Hdf5Turn turn;
    const Hdf5Id group = file.createGroup("VTKHDF");
    file.addAttribute(group, "Version", std::vector<int64_t>{2, 0});
    file.addAttribute(group, "Type", parts.type);
    add(file, "NumberOfPoints", ValueType::kInt64, 1, parts.points);
    add(file, "NumberOfCells", ValueType::kInt64, 1, parts.cells);
    add(file, "NumberOfConnectivityIds", ValueType::kInt64, 1, parts.ids);
    add(file, "Points", ValueType::kFloat64, 3, parts.positions);
    add(file, "Connectivity", ValueType::kInt64, 1, parts.connectivity);
    add(file, "Offsets", ValueType::kInt64, 1, parts.offsets);
    add(file, "Types", ValueType::kUInt8, 1, parts.types);
    file.createGroup("VTKHDF/PointData");
    add(file, "PointData/p", ValueType::kFloat32, 1, parts.fields);
    file.createGroup("VTKHDF/CellData");
    add(file, "CellData/region", ValueType::kInt64, 1, parts.labels);
    if (more) more(file);
  }
  file.close();
  return bytes;
}

TEST(VtkHdf, JoinsPartitions) {
  for (const size_t step : {1, 1000}) {
    const VtuMesh mesh = readAs("vtkhdf", makeVtkHdf({}), step);
    EXPECT_EQ(mesh.schema.vertex_count, 5);
    EXPECT_EQ(mesh.cells, (std::vector<int64_t>{0, 1, 2, 3, 0, 1, 2, 4}));
    EXPECT_EQ(valuesAs<float>(mesh.fields[0]), (std::vector<float>{1, 2, 3, 4, 5}));
    EXPECT_EQ(valuesAs<int64_t>(mesh.cell_data[0]), (std::vector<int64_t>{7, 8}));
    EXPECT_EQ(mesh.faces, (std::vector<int64_t>{2, 1, 0}));
    EXPECT_EQ(mesh.face_labels, (std::vector<int64_t>{9}));
    EXPECT_EQ(mesh.notes.size(), 2u);  // the triangle, the points
  }
}

// Three time steps: of the first two the mesh is the same, the last has one of its own.
TEST(VtkHdf, ReadsOneTimeStep) {
  const Parts parts;
  const auto file = makeVtkHdf(parts, [](Hdf5File& out) {
    out.createGroup("VTKHDF/Steps");
    out.createGroup("VTKHDF/Steps/PointDataOffsets");
    out.createGroup("VTKHDF/Steps/CellDataOffsets");
    const auto list = [&](const char* name, const std::vector<int64_t>& numbers) {
      add(out, std::string("Steps/") + name, ValueType::kInt64, 1, numbers);
    };
    add<double>(out, "Steps/Values", ValueType::kFloat64, 1, {0, 0.5, 1});
    list("NumberOfParts", {1, 1, 1});
    list("PartOffsets", {0, 0, 1});
    list("PointOffsets", {0, 0, 4});
    list("CellOffsets", {0, 0, 1});
    list("ConnectivityIdOffsets", {0, 0, 4});
    list("PointDataOffsets/p", {0, 4, 4});
    list("CellDataOffsets/region", {0, 1, 1});
  });
  const struct {
    int64_t step;
    double time;
    std::vector<float> field;
    std::vector<int64_t> labels, cells;
  } cases[] = {{0, 0, {1, 2, 3, 4}, {7}, {0, 1, 2, 3}},
               {1, 0.5, {1, 2, 3, 5}, {8}, {0, 1, 2, 3}},
               {kLastStep, 1, {1, 2, 3, 5}, {8}, {0, 1, 2, 3}}};
  for (const auto& c : cases) {
    ReadOptions options;
    options.step = c.step;
    const VtuMesh mesh = readAs("vtkhdf", file, 1000, options);
    EXPECT_EQ(valuesAs<float>(mesh.fields[0]), c.field) << c.step;
    EXPECT_EQ(valuesAs<int64_t>(mesh.cell_data[0]), c.labels) << c.step;
    EXPECT_EQ(mesh.cells, c.cells) << c.step;
    EXPECT_EQ(mesh.schema.time, c.time);
    EXPECT_EQ(mesh.faces.size(), c.step == kLastStep ? 3u : 0u);
    EXPECT_EQ(valuesAs<double>(mesh.positions)[9], c.step == kLastStep ? 1 : -1);
    EXPECT_TRUE(has(mesh.notes[0], "of 3 time steps, 0 to 2, step")) << mesh.notes[0];
  }
  ReadOptions options;
  options.step = 3;
  EXPECT_THROW(readAs("vtkhdf", file, 1000, options), Error);
}

TEST(VtkHdf, StepsNeedNoTimes) {
  const VtuMesh mesh =
      readAs("vtkhdf", makeVtkHdf({}, [](Hdf5File& out) {
               out.createGroup("VTKHDF/Steps");
               add<int64_t>(out, "Steps/NumberOfParts", ValueType::kInt64, 1, {1, 2});
             }));
  EXPECT_EQ(mesh.cells.size(), 8u);
  EXPECT_TRUE(hasNote(mesh, "of 2 time steps, 0 to 1, step 1 is read"));
  EXPECT_FALSE(hasNote(mesh, "at time"));
  EXPECT_FALSE(mesh.schema.time);
}

TEST(VtkHdf, TakesATimeThatIsOneNumberByItsName) {
  const struct {
    const char* name;
    std::vector<double> values;
    std::optional<double> time;
    size_t notes;  // beside those on the triangle and the points
  } cases[] = {{"TimeValue", {0.1}, 0.1, 0},
               {"TIME", {0.5}, 0.5, 0},
               {"TimeValue", {0.1, 0.2}, {}, 1},
               {"TimeValue", {INFINITY}, {}, 1},
               {"CYCLE", {3}, {}, 1}};
  for (const auto& c : cases) {
    const VtuMesh mesh =
        readAs("vtkhdf", makeVtkHdf({}, [&c](Hdf5File& out) {
                 out.createGroup("VTKHDF/FieldData");
                 add(out, std::string("FieldData/") + c.name, ValueType::kFloat64, 1, c.values);
               }));
    EXPECT_EQ(mesh.schema.time, c.time) << c.name;
    EXPECT_EQ(mesh.notes.size(), 2 + c.notes) << c.name;
  }
}

// Two hexahedra in two partitions: the points of the shared square are numbered the other way round
// in the second, so that each cut of its own would go across.
TEST(VtkHdf, SplitsCellsOfPartitionsAlikeWhereTheyMeet) {
  Parts parts;
  parts.points = {8, 8};
  parts.cells = {1, 1};
  parts.ids = {8, 8};
  parts.connectivity = {0, 1, 2, 3, 4, 5, 6, 7, 1, 4, 5, 0, 2, 7, 6, 3};
  parts.offsets = {0, 8, 0, 8};
  parts.types = {12, 12};
  parts.fields.assign(16, 0);
  parts.labels = {7, 8};
  parts.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1,
                     1, 0, 1, 1, 0, 0, 1, 1, 0, 1, 1, 1, 2, 0, 0, 2, 0, 1, 2, 1, 1, 2, 1, 0};
  ReadOptions options;
  options.split = true;
  const VtuMesh mesh = readAs("vtkhdf", makeVtkHdf(parts), 5, options);
  EXPECT_EQ(mesh.schema.vertex_count, 12);
  EXPECT_EQ(mesh.schema.cell_count, 12);
  std::map<std::set<int64_t>, int> triangles;
  for (size_t c = 0; c < mesh.cells.size(); c += 4)
    for (size_t without = 0; without < 4; ++without) {
      std::set<int64_t> triangle(mesh.cells.begin() + static_cast<std::ptrdiff_t>(c),
                                 mesh.cells.begin() + static_cast<std::ptrdiff_t>(c) + 4);
      triangle.erase(mesh.cells[c + without]);
      ++triangles[triangle];
    }
  EXPECT_EQ(std::count_if(triangles.begin(), triangles.end(),
                          [](const auto& entry) { return entry.second == 1; }),
            20);  // two on each of the ten squares outside
}

TEST(VtkHdf, WrittenGivesBackEveryArrayInTheSameBytes) {
  VtuTestPiece piece = twoCellPiece();
  piece.point_data.push_back({"Float64", "v", 3, {}, {}});
  piece.point_data.back().reals.assign(15, 0.1);
  piece.cell_data.push_back({"Int64", "wide", 1, {}, {INT64_MIN, INT64_MAX}});
  VtuMesh mesh = readVtu(makeVtu({piece}, {}));
  mesh.schema.time = 0.1;
  for (const bool compress : {true, false}) {
    const std::string file = writtenAs("vtkhdf", mesh, compress);
    VtuMesh read = readAs("vtkhdf", file);
    EXPECT_TRUE(read == mesh);
    EXPECT_TRUE(file == writtenAs("vtkhdf", mesh, compress));
  }
}

TEST(VtkHdf, ReadsColumnsOfManyChunks) {
  VtuMesh mesh = readVtu(makeVtu({twoCellPiece()}, {}));
  const int64_t copies = 20000;  // a chunk holds 65536 ids
  const std::vector<int64_t> cells = mesh.cells;
  const std::string labels = mesh.cell_data[0];
  for (int64_t i = 1; i < copies; ++i) {
    mesh.cells.insert(mesh.cells.end(), cells.begin(), cells.end());
    mesh.cell_data[0] += labels;
  }
  mesh.schema.cell_count *= copies;
  EXPECT_TRUE(readAs("vtkhdf", writtenAs("vtkhdf", mesh), 777) == mesh);
}

TEST(VtkHdf, SaysWhichArrayIsWrong) {
  const auto failure = [](const std::function<void(Parts&)>& change) {
    Parts parts;
    change(parts);
    return failureAs("vtkhdf", makeVtkHdf(parts));
  };
  EXPECT_TRUE(has(failureAs("vtkhdf", "no HDF5 at all"), "BAD_DATA: test.vtkhdf: this is no HDF5"));
  EXPECT_TRUE(has(failureAs("vtkhdf", ""), "BAD_DATA: test.vtkhdf: this is no HDF5"));
  EXPECT_TRUE(has(failure([](Parts& p) { p.type = "ImageData"; }),
                  "UNSUPPORTED: test.vtkhdf: the file holds \"ImageData\""));
  EXPECT_TRUE(has(failure([](Parts& p) { p.types[1] = 14; }), "cell 1 has VTK's type 14"));
  EXPECT_TRUE(has(failure([](Parts& p) { p.connectivity[7] = 4; }), "cell 1 uses point 4"));
  EXPECT_TRUE(has(failure([](Parts& p) {
                    p.points = {4, 5};
                  }),
                  "dataset \"VTKHDF/Points\" has 8 rows where the counts need 9"));
  EXPECT_TRUE(has(failure([](Parts& p) { p.cells = {1}; }), "different partitions"));
  EXPECT_TRUE(has(failure([](Parts& p) { p.cells = {1, -2}; }), "than any file can hold"));
  EXPECT_TRUE(has(failure([](Parts& p) { p.fields.resize(7); }),
                  "dataset \"VTKHDF/PointData/p\" has 7 rows where the counts need 8"));
  EXPECT_TRUE(has(failure([](Parts& p) { p.offsets[4] = 8; }), "dataset \"VTKHDF/Connectivity\""));
}

TEST(VtkHdf, RefusesSpaceThatWasNeverWritten) {
  std::string bytes;
  Hdf5File file(std::make_unique<MemoryStorage>(bytes), "made", true);
  const Hdf5Turn turn;
  const Hdf5Functions& h = hdf5();
  const hsize_t rows = hsize_t{1} << 50, chunk = 1024;
  const Hdf5Id space(h.Screate_simple(1, &rows, nullptr), h.Sclose);
  const Hdf5Id plan(h.Pcreate(h.P_CLS_DATASET_CREATE_ID), h.Pclose);
  h.Pset_chunk(plan, 1, &chunk);
  const Hdf5Id made = file.create("claim", h.T_NATIVE_DOUBLE, space, plan);
  try {
    file.shapeOf("claim");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_TRUE(has(error.text(), "dataset \"claim\" claims 1125899906842624 rows"))
        << error.text();
  }
}

TEST(VtkHdf, RefusesFilesThatAreCut) {
  const std::string good = makeVtkHdf({});
  for (size_t size = 0; size < good.size(); size += 13 * oneIn(5)) {
    const std::string text = failureAs("vtkhdf", good.substr(0, size));
    EXPECT_TRUE(text.starts_with("TETSTREAM_BAD_DATA: test.vtkhdf: ")) << size << ": " << text;
  }
}

TEST(VtkHdf, TellsWhatTheStorageSays) {
  for (int at = 0; at < 3; ++at) {
    std::string bytes;
    auto storage = std::make_unique<MemoryStorage>(bytes);
    storage->fail_at_ = at;
    try {
      Hdf5File file(std::move(storage), "made", true);
      {
        const Hdf5Turn turn;
        file.createGroup("VTKHDF");
        add<double>(file, "x", ValueType::kFloat64, 1, std::vector<double>(50000));
      }
      file.close();
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Status::kIo) << error.text();
      EXPECT_EQ(error.text(), "the disk is full");
    }
  }
}

TEST(VtkHdf, TellsWhatTheStorageSaysWhereTheSizeOfADatasetIsRead) {
  std::string bytes = makeVtkHdf({});
  for (int at = 0;; ++at) {
    auto storage = std::make_unique<MemoryStorage>(bytes);
    MemoryStorage& failing = *storage;
    failing.fail_read_at_ = at;
    try {
      Hdf5File file(std::move(storage), "made", false);
      const Hdf5Turn turn;
      for (const std::string& name : file.datasetsOf("VTKHDF")) file.shapeOf("VTKHDF/" + name);
      EXPECT_GT(at, 5);
      EXPECT_GE(failing.fail_read_at_, 0) << "read " << at << " failed, and nobody told";
      return;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Status::kIo) << "read " << at << ": " << error.text();
      EXPECT_EQ(error.text(), "the disk is gone");
    }
  }
}

// Offsets are there once more than cells.
TEST(VtkHdf, FacesAreWrittenAfterTheCellsAndComeBack) {
  VtuMesh mesh = readVtu(makeVtu({twoCellPiece()}, {}));
  mesh.faces = {0, 1, 2, 2, 4, 3};
  mesh.face_labels = {-5, int64_t{1} << 40};
  mesh.schema.face_count = 2;
  for (const bool compress : {false, true}) {
    const VtuMesh back = readAs("vtkhdf", writtenAs("vtkhdf", mesh, compress));
    EXPECT_TRUE(back == mesh);
    ASSERT_EQ(back.notes.size(), 1u);
    EXPECT_TRUE(hasNote(back, "by the cell array \"face_label\""));
  }
}

}  // namespace
}  // namespace tetstream
