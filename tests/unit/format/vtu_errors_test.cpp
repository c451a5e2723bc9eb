// Broken and hostile .vtu files: each gives a status and a sentence that names the place.
#include <gtest/gtest.h>

#include <algorithm>

#include "memory.h"
#include "slow_run.h"
#include "status.h"
#include "vtu_encode.h"
#include "vtu_mesh_testing.h"

namespace tetstream {
namespace {

using namespace test;

const std::vector<VtuStyle> kErrorStyles = {{},
                                            {VtuCoding::kInline},
                                            {VtuCoding::kAppendedBase64, true},
                                            {VtuCoding::kAppendedRaw},
                                            {VtuCoding::kAppendedRaw, true, false, 64, 16}};

TEST(VtuErrors, NamesACellThatIsNoTetrahedron) {
  VtuTestPiece piece = twoCellPiece();
  piece.cells_element[2].integers = {10, 12};
  VtuTestPiece longer = piece;  // a connectivity that does not fit four per cell says the same
  longer.cells_element[0].integers = {0, 1, 2, 3, 0, 1, 2, 3, 4, 0, 1, 2};
  longer.cells_element[1].integers = {4, 12};
  for (const VtuStyle& style : kErrorStyles)
    for (const VtuTestPiece& p : {piece, longer}) {
      const std::string text = vtuFailure(makeVtu({twoCellPiece(), p}, style));
      EXPECT_TRUE(has(text, "TETSTREAM_UNSUPPORTED: test.vtu: cell 3 has VTK's type 12")) << text;
    }
}

TEST(VtuErrors, NamesACellWithAWrongOffsetOrPoint) {
  VtuTestPiece offset = twoCellPiece(), high = offset, negative = offset;
  offset.cells_element[1].integers = {4, 9};
  high.cells_element[0].integers[5] = 5;
  negative.cells_element[0].integers[4] = -1;
  for (const VtuStyle& style : kErrorStyles) {
    std::string text = vtuFailure(makeVtu({offset}, style));
    EXPECT_TRUE(has(text, "BAD_DATA: test.vtu: the offset of cell 1 is 9")) << text;
    text = vtuFailure(makeVtu({twoCellPiece(), high}, style));  // 5 is a point, of another piece
    EXPECT_TRUE(has(text, "BAD_DATA: test.vtu: cell 3 uses point 5, there are 5")) << text;
    text = vtuFailure(makeVtu({negative}, style));
    EXPECT_TRUE(has(text, "BAD_DATA: test.vtu: cell 1 uses point -1")) << text;
  }
}

TEST(VtuErrors, NamesAnIntegerThatIsTooLarge) {
  VtuTestPiece piece = twoCellPiece();
  piece.cell_data.push_back({"UInt64", "hash", 1, {}, {7, -3}});
  for (const VtuStyle& style : kErrorStyles) {
    if (style.coding == VtuCoding::kAscii) continue;  // where it would be -3
    const std::string text = vtuFailure(makeVtu({piece}, style));
    EXPECT_TRUE(has(text,
                    "TETSTREAM_UNSUPPORTED: test.vtu: array \"hash\": value 1 does not fit "
                    "into a signed 64-bit integer: it is 18446744073709551613"))
        << text;
  }
}

TEST(VtuErrors, RefusesCountsThatTheFileCannotHold) {
  for (const char* count :
       {"2000", "2305843009213693952", "72057594037927936", "99999999999999999999", "-1", "", "5x"})
    for (const VtuStyle& style : kErrorStyles)
      for (const char* name : {"NumberOfPoints=\"5  ", "NumberOfCells=\"2"}) {
        const std::string key = std::string(name).substr(0, std::string(name).find('"') + 1);
        const std::string text =
            vtuFailure(replaced(makeVtu({twoCellPiece()}, style), name, key + count));
        EXPECT_TRUE(has(text, "TETSTREAM_BAD_DATA: test.vtu")) << text;
      }
}

TEST(VtuErrors, RefusesABlockThatClaimsMoreThanItCanHold) {
  // One block of 2^40 bytes for 2^40 types, in a few bytes: refused before it is looked into.
  VtuTestPiece piece = twoCellPiece();
  std::string file = makeVtu({piece}, {VtuCoding::kAppendedRaw, true, false, 64});
  const auto patch = [&](const char* name, uint64_t size) {
    const size_t tag = file.find(std::string("Name=\"") + name);
    const size_t offset = std::stoul(file.substr(file.find("offset=\"", tag) + 8, 12));
    const size_t begin = file.find("\n _") + 3 + offset;
    const uint64_t words[3] = {1, size, 0};
    file.replace(begin, 24, reinterpret_cast<const char*>(words), 24);
  };
  const uint64_t cells = uint64_t{1} << 40;
  file = replaced(file, "NumberOfCells=\"2\"", "NumberOfCells=\"" + std::to_string(cells) + "\"");
  patch("types", cells);
  const std::string text = vtuFailure(file);
  EXPECT_TRUE(has(text, "array \"types\": a block claims to hold more than it can")) << text;
}

TEST(VtuErrors, SaysWhatIsWrongWithTheHeader) {
  const std::string good = makeVtu({twoCellPiece()}, {VtuCoding::kAppendedRaw});
  const struct {
    const char *from, *to, *says;
  } cases[] = {
      {"<VTKFile", "<VTKFile <", "BAD_DATA: test.vtu: line 1, byte"},
      {"<VTKFile", "<!DOCTYPE a><VTKFile", "UNSUPPORTED: test.vtu: byte"},
      {"=\"UnstructuredGrid\"", "=\"PolyData\"", "UNSUPPORTED: test.vtu: byte 0: the file holds"},
      {"<VTKFile", "<VTKFile byte_order='x'", "byte_order"},
      {"<VTKFile", "<VTKFile header_type='Int8'", "header_type"},
      {"<VTKFile", "<VTKFile compressor='vtkFooDataCompressor'",
       "UNSUPPORTED: test.vtu: the values"},
      {"\"raw\"", "\"hex\"", "encoding"},
      {" _", " x", "begin with '_'"},
      {"offset=\"0", "offset=\"9999999", "begins past the end"},
      {"offset=\"0", "offset=\"x", "offset"},
      {"'appended'", "'hidden'", "format"},
      {"type=\"Int64\"", "type=\"Float64\"", "are no integers"},
      {"type=\"Int64\"", "type=\"Id\"", "has the type \"Id\""},
      {"NumberOfComponents=\"3\"", "NumberOfComponents=\"2\"", "2 coordinates"},
      {"\"connectivity\"", "\"connectivitY\"", "piece 0 has no connectivity"},
      {"<Points>", "<points>", "not XML"},
      {"Piece", "piece", "not XML"},
      {"NumberOfCells", "numberOfCells", "NumberOfCells is missing"},
  };
  for (const auto& c : cases) {
    const std::string text = vtuFailure(replaced(good, c.from, c.to));
    EXPECT_TRUE(has(text, c.says)) << c.from << " -> " << c.to << ": " << text;
  }
  EXPECT_TRUE(has(vtuFailure(""), "BAD_DATA: test.vtu: line 1, byte 0"));
  EXPECT_TRUE(has(vtuFailure("<a/>"), "not a VTK XML file"));
  EXPECT_TRUE(has(vtuFailure("<VTKFile type='UnstructuredGrid'/>"), "no <Piece>"));
  EXPECT_TRUE(has(vtuFailure("<!--" + std::string(3 << 20, 'x')), "longer than 1 MiB"));
}

TEST(VtuErrors, SaysWhichWordIsNoNumber) {
  const std::string good = makeVtu({twoCellPiece()}, {});
  const struct {
    const char *from, *to, *says;
  } cases[] = {{"-1.25", "-1,25", "\"-1,25\" is no number"},
               {"1e+30", "1e39", "\"1e39\" is no number"},
               {"-7", "2147483648", "is no number"},
               {"-7", "7.0", "is no number"},
               {"-7", "", "there are 1 values where the counts need 2"},
               {"-7", "-7 8", "more values than the 2"},
               {"-7", "", "array \"region\": byte"},
               {"<DataArray", "<DataArray type='Float32' Name='p'/><DataArray", "not enough text"}};
  for (const auto& c : cases) {
    const std::string file = replaced(good, c.from, c.to);
    const std::string text = vtuFailure(file);
    EXPECT_TRUE(has(text, c.says)) << c.from << " -> " << c.to << ": " << text;
  }
  VtuTestPiece wide = twoCellPiece();
  wide.cell_data = {{"UInt64", "u", 1, {}, {0, -1}}};
  EXPECT_TRUE(has(vtuFailure(makeVtu({wide}, {VtuCoding::kInline})), "value 1 does not fit"));
  const std::string word(5000, '1');
  EXPECT_TRUE(has(vtuFailure(replaced(good, "-7", word)), "more than 512 characters"));
}

TEST(VtuErrors, FindsBlanksInsideBase64) {
  const std::string good = makeVtu({twoCellPiece()}, {VtuCoding::kInline});
  const size_t place = good.find("</DataArray>") - 9;
  const std::string text = vtuFailure(std::string(good).insert(place, "\n"));
  EXPECT_TRUE(has(text, "array \"p\": byte")) << text;
}

// What may be cut and flipped: three encodings, small so that every bit has its turn.
std::string damageable(const VtuStyle& style) {
  VtuTestPiece piece = twoCellPiece("Float32", "UInt8");
  return makeVtu({piece}, style);
}

// A damaged file is refused with a sentence or read as a mesh that is valid.
void expectSafe(const std::string& file, const std::string& where) {
  try {
    const VtuMesh mesh = readVtu(file);
    for (int64_t id : mesh.cells) ASSERT_TRUE(id >= 0 && id < mesh.schema.vertex_count) << where;
    ASSERT_EQ(mesh.cells.size(), 4 * static_cast<size_t>(mesh.schema.cell_count)) << where;
  } catch (const Error& error) {
    ASSERT_TRUE(error.status() == Status::kBadData || error.status() == Status::kUnsupported)
        << where << ": " << error.text();
    ASSERT_TRUE(error.text().starts_with("test.vtu: ")) << where << ": " << error.text();
    ASSERT_GT(error.text().size(), 20u) << where;
  }
}

void damageVtuEverywhere(const VtuStyle& style) {
  const std::string good = damageable(style);
  ASSERT_EQ(vtuFailure(good), "");
  for (size_t size = 0; size < good.size(); size += oneIn(5))
    expectSafe(good.substr(0, size), "cut to " + std::to_string(size));
  for (size_t bit = 0; bit < 8 * good.size(); bit += oneIn(9)) {
    std::string bad = good;
    bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << bit % 8));
    expectSafe(bad, "bit " + std::to_string(bit));
  }
}

