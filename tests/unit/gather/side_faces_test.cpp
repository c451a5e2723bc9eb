// Faces that a file names apart from its cells: each once, as it came first.
#include "side_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <vector>

namespace tetstream {
namespace {

struct SideFace {
  int64_t corners[3], label;
};

// What is kept of them, by sorted corners.
std::map<FaceKey, SideFace> keptOf(SideFaces& faces) {
  std::vector<int64_t> corners(3 * faces.count()), labels(faces.count());
  for (uint64_t first = 0; first < faces.count(); first += 100) {
    const auto some = static_cast<size_t>(std::min<uint64_t>(100, faces.count() - first));
    faces.read(first, some, &corners[3 * first], &labels[first]);
  }
  std::map<FaceKey, SideFace> kept;
  for (size_t i = 0; i < labels.size(); ++i) {
    const int64_t* c = &corners[3 * i];
    EXPECT_TRUE(kept.insert({faceKey(c), {{c[0], c[1], c[2]}, labels[i]}}).second);
  }
  return kept;
}

TEST(SideFaces, AreKeptOnceWhateverTheOrderOfTheirCorners) {
  SideFaces faces("");
  std::map<FaceKey, SideFace> expected;
  std::mt19937 random(1);
  for (int64_t n = 0; n < 20000; ++n) {
    int64_t corners[3] = {};
    for (int64_t& corner : corners) corner = static_cast<int64_t>(random() % 40);
    faces.add(corners, n);
    expected.insert({faceKey(corners), {{corners[0], corners[1], corners[2]}, n}});
  }
  EXPECT_EQ(faces.finish(), 20000 - expected.size());
  const std::map<FaceKey, SideFace> kept = keptOf(faces);
  ASSERT_EQ(kept.size(), expected.size());
  for (const auto& [key, face] : expected) {
    ASSERT_EQ(kept.at(key).label, face.label);  // of the first
    ASSERT_TRUE(std::equal(face.corners, face.corners + 3, kept.at(key).corners));
  }
}

TEST(SideFaces, MayBeNone) {
  SideFaces faces("");
  EXPECT_EQ(faces.finish(), 0u);
  EXPECT_EQ(faces.count(), 0u);
}

}  // namespace
}  // namespace tetstream
