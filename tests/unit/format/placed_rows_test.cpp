// Binary MEDIT and Gmsh files: rows that are read where they lie are those that come as a pipe
// gives them, and what is wrong with them is told when they are read.
#include <gtest/gtest.h>

#include <cstring>

#include "gmsh_format.h"
#include "medit_format.h"
#include "placed_files.h"

namespace tetstream {
namespace {

using namespace test;

struct Reading {
  SvMesh mesh;
  std::vector<TestFace> faces;
  std::vector<std::string> notes;
};

Reading readWhole(Open open, std::unique_ptr<ByteSource> bytes, size_t step,
                  const Tasks* tasks = nullptr) {
  Reading r;
  ReadOptions options;
  options.split = true;
  options.threads.tasks = tasks;
  options.note = [&r](const std::string& note) { r.notes.push_back(note); };
  Input input = open(std::move(bytes), options);
  r.mesh = readIndexed(*input.indexed, step);
  r.faces = facesOf(input);
  return r;
}

void expectSameReading(const Reading& a, const Reading& b) {
  EXPECT_EQ(a.mesh.positions, b.mesh.positions);
  EXPECT_EQ(a.mesh.cells, b.mesh.cells);
  EXPECT_EQ(a.mesh.fields, b.mesh.fields);
  EXPECT_EQ(a.mesh.cell_data, b.mesh.cell_data);
  EXPECT_EQ(a.faces, b.faces);
  EXPECT_EQ(a.notes, b.notes);
  EXPECT_EQ(a.mesh.schema.position_type, b.mesh.schema.position_type);
  const auto expectSameColumns = [](const std::vector<Column>& c, const std::vector<Column>& d) {
    ASSERT_EQ(c.size(), d.size());
    for (size_t i = 0; i < c.size(); ++i) {
      EXPECT_EQ(c[i].name, d[i].name);
      EXPECT_EQ(c[i].type, d[i].type);
      EXPECT_EQ(c[i].components, d[i].components);
    }
  };
  expectSameColumns(a.mesh.schema.fields, b.mesh.schema.fields);
  expectSameColumns(a.mesh.schema.cell_data, b.mesh.schema.cell_data);
}

Reading expectSameAsOfAPipe(Open open, const Bytes& file) {
  const Reading piped = readWhole(open, std::make_unique<PipeSource>(file, 1000, "mesh"), 7);
  const Tasks two(2);
  for (size_t step : {1, 7, 1000})
    for (const Tasks* tasks : {static_cast<const Tasks*>(nullptr), &two}) {
      SCOPED_TRACE(std::to_string(step) + " rows at once");
      expectSameReading(readWhole(open, openMemory(file.data(), file.size(), "mesh"), step, tasks),
                        piped);
    }
  return piped;
}

TEST(PlacedRows, OfMeditAreThoseOfAPipe) {
  for (int version : {1, 2, 3, 4})
    for (bool swapped : {false, true})
      for (bool labelled : {false, true}) {
        SCOPED_TRACE("version " + std::to_string(version) + (swapped ? ", swapped" : "") +
                     (labelled ? ", labelled" : ""));
        const Reading r = expectSameAsOfAPipe(openMedit, wholeMedit({version, swapped, labelled}));
        EXPECT_EQ(r.mesh.vertexCount(), size_t{kPlacedPoints});
        EXPECT_GT(r.mesh.cells.size(), size_t{kPlacedCells});
        EXPECT_EQ(r.mesh.cells.back()[3], cornerOf(kPlacedCells - 1, 3));
        EXPECT_EQ(r.mesh.positions[3 * 50 + 1], coordinate(50, 1));
        ASSERT_EQ(r.mesh.schema.fields.size(), labelled ? 3u : 2u);
        EXPECT_EQ(r.mesh.fields.back()[50], 0.5 * (4 * 50 + 3));
        ASSERT_EQ(r.mesh.cell_data.size(), labelled ? 1u : 0u);
        if (!labelled) continue;
        EXPECT_EQ(r.mesh.cell_data[0].back(), kPlacedCells - 1);
        EXPECT_EQ(r.mesh.fields[0][50], 50);
      }
}

TEST(PlacedRows, OfGmshAreThoseOfAPipe) {
  for (const char* version : {"4.1", "2.2"})
    for (bool swapped : {false, true}) {
      SCOPED_TRACE(std::string(version) + (swapped ? ", swapped" : ""));
      const Reading r = expectSameAsOfAPipe(openMsh, wholeMsh(version, swapped));
      ASSERT_EQ(r.mesh.cells.size(), size_t{kPlacedCells});
      EXPECT_EQ(r.mesh.cells[25][2], cornerOf(25, 2));
      EXPECT_EQ(r.mesh.positions[3 * 50 + 2], coordinate(50, 2));
      EXPECT_EQ(r.mesh.schema.position_type, ScalarType::kFloat32);
      ASSERT_EQ(r.mesh.schema.cell_data.size(), 4u);
      EXPECT_EQ(r.mesh.cell_data[0][19], 0);  // the group
      EXPECT_EQ(r.mesh.cell_data[0][20], 32);
      EXPECT_EQ(r.mesh.cell_data[1][19], 1);  // the entity
      EXPECT_EQ(r.mesh.cell_data[2][2 * 39 + 1], 1.5 * 39 + 1);
      EXPECT_EQ(r.mesh.cell_data[3][39], 1.5 * 41);
      ASSERT_EQ(r.mesh.schema.fields.size(), 4u);
      EXPECT_EQ(r.mesh.fields[0][6], 1.5 * 6);
      EXPECT_EQ(r.mesh.fields[0][8], 1.5);  // of the second part
      EXPECT_EQ(r.mesh.schema.fields[1].type, ScalarType::kFloat32);
      EXPECT_EQ(r.mesh.fields[2][0], 1.5 * 59);
      EXPECT_TRUE(anyNote(r.notes, "\"some\" has no value at 53 points"));
    }
}

// What cannot be read where it lies for its number of parts is copied, in the same order.
TEST(PlacedRows, OfMorePartsThanAreKeptAreCopied) {
  MeditFile file({2, false, true});
  file.vertices();
  for (int i = 0; i < 1100; ++i) file.cells(8, 1 + i % 2, 4, i % 41);
  const Reading r = expectSameAsOfAPipe(openMedit, file.end());
  EXPECT_EQ(r.mesh.cells.size(), 1650u);
  EXPECT_EQ(r.mesh.cell_data[0].back(), 34);
}

TEST(PlacedRows, OfManyRunsOfNodesAreCopied) {
  MshFile file("2.2", false);
  file.text("$Nodes\n200\n");
  for (int i = 0; i < 200; ++i) {
    file.put<int32_t>(7 * i);
    for (int k = 0; k < 3; ++k) file.put(coordinate(i, k));
  }
  file.text("\n$EndNodes\n$Elements\n1\n");
  for (int32_t value : {4, 1, 0, 1, 0, 7, 693, 1393}) file.put(value);
  file.text("\n$EndElements\n");
  const Reading r = expectSameAsOfAPipe(openMsh, file.bytes);
  EXPECT_EQ(r.mesh.cells, (std::vector<std::array<int64_t, 4>>{{0, 1, 99, 199}}));
}

// Elements that come after data of others have their tags, too.
TEST(PlacedRows, OfElementsAfterDataHaveTheirValues) {
  MshFile file("4.1", false);
  file.nodes();
  file.elements();
  file.data({"ElementData", "early", kPlacedCells, 1}, [](int i) { return 300 + i; });
  file.text("$Elements\n");
  for (int64_t count : {1, 2, 1, 999}) file.put(count);
  for (int32_t value : {3, 1, 4}) file.put(value);
  file.put<int64_t>(2);
  for (int64_t value : {290, 500, 501, 502, 503, 291, 504, 505, 506, 507}) file.put(value);
  file.text("\n$EndElements\n");
  file.data({"ElementData", "late", 3, 1}, [](int i) { return i < 2 ? 290 + i : 300; });
  const Reading r = expectSameAsOfAPipe(openMsh, file.bytes);
  ASSERT_EQ(r.mesh.cell_data.size(), 3u);
  EXPECT_EQ(r.mesh.cell_data[1][kPlacedCells - 1], 1.5 * (kPlacedCells - 1));
  EXPECT_EQ(r.mesh.cell_data[2][kPlacedCells], 0.0);
  EXPECT_EQ(r.mesh.cell_data[2][kPlacedCells + 1], 1.5);
  EXPECT_EQ(r.mesh.cell_data[2][0], 3.0);
}

std::string problemIn(Open open, const Bytes& file) {
  return errorOf(open, file).text();
}

TEST(PlacedRows, TellTheByteOfWhatIsWrong) {
  MeditFile medit({2, false, true});
  medit.vertices();
  const size_t points_end = medit.bytes.size();
  medit.cells(8, kPlacedCells, 4);
  const size_t row = medit.bytes.size() - 20;
  const auto meditWith = [&](size_t place, auto value) {
    MeditFile broken = medit;
    broken.putAt(place, value);
    return problemIn(openMedit, broken.end());
  };
  EXPECT_EQ(meditWith(row + 8, int32_t{61}),
            "mesh: byte " + std::to_string(row) + ": vertex 61, where there are 1 to 60");
  for (int32_t none : {0, -1, INT32_MIN, INT32_MAX})
    EXPECT_EQ(meditWith(row, none), "mesh: byte " + std::to_string(row) + ": vertex " +
                                        std::to_string(none) + ", where there are 1 to 60");
  const size_t position = points_end - 28;
  for (double none : {std::numeric_limits<double>::infinity(), -std::nan("")})
    EXPECT_EQ(meditWith(position + 16, none),
              "mesh: byte " + std::to_string(position) + ": a position is not a finite number");

  for (const char* version : {"4.1", "2.2"}) {
    MshFile file(version, true);
    file.nodes();
    file.elements();
    const bool is_4 = version[0] == '4';
    const std::string place = "mesh: byte " + std::to_string(file.last_row) + ": ";
    const size_t corner = file.last_row + 16;
    for (int64_t none : {int64_t{99}, int64_t{520}, int64_t{-5}, int64_t{INT32_MAX}}) {
      MshFile broken = file;
      is_4 ? broken.putAt(corner, none) : broken.putAt(corner, static_cast<int32_t>(none));
      EXPECT_EQ(problemIn(openMsh, broken.bytes),
                place + "element 339 uses node " + std::to_string(none) + ", which is not there");
    }
    is_4 ? file.putAt(file.last_row, INT64_MIN) : file.putAt(file.last_row, INT32_MIN);
    EXPECT_EQ(
        problemIn(openMsh, file.bytes),
        place + (is_4 ? std::to_string(INT64_MIN) : std::to_string(INT32_MIN)) + " is no tag");
  }
}

std::string problemOfAPipe(Open open, const Bytes& file) {
  try {
    readWhole(open, std::make_unique<PipeSource>(file, 1000, "mesh"), 7);
  } catch (const Error& error) {
    return error.text();
  }
  return "";
}

TEST(PlacedRows, OfElementsWithoutATagAreRefusedInAPipeToo) {
  for (const char* version : {"4.1", "2.2"}) {
    MshFile file(version, false);
    file.nodes();
    file.elements();
    version[0] == '4' ? file.putAt(file.last_row, int64_t{-1})
                      : file.putAt(file.last_row, int32_t{-1});
    EXPECT_NE(problemIn(openMsh, file.bytes).find("-1 is no tag"), std::string::npos);
    EXPECT_NE(problemOfAPipe(openMsh, file.bytes).find("-1 is no tag"), std::string::npos);
  }
}

// A file that gives fewer bytes than it had when it was opened.
class ShrinkingSource final : public ByteSource {
 public:
  ShrinkingSource(const Bytes& bytes, const size_t* end)
      : ByteSource("mesh"), bytes_(bytes), end_(end) {}
  size_t read(void* out, size_t size) override {
    const size_t got = readAt(place_, out, size);
    place_ += got;
    return got;
  }
  size_t readAt(uint64_t offset, void* out, size_t size) override {
    if (offset >= *end_) return 0;
    const size_t n = std::min(size, *end_ - static_cast<size_t>(offset));
    std::memcpy(out, bytes_.data() + offset, n);
    return n;
  }
  bool seekable() const override { return true; }
  uint64_t size() const override { return bytes_.size(); }

 private:
  const Bytes& bytes_;
  const size_t* end_;
  uint64_t place_ = 0;
};

TEST(PlacedRows, OfAFileThatShrinksAreAnError) {
  const Bytes file = wholeMedit({4, false, true});
  for (size_t left = 0; left < file.size(); left += 97) {
    size_t end = file.size();
    ReadOptions options;
    options.split = true;
    Input input = openMedit(std::make_unique<ShrinkingSource>(file, &end), options);
    end = left;
    try {
      readAll(input);
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Status::kBadData);
      EXPECT_NE(error.text().find("was longer when it was opened"), std::string::npos);
      continue;
    }
    // What comes last, a triangle and the end, was read when the file was opened.
    EXPECT_GT(left + 300, file.size());
  }
}

TEST(PlacedRows, SurviveEveryCutAndEveryFlippedBit) {
  MeditFile medit({2, false, true});
  medit.vertices();
  medit.cells(8, 2, 4);
  expectSurvives(openMedit, medit.end());
}

}  // namespace
}  // namespace tetstream
