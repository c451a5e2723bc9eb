// Values as numbers have that stand for missing ones: the report tells of fields whose other values
// lie close together.
#include "lone_values.h"

#include "simplify_testing.h"
#include "window_testing.h"

namespace tetstream::test {
namespace {

constexpr int kLoneSide = 4;

// Salt up to a depth where it is missing, which `missing` says.
TestMesh saltyMesh(double missing, ScalarType type) {
  TestMesh mesh = fullGrid(kLoneSide, kLoneSide, 2 * kLoneSide, 0.1);
  addPositionField(mesh, {"depth", 1, type}, [](double, double, double z) { return z; });
  addPositionField(mesh, {"salt", 1, type}, [missing](double x, double y, double z) {
    return z < kLoneSide ? missing : 30 + x + 0.1 * y;
  });
  return mesh;
}

std::string balanceOf(const TestMesh& mesh, bool say_box) {
  Cut cut;
  cut.say_box = say_box;
  return simplified(mesh, toRatio(0.3), cut).report.balance;
}

TEST(LoneValues, AreTold) {
  for (ScalarType type : {k32, k64})
    for (bool say_box : {false, true}) {
      EXPECT_NE(balanceOf(saltyMesh(-9999, type), say_box)
                    .find("salt: all values but -9999 lie within 0.04"),
                std::string::npos);
      EXPECT_NE(
          balanceOf(saltyMesh(1e20, type), say_box).find("salt: all values but 1e+20 lie within"),
          std::string::npos);
      const std::string usual = balanceOf(saltyMesh(0, type), say_box);
      EXPECT_EQ(usual.find("all values but"), std::string::npos) << usual;
    }
}

TEST(LoneValues, OfAVectorAreTold) {
  TestMesh mesh = fullGrid(kLoneSide, kLoneSide, kLoneSide, 0.1);
  mesh.addField({"flow", 3, k64}, [&](size_t v, int i) {
    return mesh.position(v, 2) < 1 ? 1e6 : mesh.position(v, i);
  });
  const std::string told = balanceOf(mesh, true);
  EXPECT_NE(told.find("flow: all values but 1e+06 lie within"), std::string::npos) << told;
}

// Beside a component that has one value everywhere, as in a flow in two dimensions.
TEST(LoneValues, OfAFlatVectorAreTold) {
  TestMesh mesh = fullGrid(kLoneSide, kLoneSide, kLoneSide, 0.1);
  mesh.addField({"flow", 3, k64}, [&](size_t v, int i) {
    return i == 2 ? 0 : mesh.position(v, 2) < 1 ? 1e20 : mesh.position(v, i);
  });
  const std::string told = balanceOf(mesh, true);
  EXPECT_NE(told.find("flow: all values but 1e+20 lie within"), std::string::npos) << told;
}

// A part of a mesh, which has little of the range of the whole: its highest value lies there, too.
TEST(LoneValues, AreNotTheEndsOfAPart) {
  TestMesh part = fullGrid(kLoneSide, kLoneSide, kLoneSide, 0.1);
  addPositionField(part, {"salt", 1, k64}, [](double x, double y, double z) { return x + y + z; });
  part.schema.box_min.assign(4, 0);
  part.schema.box_max.assign(4, 1000);
  const std::string told = balanceOf(part, false);
  EXPECT_EQ(told.find("all values but"), std::string::npos) << told;
}

// What is 0 or 1, or steep, is no number for what is missing.
TEST(LoneValues, AreNeitherLabelsNorSteps) {
  TestMesh mesh = fullGrid(kLoneSide, kLoneSide, 2 * kLoneSide, 0.1);
  addPositionField(mesh, {"inside", 1, k64},
                   [](double, double, double z) { return z > 3 ? 1 : 0; });
  addPositionField(mesh, {"front", 1, k64},
                   [](double x, double y, double z) { return std::tanh(z - 4 + 0.1 * x * y); });
  addPositionField(mesh, {"constant", 1, k64}, [](double, double, double) { return 7; });
  for (bool say_box : {false, true}) {
    const std::string told = balanceOf(mesh, say_box);
    EXPECT_EQ(told.find("all values but"), std::string::npos) << told;
  }
}

TEST(LoneValues, OfVerticesInNoCellDoNotCount) {
  for (bool is_used : {false, true}) {
    TestMesh mesh = makeMesh(
        k64, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1},
        is_used ? std::vector<int64_t>{0, 1, 2, 3, 4, 1, 2, 3} : std::vector<int64_t>{0, 1, 2, 3});
    mesh.addField({"salt", 1, k64},
                  [](size_t v, int) { return v == 4 ? -9999 : 30 + static_cast<double>(v); });
    EXPECT_EQ(balanceOf(mesh, false).find("all values but") != std::string::npos, is_used);
  }
}

}  // namespace
}  // namespace tetstream::test
