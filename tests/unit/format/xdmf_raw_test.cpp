// XDMF files whose values stand in raw files, and hyperslabs of values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

#include "folder.h"
#include "status.h"
#include "vtu_mesh_testing.h"

namespace tetstream {
namespace {

using namespace test;

template <class T>
std::string bytesOfNumbers(const std::vector<T>& values, bool turned = false) {
  std::string bytes;
  for (const T& value : values) {
    std::string one(reinterpret_cast<const char*>(&value), sizeof value);
    if (turned) std::reverse(one.begin(), one.end());
    bytes += one;
  }
  return bytes;
}

std::string item(const std::string& sizes, const std::string& words, const std::string& text) {
  return "<DataItem Dimensions=\"" + sizes + "\" " + words + ">" + text + "</DataItem>";
}

const std::string kTextPoints = item("5 3", "Precision=\"8\"", "0 0 0 1 0 0 0 1 0 0 0 1 1 1 1");
const std::string kTextCells = item("2 4", "NumberType=\"Int\"", "0 1 2 3 1 2 3 4");

std::string file(const std::string& cells, const std::string& points,
                 const std::string& more = "") {
  return "<Xdmf><Domain><Grid><Topology TopologyType=\"Tetrahedron\">" + cells +
         "</Topology><Geometry GeometryType=\"XYZ\">" + points + "</Geometry>" + more +
         "</Grid></Domain></Xdmf>";
}

std::string attribute(const std::string& values) {
  return "<Attribute Name=\"p\" Center=\"Node\">" + values + "</Attribute>";
}

// Of `from`, with numbers in the order of the file: begins, strides, counts.
std::string slab(const std::string& sizes, const std::string& numbers, const std::string& rank,
                 const std::string& from) {
  return item(sizes, "ItemType=\"HyperSlab\"", item("3 " + rank, "Format=\"XML\"", numbers) + from);
}

class XdmfRaw : public testing::Test {
 protected:
  void write(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }
  std::string raw(const std::string& sizes, const std::string& words) const {
    return item(sizes, "Format=\"Binary\" " + words, "\n " + path_ + "\n");
  }

