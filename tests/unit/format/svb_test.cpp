#include <cmath>
#include <cstring>

#include "sv_format.h"
#include "sv_testing.h"

namespace tetstream::test {
namespace {

// Words and bytes of an .svb file, in either byte order.
class SvbText {
 public:
  explicit SvbText(bool big = false) : big_(big) { bytes = {4, big, 0, 0}; }
  SvbText& i(std::initializer_list<int64_t> values) {
    for (int64_t v : values) word(static_cast<uint32_t>(v));
    return *this;
  }
  SvbText& f(std::initializer_list<float> values) {
    for (float v : values) {
      uint32_t bits;
      std::memcpy(&bits, &v, 4);
      word(bits);
    }
    return *this;
  }
  SvbText& byte(unsigned char b) {
    bytes.push_back(b);
    return *this;
  }
  Bytes bytes;

 private:
  void word(uint32_t w) {
    for (int k = 0; k < 4; ++k)
      bytes.push_back(static_cast<unsigned char>(w >> 8 * (big_ ? 3 - k : k)));
  }
  bool big_;
};

// The worked example: one cell, all vertices finalized by it.
Bytes workedExample(bool big = false) {
  SvbText t(big);
  t.i({0, -1, -1, 3, 0}).byte(0).i({0x0f});
  t.f({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
  return t.i({-4, -3, -2, -1}).bytes;
}

SvMesh oneCellMesh() {
  SvMesh m;
  m.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  m.cells = {{0, 1, 2, 3}};
  m.last_uses = {15};
  m.events = {{'v', 0}, {'v', 1}, {'v', 2}, {'v', 3}, {'c', 0}};
  return m;
}

Schema scalarSchema() {
  Schema s;
  s.fields = {{"scalar", 1, ScalarType::kFloat32}};
  return s;
}

void expectSvbError(const Bytes& bytes, const std::string& part) {
  const Error error = errorOf(openSvb, bytes);
  EXPECT_EQ(error.status(), Status::kBadData);
  EXPECT_NE(error.text().find(part), std::string::npos) << error.text();
}

// A header without counts, then whatever the test adds. The first element stands at byte 29.
SvbText header() {
  SvbText t;
  t.i({0, -1, -1, 3, 0}).byte(0);
  return t;
}

constexpr std::initializer_list<float> kFour = {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

TEST(SvbReader, ReadsTheWorkedExampleInBothByteOrders) {
  for (bool big : {false, true}) {
    const SvMesh m = readBytes(openSvb, workedExample(big));
    EXPECT_EQ(m.positions, oneCellMesh().positions);
    EXPECT_EQ(m.cells, oneCellMesh().cells);
    EXPECT_EQ(m.final_at, (std::vector<int64_t>{1, 1, 1, 1}));
    EXPECT_EQ(m.schema.vertex_count, -1);
    EXPECT_TRUE(m.schema.fields.empty());
  }
}

TEST(SvbWriter, WritesTheWorkedExampleToTheByte) {
  Bytes out;
  putStream(oneCellMesh(), *createSvb(std::make_unique<PipeSink>(out), WriteOptions()), 0);
  EXPECT_EQ(out, workedExample());
}

TEST(SvbWriter, PatchesCountsAndWritesKnownOnes) {
  const Bytes patched = writeBytes(createSvb, oneCellMesh());
  SvMesh known = oneCellMesh();
  known.schema.vertex_count = 4;
  known.schema.cell_count = 1;
  EXPECT_EQ(writeBytes(createSvb, known), patched);
  const SvMesh m = readBytes(openSvb, patched);
  EXPECT_EQ(m.schema.vertex_count, 4);
  EXPECT_EQ(m.schema.cell_count, 1);
}

TEST(SvbRoundTrip, PreOrderKeepsTheMeshAndTheLastUses) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const SvMesh m = randomStream(scalarSchema(), 60, seed);
    std::vector<std::string> notes;
    const SvMesh r = readBytes(openSvb, writeBytes(createSvb, m, false, 0, &notes));
    EXPECT_EQ(r.positions, m.positions);
    EXPECT_EQ(r.fields, m.fields);
    EXPECT_EQ(r.cells, m.cells);
    EXPECT_EQ(r.last_uses, m.last_uses);
    ASSERT_EQ(notes.size(), 1u) << "explicit finalizations are lost";
    EXPECT_NE(notes[0].find("stay active"), std::string::npos) << notes[0];
  }
}

TEST(SvbRoundTrip, PostOrderKeepsTheMeshAndFinalizesEveryVertex) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const SvMesh m = randomStream(scalarSchema(), 60, seed);
    std::vector<std::string> notes;
    const SvMesh r = readBytes(openSvb, writeBytes(createSvb, m, true, 0, &notes));
    EXPECT_EQ(r.positions, m.positions);
    EXPECT_EQ(r.fields, m.fields);
    EXPECT_EQ(sortedCells(r), sortedCells(m));
    for (int64_t at : r.final_at) EXPECT_GE(at, 0);
    EXPECT_TRUE(notes.empty());
  }
}

TEST(SvbRoundTrip, LongStreamsCrossTheBlocksOfReaderAndFormat) {
  for (bool post_order : {false, true}) {
    const SvMesh m = randomStream(scalarSchema(), slowRun() ? 7000 : 20000, 6);
    const SvMesh r = readBytes(openSvb, writeBytes(createSvb, m, post_order));
    EXPECT_EQ(r.positions, m.positions);
    EXPECT_EQ(r.fields, m.fields);
    EXPECT_EQ(sortedCells(r), sortedCells(m));
  }
}

TEST(SvbRoundTrip, EveryNumberOfElementsInTheLastBlockWorks) {
  for (int unused = 0; unused < 70; ++unused) {
    SvMesh m = oneCellMesh();
    for (int i = 0; i < unused; ++i) {
      m.positions.insert(m.positions.end(), {1, 2, double(i)});
      m.events.push_back({'v', 4 + i});
    }
    const Bytes bytes = writeBytes(createSvb, m);
    const size_t elements = 5 + static_cast<size_t>(unused);
    EXPECT_EQ(bytes.size(), 25 + 16 * elements + 4 * (elements / 32 + 1));
    EXPECT_EQ(readBytes(openSvb, bytes).positions, m.positions);
    if (elements % 32 != 0) continue;
    // The lone descriptor at the end may be missing.
    const SvMesh r = readBytes(openSvb, Bytes(bytes.begin(), bytes.end() - 4));
    EXPECT_EQ(r.positions, m.positions);
  }
}

TEST(SvbWriter, TheBytesDoNotDependOnTheBatches) {
  for (bool post_order : {false, true}) {
    const SvMesh m = randomStream(scalarSchema(), 300, 3);
    const Bytes whole = writeBytes(createSvb, m, post_order);
    for (unsigned cut = 1; cut <= 5; ++cut)
      EXPECT_EQ(writeBytes(createSvb, m, post_order, cut), whole);
  }
}

TEST(SvbWriter, SaysWhatDoesNotFit) {
  Schema schema;
  schema.position_type = ScalarType::kFloat64;
  schema.fields = {{"velocity", 3, ScalarType::kFloat32},
                   {"id", 1, ScalarType::kInt32},
                   {"T", 1, ScalarType::kFloat64},
                   {"p", 1, ScalarType::kFloat32}};
  schema.cell_data = {{"material", 1, ScalarType::kInt32}};
  SvMesh m = randomStream(schema, 30, 1);
  m.schema.box_min = {0, 1, 2, 3, 4, 5, 6, 7, 8};
  m.schema.box_max = {10, 11, 12, 13, 14, 15, 16, 17, 18};
  std::vector<std::string> notes;
  const SvMesh r = readBytes(openSvb, writeBytes(createSvb, m, true, 0, &notes));
  std::string all;
  for (const std::string& n : notes) all += n + '\n';
  for (const char* name : {"\"velocity\" is left", "\"id\" is left", "\"p\" is left",
                           "\"material\" is left", "positions are rounded", "\"T\" is rounded"})
    EXPECT_NE(all.find(name), std::string::npos) << all;
  EXPECT_EQ(notes.size(), 6u) << all;
  ASSERT_EQ(r.fields.size(), 1u);
  for (size_t i = 0; i < m.vertexCount(); ++i)
    EXPECT_EQ(r.fields[0][i], static_cast<float>(m.fields[2][i]));
  for (size_t i = 0; i < m.positions.size(); ++i)
    EXPECT_EQ(r.positions[i], static_cast<float>(m.positions[i]));
  EXPECT_EQ(r.schema.box_min, (std::vector<double>{0, 1, 2, 7}));
  EXPECT_EQ(r.schema.box_max, (std::vector<double>{10, 11, 12, 17}));
}

TEST(SvbWriter, KeepsAnIntegerFieldIfThatIsAllThereIs) {
  Schema schema;
  schema.fields = {{"id", 1, ScalarType::kInt32}};
  SvMesh m = randomStream(schema, 30, 1);
  m.schema.box_min = {0, 0, 0, -9};
  m.schema.box_max = {1, 1, 1, 9};
  const SvMesh r = readBytes(openSvb, writeBytes(createSvb, m));
  ASSERT_EQ(r.schema.fields.size(), 1u);
  EXPECT_EQ(r.schema.fields[0].type, ScalarType::kInt32);
  EXPECT_EQ(r.fields, m.fields);
  EXPECT_EQ(r.schema.box_min, m.schema.box_min);
  EXPECT_EQ(r.schema.box_max, m.schema.box_max);
}

TEST(SvbWriter, RefusesMoreVerticesThanInt32AndPositionsBeyondFloat32) {
  SvMesh m = oneCellMesh();
  m.schema.vertex_count = int64_t{1} << 31;
  try {
    writeBytes(createSvb, m);
    ADD_FAILURE() << "written";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::kUnsupported);
    EXPECT_NE(error.text().find("2147483647"), std::string::npos) << error.text();
  }
  m = oneCellMesh();
  m.schema.position_type = ScalarType::kFloat64;
  m.positions[4] = 1e39;
  EXPECT_THROW(writeBytes(createSvb, m), Error);
}

