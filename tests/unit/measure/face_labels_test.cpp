// Faces by their labels.
#include "face_labels.h"

#include <gtest/gtest.h>

namespace tetstream {
namespace {

TEST(FaceLabels, CountFacesAndAreas) {
  FaceLabels labels;
  labels.add(7, 0.5);
  labels.add(-1, 2);
  labels.add(7, 0.25);
  EXPECT_EQ(labels.faces(), 3);
  ASSERT_EQ(labels.labels().size(), 2u);
  EXPECT_EQ(labels.labels().at(7).faces, 2);
  EXPECT_EQ(labels.labels().at(7).area, 0.75);
  EXPECT_EQ(labels.labels().at(-1).faces, 1);
}

TEST(FaceLabels, ThatNumberTheFacesAreNotTold) {
  FaceLabels labels;
  const auto most = static_cast<int64_t>(FaceLabels::kMostLabels);
  for (int64_t label = 0; label < most; ++label) labels.add(label, 1);
  labels.add(0, 1);
  EXPECT_EQ(labels.labels().size(), FaceLabels::kMostLabels);
  for (int64_t label = most; label < most + 5; ++label) labels.add(label, 1);
  EXPECT_TRUE(labels.labels().empty());
  EXPECT_EQ(labels.faces(), most + 6);
}

}  // namespace
}  // namespace tetstream
