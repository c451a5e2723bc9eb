#include <cmath>

#include "sv_format.h"
#include "sv_testing.h"

namespace tetstream::test {
namespace {

const char kPreOrder[] =
    "# svtype tet\n# nverts 5\n# ncells 2\n# v_pnum_f 4\n# c_pnum_i 1\n"
    "v 0 0 0 0.5\nv 1 0 0 0.5\nv 0 1 0 0.5\nv 0 0 1 0.5\nc -4 2 3 4 10\n"
    "v 1 1 1 0.5\nc -4 -3 -2 -1 20\n";
const char kPostOrder[] =
    "# v_pnum_f 3\nc 1 2 3 4\nv 0 0 0\nc 2 3 4 5\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\n";

SvMesh readText(const std::string& text, std::vector<std::string>* notes = nullptr) {
  return readBytes(openSva, bytesOf(text), notes);
}

void expectSvaError(const std::string& text, const std::string& part) {
  const Error error = errorOf(openSva, bytesOf(text));
  EXPECT_EQ(error.status(), Status::kBadData) << text;
  EXPECT_NE(error.text().find(part), std::string::npos) << error.text();
}

// The mesh of the worked examples.
SvMesh exampleMesh(bool scalar_and_region) {
  SvMesh m;
  m.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
  m.cells = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  m.last_uses = {1, 15};
  m.events = {{'v', 0}, {'v', 1}, {'v', 2}, {'v', 3}, {'c', 0}, {'v', 4}, {'c', 1}};
  if (!scalar_and_region) return m;
  m.schema.fields = {{"scalar", 1, ScalarType::kFloat32}};
  m.schema.cell_data = {{"region", 1, ScalarType::kInt32}};
  m.schema.vertex_count = 5;
  m.schema.cell_count = 2;
  m.fields = {{0.5, 0.5, 0.5, 0.5, 0.5}};
  m.cell_data = {{10, 20}};
  return m;
}

Schema plainSchema() {
  Schema s;
  s.fields = {{"scalar", 1, ScalarType::kFloat32}};
  s.cell_data = {{"region", 1, ScalarType::kInt32}};
  return s;
}

TEST(SvaReader, ReadsTheWorkedExampleInPreOrder) {
  const SvMesh m = readText(kPreOrder);
  EXPECT_EQ(m.schema.vertex_count, 5);
  EXPECT_EQ(m.schema.cell_count, 2);
  EXPECT_EQ(m.schema.position_type, ScalarType::kFloat32);
  ASSERT_EQ(m.schema.fields.size(), 1u);
  EXPECT_EQ(m.schema.fields[0].name, "scalar");
  ASSERT_EQ(m.schema.cell_data.size(), 1u);
  EXPECT_EQ(m.schema.cell_data[0].name, "region");
  EXPECT_EQ(m.positions, exampleMesh(true).positions);
  EXPECT_EQ(m.fields[0], std::vector<double>(5, 0.5));
  EXPECT_EQ(m.cells, (std::vector<Cell>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(m.cell_data[0], (std::vector<double>{10, 20}));
  EXPECT_EQ(m.final_at, (std::vector<int64_t>{1, 2, 2, 2, 2}));
}

TEST(SvaReader, ReadsTheWorkedExampleInPostOrder) {
  const SvMesh m = readText(kPostOrder);
  EXPECT_EQ(m.positions, exampleMesh(false).positions);
  // Cell 0 waits for vertex 3, cell 1 for vertex 4.
  EXPECT_EQ(m.cells, (std::vector<Cell>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(m.final_at, (std::vector<int64_t>{1, 2, 2, 2, 2}));
}

TEST(SvaWriter, WritesTheWorkedExampleInPreOrderToTheByte) {
  EXPECT_EQ(writeBytes(createSva, exampleMesh(true)), bytesOf(kPreOrder));
}

TEST(SvaWriter, WritesTheWorkedExampleInPostOrderToTheByte) {
  Bytes out;
  WriteOptions options;
  options.post_order = true;
  putStream(exampleMesh(false), *createSva(std::make_unique<PipeSink>(out), options), 0);
  EXPECT_EQ(out, bytesOf(std::string("# svtype tet\n") + kPostOrder));
}

TEST(SvaRoundTrip, PreOrderKeepsEveryNumberNameAndFinalization) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const SvMesh m = randomStream(richSchema(), 40, seed);
    const SvMesh r = readBytes(openSva, writeBytes(createSva, m));
    EXPECT_EQ(r.schema.position_type, ScalarType::kFloat64);
    ASSERT_EQ(r.schema.fields.size(), m.schema.fields.size());
    for (size_t c = 0; c < m.fields.size(); ++c) {
      EXPECT_EQ(r.schema.fields[c].name, m.schema.fields[c].name);
      EXPECT_EQ(r.schema.fields[c].components, m.schema.fields[c].components);
      EXPECT_EQ(r.schema.fields[c].type, m.schema.fields[c].type);
    }
    ASSERT_EQ(r.schema.cell_data.size(), m.schema.cell_data.size());
    EXPECT_EQ(r.schema.cell_data[0].type, ScalarType::kInt64);
    EXPECT_EQ(r.schema.vertex_count, static_cast<int64_t>(m.vertexCount()));
    EXPECT_EQ(r.schema.cell_count, 40);
    EXPECT_EQ(r.positions, m.positions);
    EXPECT_EQ(r.fields, m.fields);
    EXPECT_EQ(r.cells, m.cells);
    EXPECT_EQ(r.cell_data, m.cell_data);
    EXPECT_EQ(r.last_uses, m.last_uses);
    EXPECT_EQ(r.final_at, m.final_at);
  }
}

TEST(SvaRoundTrip, PostOrderKeepsTheMeshAndFinalizesEveryVertex) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const SvMesh m = randomStream(richSchema(), 40, seed);
    const SvMesh r = readBytes(openSva, writeBytes(createSva, m, true));
    EXPECT_EQ(r.positions, m.positions);
    EXPECT_EQ(r.fields, m.fields);
    EXPECT_EQ(sortedCells(r), sortedCells(m));
    for (int64_t at : r.final_at) EXPECT_GE(at, 0);
  }
}

TEST(SvaRoundTrip, LongStreamsCrossTheBlocksOfTheReader) {
  for (bool post_order : {false, true}) {
    const SvMesh m = randomStream(plainSchema(), slowRun() ? 7000 : 20000, 5);
    const SvMesh r = readBytes(openSva, writeBytes(createSva, m, post_order));
    EXPECT_EQ(r.schema.position_type, ScalarType::kFloat32) << "large floats have 9 digits, too";
    EXPECT_EQ(r.positions, m.positions);
    EXPECT_EQ(sortedCells(r), sortedCells(m));
    EXPECT_TRUE(post_order || r.final_at == m.final_at);
  }
}

TEST(SvaWriter, TheBytesDoNotDependOnTheBatches) {
  for (bool post_order : {false, true}) {
    const SvMesh m = randomStream(plainSchema(), 300, 3);
    const Bytes whole = writeBytes(createSva, m, post_order);
    for (unsigned cut = 1; cut <= 5; ++cut)
      EXPECT_EQ(writeBytes(createSva, m, post_order, cut), whole);
  }
}

TEST(SvaWriter, PreOrderIsCompact) {
  // Vertex 4 is given first of all but stands just before the cell that uses it.
  SvMesh m = exampleMesh(true);
  m.events = {{'v', 0}, {'v', 1}, {'v', 2}, {'v', 3}, {'v', 4}, {'c', 0}, {'c', 1}};
  EXPECT_EQ(writeBytes(createSva, m), bytesOf(kPreOrder));
}

TEST(SvaWriter, CountsThatWereNotKnownArePatchedWhereThatIsPossible) {
  SvMesh m = exampleMesh(true);
  m.schema.vertex_count = m.schema.cell_count = -1;
  const SvMesh r = readBytes(openSva, writeBytes(createSva, m));
  EXPECT_EQ(r.schema.vertex_count, 5);
  EXPECT_EQ(r.schema.cell_count, 2);
  Bytes piped;
  putStream(m, *createSva(std::make_unique<PipeSink>(piped), WriteOptions()), 0);
  EXPECT_EQ(readBytes(openSva, piped).schema.vertex_count, -1);
}

TEST(SvaWriter, WrongAnnouncedCountsAreAnError) {
  SvMesh m = exampleMesh(true);
  m.schema.cell_count = 3;
  EXPECT_THROW(writeBytes(createSva, m), Error);
}

TEST(SvaWriter, AnEmptyMeshComesBackEmpty) {
  SvMesh empty;
  EXPECT_TRUE(readBytes(openSva, writeBytes(createSva, empty)).cells.empty());
  Bytes piped;
  putStream(empty, *createSva(std::make_unique<PipeSink>(piped), WriteOptions()), 0);
  EXPECT_EQ(readBytes(openSva, piped).vertexCount(), 0u);
}

TEST(SvaWriter, RefusesVerticesThatDidNotComeOrAreNoNumbers) {
  SvMesh m = exampleMesh(true);
  m.cells[1][3] = 5;
  EXPECT_THROW(writeBytes(createSva, m), Error);
  m = exampleMesh(true);
  m.positions[4] = NAN;
  EXPECT_THROW(writeBytes(createSva, m), Error);
}

TEST(SvaWriter, PostOrderDoesNotWriteAVertexBeforeTheFirstCell) {
  SvMesh m = exampleMesh(false);
  m.positions.insert(m.positions.begin(), {9, 9, 9});  // never used and final at once
  m.cells = {{1, 2, 3, 4}, {2, 3, 4, 5}};
  m.events = {{'v', 0}, {'x', 0}, {'v', 1}, {'v', 2}, {'v', 3},
              {'v', 4}, {'c', 0}, {'v', 5}, {'c', 1}};
  const Bytes bytes = writeBytes(createSva, m, true);
  const std::string text(bytes.begin(), bytes.end());
  EXPECT_LT(text.find("\nc "), text.find("\nv "));
  const SvMesh r = readBytes(openSva, bytes);
  EXPECT_EQ(r.positions, m.positions);
  EXPECT_EQ(sortedCells(r), sortedCells(m));
}

TEST(SvaWriter, BoxesComeBackAndEncloseWhatTheyDid) {
  SvMesh m = exampleMesh(true);
  m.schema.fields.insert(m.schema.fields.begin(), {"id", 1, ScalarType::kInt32});
  m.fields.insert(m.fields.begin(), {{1, 2, 3, 4, 5}});
  m.schema.box_min = {0, 0, 0, 1, 0.1};
  m.schema.box_max = {1, 1, 1, 5, 0.7};
  const SvMesh r = readBytes(openSva, writeBytes(createSva, m));
  ASSERT_TRUE(r.schema.hasBox());
  for (size_t i = 0; i < 5; ++i) {
    EXPECT_LE(r.schema.box_min[i], m.schema.box_min[i]);
    EXPECT_GE(r.schema.box_max[i], m.schema.box_max[i]);
    EXPECT_NEAR(r.schema.box_max[i], m.schema.box_max[i], 1e-7);
  }
  EXPECT_EQ(r.schema.box_max[3], 5);
}

const char kSixVertices[] = "# v_pnum_f 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\nv 2 2 2\n";

TEST(SvaReader, ExplicitFinalizationKeepsItsPlace) {
  const SvMesh m = readText(std::string(kSixVertices) + "c 1 2 3 4\nx 1\nx -5\nc 3 4 5 6\n");
  EXPECT_EQ(m.final_at, (std::vector<int64_t>{1, 1, -1, -1, -1, -1}));
}

TEST(SvaReader, AnUnusedVertexOfAPostOrderFileIsFinalWhereItStands) {
  const SvMesh m = readText(
      "# v_pnum_f 3\nc 1 2 3 4\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 9 9 9\n"
      "c 7 8 9 10\nv 8 8 8\nv 1 1 1\nv 2 2 2\nv 3 3 3\nv 4 5 6\n");
  EXPECT_EQ(m.final_at, (std::vector<int64_t>{1, 1, 1, 1, 1, 1, 2, 2, 2, 2}));
}

TEST(SvaReader, TheStandardFormIsIndexed) {
  const std::string text = std::string(kSixVertices) + "c 1 2 3 4\nc 3 4 5 6\n";
  Input input = openBytes(openSva, bytesOf(text));
  ASSERT_TRUE(input.indexed);
  const SvMesh m = readIndexed(*input.indexed, 3);
  EXPECT_EQ(m.schema.vertex_count, 6);
  EXPECT_EQ(m.cells, (std::vector<Cell>{{0, 1, 2, 3}, {2, 3, 4, 5}}));
  EXPECT_EQ(m.positions.back(), 2);
  // Anything that finalizes, or a vertex after a cell, makes it a stream.
  EXPECT_TRUE(openBytes(openSva, bytesOf(text + "x 1\n")).stream);
  EXPECT_TRUE(openBytes(openSva, bytesOf(text + "v 3 3 3\n")).stream);
  EXPECT_TRUE(openBytes(openSva, bytesOf(text + "c 3 4 5 -1\n")).stream);
}

TEST(SvaReader, ANegativeCellPropertyIsNoFinalization) {
  const std::string text = "# c_pnum_i 1\n" + std::string(kSixVertices) + "c 1 2 3 4 -7\n";
  Input input = openBytes(openSva, bytesOf(text));
  ASSERT_TRUE(input.indexed);
  EXPECT_EQ(readIndexed(*input.indexed).cell_data[0][0], -7);
}

// A large mesh in the standard form, with every kind of column.
std::string standardSva(size_t vertices, size_t cells) {
  std::string text = "# v_pnum_f 5\n# v_pnum_i 1\n# c_pnum_f 1\n# c_pnum_i 2\n";
  for (size_t i = 0; i < vertices; ++i) {
    const std::string n = std::to_string(i);
    text += "v " + n + " 0 1 " + n + ".5 -" + n + ' ' + n + '\n';
  }
  for (size_t i = 0; i < cells; ++i) {
    const auto vertex = [&](size_t k) { return ' ' + std::to_string((i * 7 + k) % vertices + 1); };
    text += 'c' + vertex(0) + vertex(1) + vertex(2) + vertex(3) + " 0." + std::to_string(i) + ' ' +
            std::to_string(i) + " -1\n";
  }
  return text;
}

TEST(SvaReader, TheStandardFormComesFromFilesAndPipes) {
  const size_t vertices = 30000, cells = 10000;
  const Bytes data = bytesOf(standardSva(vertices, cells));
  ASSERT_GT(data.size(), 1u << 20) << "else the pipe is not spooled";
  const SvMesh m = readPipe(openSva, data, 1000);
  Input file = openBytes(openSva, data);
  ASSERT_TRUE(file.indexed);
  const SvMesh f = readIndexed(*file.indexed, 5000);
  ASSERT_EQ(m.schema.fields.size(), 3u);
  EXPECT_EQ(m.schema.fields[1].name, "scalar1");
  EXPECT_EQ(m.schema.fields[2].name, "label0");
  ASSERT_EQ(m.schema.cell_data.size(), 3u);
  EXPECT_EQ(m.schema.cell_data[0].name, "cell0");
  EXPECT_EQ(m.schema.cell_data[2].name, "region1");
  ASSERT_EQ(m.vertexCount(), vertices);
  ASSERT_EQ(m.cells.size(), cells);
  for (size_t i = 0; i < vertices; ++i) {
    ASSERT_EQ(m.positions[3 * i], static_cast<double>(i));
    ASSERT_EQ(m.fields[0][i], static_cast<double>(i) + 0.5);
    ASSERT_EQ(m.fields[2][i], static_cast<double>(i));
  }
  for (size_t i = 0; i < cells; ++i) {
    ASSERT_EQ(m.cells[i][3], static_cast<int64_t>((i * 7 + 3) % vertices));
    ASSERT_EQ(m.cell_data[1][i], static_cast<double>(i));
  }
  EXPECT_EQ(f.positions, m.positions);
  EXPECT_EQ(f.fields, m.fields);
  EXPECT_EQ(f.cells, m.cells);
  EXPECT_EQ(f.cell_data, m.cell_data);
}

TEST(SvaReader, AStreamThatShowsItselfLateOnAPipeIsStillAStream) {
  const std::string text = standardSva(30000, 10000) + "c -1 1 2 3 0 0 0\n";
  ASSERT_GT(text.size(), 1u << 20);
  const Bytes data = bytesOf(text);
  Input input = openSva(std::make_unique<PipeSource>(data, 4096, "mesh"), ReadOptions());
  ASSERT_TRUE(input.stream);
  const SvMesh m = readStream(*input.stream);
  EXPECT_EQ(m.cells.size(), 10001u);
  EXPECT_EQ(m.final_at.back(), 10001);
}

TEST(SvaReader, AStreamFromAPipeStartsBeforeThePipeEnds) {
  class CountingPipe final : public ByteSource {
   public:
    CountingPipe(const Bytes& data, size_t* taken)
        : ByteSource("mesh"), pipe_(data, 4096, "mesh"), taken_(taken) {}
    size_t read(void* out, size_t size) override {
      const size_t got = pipe_.read(out, size);
      *taken_ += got;
      return got;
    }
    size_t readAt(uint64_t, void*, size_t) override { return 0; }
    bool seekable() const override { return false; }
    uint64_t size() const override { return 0; }

   private:
    PipeSource pipe_;
    size_t* taken_;
  };
  const Bytes data = writeBytes(createSva, randomStream(plainSchema(), 30000, 2));
  ASSERT_GT(data.size(), 1u << 20);
  size_t taken = 0;
  Input input = openSva(std::make_unique<CountingPipe>(data, &taken), ReadOptions());
  EXPECT_TRUE(input.stream);
  EXPECT_LT(taken, data.size() / 2);
  EXPECT_EQ(readStream(*input.stream).cells.size(), 30000u);
}

TEST(SvaReader, PipesGiveTheSameMeshHoweverTheyCutTheBytes) {
  expectSameThroughPipes(openSva, createSva, randomStream(richSchema(), 60, 9), {1, 2, 7, 64});
}

TEST(SvaReader, TakesWindowsLineEndsCommentsBlankLinesAndUnknownLines) {
  std::vector<std::string> notes;
  const SvMesh m = readText(
      "# a comment\r\n#\r\nhello\r\n# v_pnum_f 3\r\n\r\nv 0 0 0\r\n# in the body\r\nv 1 0 0\r\n"
      "v 0 1 0\r\nvertex\r\nv 0 0 1\r\n# nverts 77\r\nc -4 -3 -2 -1",
      &notes);
  EXPECT_EQ(m.vertexCount(), 4u);
  EXPECT_EQ(m.cells.size(), 1u);
  EXPECT_EQ(m.schema.vertex_count, -1);
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0].find("mesh: line 3: \"hello\""), 0u) << notes[0];
  EXPECT_NE(notes[1].find("not the end of a line"), std::string::npos) << notes[1];
}