TEST(SvbReader, ReadsBoxesIntegersAndSkipsComments) {
  for (bool big : {false, true}) {
    SvbText t(big);
    t.i({2, 3}).byte('a').byte('b').byte('c').i({0});
    t.i({4, 1, 3, 1}).byte(1).f({0, 0, 0, 1, 2, 4}).byte(1).i({-3, 30}).i({0x0f});
    for (int v : {0, 1, 2, 3})
      t.f({v == 1 ? 1.f : 0.f, v == 2 ? 2.f : 0.f, v == 3 ? 4.f : 0.f}).i({10 * v});
    t.i({-4, -3, -2, -1});
    const SvMesh m = readBytes(openSvb, t.bytes);
    ASSERT_EQ(m.schema.fields.size(), 1u);
    EXPECT_EQ(m.schema.fields[0].name, "label0");
    EXPECT_EQ(m.fields[0], (std::vector<double>{0, 10, 20, 30}));
    EXPECT_EQ(m.schema.box_min, (std::vector<double>{0, 0, 0, -3}));
    EXPECT_EQ(m.schema.box_max, (std::vector<double>{1, 2, 4, 30}));
  }
}

// All vertices, then all cells, positive references.
Bytes standardSvb(size_t vertices, size_t cells, bool big) {
  SvbText t(big);
  t.i({0, static_cast<int64_t>(vertices), static_cast<int64_t>(cells), 4, 0}).byte(0);
  for (size_t first = 0; first < vertices + cells; first += 32) {
    const size_t end = std::min(first + 32, vertices + cells);
    uint32_t descriptor = 0;
    for (size_t e = first; e < end && e < vertices; ++e) descriptor |= 1u << (e - first);
    t.i({descriptor});
    for (size_t e = first; e < end; ++e) {
      const float x = static_cast<float>(e);
      const auto vertex = [&](size_t k) {
        return static_cast<int64_t>((7 * e + k) % vertices + 1);
      };
      if (e < vertices)
        t.f({x, 0, 1, -x});
      else
        t.i({vertex(0), vertex(1), vertex(2), vertex(3)});
    }
  }
  return t.bytes;
}