// Much text between the tags is not parsed; what stands behind it is found, and named.
TEST(VtuErrors, NamesThePlaceOfWhatIsNoXmlBehindLongTexts) {
  const VtuMesh mesh = readVtu(makeVtu({twoCellPiece()}, {}));
  const size_t sizes[] = {1000, 65536, 65536 - 700, 131072, 65000, 200001};
  for (size_t i = 0; i < std::size(sizes); i += oneIn(3)) {
    const size_t size = sizes[i];
    std::string blanks;
    while (blanks.size() < size) blanks += blanks.size() % 3 ? " " : "\r\n";
    std::string text = makeVtu({twoCellPiece()}, {});
    for (size_t at = 0; (at = text.find("</DataArray>", at)) != text.npos; at += size + 20)
      text.insert(at, blanks);
    const size_t root_end = text.find("</VTKFile>");
    text.insert(root_end, "<x>" + blanks + "<![CDATA[<a>" + blanks + "<b>]]><!--" + blanks +
                              "<a>-->" + blanks + "<y/></x>");
    EXPECT_TRUE(readVtu(text) == mesh) << size;
    const std::string broken = replaced(text, "</VTKFile>", "</VTKfile>");
    const size_t byte = broken.find("</VTKfile>") + 2;
    const auto line =
        1 + std::count(broken.begin(), broken.begin() + static_cast<ptrdiff_t>(byte), '\n');
    EXPECT_TRUE(has(vtuFailure(broken), "line " + std::to_string(line) + ", byte " +
                                            std::to_string(byte) + ": not XML: mismatched tag"))
        << vtuFailure(broken) << " " << line << " " << byte;
    EXPECT_NE(vtuFailure(text.substr(0, text.size() - 40)), "");
  }
}

TEST(VtuErrors, SurvivesDamageToAscii) {
  damageVtuEverywhere({});
}
TEST(VtuErrors, SurvivesDamageToAppendedBase64WithZlib) {
  damageVtuEverywhere({VtuCoding::kAppendedBase64, true, false, 32, 8});
}
TEST(VtuErrors, SurvivesDamageToAppendedRawWithZlibAndLongWords) {
  damageVtuEverywhere({VtuCoding::kAppendedRaw, true, false, 64, 8});
}

TEST(VtuErrors, TruncationNeverPassesForAWholeMesh) {
  for (const VtuStyle& style : kErrorStyles) {
    const std::string good = makeVtu({twoCellPiece()}, style);
    const size_t tail = style.coding >= VtuCoding::kAppendedBase64
                            ? good.size() - good.rfind("\n</AppendedData>")
                            : 1;
    for (size_t size = 0; size < good.size() - tail; size += oneIn(5))
      ASSERT_NE(vtuFailure(good.substr(0, size)), "") << size;
  }
}

}  // namespace
}  // namespace tetstream
