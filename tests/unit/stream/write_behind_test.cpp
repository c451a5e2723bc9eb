// Batches written behind: the same ones in the same order, errors after what came before them.
#include "write_behind.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "batch_ring.h"
#include "shapes.h"
#include "status.h"
#include "strange_workers.h"

namespace tetstream::test {
namespace {

Cut smallBatches() {
  Cut cut;
  cut.batch_cells = 20;
  return cut;
}

// Fails in place of taking batch `fails_at`.
class WatchedSink final : public Sink {
 public:
  explicit WatchedSink(size_t fails_at = SIZE_MAX) : fails_at_(fails_at) {}
  void begin(const Schema& schema) override { out.begin(schema); }
  void put(const BatchView& batch) override {
    if (inside_.exchange(true)) ADD_FAILURE() << "two threads write at once";
    if (taken > fails_at_) ADD_FAILURE() << "written after an error";
    const bool fails = taken++ == fails_at_;
    if (!fails) out.put(batch);
    inside_ = false;
    if (fails) fail(Status::kIo, "batch %zu", fails_at_);
  }
  void finish() override { out.finish(); }
  Recorder out;
  std::atomic<size_t> taken = 0;

 private:
  size_t fails_at_;
  std::atomic<bool> inside_ = false;
};

TEST(WriteBehind, GivesTheSameStreamWhoeverWrites) {
  const TestMesh mesh = fullGrid(5, 5, 8, 0.1);
  Recorder alone;
  MeshStream plain(mesh, smallBatches());
  copyStream(plain, alone);
  NoWorkers none;
  HastyWorkers hasty;
  LazyWorkers lazy;
  for (Workers* workers : std::initializer_list<Workers*>{nullptr, &none, &hasty, &lazy}) {
    const Tasks tasks(2, workers);
    WatchedSink sink;
    {
      WriteBehind behind(sink, tasks);
      MeshStream in(mesh, smallBatches());
      copyStream(in, behind);
    }
    lazy.workAll();  // late, when nothing is left to write
    EXPECT_EQ(sink.out.problem, "");
    EXPECT_TRUE(sink.out.finished);
    EXPECT_EQ(sink.out.batches, alone.batches);
    EXPECT_TRUE(sink.out.allBytes() == alone.allBytes());
  }
}

TEST(WriteBehind, TellsAnErrorSoonAndWritesNothingAfterIt) {
  const TestMesh mesh = fullGrid(5, 5, 8, 0.1);
  LazyWorkers lazy;
  for (Workers* workers : std::initializer_list<Workers*>{nullptr, &lazy})
    for (size_t fails_at : {0, 1, 2, 3, 20}) {
      const Tasks tasks(2, workers);
      WatchedSink sink(fails_at);
      size_t put = 0;
      try {
        WriteBehind behind(sink, tasks);
        MeshStream in(mesh, smallBatches());
        behind.begin(in.schema());
        BatchView batch;
        for (; in.next(batch); ++put) behind.put(batch);
        behind.finish();
        ADD_FAILURE() << "no error";
      } catch (const Error& error) {
        EXPECT_EQ(error.status(), Status::kIo);
        EXPECT_EQ(error.text(), textOf("batch %zu", fails_at));
      }
      EXPECT_LE(put, fails_at + batchesBehind(tasks.threads()) + 1);
      EXPECT_FALSE(sink.out.finished);
      lazy.workAll();
    }
}

TEST(WriteBehind, LetsFewBatchesWait) {
  const TestMesh mesh = fullGrid(5, 5, 8, 0.1);
  for (const auto& [threads, most] : {std::pair<size_t, size_t>{2, 4}, {5, 10}, {64, 16}}) {
    LazyWorkers lazy;
    const Tasks tasks(threads, &lazy);
    WatchedSink sink;
    WriteBehind behind(sink, tasks);
    MeshStream in(mesh, smallBatches());
    behind.begin(in.schema());
    BatchView batch;
    size_t waited = 0;
    for (size_t put = 1; in.next(batch); ++put) {
      behind.put(batch);
      waited = std::max(waited, put - sink.taken);
      EXPECT_GE(sink.taken, std::min(put, kBatchesOfOneThread));
    }
    EXPECT_EQ(waited, most) << threads << " threads";
    EXPECT_EQ(lazy.waiting.size(), 1u);
    behind.settle();
    EXPECT_EQ(sink.out.mesh.cellCount(), mesh.cellCount());
  }
}

TEST(WriteBehind, DropsWhatWaitsWhenItIsLeft) {
  const TestMesh mesh = fullGrid(5, 5, 8, 0.1);
  const Tasks tasks(2);
  for (size_t put = 0; put < 12; ++put) {
    WatchedSink sink;
    {
      WriteBehind behind(sink, tasks);
      MeshStream in(mesh, smallBatches());
      behind.begin(in.schema());
      BatchView batch;
      for (size_t i = 0; i < put && in.next(batch); ++i) behind.put(batch);
    }
    const size_t taken = sink.taken;
    EXPECT_LE(taken, put);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(sink.taken, taken);  // nobody writes any more
  }
}

}  // namespace
}  // namespace tetstream::test
