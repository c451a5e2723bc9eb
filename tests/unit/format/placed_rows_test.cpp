// Binary MEDIT and Gmsh files: rows that are read where they lie are those that come as a pipe
// gives them, and what is wrong with them is told when they are read.
#include <gtest/gtest.h>

#include <cstring>

#include "indexed_testing.h"

namespace tetstream {
namespace {

using namespace test;

constexpr int kPoints = 60, kCells = 40;

class BinaryFile {
 public:
  explicit BinaryFile(bool swapped) : swapped_(swapped) {}
  void text(const std::string& text) { bytes.insert(bytes.end(), text.begin(), text.end()); }
  template <class Number>
  size_t put(Number value) {
    unsigned char at[sizeof value];
    std::memcpy(at, &value, sizeof value);
    if (swapped_) std::reverse(at, at + sizeof value);
    bytes.insert(bytes.end(), at, at + sizeof value);
    return bytes.size() - sizeof value;
  }
  // Over what is there.
  template <class Number>
  void putAt(size_t place, Number value) {
    const size_t end = bytes.size();
    put(value);
    std::copy(bytes.begin() + static_cast<std::ptrdiff_t>(end), bytes.end(),
              bytes.begin() + static_cast<std::ptrdiff_t>(place));
    bytes.resize(end);
  }
  // 4 or 8 bytes
  size_t integer(int64_t value, size_t width) {
    return width == 4 ? put(static_cast<int32_t>(value)) : put(value);
  }
  void real(double value, size_t width) {
    width == 4 ? put(static_cast<float>(value)) : put(value);
  }

  Bytes bytes;

 private:
  bool swapped_;
};

double coordinate(int point, int axis) {
  return 0.25 * ((point * 7 + axis * 11) % 29) - axis;
}

int64_t cornerOf(int cell, int k) {
  return (cell * 3 + k * 5) % kPoints;
}

// ------------------------------------------------------------------------------------------ MEDIT

struct MeditKind {
  int version;
  bool swapped, labelled;
};

class MeditFile : public BinaryFile {
 public:
  explicit MeditFile(const MeditKind& kind)
      : BinaryFile(kind.swapped),
        kind_(kind),
        integer_bytes_(kind.version == 4 ? 8 : 4),
        real_bytes_(kind.version == 1 ? 4 : 8),
        place_bytes_(kind.version >= 3 ? 8 : 4) {
    put<int32_t>(1);
    put<int32_t>(kind.version);
    begin(3);
    put<int32_t>(3);
  }
  void begin(int32_t keyword) {
    if (next_ > 0) {
      kind_.version >= 3 ? putAt(next_, static_cast<int64_t>(bytes.size()))
                         : putAt(next_, static_cast<int32_t>(bytes.size()));
    }
    put(keyword);
    next_ = integer(0, place_bytes_);
  }
  void rows(int64_t count) { integer(count, integer_bytes_); }
  void integer(int64_t value) { BinaryFile::integer(value, integer_bytes_); }
  using BinaryFile::integer;
  void real(double value) { BinaryFile::real(value, real_bytes_); }
  void vertices() {
    begin(4);
    rows(kPoints);
    for (int i = 0; i < kPoints; ++i) {
      for (int k = 0; k < 3; ++k) real(coordinate(i, k));
      integer(kind_.labelled && i > 40 ? i : 0);
    }
  }
  // Cells of so many points; the labels are 0 up to the last ones.
  void cells(int32_t keyword, int count, int points, int first = 0) {
    begin(keyword);
    rows(count);
    for (int i = first; i < first + count; ++i) {
      for (int k = 0; k < points; ++k) integer(1 + cornerOf(i, k));
      integer(kind_.labelled && i >= 30 ? i : 0);
    }
  }
  void solution(int32_t keyword, int count) {
    begin(keyword);
    rows(count);
    put<int32_t>(2);
    put<int32_t>(2);
    put<int32_t>(1);
    for (int i = 0; i < 4 * count; ++i) real(0.5 * i);
  }
  Bytes end() {
    begin(54);
    return bytes;
  }