  const Folder folder_;
  const std::string path_ = folder_.file("raw.bin");
};

TEST_F(XdmfRaw, NumbersOfAnyTypeAndByteOrderAreReadWhereTheyLie) {
  const std::vector<double> points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
  const std::vector<int64_t> wide(kTwoCells);
  const std::vector<uint8_t> narrow(kTwoCells.begin(), kTwoCells.end());
  const std::vector<int16_t> few(kTwoCells.begin(), kTwoCells.end());
  write(bytesOfNumbers(points) + bytesOfNumbers(points, true) + bytesOfNumbers(wide, true) +
        bytesOfNumbers(narrow) + bytesOfNumbers(few));
  const std::string cells[] = {
      raw("2 4", "NumberType=\"Int\" Precision=\"8\" Endian=\"Big\" Seek=\"240\""),
      raw("8", "NumberType=\"UChar\" Seek=\"304\""),
      raw("8", "DataType=\"Int\" Precision=\"2\" Endian=\"Little\" Seek=\"312\""),
      raw("2 4", "NumberType=\"Short\" Seek=\"312\"")};
  for (const std::string& item : cells)
    for (const size_t step : {1, 1000})
      EXPECT_EQ(readAs("xdmf", file(item, kTextPoints), step).cells, kTwoCells);
  for (const char* words : {"Precision=\"8\"", "Precision=\"8\" Endian=\"Big\" Seek=\"120\""}) {
    const VtuMesh mesh = readAs("xdmf", file(kTextCells, raw("5 3", words)));
    EXPECT_EQ(mesh.schema.position_type, ScalarType::kFloat64);
    EXPECT_EQ(valuesAs<double>(mesh.positions), points);
  }
}

TEST_F(XdmfRaw, SaysWhatIsWrongWithAFile) {
  write(bytesOfNumbers(std::vector<float>(15)));
  const auto failure = [&](const std::string& sizes, const std::string& words) {
    return failureAs("xdmf", file(kTextCells, raw(sizes, words)));
  };
  EXPECT_TRUE(has(failure("6 3", ""), "has 60 bytes, fewer than"));
  EXPECT_TRUE(has(failure("5 3", "Seek=\"1\""), "has 60 bytes, fewer than"));
  EXPECT_TRUE(has(failure("5 3", "Seek=\"18446744073709551615\""), "has 60 bytes, fewer than"));
  EXPECT_TRUE(has(failure("5 3", "Seek=\"-1\""), "a Seek is no number"));
  EXPECT_TRUE(has(failure("72057594037927936 3", ""), "has 60 bytes, fewer than"));
  EXPECT_TRUE(has(failure("5 3", "Endian=\"Middle\""), "the byte order \"Middle\""));
  EXPECT_TRUE(has(failure("5 3", "Compression=\"Zlib\""), "the compression \"Zlib\""));
  EXPECT_TRUE(has(failure("5 3", "Precision=\"16\""), "the type \"Float\" of 16 bytes"));
  EXPECT_TRUE(has(failureAs("xdmf", file(kTextCells, item("5 3", "Format=\"Binary\"", " "))),
                  "the name of a file is missing"));
  std::remove(path_.c_str());
  EXPECT_TRUE(failure("5 3", "").starts_with("TETSTREAM_IO"));
}

TEST_F(XdmfRaw, SlabsAreCutOutOfTextAndOfRawFiles) {
  // Of ten rows of seven numbers, the last three of rows 1, 3, ... are positions.
  std::vector<float> rows(10 * 7, -1);
  const double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
  for (size_t i = 0; i < 15; ++i)
    rows[(2 * (i / 3) + 1) * 7 + 4 + i % 3] = static_cast<float>(points[i]);
  write(bytesOfNumbers(rows));
  const std::string cut = slab("5 3", "1 4 2 1\n5 3", "2", raw("10 7", ""));
  // The last numbers of the rows of the first of two tables.
  const std::string last =
      slab("5", "0 0 2 1 1 5 1 5 1", "3",
           item("2 5 3", "",
                "0 0 1 0 0 2 0 0 3 0 0 4 0 0 5 " + std::string("9 9 9 9 9 9 9 9 9 9 9 9 9 9 9")));
  for (const size_t step : {1, 1000}) {
    const VtuMesh mesh = readAs("xdmf", file(kTextCells, cut, attribute(last)), step);
    EXPECT_EQ(mesh.cells, kTwoCells);
    EXPECT_EQ(valuesAs<float>(mesh.positions), std::vector<float>(points, points + 15));
    EXPECT_EQ(valuesAs<float>(mesh.fields[0]), (std::vector<float>{1, 2, 3, 4, 5}));
  }
  // Of a slab: its last two rows are the cells, whole rows that lie together.
  const std::string inner =
      slab("3 4", "1 0 1 1 3 4", "2",
           item("4 4", "NumberType=\"Int\"", "9 9 9 9 9 9 9 9 0 1 2 3 1 2 3 4"));
  EXPECT_EQ(readAs("xdmf", file(slab("2 4", "1 0 1 1 2 4", "2", inner), kTextPoints)).cells,
            kTwoCells);
}

// Long rows are read at once, others out of what is held; both wherever a reading begins.
TEST_F(XdmfRaw, LongSlabsGiveTheSameWhereverTheyAreRead) {
  std::vector<float> rows(3000 * 6);
  for (size_t i = 0; i < rows.size(); ++i) rows[i] = static_cast<float>(i);
  write(bytesOfNumbers(rows));
  std::string points;
  for (int i = 0; i < 3000; ++i) points += "0 " + std::to_string(i % 7) + " 1 ";
  const struct {
    std::string numbers, rank, sizes;
    size_t begin, stride;
  } cases[] = {{"0 2 1 1 3000 1", "2", "3000 6", 2, 6},
               {"1 0 1 1 500 6", "2", "3000 6", 6, 1},
               {"700 3 3000", "1", "18000", 700, 3}};
  for (const auto& c : cases) {
    const VtuMesh mesh = readAs("xdmf",
                                file(kTextCells, item("3000 3", "", points),
                                     attribute(slab("3000", c.numbers, c.rank, raw(c.sizes, "")))),
                                400);
    std::vector<float> wanted;
    for (size_t i = 0; i < 3000; ++i) wanted.push_back(rows[c.begin + i * c.stride]);
    EXPECT_EQ(valuesAs<float>(mesh.fields[0]), wanted) << c.numbers;
  }
}

TEST_F(XdmfRaw, SaysWhatIsWrongWithASlab) {
  const auto failure = [&](const std::string& points) {
    return failureAs("xdmf", file(kTextCells, points));
  };
  const auto cut = [&](const std::string& numbers) {
    return failure(slab("5 3", numbers, "2", item("5 3", "", "0 0 0 1 0 0 0 1 0 0 0 1 1 1 1")));
  };
  EXPECT_EQ(cut("0 0 1 1 5 3"), "");
  EXPECT_TRUE(has(cut("1 0 1 1 5 3"), "reaches out of its values in direction 0"));
  EXPECT_TRUE(has(cut("0 0 1 2 5 3"), "reaches out of its values in direction 1"));
  EXPECT_TRUE(has(cut("0 0 0 1 5 3"), "reaches out"));
  EXPECT_TRUE(has(cut("0 0 1 1 5 0"), "reaches out"));
  EXPECT_TRUE(has(cut("0 0 1 9223372036854775807 5 3"), "reaches out"));
  EXPECT_TRUE(has(cut("0 0 1 1 4 3"), "of 12 values has not the 15 of its Dimensions"));
  EXPECT_TRUE(has(cut("0 0 1 1 5"), "of 2 directions has 5 numbers"));
  EXPECT_TRUE(has(cut("0 0 1 one 5 3"), "\"one\" in a HyperSlab is no number"));
  EXPECT_TRUE(has(cut("0 0 1 -1 5 3"), "\"-1\" in a HyperSlab is no number"));
  EXPECT_TRUE(has(failure(item("5 3", "ItemType=\"HyperSlab\"", "")), "a HyperSlab is not read"));
  EXPECT_TRUE(has(failure(item("5 3", "ItemType=\"Function\"", "")), "of the type \"Function\""));
}

}  // namespace
}  // namespace tetstream