TEST(SvaReader, TakesHeaderWordsInAnyOrderAndTheOlderBox) {
  const SvMesh m = readText(
      "# bb_max 1 1 2\n#bb_min 0 0 0\n# ncells 1\n# nverts 4\n# svtype tet\n"
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv +0 0.0e0 2\nc -4 -3 -2 -1\n");
  EXPECT_EQ(m.schema.box_max, (std::vector<double>{1, 1, 2}));
  EXPECT_EQ(m.schema.cell_count, 1);
  EXPECT_EQ(m.positions[11], 2);
}

TEST(SvaReader, ChoosesFloat64WhereNumbersHaveMoreThanNineDigits) {
  const auto typeOf = [](const std::string& first) {
    return readText("# v_pnum_f 3\nv " + first + " 0 0\n").schema.position_type;
  };
  EXPECT_EQ(typeOf("1.23456789"), ScalarType::kFloat32);
  EXPECT_EQ(typeOf("0.0001234567890000"), ScalarType::kFloat32);
  EXPECT_EQ(typeOf("1.17549435e-38"), ScalarType::kFloat32);
  EXPECT_EQ(typeOf("1.234567891"), ScalarType::kFloat64);
  EXPECT_EQ(typeOf("-0.1000000000000000055511"), ScalarType::kFloat64);
}

TEST(SvaReader, NumbersBeyondATypesRangeAreZeroOrAnError) {
  EXPECT_EQ(readText("# v_pnum_f 3\nv 1e-400 1e-50 0." + std::string(500, '0') + "1\n").positions,
            (std::vector<double>{0, 0, 0}));
  expectSvaError("# v_pnum_f 3\nv 0 0 0\nv 0 1e39 0\n", "line 3: vertex 1");
  expectSvaError("# v_pnum_f 3\nv 0 0 1e400\n", "line 2: vertex 0");
  expectSvaError("# v_pnum_f 3\nv 0 0 " + std::string(400, '9') + "\n", "line 2: vertex 0");
}

TEST(SvaReader, NamesThePlaceOfWhatIsWrong) {
  const std::string six = kSixVertices;  // lines 1 to 7
  expectSvaError(six + "c 1 2 3 0\nx 1\n", "line 8: the reference 0");
  expectSvaError(six + "c 1 2 3 -7\n", "line 8: the reference -7");
  expectSvaError(six + "c 1 2 3 7\n", "line 8: the reference 7");
  expectSvaError(six + "c 1 2 3 9223372036854775807\n", "line 8: the reference");
  expectSvaError(six + "c 1 2 3 -9223372036854775808\n", "line 8: the reference");
  expectSvaError(six + "c 1 2 3 99999999999999999999\n", "line 8: \"99999999999999999999\"");
  expectSvaError(six + "c 1 2 -1 6\n", "line 8: a cell needs four different vertices");
  expectSvaError(six + "c -6 2 3 4\nc 1 2 3 4\n", "line 9: vertex 0 is used after");
  expectSvaError(six + "x 1\nc 1 2 3 4\n", "line 9: vertex 0 is used after");
  expectSvaError(six + "x 1\nx 1\n", "line 9: vertex 0 is used after");
  expectSvaError(six + "x 7\n", "line 8: the reference 7");
  expectSvaError(six + "v nan 0 0\n", "line 8: vertex 6 has a position");
  expectSvaError(six + "v 0 -inf 0\n", "line 8: vertex 6 has a position");
  expectSvaError(six + "v 0 0\n", "line 8 ends where a number should be");
  expectSvaError(six + "v 0 0 a\n", "line 8: \"a\" is not a number");
  expectSvaError(six + "c 1 2 3\n", "line 8 ends where a reference");
  expectSvaError("# v_pnum_i 1\n" + six, "line 3 ends where an integer");
  expectSvaError("# nverts 7\n" + six, "6 vertices were read, the header says 7");
  expectSvaError("# ncells 1\n" + six, "0 cells were read, the header says 1");
  expectSvaError("# nverts -2\n" + six, "line 1");
  expectSvaError("# v_pnum_f 1000000000000\n" + six, "line 1");
  expectSvaError("# v_pnum_f 2\nv 0 0\n", "v_pnum_f is 2");
  expectSvaError(six + "# " + std::string(1 << 16, '-') + "\n", "line 8 is longer");
  expectSvaError("", "no vertex and no cell");
  expectSvaError("# svtype tet\n", "no vertex and no cell");
  EXPECT_EQ(errorOf(openSva, bytesOf("# svtype hex\n")).status(), Status::kUnsupported);
}

TEST(SvaReader, NamesThePlaceOfWhatIsWrongInPostOrder) {
  const std::string head = "# v_pnum_f 3\n# nverts 4\n";
  const std::string four = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  expectSvaError(head + "c 1 2 3 -4\n" + four, "line 3: a post-order cell");
  expectSvaError(head + "c 1 2 3 0\n" + four, "line 3: a post-order cell");
  expectSvaError(head + "c 1 2 3 5\n" + four, "line 3: the cell uses a vertex beyond");
  expectSvaError(head + "c 1 2 3 3\n" + four, "line 3: a cell needs four");
  expectSvaError(head + "c 1 2 3 4\n" + four + "c 1 2 3 4\n",
                 "line 8: the cell uses a vertex that was");
  expectSvaError(head + "c 1 2 3 4\nx 1\n" + four, "line 4: in post-order");
  expectSvaError("c 1 2 3 9\n" + four, "line 1: the cell uses vertex 8, which does not come");
}

TEST(SvaReader, MoreNumbersThanAnnouncedAreLeftOutWithANote) {
  std::vector<std::string> notes;
  const SvMesh m = readText("v 1 2 3 4\nv 1 2 4 5\n", &notes);
  EXPECT_EQ(m.positions, (std::vector<double>{1, 2, 3, 1, 2, 4}));
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_NE(notes[0].find("no v_pnum_f"), std::string::npos);
  EXPECT_NE(notes[1].find("line 1: "), std::string::npos) << notes[1];
}

TEST(SvaReader, SurvivesEveryCutAndEveryFlippedBit) {
  expectSurvives(openSva, bytesOf(kPreOrder));
  expectSurvives(openSva, bytesOf(kPostOrder));
  expectSurvives(openSva, bytesOf(std::string(kSixVertices) + "c 1 2 3 4\nc 3 4 5 6\n"));
  Schema schema = plainSchema();
  schema.fields[0].name = "p";
  expectSurvives(openSva, writeBytes(createSva, randomStream(schema, 4, 1)));
}

TEST(SvaReader, AHeaderCutBeforeTheBodyIsNoEmptyMesh) {
  const std::string text = kPreOrder;
  for (size_t size = 0; size < text.find("v 0"); ++size)
    EXPECT_NE(errorOf(openSva, bytesOf(text.substr(0, size))).status(), Status::kOk) << size;
}

}  // namespace
}  // namespace tetstream::test