 private:
  MeditKind kind_;
  size_t integer_bytes_, real_bytes_, place_bytes_, next_ = 0;
};

Bytes wholeMedit(const MeditKind& kind) {
  MeditFile file(kind);
  file.cells(6, 1, 3);
  file.vertices();
  file.cells(8, kCells - 10, 4);
  file.begin(5);  // edges, which are passed over
  file.rows(1);
  for (int i = 0; i < 3; ++i) file.integer(1);
  file.cells(10, 2, 8, 3);
  file.cells(30, 10, 10, kCells - 10);
  file.cells(6, 2, 3, 35);
  file.solution(62, kPoints);
  return file.end();
}

// ------------------------------------------------------------------------------------------- Gmsh

// Tags of points are runs, those of elements count on.
int64_t tagOf(int64_t point) {
  return point < 20 ? 500 + point : 100 + point;
}

class MshFile : public BinaryFile {
 public:
  MshFile(const char* version, bool swapped) : BinaryFile(swapped), is_4_(version[0] == '4') {
    text(std::string("$MeshFormat\n") + version + " 1 8\n");
    put<int32_t>(1);
    text("\n$EndMeshFormat\n");
  }
  void comments(const std::string& text) { this->text("$Comments\n" + text + "\n$EndComments\n"); }
  void entities() {
    text("$Entities\n");
    for (int64_t count : {0, 0, 1, 2}) put(count);
    for (int32_t entity : {4, 1, 2}) {
      put(entity);
      for (int k = 0; k < 6; ++k) put(0.0);
      put(int64_t{entity == 1 ? 0 : 1});
      if (entity != 1) put<int32_t>(entity + 30);
      put<int64_t>(0);
    }
    text("\n$EndEntities\n");
  }
  void nodes() {
    text(is_4_ ? "$Nodes\n" : "$Nodes\n" + std::to_string(kPoints) + "\n");
    if (is_4_) {
      for (int64_t count : {2, kPoints, 1, 999}) put(count);
      nodeBlock(0, 20, 2, true);
      nodeBlock(20, kPoints, 3, false);
    }
    for (int i = 0; i < kPoints && !is_4_; ++i) {
      put(static_cast<int32_t>(tagOf(i)));
      position(i);
    }
    text("\n$EndNodes\n");
  }
  void elements() {
    text(is_4_ ? "$Elements\n" : "$Elements\n" + std::to_string(kCells + 2) + "\n");
    if (is_4_)
      for (int64_t count : {4, kCells + 2, 1, 999}) put(count);
    block({2, 4, 2, 2, 3}, 0, 2);
    block({3, 1, 4, 2, 4}, 0, 20);
    block({3, 2, 11, 3, 10}, 20, 10);
    block({3, 2, 4, 2, 4}, 30, 10);
    text("\n$EndElements\n");
  }
  struct Data {
    const char* section;
    const char* name;
    int rows, components;
  };
  // Of tag(row)
  template <class Tag>
  void data(const Data& d, Tag tag) {
    text(std::string("$") + d.section + "\n1\n\"" + d.name + "\"\n1\n0\n3\n0\n" +
         std::to_string(d.components) + "\n" + std::to_string(d.rows) + "\n");
    for (int i = 0; i < d.rows; ++i) {
      put(static_cast<int32_t>(tag(i)));
      for (int k = 0; k < d.components; ++k) put(1.5 * i + k);
    }
    text(std::string("\n$End") + d.section + "\n");
  }
  size_t last_row = 0;  // where the last element begins

