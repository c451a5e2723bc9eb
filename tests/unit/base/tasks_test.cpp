// Threads that share work: every part is done once, the caller does what nobody began, and the
// first error is the one that is told.
#include "tasks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "strange_workers.h"

namespace tetstream::test {
namespace {

TEST(Tasks, DoEveryPartOnce) {
  for (size_t threads : {0, 1, 2, 5}) {
    const Tasks tasks(threads);
    EXPECT_EQ(tasks.threads(), std::max<size_t>(threads, 1));
    for (size_t count : {0, 1, 2, 3, 100}) {
      std::vector<std::atomic<int>> done(count);
      tasks.forParts(count, [&](size_t part) { ++done[part]; });
      for (const std::atomic<int>& times : done) EXPECT_EQ(times, 1);
    }
  }
}

TEST(Tasks, GiveTheFirstPartToTheCaller) {
  const Tasks tasks(3);
  for (int round = 0; round < 50; ++round) {
    std::thread::id first;
    tasks.forParts(3, [&](size_t part) {
      if (part == 0) first = std::this_thread::get_id();
    });
    EXPECT_EQ(first, std::this_thread::get_id());
  }
}

// Two parts that wait for each other end only if two threads have them.
TEST(Tasks, WorkAtTheSameTime) {
  const Tasks tasks(2);
  for (int round = 0; round < 20; ++round) {
    std::atomic<int> begun = 0;
    tasks.forParts(2, [&](size_t) {
      ++begun;
      while (begun < 2) std::this_thread::yield();
    });
    EXPECT_EQ(begun, 2);
  }
}

TEST(Tasks, TellTheErrorOfTheFirstPartAndServeAgain) {
  for (size_t threads : {1, 3}) {
    const Tasks tasks(threads);
    for (int round = 0; round < 20; ++round) {
      std::atomic<int> done = 0;
      try {
        tasks.forParts(6, [&](size_t part) {
          ++done;
          if (part % 2 == 1) throw std::runtime_error(std::to_string(part));
        });
        ADD_FAILURE() << "nothing was thrown";
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "1");
      }
      EXPECT_EQ(done, 6);
    }
  }
}

TEST(Tasks, AreDoneWhateverTheWorkersThatWereBrought) {
  NoWorkers none;
  HastyWorkers hasty;
  LazyWorkers lazy;
  for (Workers* workers : std::initializer_list<Workers*>{&none, &hasty, &lazy}) {
    const Tasks tasks(4, workers);
    EXPECT_EQ(tasks.threads(), 4u);
    for (size_t count : {0, 1, 3, 50}) {
      std::vector<std::thread::id> done(count);
      tasks.forParts(count, [&](size_t part) { done[part] = std::this_thread::get_id(); });
      for (std::thread::id thread : done) EXPECT_EQ(thread, std::this_thread::get_id());
    }
  }
  EXPECT_GT(none.refused, 0u);
}

TEST(Tasks, AskForNoMoreHelpThanIsOnItsWay) {
  LazyWorkers lazy;
  {
    const Tasks tasks(3, &lazy);
    for (int round = 0; round < 10; ++round) tasks.forParts(20, [](size_t) {});
    EXPECT_EQ(lazy.waiting.size(), 2u);
    lazy.workAll();
    for (int round = 0; round < 10; ++round) tasks.forParts(20, [](size_t) {});
    EXPECT_EQ(lazy.waiting.size(), 2u);
  }
  lazy.workAll();  // late, when nothing is left of the tasks
}

class Counting final : public Work {
 public:
  explicit Counting(std::atomic<int>& ran) : ran_(ran) {}
  void run() noexcept override {
    if (std::this_thread::get_id() != caller_) ++ran_;
  }

 private:
  std::atomic<int>& ran_;
  const std::thread::id caller_ = std::this_thread::get_id();
};

TEST(Tasks, RunWorkBesideTheCaller) {
  std::atomic<int> ran = 0;
  const Tasks tasks(3);
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(tasks.submit(new Counting(ran)));
  while (ran < 100) std::this_thread::yield();
  EXPECT_FALSE(Tasks(1).submit(new Counting(ran)));
}

TEST(Tasks, DoBothWithThreadsOrWithout) {
  const Tasks tasks(2);
  for (const Tasks* with : {&tasks, static_cast<const Tasks*>(nullptr)}) {
    int done[2] = {0, 0};
    doBoth(
        with, [&] { ++done[0]; }, [&] { ++done[1]; });
    EXPECT_EQ(done[0], 1);
    EXPECT_EQ(done[1], 1);
  }
}

TEST(Tasks, KnowAtLeastOneCore) {
  EXPECT_GE(coresToUse(), 1u);
}

}  // namespace
}  // namespace tetstream::test
