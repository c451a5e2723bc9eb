// Contacts of tiles: who shares how much with whom, and who is kept apart.
#include "tile_contacts.h"

#include <gtest/gtest.h>

namespace tetstream::test {
namespace {

// Eight tiles of a cube: bit by bit of their numbers along the three axes.
TileContacts cube(size_t at_face, size_t at_edge, size_t at_corner) {
  TileContacts contacts;
  contacts.reset(8);
  for (uint32_t a = 0; a < 8; ++a)
    for (uint32_t b = 0; b < a; ++b) {
      const int axes = __builtin_popcount(a ^ b);
      contacts.add(a, b, axes == 1 ? at_face : axes == 2 ? at_edge : at_corner);
    }
  return contacts;
}

TEST(TileContacts, OfACubeHasSidesLikeAChessBoard) {
  TileContacts contacts = cube(1000, 100, 5);
  EXPECT_FALSE(contacts.areApart(0, 3));
  contacts.divide(std::vector<size_t>(8, 2000));
  for (uint32_t a = 0; a < 8; ++a)
    for (uint32_t b = 0; b < a; ++b) {
      const bool across_edge = __builtin_popcount(a ^ b) == 2;
      EXPECT_EQ(contacts.side(a) == contacts.side(b), across_edge) << a << ' ' << b;
      EXPECT_EQ(contacts.areApart(a, b), across_edge) << a << ' ' << b;
      EXPECT_EQ(contacts.areApart(b, a), across_edge) << a << ' ' << b;
    }
}

// Three that meet each other: two of them are of one side.
TEST(TileContacts, ThatShareMuchAreNotKeptApart) {
  TileContacts contacts;
  contacts.reset(3);
  contacts.add(0, 1, 400);
  contacts.add(1, 2, 500);
  contacts.add(2, 0, 300);
  contacts.divide({1000, 1000, 1000});
  EXPECT_EQ(contacts.side(0), contacts.side(2));
  EXPECT_FALSE(contacts.areApart(0, 2));
  contacts.divide({1000, 1000, 4000});
  EXPECT_FALSE(contacts.areApart(0, 2)) << "few beside the vertices of the larger one only";
  contacts.divide({2400, 1000, 4000});
  EXPECT_TRUE(contacts.areApart(0, 2));
}

// Two that were put on one side before the third was known are parted when it is.
TEST(TileContacts, AreDividedBetterThanInTheirOrder) {
  TileContacts contacts;
  contacts.reset(4);
  contacts.add(0, 1, 1);
  contacts.add(0, 2, 1);
  contacts.add(1, 3, 10);
  contacts.add(0, 3, 100);
  contacts.add(2, 3, 10);
  contacts.divide({800, 800, 800, 800});
  EXPECT_NE(contacts.side(0), contacts.side(3));
  EXPECT_NE(contacts.side(1), contacts.side(3));
  EXPECT_NE(contacts.side(2), contacts.side(3));
  EXPECT_TRUE(contacts.areApart(0, 1));
  EXPECT_FALSE(contacts.areApart(1, 2)) << "they do not meet";
}

TEST(TileContacts, OfPartsAreAddedUp) {
  TileContacts sum, part;
  sum.reset(3);
  part.reset(3);
  sum.add(0, 1, 7);
  part.add(1, 0);
  part.add(2, 1, 4);
  sum.add(part);
  ASSERT_EQ(sum.of(1).size(), 2u);
  EXPECT_EQ(sum.of(0)[0].cells, 8u);
  EXPECT_EQ(sum.of(1)[0].cells, 8u);
  EXPECT_EQ(sum.of(2)[0].cells, 4u);
  sum.reset(2);
  EXPECT_TRUE(sum.of(0).empty());
  EXPECT_EQ(sum.side(1), 0);
}

}  // namespace
}  // namespace tetstream::test
