// XDMF files with entities in their document type and DataItems that stand for others, as PETSc's
// petsc_gen_xdmf.py writes them.
#include <gtest/gtest.h>

#include <fstream>

#include "folder.h"
#include "status.h"
#include "vtu_mesh_testing.h"
#include "xdmf_testing.h"

namespace tetstream {
namespace {

using namespace test;

std::string reference(const std::string& path) {
  return "<DataItem Reference=\"XML\">\n  " + path + "\n</DataItem>";
}

std::string ofDomain(const std::string& name) {
  return reference("/Xdmf/Domain/DataItem[@Name=\"" + name + "\"]");
}

std::string gridOf(const std::string& cells, const std::string& points,
                   const std::string& more = "") {
  return xdmfGrid("domain", "<Topology TopologyType=\"Tetrahedron\">" + cells +
                                "</Topology><Geometry GeometryType=\"XYZ\">" + points +
                                "</Geometry>" + more);
}

const std::string kNamedCells =
    xdmfItem("2 4", "0 1 2 3 1 2 3 4", "Name=\"cells\" ItemType=\"Uniform\" NumberType=\"Int\"");
const std::string kNamedPoints =
    xdmfItem("5 3", "0 0 0 1 0 0 0 1 0 0 0 1 1 1 1", "Name=\"vertices\"");

// Numbers of 32 bits in a raw file.
class XdmfReferences : public testing::Test {
 protected:
  void write(const std::vector<int32_t>& numbers) const {
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(numbers.data()),
               static_cast<std::streamsize>(sizeof numbers[0] * numbers.size()));
  }

