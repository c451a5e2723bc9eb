// Tiles are given out as soon as those before them that they share cells with are done, those with
// most ahead first.
#include "tile_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace tetstream::test {
namespace {

using Earlier = std::vector<std::vector<uint32_t>>;

TEST(TileQueue, GivesOutWhatWaitsForNothing) {
  const Earlier earlier = {{}, {0}, {}, {1, 2}};
  const std::vector<size_t> ahead = {1, 1, 1, 1};
  TileQueue queue(earlier, ahead, 0, 4);
  EXPECT_EQ(queue.take(), 0u);
  EXPECT_EQ(queue.take(), 2u) << "1 waits for 0";
  queue.finish(0);
  EXPECT_EQ(queue.take(), 1u);
  queue.finish(2);
  queue.finish(1);
  EXPECT_EQ(queue.take(), 3u);
  queue.finish(3);
  EXPECT_EQ(queue.take(), std::nullopt);
}

TEST(TileQueue, GivesOutWhatMostWaitsFor) {
  const Earlier earlier = {{}, {}, {}, {2}, {2}};
  const std::vector<size_t> ahead = {2, 3, 7, 1, 3};
  TileQueue queue(earlier, ahead, 0, 5);
  EXPECT_EQ(queue.take(), 2u);
  EXPECT_EQ(queue.take(), 1u);
  queue.finish(2);
  EXPECT_EQ(queue.take(), 4u);
  EXPECT_EQ(queue.take(), 0u);
  EXPECT_EQ(queue.take(), 3u);
  EXPECT_EQ(queue.take(), std::nullopt);
}

TEST(TileQueue, TakesTilesBeforeItsOwnAsDone) {
  const Earlier earlier = {{}, {0}, {0, 1}};
  const std::vector<size_t> ahead = {1, 1, 1};
  TileQueue queue(earlier, ahead, 1, 3);
  EXPECT_EQ(queue.take(), 1u);
  queue.finish(1);
  EXPECT_EQ(queue.take(), 2u);
}

TEST(TileQueue, GivesOutWhatIsToBeLoadedWhileThoseBeforeItAreSettled) {
  const Earlier earlier = {{}, {0}, {1}};
  const std::vector<size_t> ahead = {3, 2, 1};
  TileQueue queue(earlier, ahead, 0, 3);
  EXPECT_EQ(queue.take(), 0u);
  EXPECT_TRUE(queue.waitForEarlier(0)) << "it waits for none";
  queue.store(0);
  EXPECT_EQ(queue.take(), 1u);
  std::atomic<bool> is_settled = false;
  std::thread other([&] {
    EXPECT_TRUE(queue.waitForEarlier(1));
    EXPECT_TRUE(is_settled);
    queue.finish(1);
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  is_settled = true;
  queue.finish(0);
  EXPECT_EQ(queue.take(), 2u) << "not stored, but finished";
  other.join();
}

TEST(TileQueue, EndsTheWaitingForThoseBeforeWhenSomebodyGivesUp) {
  const Earlier earlier = {{}, {0}};
  const std::vector<size_t> ahead = {2, 1};
  TileQueue queue(earlier, ahead, 0, 2);
  EXPECT_EQ(queue.take(), 0u);
  queue.store(0);
  EXPECT_EQ(queue.take(), 1u);
  std::thread other([&] { EXPECT_FALSE(queue.waitForEarlier(1)); });
  queue.giveUp();
  other.join();
}

TEST(TileQueue, LetsThreadsWaitUntilATileIsDoneOrSomebodyGivesUp) {
  const Earlier earlier = {{}, {0}, {1}};
  const std::vector<size_t> ahead = {1, 1, 1};
  TileQueue queue(earlier, ahead, 0, 3);
  EXPECT_EQ(queue.take(), 0u);
  std::optional<size_t> second, third;
  std::thread other([&] {
    second = queue.take();
    third = queue.take();  // waits for the second, which nobody finishes
  });
  queue.finish(0);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  queue.giveUp();
  other.join();
  EXPECT_TRUE(second == 1u || second == std::nullopt);
  EXPECT_EQ(third, std::nullopt);
}

}  // namespace
}  // namespace tetstream::test
