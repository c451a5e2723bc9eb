// The front of ordered cells is what FrontMeter finds, and their vertices are numbered as they
// come.
#include "cell_front.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "batch.h"
#include "slow_run.h"

namespace tetstream::test {
namespace {

using Cells = std::vector<uint32_t>;  // [n][4]

// Cells near each other have vertices near each other, now and then one that is far.
Cells someCells(std::mt19937& random, size_t cells, uint32_t vertices, uint32_t near) {
  Cells all;
  const auto below = [&random](uint32_t end) { return static_cast<uint32_t>(random() % end); };
  for (size_t c = 0; c < cells; ++c) {
    const auto middle = static_cast<uint32_t>(c * vertices / cells);
    uint32_t corners[4];
    for (int j = 0; j < 4; ++j)
      for (bool is_new = false; !is_new;) {
        corners[j] = below(20) == 0 ? below(vertices) : (middle + below(near)) % vertices;
        is_new = true;
        for (int i = 0; i < j; ++i) is_new = is_new && corners[i] != corners[j];
      }
    all.insert(all.end(), corners, corners + 4);
  }
  return all;
}

struct Found {
  FrontStatistics front;
  std::vector<uint32_t> numbers;  // of each corner
};

Found taken(const Cells& cells, uint32_t vertices) {
  Account account;
  CellFront front(vertices, account);
  EXPECT_EQ(account.used(), CellFront::bytesFor(vertices));
  std::vector<unsigned> uses(cells.size() / 4);
  for (size_t c = uses.size(); c-- > 0;)
    uses[c] = front.takeLast(&cells[4 * c], static_cast<uint32_t>(c));
  front.turnRound();
  for (size_t c = 0; c < uses.size(); ++c) front.takeFirst(&cells[4 * c], uses[c]);
  front.finish();
  EXPECT_EQ(account.used(), 4 * vertices);
  Found found{front.statistics(), {}};
  for (uint32_t corner : cells) found.numbers.push_back(front.number(corner));
  return found;
}

Found metered(const Cells& cells, uint32_t vertices) {
  std::vector<uint32_t> number(vertices, 0xffffffffu);
  std::vector<size_t> last(vertices);
  Found found;
  uint32_t next = 0;
  for (size_t i = 0; i < cells.size(); ++i) {
    if (number[cells[i]] == 0xffffffffu) number[cells[i]] = next++;
    found.numbers.push_back(number[cells[i]]);
    last[cells[i]] = i;
  }
  Schema schema;
  Batch batch(schema);
  batch.clear(0);
  batch.addVertices(next);
  for (size_t c = 0; c < cells.size() / 4; ++c) {
    batch.addCells(1);
    for (size_t j = 0; j < 4; ++j) {
      batch.cell(c)[j] = found.numbers[4 * c + j];
      if (last[cells[4 * c + j]] == 4 * c + j)
        batch.lastUses(c) = static_cast<uint8_t>(batch.lastUses(c) | 1u << j);
    }
  }
  Account account;
  FrontMeter meter(account);
  meter.put(batch.view());
  found.front = meter.statistics();
  return found;
}

TEST(CellFront, IsWhatFrontMeterFinds) {
  std::mt19937 random(5);
  for (int k = 0; k < (slowRun() ? 3 : 60); ++k) {
    const size_t cells = 1 + random() % 2000;
    const auto vertices = static_cast<uint32_t>(4 + random() % 600);
    const auto near = static_cast<uint32_t>(4 + random() % 40);
    const Cells all = someCells(random, cells, vertices, near);
    const Found found = taken(all, vertices), expected = metered(all, vertices);
    ASSERT_EQ(found.front.width, expected.front.width);
    ASSERT_EQ(found.front.span, expected.front.span);
    ASSERT_EQ(found.front.cells, expected.front.cells);
    ASSERT_EQ(found.numbers, expected.numbers);
  }
}

// One component is over before the next one begins.
TEST(CellFront, IsThatOfOneCellWhereTheyAreApart) {
  const Found found = taken({3, 2, 1, 0, 7, 4, 5, 6}, 8);
  EXPECT_EQ(found.front.width, 4);
  EXPECT_EQ(found.front.span, 4);
  EXPECT_EQ(found.front.cells, 0);
  EXPECT_EQ(found.numbers, (std::vector<uint32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(CellFront, IsNothingOfNoCells) {
  const Found found = taken({}, 0);
  EXPECT_EQ(found.front.width, 0);
  EXPECT_EQ(found.front.cells, 0);
}

}  // namespace
}  // namespace tetstream::test
