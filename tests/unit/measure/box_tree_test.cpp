// Boxes found in a tree are those that a look at all of them finds.
#include "box_tree.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <limits>
#include <set>

#include "cells_testing.h"

namespace tetstream::test {
namespace {

Box randomBox(Random& random, double size) {
  return RowShape{2, 0}.boxOf(randomSimplex(random, 2, size).data());
}

std::vector<Box> randomBoxes(Random& random, size_t count) {
  std::vector<Box> boxes;
  for (size_t i = 0; i < count; ++i) boxes.push_back(randomBox(random, i % 50 ? 0.05 : 0.5));
  return boxes;
}

double squaredTo(const Box& box, const std::vector<double>& place) {
  double sum = 0;
  for (size_t k = 0; k < 3; ++k) {
    const double nearest = std::clamp(place[k], box.low[k], box.high[k]);
    sum += (place[k] - nearest) * (place[k] - nearest);
  }
  return sum;
}

// visit(random, boxes, tree, account) for trees of none to many boxes.
template <class Visit>
void forTrees(uint32_t seed, Visit visit) {
  Random random(seed);
  for (const size_t count : {0, 1, 4, 5, 9, 33, 3000}) {
    Account account;
    const std::vector<Box> boxes = randomBoxes(random, count);
    const BoxTree tree(account, boxes.data(), count);
    visit(random, boxes, tree, account);
  }
}

TEST(BoxTree, VisitsWhatMeetsABoxOnce) {
  forTrees(1, [](Random& random, const std::vector<Box>& boxes, const BoxTree& tree, Account&) {
    for (int n = 0; n < 100; ++n) {
      const Box asked = randomBox(random, 0.2);
      std::set<uint32_t> seen;
      tree.forEachNear(asked, [&](uint32_t i) { EXPECT_TRUE(seen.insert(i).second); });
      for (uint32_t i = 0; i < boxes.size(); ++i)
        EXPECT_TRUE(seen.count(i) || !boxes[i].meets(asked));
      EXPECT_TRUE(boxes.size() < 100 || seen.size() < boxes.size() / 4) << seen.size();
    }
  });
}

TEST(BoxTree, VisitsAllOfThemForABoxRoundAll) {
  forTrees(2, [](Random&, const std::vector<Box>& boxes, const BoxTree& tree, Account&) {
    Box all;
    for (const Box& box : boxes) all.add(box);
    size_t seen = 0;
    tree.forEachNear(all, [&](uint32_t) { ++seen; });
    EXPECT_EQ(seen, boxes.size());
    tree.forEachNear(Box(), [&](uint32_t) { ADD_FAILURE() << "near nothing"; });
  });
}

TEST(BoxTree, FindsTheNearestOneWithFewVisits) {
  forTrees(3, [](Random& random, const std::vector<Box>& boxes, const BoxTree& tree, Account&) {
    size_t visits = 0;
    for (int n = 0; n < 100; ++n) {
      const std::vector<double> place = randomSimplex(random, 1, 1);
      double least = std::numeric_limits<double>::infinity(), found = least;
      for (const Box& box : boxes) least = std::min(least, squaredTo(box, place));
      tree.forEachWithin(place.data(), found, [&](uint32_t i) {
        ++visits;
        return found = std::min(found, squaredTo(boxes[i], place));
      });
      EXPECT_EQ(found, least);
    }
    EXPECT_TRUE(boxes.size() < 100 || visits / 100 < boxes.size() / 50) << visits;
  });
}

// Halved along their row, whichever way it runs.
TEST(BoxTree, FindsBoxesInARowWithFewVisits) {
  for (int axis = 0; axis < 3; ++axis) {
    Account account;
    std::vector<Box> boxes(1000);
    for (size_t i = 0; i < boxes.size(); ++i) {
      double place[3] = {0, 0, 0};
      place[axis] = static_cast<double>(i * 7 % 1000);
      boxes[i].add(place);
    }
    const BoxTree tree(account, boxes.data(), boxes.size());
    size_t visits = 0;
    for (const Box& box : boxes) tree.forEachNear(box, [&](uint32_t) { ++visits; });
    EXPECT_LE(visits, 8 * boxes.size());
  }
}

// Also what is just as far away.
TEST(BoxTree, VisitsAllWithinADistance) {
  Random random(4);
  Account account;
  const std::vector<Box> boxes = randomBoxes(random, 1000);
  const BoxTree tree(account, boxes.data(), boxes.size());
  for (int n = 0; n < 100; ++n) {
    const std::vector<double> place = randomSimplex(random, 1, 1);
    const double within = squaredTo(boxes[random.below(1000)], place);
    std::set<uint32_t> seen;
    tree.forEachWithin(place.data(), within, [&](uint32_t i) {
      EXPECT_TRUE(seen.insert(i).second);
      return within;
    });
    for (uint32_t i = 0; i < boxes.size(); ++i)
      EXPECT_TRUE(seen.count(i) || squaredTo(boxes[i], place) > within);
  }
}

TEST(BoxTree, HoldsBoxesThatAreAllTheSame) {
  Random random(5);
  Account account;
  const std::vector<Box> boxes(1000, randomBox(random, 1));
  const BoxTree tree(account, boxes.data(), boxes.size());
  std::set<uint32_t> seen;
  tree.forEachNear(boxes[0], [&](uint32_t i) { seen.insert(i); });
  EXPECT_EQ(seen.size(), boxes.size());
}

TEST(BoxTree, TakesTheBytesThatItTells) {
  forTrees(6, [](Random&, const std::vector<Box>& boxes, const BoxTree&, Account& account) {
    EXPECT_LE(account.peak(), BoxTree::bytesFor(boxes.size()));
  });
}

}  // namespace
}  // namespace tetstream::test
