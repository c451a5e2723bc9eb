// Functions of finite element spaces as FEniCS's checkpoints have them: dolfin 2019.2 wrote what
// these files are like.
#include "xdmf_testing.h"

namespace tetstream {
namespace {

using namespace test;

// The numbers, the values and where the rows of two cells begin; then, of no use here, the cells.
std::string items(const std::string& numbers, const std::string& values, int each) {
  const auto count = [](const std::string& text) {
    return std::to_string(std::count(text.begin(), text.end(), ' ') + 1) + " 1";
  };
  const std::string begins = "0 " + std::to_string(each) + " " + std::to_string(2 * each);
  const std::string whole = "NumberType=\"UInt\" Format=\"XML\"";
  return xdmfItem(count(numbers), numbers, whole) +
         xdmfItem(count(values), values, "NumberType=\"Float\" Precision=\"8\" Format=\"XML\"") +
         xdmfItem("3 1", begins, whole) + xdmfItem("2 1", "1 0", whole);
}

std::string function(const std::string& name, const std::string& space, const std::string& type,
                     const std::string& held, const std::string& cell = "tetrahedron") {
  const size_t blank = space.find(' ');
  return "<Attribute ItemType=\"FiniteElementFunction\" ElementFamily=\"" + space.substr(0, blank) +
         "\" ElementDegree=\"" + space.substr(blank + 1) + "\" ElementCell=\"" + cell +
         "\" Name=\"" + name + "\" Center=\"Other\" AttributeType=\"" + type + "\">" + held +
         "</Attribute>";
}

std::string ofTwoCells(const std::string& functions) {
  return xdmfFile(xdmfGrid("mesh", kXdmfTwoCells + kXdmfFivePoints + functions));
}

// Points 0 to 4 have 10, 11, 12, 13 and 14, in another order.
const std::string kNumbers = "3 0 4 1 0 4 1 2", kValues = "11 13 14 10 12";
const std::string kLinear = function("u", "CG 1", "Scalar", items(kNumbers, kValues, 4));

TEST(XdmfFunctions, OfPointsHaveTheirValuesThere) {
  for (const size_t step : {1, 1000}) {
    const VtuMesh mesh = readAs("xdmf", ofTwoCells(kLinear), step);
    ASSERT_EQ(mesh.fields.size(), 1u);
    EXPECT_EQ(mesh.schema.fields[0].name, "u");
    EXPECT_EQ(valuesAs<double>(mesh.fields[0]), (std::vector<double>{10, 11, 12, 13, 14}));
    EXPECT_TRUE(mesh.notes.empty());
  }
}

TEST(XdmfFunctions, OfPointsOfNoCellAreZero) {
  const VtuMesh mesh = readAs(
      "xdmf",
      xdmfFile(xdmfGrid(
          "mesh",
          kXdmfTwoCells + xdmfGeometry("6 3", "0 0 0 1 0 0 0 1 0 0 0 1 1 1 1 2 2 2") + kLinear)));
  EXPECT_EQ(valuesAs<double>(mesh.fields.at(0)), (std::vector<double>{10, 11, 12, 13, 14, 0}));
}

TEST(XdmfFunctions, OfCellsHaveTheirValuesThere) {
  const VtuMesh mesh = readAs(
      "xdmf", ofTwoCells(function("v", "DG 0", "Vector", items("5 4 3 2 1 0", "1 2 3 4 5 6", 3))));
  ASSERT_EQ(mesh.cell_data.size(), 1u);
  EXPECT_EQ(valuesAs<double>(mesh.cell_data[0]), (std::vector<double>{6, 5, 4, 3, 2, 1}));
}

// Component after component, each with its corners before its edges.
TEST(XdmfFunctions, OfHigherDegreeAreReadAtCorners) {
  std::string numbers, values = "0";
  for (int value = 1; value < 30; ++value) values += " " + std::to_string(value);
  for (const char* corners : {"0 1 2 3", "1 2 3 4"})
    for (const char* shift : {"", "1", "2"})  // before a digit: ten and twenty more
      for (int i = 0; i < 10; ++i)
        numbers += (numbers.empty() ? "" : " ") + std::string(shift) +
                   (i < 4 ? std::string(1, corners[2 * i]) : "9");
  const VtuMesh mesh =
      readAs("xdmf", ofTwoCells(function("w", "CG 2", "Vector", items(numbers, values, 30))));
  ASSERT_EQ(mesh.fields.size(), 1u);
  EXPECT_EQ(valuesAs<double>(mesh.fields[0]),
            (std::vector<double>{0, 10, 20, 1, 11, 21, 2, 12, 22, 3, 13, 23, 4, 14, 24}));
  EXPECT_TRUE(hasNote(mesh, "array \"w\" is of degree 2: its values at the corners of cells"));
}

// FEniCS's order is xx, xy, xz, yy, yz and zz.
TEST(XdmfFunctions, SymmetricMatricesAreInOurOrder) {
  const std::string held = items("0 1 2 3 4 5 0 1 2 3 4 5", "1 2 3 4 5 6", 6);
  const auto first = [&](const std::string& type) {
    const VtuMesh mesh = readAs("xdmf", ofTwoCells(function("s", "DG 0", type, held)));
    std::vector<double> values = valuesAs<double>(mesh.cell_data.at(0));
    values.resize(6);
    return values;
  };
  EXPECT_EQ(first("Tensor"), (std::vector<double>{1, 4, 6, 2, 5, 3}));
  EXPECT_EQ(first("Vector"), (std::vector<double>{1, 2, 3, 4, 5, 6}));
}

// Each function of a checkpoint has a mesh of its own.
TEST(XdmfFunctions, JoinThoseWhoseMeshIsEqual) {
  const auto file = [](const std::string& cells, const std::string& points) {
    return xdmfFile(xdmfSteps("u", xdmfGrid("u_0", kXdmfTwoCells + kXdmfFivePoints + kLinear)) +
                    xdmfSteps("v", xdmfGrid("v_0", cells + points +
                                                       function("v", "DG 0", "Scalar",
                                                                items("1 0", "7 8", 1)))));
  };
  const VtuMesh mesh = readAs("xdmf", file(kXdmfTwoCells, kXdmfFivePoints));
  ASSERT_EQ(mesh.cell_data.size(), 1u);
  EXPECT_EQ(valuesAs<double>(mesh.cell_data[0]), (std::vector<double>{8, 7}));
  const std::string other_cells = xdmfTopology("Tetrahedron", "2 4", "0 1 2 3 1 2 4 3"),
                    fewer = xdmfTopology("Tetrahedron", "1 4", "0 1 2 3"),
                    other_points = xdmfGeometry("5 3", "0 0 0 1 0 0 0 1 0 0 0 1 1 1 2");
  for (const std::string& other : {file(other_cells, kXdmfFivePoints), file(fewer, kXdmfFivePoints),
                                   file(kXdmfTwoCells, other_points)}) {
    const VtuMesh apart = readAs("xdmf", other);
    EXPECT_TRUE(apart.cell_data.empty());
    EXPECT_EQ(apart.fields.size(), 1u);
    EXPECT_TRUE(hasNote(apart, "grid \"v_0\" is left out: it has another mesh"));
  }
}

TEST(XdmfFunctions, OfOtherSpacesAreLeftOut) {
  const std::string held = items(kNumbers, kValues, 4);
  for (const std::string& other :
       {function("f", "DG 1", "Scalar", held), function("f", "CR 1", "Scalar", held),
        function("f", "CG 0", "Scalar", held), function("f", "CG x", "Scalar", held),
        function("f", "CG 99", "Scalar", held), function("f", "CG 1", "Scalar", held, "triangle"),
        function("f", "CG 1", "Scalar", xdmfItem("8 1", kNumbers))}) {
    const VtuMesh mesh = readAs("xdmf", ofTwoCells(kLinear + other));
    EXPECT_EQ(mesh.fields.size(), 1u);
    EXPECT_TRUE(hasNote(mesh, "array \"f\" is left out: it is a function of the family")) << other;
  }
  const VtuMesh twice = readAs("xdmf", ofTwoCells(kLinear + kLinear));
  EXPECT_EQ(twice.fields.size(), 1u);
  EXPECT_TRUE(hasNote(twice, "another one of its name"));
}

TEST(XdmfFunctions, SayWhatIsWrong) {
  const std::string good = ofTwoCells(kLinear);
  EXPECT_TRUE(has(failureAs("xdmf", replaced(good, ">3 0 4 1 ", ">3 0 5 1 ")),
                  "cell 0 has number 5, there are 5 values"));
  EXPECT_TRUE(has(failureAs("xdmf", replaced(good, ">3 0 4 1 0 4", ">3 0 4 1 4 0")),
                  "cell 1 has number 4 at point 1, another cell 0"));
  EXPECT_TRUE(has(failureAs("xdmf", replaced(good, ">0 4 8<", ">0 5 8<")),
                  "those of cell 1 begin at 5, not at 4"));
  EXPECT_TRUE(has(failureAs("xdmf", replaced(good, ">0 4 8<", ">0 4 8 8<")), "BAD_DATA"));
  EXPECT_TRUE(has(failureAs("xdmf", ofTwoCells(function("u", "CG 1", "Scalar",
                                                        items(kNumbers + " 1", kValues, 4)))),
                  "has 9 values for 8 rows"));
  EXPECT_TRUE(has(failureAs("xdmf", replaced(good, "NumberType=\"UInt\"", "NumberType=\"Float\"")),
                  "are no integers"));
  EXPECT_TRUE(
      has(failureAs("xdmf", replaced(good, "\"5 3\"", "\"1000000000000000 3\"")), "BAD_DATA"));
  expectXdmfSurvives(good);
}

}  // namespace
}  // namespace tetstream