  const Folder folder_;
  const std::string path_ = folder_.file("tetstream_xdmf&.bin");
};

TEST_F(XdmfReferences, LeadToNamedItemsOfTheDomain) {
  const std::string text =
      xdmfFile(kNamedCells + kNamedPoints + gridOf(ofDomain("cells"), ofDomain("vertices")));
  for (const size_t step : {1, 1000}) {
    const VtuMesh mesh = readAs("xdmf", text, step);
    EXPECT_EQ(mesh.cells, kTwoCells);
    EXPECT_EQ(mesh.schema.vertex_count, 5);
  }
  for (const char* path :
       {"//DataItem[@Name='cells']", "/Xdmf/Domain/DataItem[@Name=&quot;cells&quot;]"})
    for (const bool in_tag : {false, true})
      EXPECT_EQ(readAs("xdmf", xdmfFile(kNamedPoints + kNamedCells +
                                        gridOf(in_tag ? "<DataItem Reference=\"" +
                                                            std::string(path) + "\"/>"
                                                      : reference(path),
                                               ofDomain("vertices"))))
                    .cells,
                kTwoCells);
}

// The same values have the same place, whoever refers to them: grids on one mesh join.
TEST_F(XdmfReferences, TellTheSameMeshApart) {
  const auto values = [](const char* name) { return xdmfValues(name, "5", "1 2 3 4 5", "Node"); };
  const VtuMesh mesh =
      readAs("xdmf", xdmfFile(kNamedCells + kNamedPoints +
                              gridOf(ofDomain("cells"), ofDomain("vertices"), values("p")) +
                              gridOf(ofDomain("cells"), ofDomain("vertices"), values("q"))));
  EXPECT_EQ(mesh.schema.fields.size(), 2u);
  EXPECT_TRUE(mesh.notes.empty());
}

// The whole of what PETSc writes: entity, references, a list of times and slabs of each step.
TEST_F(XdmfReferences, AFileLikeThoseOfPetsc) {
  write({0, 1, 2, 3, 1, 2, 3, 4, 10, 11, 12, 13, 14, 20, 21, 22, 23, 24, 30, 31, 32, 33, 34});
  const std::string name = path_.substr(path_.rfind('/') + 1);
  const std::string directory = path_.substr(0, path_.rfind('/') + 1);
  const std::string doctype =
      "<?xml version=\"1.0\" ?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" [\n<!ENTITY HeavyData "
      "\"tetstream_xdmf\">\n<!ENTITY HeavyData \"another\">\n]>\n";
  const std::string file = directory + "&HeavyData;&amp;.bin";
  const std::string cells =
      xdmfItem("2 4", file, "Name=\"cells\" Format=\"Binary\" NumberType=\"Int\"");
  std::string steps = "<Time TimeType=\"List\">" + xdmfItem("3", "0.0 0.5 1.25") + "</Time>";
  for (const char* step : {"0", "1", "2"})
    steps += gridOf(ofDomain("cells"), ofDomain("vertices"),
                    "<Attribute Name=\"p\" Type=\"Scalar\" Center=\"Node\">"
                    "<DataItem ItemType=\"HyperSlab\" Dimensions=\"1 5 1\" Type=\"HyperSlab\">" +
                        xdmfItem("3 3", std::string(step) + " 0 0\n1 1 1\n1 5 1") +
                        xdmfItem("3 5 1", file, "Format=\"Binary\" DataType=\"Int\" Seek=\"32\"") +
                        "</DataItem></Attribute>");
  const std::string text = xdmfFile(cells + kNamedPoints + xdmfSteps("TimeSeries", steps), doctype);
  const VtuMesh mesh = readAs("xdmf", text);
  EXPECT_EQ(mesh.cells, kTwoCells);
  EXPECT_EQ(valuesAs<int32_t>(mesh.fields[0]), (std::vector<int32_t>{30, 31, 32, 33, 34}));
  EXPECT_TRUE(hasNote(mesh, "of 3 time steps, 0 to 2, step 2 is read, at time 1.25"));
  ReadOptions options;
  options.step = 0;
  EXPECT_EQ(valuesAs<int32_t>(readAs("xdmf", text, 1, options).fields[0]),
            (std::vector<int32_t>{10, 11, 12, 13, 14}));
  // A list of other times is none of these steps.
  EXPECT_TRUE(hasNote(readAs("xdmf", replaced(replaced(text, "\"3\"", "\"2\""), " 1.25", "")),
                      "of 3 time steps, 0 to 2, step 2 is read"));
  EXPECT_TRUE(has(failureAs("xdmf", replaced(text, "0.0 0.5 1.25", "0.0 0.5 late")), "\"late\""));
  EXPECT_TRUE(has(failureAs("xdmf", replaced(text, "&HeavyData;", "&LightData;")),
                  "\"&LightData;\" stands for nothing"));
  EXPECT_TRUE(failureAs("xdmf", replaced(text, "\"tetstream_xdmf", "\"not_there_xdmf"))
                  .starts_with("TETSTREAM_IO"));
}

TEST_F(XdmfReferences, AreFollowedThroughSlabsAndOtherReferences) {
  const std::string named =
      kNamedPoints +
      xdmfItem("3 4", "9 9 9 9 0 1 2 3 1 2 3 4", "Name=\"list\" NumberType=\"Int\"") +
      "<DataItem Name=\"cut\" ItemType=\"HyperSlab\" Dimensions=\"2 4\">" +
      xdmfItem("3 2", "1 0 1 1 2 4") + ofDomain("list") + "</DataItem>" +
      "<DataItem Name=\"again\" Reference=\"XML\">//DataItem[@Name='cut']</DataItem>";
  EXPECT_EQ(readAs("xdmf", xdmfFile(named + gridOf(ofDomain("again"), ofDomain("vertices")))).cells,
            kTwoCells);
}

TEST_F(XdmfReferences, SaysWhichLeadNowhere) {
  const auto failure = [](const std::string& named, const std::string& cells) {
    return failureAs("xdmf", xdmfFile(named + kNamedPoints + gridOf(cells, ofDomain("vertices"))));
  };
  EXPECT_EQ(failure(kNamedCells, ofDomain("cells")), "");
  EXPECT_TRUE(
      has(failure(kNamedCells, ofDomain("none")), "there is no DataItem \"none\" in the Domain"));
  for (const char* path :
       {"", "cells", "/Xdmf/Domain/DataItem[1]", "/Xdmf/Domain/DataItem[@Name=\"cells\"",
        "/Xdmf/Domain/DataItem[@Name=\"]", "/Xdmf/Domain/DataItem[@Name=\"\"]",
        "/Xdmf/Domain/DataItem[@Name=cells]", "/Xdmf/Domain/Grid/Geometry/DataItem[@Name=\"c\"]"})
    EXPECT_TRUE(has(failure(kNamedCells, reference(path)), "is not followed: only those")) << path;
  // The first of a name counts; one of a type that is not read can be there, but not be meant.
  const std::string other = "<DataItem Name=\"cells\" ItemType=\"Function\" Function=\"$0\"/>";
  EXPECT_EQ(failure(kNamedCells + kNamedCells, ofDomain("cells")), "");
  EXPECT_EQ(failure(other + kNamedCells, ofDomain("cells")), "");
  EXPECT_TRUE(has(failure(other, ofDomain("cells")), "there is no DataItem \"cells\""));
  EXPECT_TRUE(has(failure(kNamedCells, "<DataItem Reference=\"" + std::string(2000, 'a') + "\"/>"),
                  "a Reference is too long"));
  EXPECT_TRUE(has(failure(kNamedCells, reference(std::string(5000, 'a'))), "BAD_DATA"));
  EXPECT_TRUE(
      has(failure(replaced(kNamedCells, "2 4", "200000 4"), ofDomain("cells")), "BAD_DATA"));
  std::string ones = "2 4";
  for (int i = 0; i < 40; ++i) ones += " 1";
  EXPECT_TRUE(has(failure(replaced(kNamedCells, "2 4", ones), ofDomain("cells")),
                  "there is no DataItem \"cells\""));
}

TEST_F(XdmfReferences, DoNotRunInCircles) {
  const auto failure = [](const std::string& named) {
    return failureAs("xdmf",
                     xdmfFile(named + kNamedPoints + gridOf(ofDomain("a"), ofDomain("vertices"))));
  };
  const auto named = [](const std::string& name, const std::string& to) {
    return "<DataItem Name=\"" + name + "\" Reference=\"//DataItem[@Name='" + to + "']\"/>";
  };
  const auto slab = [](const std::string& name, const std::string& parts) {
    return "<DataItem Name=\"" + name + "\" ItemType=\"HyperSlab\" Dimensions=\"2 4\">" + parts +
           "</DataItem>";
  };
  EXPECT_TRUE(has(failure(named("a", "a")), "to references without an end"));
  EXPECT_TRUE(has(failure(named("a", "b") + named("b", "a")), "to references without an end"));
  EXPECT_TRUE(has(failure(slab("a", ofDomain("b")) + slab("b", ofDomain("a"))),
                  "to references without an end"));
  // Each has a hundred of the next one.
  std::string bomb;
  for (char name = 'a'; name < 'k'; ++name) {
    std::string parts;
    for (int i = 0; i < 100; ++i) parts += ofDomain(std::string(1, static_cast<char>(name + 1)));
    bomb += slab(std::string(1, name), parts);
  }
  EXPECT_TRUE(has(failure(bomb + slab("k", "")), "the references lead to too many arrays"));
}

TEST_F(XdmfReferences, EntitiesArePlain) {
  const auto failure = [](const std::string& declared, const std::string& name = "m") {
    return failureAs("xdmf", xdmfFile(xdmfGrid(name, kXdmfTwoCells + kXdmfFivePoints),
                                      "<!DOCTYPE Xdmf [" + declared + "]>"));
  };
  const auto declared = [](const std::string& name, const std::string& text) {
    return "<!ENTITY " + name + " \"" + text + "\">";
  };
  const std::string a = declared("a", "b");
  EXPECT_EQ(failure(a, "&a; &a;"), "");
  EXPECT_TRUE(failure(a, "&c;").starts_with("TETSTREAM_BAD_DATA"));
  EXPECT_TRUE(has(failure(declared("% a", "b")), "but for those of plain text"));
  EXPECT_TRUE(has(failure("<!ENTITY a SYSTEM \"file:///etc/passwd\">"), "but for those of plain"));
  for (const char* text : {"&b;", "&#38;b;", "&amp;", "&#60;Grid/>"})
    EXPECT_TRUE(has(failure(declared("a", text)), "more than plain text")) << text;
  EXPECT_EQ(failure(declared("a", std::string(512, 'b'))), "");
  EXPECT_TRUE(has(failure(declared("a", std::string(513, 'b'))), "more than plain text"));
  EXPECT_TRUE(has(failure(declared(std::string(513, 'a'), "b")), "more than plain text"));
  EXPECT_TRUE(has(failure(a + "<!ATTLIST Grid Name CDATA \"&a;\">"), "beside entities are not"));
  EXPECT_EQ(failure("<!ATTLIST Grid Name CDATA \"a\">"), "");
  std::string many;
  for (int i = 0; i < 64; ++i) many += declared("a" + std::to_string(i), "b");
  EXPECT_EQ(failure(many), "");
  EXPECT_TRUE(has(failure(many + a), "more than plain text"));
}

// The names of the tags that are as long as may be, of entities that are.
TEST_F(XdmfReferences, EntitiesGrowNoFurtherThanTheyMay) {
  const std::string declared = "<!DOCTYPE Xdmf [<!ENTITY a \"" + std::string(512, 'b') + "\">]>";
  const auto failure = [&](size_t times) {
    std::string name;
    for (size_t i = 0; i < times; ++i) name += "&a;";
    return failureAs("xdmf", xdmfFile(xdmfGrid(name, kXdmfTwoCells + kXdmfFivePoints), declared));
  };
  EXPECT_EQ(failure(1000), "");
  EXPECT_TRUE(has(failure(100000), "a tag or comment is longer than 64 KiB"));
  // Where expat protects itself, it stops what comes near.
  const std::string close = failure(40000);
  EXPECT_TRUE(close.empty() || close.starts_with("TETSTREAM_BAD_DATA")) << close;
  // A billion of them, of which the first declaration that has another in it is refused.
  std::string laughs = "<!DOCTYPE Xdmf [<!ENTITY l0 \"lol\">";
  for (int i = 1; i < 10; ++i) {
    laughs += "<!ENTITY l" + std::to_string(i) + " \"";
    for (int k = 0; k < 10; ++k) laughs += "&l" + std::to_string(i - 1) + ";";
    laughs += "\">";
  }
  for (const std::string name : {"&l9;", "m"}) {
    const std::string grid = xdmfGrid(name, kXdmfTwoCells + kXdmfFivePoints + "&l9;");
    const std::string refusal = failureAs("xdmf", xdmfFile(grid, laughs + "]>"));
    EXPECT_TRUE(refusal.starts_with("TETSTREAM_UNSUPPORTED")) << refusal;
    EXPECT_TRUE(has(refusal, "more than plain text")) << refusal;
  }
}

// Of text that stands for itself wherever it is cut: entities begin and end between two readings.
TEST_F(XdmfReferences, EntitiesInTextAreFoundWhereverTheyStand) {
  write({0, 1, 2, 3, 1, 2, 3, 4});
  const std::string doctype =
      "<!DOCTYPE Xdmf [<!ENTITY File \"" + replaced(path_, "&", "\"><!ENTITY Tail \"") + "\">]>";
  const std::string cells =
      xdmfItem("2 4", "&File;&amp;&Tail;", "Format=\"Binary\" NumberType=\"Int\"");
  for (const int blanks : {65000, 65300, 65330, 65340, 65350, 65360, 65370, 65380, 65390, 65400})
    EXPECT_EQ(readAs("xdmf", xdmfFile(std::string(static_cast<size_t>(blanks), ' ') + kNamedPoints +
                                          gridOf(cells, ofDomain("vertices")),
                                      doctype))
                  .cells,
              kTwoCells)
        << blanks;
}

TEST_F(XdmfReferences, ItemsThatNobodyRefersToMayBeAnything) {
  const std::string odd = "<DataItem Name=\"odd\" Dimensions=\"two\">1 2</DataItem>";
  const std::string grid = gridOf(ofDomain("cells"), ofDomain("vertices"));
  EXPECT_EQ(failureAs("xdmf", xdmfFile(odd + kNamedCells + kNamedPoints + grid)), "");
  EXPECT_TRUE(has(
      failureAs("xdmf", xdmfFile(odd + kNamedCells + gridOf(ofDomain("cells"), ofDomain("odd")))),
      "there is no DataItem \"odd\" in the Domain"));
}

TEST_F(XdmfReferences, SurvivesEveryCutAndEveryFlippedBit) {
  const std::string good =
      xdmfFile(kNamedCells + kNamedPoints + gridOf(ofDomain("cells"), ofDomain("vertices")),
               "<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" [<!ENTITY HeavyData \"a.h5\">]>");
  expectXdmfSurvives(good);
}

}  // namespace
}  // namespace tetstream