 private:
  struct Block {
    int32_t dimension, entity, kind;
    int tags, points;  // tags: of version 2
  };
  void position(int point) {
    for (int k = 0; k < 3; ++k) put(coordinate(point, k));
  }
  void nodeBlock(int begin, int end, int32_t dimension, bool parametric) {
    for (int32_t value : {dimension, 1, parametric ? 1 : 0}) put(value);
    put<int64_t>(end - begin);
    for (int i = begin; i < end; ++i) put(tagOf(i));
    for (int i = begin; i < end; ++i) {
      position(i);
      for (int k = 0; k < dimension && parametric; ++k) put(9.0);
    }
  }
  void block(const Block& b, int first, int count) {
    if (is_4_) {
      for (int32_t value : {b.dimension, b.entity, b.kind}) put(value);
      put<int64_t>(count);
    } else {
      for (int32_t value : {b.kind, count, b.tags}) put(value);
    }
    const size_t width = is_4_ ? 8 : 4;
    for (int i = first; i < first + count; ++i) {
      last_row = integer(b.dimension == 2 ? 900 + i : 300 + i, width);
      for (int k = 0; k < b.tags && !is_4_; ++k)
        integer(k == 0 ? (b.entity == 1 ? 0 : b.entity + 30) : b.entity, width);
      for (int k = 0; k < b.points; ++k) integer(tagOf(cornerOf(i, k)), width);
    }
  }
  bool is_4_;
};

Bytes wholeMsh(const char* version, bool swapped) {
  MshFile file(version, swapped);
  file.comments("tetstream position float32\ntetstream field float32 narrow");
  if (version[0] == '4') file.entities();
  file.nodes();
  file.elements();
  file.data({"NodeData", "in order", kPoints, 1}, [](int i) { return tagOf(i); });
  file.data({"NodeData", "narrow", kPoints, 3}, [](int i) { return tagOf(i); });
  file.data({"NodeData", "reversed", kPoints, 1}, [](int i) { return tagOf(kPoints - 1 - i); });
  file.data({"NodeData", "some", 7, 1}, [](int i) { return tagOf(3 * i); });
  file.data({"ElementData", "of cells", kCells, 2}, [](int i) { return 300 + i; });
  file.data({"ElementData", "of faces, too", kCells + 2, 1},
            [](int i) { return i < 2 ? 900 + i : 298 + i; });
  // A second part of what had all rows.
  file.data({"NodeData", "in order", 2, 1}, [](int i) { return tagOf(7 + i); });
  return file.bytes;
}

// ------------------------------------------------------------------------------------------ tests

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

void expectSame(const Reading& a, const Reading& b) {
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
      expectSame(readWhole(open, openMemory(file.data(), file.size(), "mesh"), step, tasks), piped);
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
        EXPECT_EQ(r.mesh.vertexCount(), size_t{kPoints});
        EXPECT_GT(r.mesh.cells.size(), size_t{kCells});
        EXPECT_EQ(r.mesh.cells.back()[3], cornerOf(kCells - 1, 3));
        EXPECT_EQ(r.mesh.positions[3 * 50 + 1], coordinate(50, 1));
        ASSERT_EQ(r.mesh.schema.fields.size(), labelled ? 3u : 2u);
        EXPECT_EQ(r.mesh.fields.back()[50], 0.5 * (4 * 50 + 3));
        ASSERT_EQ(r.mesh.cell_data.size(), labelled ? 1u : 0u);
        if (!labelled) continue;
        EXPECT_EQ(r.mesh.cell_data[0].back(), kCells - 1);
        EXPECT_EQ(r.mesh.fields[0][50], 50);
      }
}

TEST(PlacedRows, OfGmshAreThoseOfAPipe) {
  for (const char* version : {"4.1", "2.2"})
    for (bool swapped : {false, true}) {
      SCOPED_TRACE(std::string(version) + (swapped ? ", swapped" : ""));
      const Reading r = expectSameAsOfAPipe(openMsh, wholeMsh(version, swapped));
      ASSERT_EQ(r.mesh.cells.size(), size_t{kCells});
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
  file.data({"ElementData", "early", kCells, 1}, [](int i) { return 300 + i; });
  file.text("$Elements\n");
  for (int64_t count : {1, 2, 1, 999}) file.put(count);
  for (int32_t value : {3, 1, 4}) file.put(value);
  file.put<int64_t>(2);
  for (int64_t value : {290, 500, 501, 502, 503, 291, 504, 505, 506, 507}) file.put(value);
  file.text("\n$EndElements\n");
  file.data({"ElementData", "late", 3, 1}, [](int i) { return i < 2 ? 290 + i : 300; });
  const Reading r = expectSameAsOfAPipe(openMsh, file.bytes);
  ASSERT_EQ(r.mesh.cell_data.size(), 3u);
  EXPECT_EQ(r.mesh.cell_data[1][kCells - 1], 1.5 * (kCells - 1));
  EXPECT_EQ(r.mesh.cell_data[2][kCells], 0.0);
  EXPECT_EQ(r.mesh.cell_data[2][kCells + 1], 1.5);
  EXPECT_EQ(r.mesh.cell_data[2][0], 3.0);
}

std::string problemIn(Open open, const Bytes& file) {
  return errorOf(open, file).text();
}

TEST(PlacedRows, TellTheByteOfWhatIsWrong) {
  MeditFile medit({2, false, true});
  medit.vertices();
  const size_t points_end = medit.bytes.size();
  medit.cells(8, kCells, 4);
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