TEST(SvbReader, TheStandardFormIsIndexedFromFilesAndPipes) {
  for (size_t vertices : {4u, 31u, 32u, 33u, 70000u})
    for (bool big : {false, true}) {
      const size_t cells = vertices / 2;
      const Bytes data = standardSvb(vertices, cells, big);
      Input file = openBytes(openSvb, data);
      ASSERT_TRUE(file.indexed);
      const SvMesh m = readIndexed(*file.indexed, vertices > 1000 ? 9999 : 7);
      ASSERT_EQ(m.vertexCount(), vertices);
      ASSERT_EQ(m.cells.size(), cells);
      for (size_t i = 0; i < vertices; ++i) {
        ASSERT_EQ(m.positions[3 * i], static_cast<double>(i));
        ASSERT_EQ(m.fields[0][i], -static_cast<double>(i));
      }
      for (size_t i = 0; i < cells; ++i)
        ASSERT_EQ(m.cells[i][2], static_cast<int64_t>((7 * (i + vertices) + 2) % vertices));
      const SvMesh p = readPipe(openSvb, data, 1001);
      EXPECT_EQ(p.positions, m.positions);
      EXPECT_EQ(p.cells, m.cells);
      EXPECT_EQ(p.schema.cell_count, static_cast<int64_t>(cells));
    }
}

TEST(SvbReader, PipesGiveTheSameMeshHoweverTheyCutTheBytes) {
  expectSameThroughPipes(openSvb, createSvb, randomStream(scalarSchema(), 60, 9), {1, 3, 17, 64});
}

