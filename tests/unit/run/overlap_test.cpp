// Reading and writing beside the simplification: the same bytes and the same errors for any number
// of threads, and nothing of the caller's on another thread than his.
#include <gtest/gtest.h>
#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include "run.h"
#include "shapes.h"
#include "status.h"
#include "strange_workers.h"

namespace tetstream::test {
namespace {

constexpr size_t kNever = SIZE_MAX;

std::vector<int64_t> threadCounts() {
  return slowRun() ? std::vector<int64_t>{1, 4} : std::vector<int64_t>{1, 2, 3, 4, 8};
}

// 20736 cells, which leave in five batches.
TestMesh wavyGrid() {
  const int n = 12;
  TestMesh mesh = fullGrid(n, n, 2 * n, 0.1);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat32},
                   [](double x, double y, double z) { return std::sin(x * y) - z; });
  return mesh;
}

Cut smallBatches() {
  Cut cut;
  cut.batch_cells = 100;
  cut.say_front = true;
  return cut;
}

// What both ends of a run have seen.
struct Ends {
  size_t reader_fails_at = kNever, writer_fails_at = kNever;
  bool stay_with_caller = false;
  bool reader_waits = false;  // for somebody at the other end
  bool caller_waits = false;  // for another thread that reads
  std::atomic<size_t> given = 0;
  std::atomic<bool> read_elsewhere = false, written_elsewhere = false;
  std::thread::id caller = std::this_thread::get_id();
};

class In final : public Source {
 public:
  In(const TestMesh& mesh, Ends& ends) : in_(mesh, smallBatches()), ends_(ends) {}
  const Schema& schema() const override { return in_.schema(); }
  bool next(BatchView& batch) override {
    if (std::this_thread::get_id() != ends_.caller) ends_.read_elsewhere = true;
    if (ends_.given++ == ends_.reader_fails_at) fail(Status::kBadData, "the reader");
    return in_.next(batch);
  }

 private:
  MeshStream in_;
  Ends& ends_;
};

class Out final : public Sink {
 public:
  explicit Out(Ends& ends) : ends_(ends) {}
  void begin(const Schema& schema) override { out.begin(schema); }
  void put(const BatchView& batch) override {
    if (std::this_thread::get_id() != ends_.caller) ends_.written_elsewhere = true;
    if (taken_++ == ends_.writer_fails_at) fail(Status::kIo, "the writer");
    out.put(batch);
  }
  void finish() override { out.finish(); }
  bool staysWithCaller() const override { return ends_.stay_with_caller; }
  Recorder out;

 private:
  Ends& ends_;
  size_t taken_ = 0;
};

RunOptions through(int64_t threads) {
  RunOptions options;
  options.threads = threads;
  options.simplify.ratio = 0.9;
  options.simplify.window_cells = 1000;
  return options;
}

// Until another thread has read, once it was asked to; not for ever.
void waitForReader(const Ends& ends) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(10);
  while (ends.given > 5 && !ends.read_elsewhere && Clock::now() < end) std::this_thread::yield();
}

std::vector<unsigned char> ran(const TestMesh& mesh, const RunOptions& options, Ends& ends) {
  Out out(ends);
  SimplifyRun run(options, out, [&ends](const Progress&) {
    EXPECT_EQ(std::this_thread::get_id(), ends.caller);
    if (ends.caller_waits) waitForReader(ends);
  });
  Input input;
  input.stays_with_caller = ends.stay_with_caller;
  if (ends.reader_waits) input.waiting = std::make_shared<Waiting>();
  input.stream = std::make_unique<In>(mesh, ends);
  run.run(input);
  EXPECT_EQ(out.out.problem, "");
  EXPECT_TRUE(out.out.finished);
  return out.out.allBytes();
}

TEST(Overlap, GivesTheSameBytesForAnyNumberOfThreads) {
  const TestMesh mesh = wavyGrid();
  Ends alone;
  const std::vector<unsigned char> bytes = ran(mesh, through(1), alone);
  EXPECT_FALSE(alone.read_elsewhere || alone.written_elsewhere);
  for (int64_t threads : threadCounts()) {
    Ends ends;
    EXPECT_TRUE(ran(mesh, through(threads), ends) == bytes) << threads << " threads";
  }
}

TEST(Overlap, LeavesToTheCallersThreadWhatIsTheCallers) {
  const TestMesh mesh = wavyGrid();
  Ends ends;
  ends.stay_with_caller = true;
  ran(mesh, through(4), ends);
  EXPECT_FALSE(ends.read_elsewhere || ends.written_elsewhere);
}

// Neither one of a pool, nor of two, waits for the other end.
TEST(Overlap, LeavesWhatMayWaitToAThreadMoreThanThree) {
  const TestMesh mesh = wavyGrid();
  Ends alone;
  const std::vector<unsigned char> bytes = ran(mesh, through(1), alone);
  SwiftWorkers pool;
  struct Case {
    int64_t threads;
    Workers* workers;
    bool elsewhere;
  };
  for (const Case& c : {Case{2, nullptr, false}, Case{3, nullptr, true}, Case{3, &pool, false}}) {
    Ends ends;
    ends.reader_waits = true;
    ends.caller_waits = c.elsewhere;
    RunOptions options = through(c.threads);
    options.workers = c.workers;
    EXPECT_TRUE(ran(mesh, options, ends) == bytes);
    EXPECT_EQ(ends.read_elsewhere, c.elsewhere) << c.threads << " threads";
  }
}

TEST(Overlap, IsNoneWithAMemoryBudget) {
  const TestMesh mesh = wavyGrid();
  Ends ends;
  RunOptions options = through(4);
  options.simplify.memory_bytes = 64 << 20;
  ran(mesh, options, ends);
  EXPECT_FALSE(ends.read_elsewhere || ends.written_elsewhere);
}

TEST(Overlap, TellsTheErrorThatCameFirstInTheStream) {
  const TestMesh mesh = wavyGrid();
  struct Case {
    size_t reader, writer;
    const char* told;
  };
  for (const Case& c :
       {Case{5, kNever, "the reader"}, Case{kNever, 0, "the writer"}, Case{kNever, 1, "the writer"},
        Case{150, 0, "the writer"}, Case{205, 3, "the writer"}, Case{12, 3, "the reader"}})
    for (int64_t threads : threadCounts()) {
      Ends ends;
      ends.reader_waits = threads % 2 == 0;
      ends.reader_fails_at = c.reader;
      ends.writer_fails_at = c.writer;
      try {
        ran(mesh, through(threads), ends);
        ADD_FAILURE() << "no error";
      } catch (const Error& error) {
        EXPECT_EQ(error.text(), c.told) << threads << " threads, " << c.reader << ", " << c.writer;
      }
    }
}

TEST(Overlap, EndsWhereTheProgressCallbackSaysSo) {
  const TestMesh mesh = wavyGrid();
  for (int64_t threads : threadCounts()) {
    Ends ends;
    Out out(ends);
    int told = 0;
    SimplifyRun run(through(threads), out, [&told](const Progress&) {
      if (++told == 3) fail(Status::kCancelled, "enough");
    });
    Input input;
    input.stays_with_caller = false;
    input.stream = std::make_unique<In>(mesh, ends);
    EXPECT_THROW(run.run(input), Error);
    EXPECT_EQ(told, 3);
  }
}

}  // namespace
}  // namespace tetstream::test
