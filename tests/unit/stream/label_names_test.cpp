// Names of labels: what a schema may hold, what becomes of a file's, and how they are told.
#include <gtest/gtest.h>

#include "label_names.h"
#include "status.h"

namespace tetstream {
namespace {

Schema schemaWith(std::vector<LabelName> names) {
  Schema schema;
  schema.cell_data = {{"material", 1, ScalarType::kInt32},
                      {"pair", 2, ScalarType::kInt32},
                      {"density", 1, ScalarType::kFloat64}};
  schema.label_names = std::move(names);
  return schema;
}

std::string problemOf(std::vector<LabelName> names) {
  try {
    checkSchema(schemaWith(std::move(names)));
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::kBadArgument);
    return error.text();
  }
  return "";
}

TEST(LabelNames, AreOfFacesOrOfAnArrayOfIntegers) {
  EXPECT_EQ(problemOf({{"", -4, "inlet"}, {"material", 3, "inlet"}, {"material", 4, "lead"}}), "");
  EXPECT_EQ(problemOf({{"", 1, ""}}),
            "the name of faces 1 has no bytes, of which there are 1 to 255");
  EXPECT_EQ(problemOf({{"material", 1, std::string(256, 'x')}}),
            "the name of \"material\" 1 has too many bytes, of which there are 1 to 255");
  EXPECT_EQ(problemOf({{"", 1, "a"}, {"", 1, "b"}}), "faces 1 has two names, \"a\" and \"b\"");
  EXPECT_EQ(problemOf({{"mat", 1, "a"}}), "label name \"a\": there is no cell array \"mat\"");
  for (const char* array : {"pair", "density"})
    EXPECT_NE(problemOf({{array, 1, "a"}}).find("has no labels"), std::string::npos) << array;
}

TEST(LabelNames, OfAFileAreTheFirstOnesOfTheirLabelsCutToTheirSize) {
  std::vector<LabelName> names = {{"material", 2, "lead"},
                                  {"material", 1, std::string(254, 'x') + "\xc3\xa4"},
                                  {"", 2, ""},
                                  {"", 3, "wall"},
                                  {"material", 2, "gold"},
                                  {"", 2, std::string("in\0let", 6)}};
  settleLabelNames(names);
  ASSERT_EQ(names.size(), 4u);
  checkSchema(schemaWith(names));
  EXPECT_EQ(findLabelName(names, "", 2)->name, "in");
  EXPECT_EQ(findLabelName(names, "", 3)->name, "wall");
  EXPECT_EQ(findLabelName(names, "material", 1)->name, std::string(254, 'x'));
  EXPECT_EQ(findLabelName(names, "material", 2)->name, "lead");
  EXPECT_EQ(findLabelName(names, "material", 3), nullptr);
  EXPECT_EQ(findLabelName(names, "", 1), nullptr);
  removeLabelNames(names, "");
  EXPECT_EQ(names.size(), 2u);
  EXPECT_EQ(findLabelName(names, "", 3), nullptr);
}

TEST(LabelNames, AreToldUpToTwenty) {
  EXPECT_EQ(shownLabelNames({{"", 1, "inlet"}, {"material", -3, "lead"}}),
            "faces 1 \"inlet\", \"material\" -3 \"lead\"");
  std::vector<LabelName> names;
  for (int64_t i = 0; i < 23; ++i) names.push_back({"", i, "part"});
  EXPECT_NE(shownLabelNames(names).find("faces 19 \"part\" and 3 more"), std::string::npos);
}

}  // namespace
}  // namespace tetstream