TEST(SvbReader, NamesTheByteOfWhatIsWrong) {
  const auto cell = [](std::initializer_list<int64_t> refs) {
    return header().i({0x0f}).f(kFour).i(refs).bytes;  // the cell stands at byte 93
  };
  expectSvbError(cell({-4, -3, -2, 0}), "byte 93: the reference 0");
  expectSvbError(cell({-4, -3, -2, -5}), "byte 93: the reference -5");
  expectSvbError(cell({-4, -3, -2, 5}), "byte 93: the reference 5");
  expectSvbError(cell({-4, -3, -2, 3}), "byte 93: a cell needs four");
  expectSvbError(cell({1, 2, 3, 5}), "byte 93: the reference 5");  // the indexed form
  expectSvbError(cell({1, 2, 3, 3}), "byte 93: a cell needs four");
  expectSvbError(header().i({0x4f}).f(kFour).i({-4, 2, 3, 4, 1, 2, 3, 4}).f({0, 0, 0, 0}).bytes,
                 "byte 109: vertex 0 is used after");
  expectSvbError(header().i({3}).f({0, 0, 0, 0, 0, 0, NAN, 0}).bytes, "byte 45: vertex 1 has");
  expectSvbError(header().i({7}).f({0, 0, 0, 0}).bytes, "byte 45: the file ends, but its last");
  Bytes fragment = workedExample();
  fragment.push_back(0);
  expectSvbError(fragment, "byte 110: the file ends within an element");
  expectSvbError(header().bytes, "no vertex and no cell");
  expectSvbError({}, "the file ends at byte 0, within the header");
  expectSvbError({4, 0, 0, 0, 0, 0}, "the file ends at byte 6");
}

TEST(SvbReader, ChecksTheHeaderBeforeBelievingIt) {
  const auto with = [](std::initializer_list<int64_t> words) {
    return SvbText().i(words).byte(0).i({1}).f({0, 0, 0, 0}).bytes;
  };
  expectSvbError(with({0, 2, -1, 3, 0}), "1 vertices were read, the header says 2");
  expectSvbError(with({0, -1, 2, 3, 0}), "0 cells were read, the header says 2");
  expectSvbError(with({0, INT32_MAX, INT32_MAX, 3, 0}), "the header says");
  expectSvbError(with({0, -2, -1, 3, 0}), "byte 8: nverts");
  expectSvbError(with({0, -1, -2, 3, 0}), "byte 12: ncells");
  expectSvbError(with({0, -1, -1, 2, 0}), "byte 16: v_pnum_f");
  expectSvbError(with({0, -1, -1, 5, 0}), "byte 16: v_pnum_f");
  expectSvbError(with({0, -1, -1, 4, 1}), "byte 20: v_pnum_i");
  expectSvbError(with({-1, -1, -1, 3, 0}), "byte 4: the number of comments");
  expectSvbError(with({1, INT32_MAX, -1, 3, 0}), "byte 8: a comment's length");
  expectSvbError(with({INT32_MAX, 0, 0, 0, 0}), "within the header");
  Bytes bytes = workedExample();
  bytes[0] = 3;
  expectSvbError(bytes, "byte 0");
  bytes = workedExample();
  bytes[1] = 2;
  expectSvbError(bytes, "byte 1");
  bytes = workedExample();
  bytes[24] = 7;
  expectSvbError(bytes, "byte 24");
  bytes = workedExample();
  bytes[2] = 1;
  EXPECT_EQ(errorOf(openSvb, bytes).status(), Status::kUnsupported);
}

TEST(SvbReader, PostOrderCellsWaitForTheirVertices) {
  // c v v v v, a vertex that nothing uses, c v v v v.
  SvbText t = header();
  t.i({0b11110111110}).i({1, 2, 3, 4}).f(kFour).f({9, 9, 9, 0}).i({6, 7, 8, 9}).f(kFour);
  const SvMesh m = readBytes(openSvb, t.bytes);
  EXPECT_EQ(m.cells, (std::vector<Cell>{{0, 1, 2, 3}, {5, 6, 7, 8}}));
  EXPECT_EQ(m.final_at, (std::vector<int64_t>{1, 1, 1, 1, 1, 2, 2, 2, 2}));
}

TEST(SvbReader, SurvivesEveryCutAndEveryFlippedBit) {
  expectSurvives(openSvb, workedExample());
  expectSurvives(openSvb, workedExample(true));
  expectSurvives(openSvb, standardSvb(20, 15, false));
  expectSurvives(openSvb, writeBytes(createSvb, randomStream(scalarSchema(), 12, 1)));
  expectSurvives(openSvb, writeBytes(createSvb, randomStream(scalarSchema(), 12, 1), true));
}

}  // namespace
}  // namespace tetstream::test
