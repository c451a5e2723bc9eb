// The front of the stream that comes of ranked vertices.
#include "order_front.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "order_checks.h"
#include "random.h"
#include "shapes.h"

namespace tetstream::test {
namespace {

Array<uint32_t> arrayOf(Account& account, const std::vector<uint32_t>& numbers) {
  Array<uint32_t> array(account, numbers.size());
  std::copy(numbers.begin(), numbers.end(), array.data());
  return array;
}

void expectFront(const OrderFront& front, int64_t cells, int64_t width, int64_t span, double mean) {
  EXPECT_EQ(front.front_cells, cells);
  EXPECT_EQ(front.front_width, width);
  EXPECT_EQ(front.front_span, span);
  EXPECT_DOUBLE_EQ(front.mean_width, mean);
}

// Three cells in a ring: the last one shares vertex 0 with the first and vertex 4 with the second.
TestMesh threeCells() {
  return makeMesh(ScalarType::kFloat64, std::vector<double>(21, 0.0),
                  {0, 1, 2, 3, 1, 2, 3, 4, 0, 4, 5, 6});
}

TEST(OrderFront, IsAsCountedByHand) {
  const OrderMesh mesh(threeCells());
  Account account;
  // 0 to 3 come with the first cell, 4 with the second, which is the last one for 1, 2 and 3; then
  // 5 and 6 come while 0 is still there.
  const auto forwards = arrayOf(account, {0, 1, 2, 3, 4, 5, 6});
  expectFront(frontOfRanks(mesh.connectivity, forwards, account), 2, 5, 7, (4 + 5 + 4) / 3.0);
  // The second cell, then the first and third, both at vertex 0, by number: when 5 and 6 come, 1, 2
  // and 3 are final, and 4, which is the fourth one in the stream, is the oldest.
  const auto backwards = arrayOf(account, {6, 5, 4, 3, 2, 1, 0});
  expectFront(frontOfRanks(mesh.connectivity, backwards, account), 2, 5, 5, (4 + 5 + 4) / 3.0);
}

TEST(OrderFront, TheStreamHoldsEachCellAtItsLastVertex) {
  const OrderMesh mesh(threeCells());
  Account account;
  StreamOrder order(account);
  order.rank.resize(7);
  for (uint32_t v = 0; v < 7; ++v) order.rank[v] = 6 - v;
  makeStream(mesh.connectivity, account, order);
  const std::vector<uint32_t> cells(order.cell_at.data(), order.cell_at.data() + 3);
  EXPECT_EQ(cells, (std::vector<uint32_t>{1, 0, 2}));
  const std::vector<uint32_t> ranks(order.rank.data(), order.rank.data() + 7);
  EXPECT_EQ(ranks, (std::vector<uint32_t>{4, 0, 1, 2, 3, 5, 6}));
  const std::vector<uint32_t> last(order.last_use.data(), order.last_use.data() + 7);
  EXPECT_EQ(last, (std::vector<uint32_t>{2, 1, 1, 1, 2, 2, 2}));
  EXPECT_EQ(order.used_vertices, 7u);
}

TEST(OrderFront, IsThatOfAPlainCountOnRandomRanks) {
  Random random(3);
  std::vector<TestMesh> meshes = oddMeshes();
  meshes.push_back(shuffled(fullGrid(3, 4, 5), 1));
  for (const TestMesh& test_mesh : meshes) {
    const OrderMesh mesh(test_mesh);
    std::vector<uint32_t> rank(mesh.connectivity.vertices);
    std::iota(rank.begin(), rank.end(), 0u);
    for (size_t i = rank.size(); i > 1; --i)
      std::swap(rank[i - 1], rank[random.below(static_cast<uint32_t>(i))]);
    Account account;
    const OrderFront plain = plainFront(mesh.connectivity, rank);
    expectFront(frontOfRanks(mesh.connectivity, arrayOf(account, rank), account), plain.front_cells,
                plain.front_width, plain.front_span, plain.mean_width);
  }
}

TEST(OrderFront, OfCellsAsTheyStandCountsThoseCells) {
  const OrderMesh mesh(threeCells());
  Account account;
  StreamOrder order(account);
  order.cell_at.resize(3);
  order.cell_at[0] = 2;
  order.cell_at[1] = 0;
  order.cell_at[2] = 1;
  followCells(mesh.connectivity, account, order);
  // 0, 4, 5, 6; then 1, 2, 3, the last of seven, beside 0 and 4; then 0 is gone.
  expectFront(order, 2, 5, 7, (4 + 5 + 4) / 3.0);
}

TEST(OrderFront, GivesItsMemoryBack) {
  const OrderMesh mesh(fullGrid(3, 3, 3));
  Account account;
  {
    const auto rank = arrayOf(account, std::vector<uint32_t>(mesh.connectivity.vertices, 0));
    const size_t before = account.used();
    frontOfRanks(mesh.connectivity, rank, account);
    EXPECT_EQ(account.used(), before);
  }
  EXPECT_EQ(account.used(), 0u);
}

}  // namespace
}  // namespace tetstream::test
