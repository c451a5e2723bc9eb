// Batches read ahead: the same ones, the same end, whoever reads them.
#include "read_ahead.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "batch_copy.h"
#include "batch_ring.h"
#include "bytes.h"
#include "shapes.h"
#include "status.h"
#include "strange_workers.h"

namespace tetstream::test {
namespace {

TestMesh richMesh() {
  TestMesh mesh = fullGrid(5, 5, 8, 0.1);
  addPositionField(mesh, {"f", 2, ScalarType::kFloat32},
                   [](double x, double y, double z) { return x * y - z; });
  mesh.addIntegerField("label", [](size_t v) { return int64_t(v % 3); });
  mesh.addCellData({"d", 1, ScalarType::kFloat64}, [](size_t c, int) { return double(c % 5); });
  for (size_t v = 0; v < mesh.vertexCount(); ++v) mesh.locked.push_back(v % 50 == 0);
  return mesh;
}

Cut smallExplicitBatches() {
  Cut cut;
  cut.batch_cells = 20;
  cut.explicit_final = true;
  return cut;
}

// Gives a mesh, and fails in place of batch `fails_at`; counts who is in it at once.
class WatchedSource final : public Source {
 public:
  WatchedSource(const TestMesh& mesh, size_t fails_at)
      : in_(mesh, smallExplicitBatches()), fails_at_(fails_at) {}
  const Schema& schema() const override { return in_.schema(); }
  bool next(BatchView& batch) override {
    if (inside_.exchange(true)) ADD_FAILURE() << "two threads read at once";
    if (ended_) ADD_FAILURE() << "read beyond the end";
    if (given == fails_at_) {
      ended_ = true;
      inside_ = false;
      fail(Status::kBadData, "batch %zu", fails_at_);
    }
    ended_ = !in_.next(batch);
    ++given;
    inside_ = false;
    return !ended_;
  }
  std::atomic<size_t> given = 0;

 private:
  MeshStream in_;
  size_t fails_at_;
  std::atomic<bool> inside_ = false;
  bool ended_ = false;
};

constexpr size_t kNever = SIZE_MAX;

TEST(ReadAhead, GivesTheSameStreamWhoeverReads) {
  const TestMesh mesh = richMesh();
  Recorder alone;
  MeshStream plain(mesh, smallExplicitBatches());
  copyStream(plain, alone);
  NoWorkers none;
  HastyWorkers hasty;
  LazyWorkers lazy;
  for (Workers* workers : std::initializer_list<Workers*>{nullptr, &none, &hasty, &lazy}) {
    const Tasks tasks(2, workers);
    Recorder out;
    {
      WatchedSource in(mesh, kNever);
      ReadAhead ahead(in, tasks);
      copyStream(ahead, out);
      BatchView batch;
      EXPECT_FALSE(ahead.next(batch));
    }
    EXPECT_EQ(out.problem, "");
    EXPECT_EQ(out.batches, alone.batches);
    EXPECT_TRUE(out.allBytes() == alone.allBytes());
    EXPECT_TRUE(out.mesh.locked == alone.mesh.locked);
    lazy.workAll();  // late, when the source is gone
  }
}

TEST(ReadAhead, TellsAnErrorAfterTheBatchesBeforeIt) {
  const TestMesh mesh = richMesh();
  HastyWorkers hasty;
  for (Workers* workers : std::initializer_list<Workers*>{nullptr, &hasty})
    for (size_t fails_at : {0, 1, 2, 3, 7, 20}) {
      const Tasks tasks(2, workers);
      WatchedSource in(mesh, fails_at);
      ReadAhead ahead(in, tasks);
      size_t came = 0;
      try {
        BatchView batch;
        while (ahead.next(batch)) ++came;
        ADD_FAILURE() << "no error";
      } catch (const Error& error) {
        EXPECT_EQ(error.status(), Status::kBadData);
        EXPECT_EQ(error.text(), textOf("batch %zu", fails_at));
      }
      EXPECT_EQ(came, fails_at);
    }
}

TEST(ReadAhead, ReadsNothingBeforeItIsAskedAndFewBatchesBeyond) {
  const TestMesh mesh = richMesh();
  HastyWorkers hasty;
  const Tasks tasks(2, &hasty);
  WatchedSource in(mesh, kNever);
  ReadAhead ahead(in, tasks);
  EXPECT_EQ(in.given, 0u);
  BatchView batch;
  for (size_t asked = 1; asked <= 20; ++asked) {
    EXPECT_TRUE(ahead.next(batch));
    // The one that is handed out counts among those that may wait.
    EXPECT_EQ(in.given, asked <= kBatchesOfOneThread ? asked : asked + kBatchesAhead - 1);
  }
}

TEST(ReadAhead, MayBeLeftInTheMiddle) {
  const TestMesh mesh = richMesh();
  const Tasks tasks(2);
  for (size_t asked = 0; asked < 12; ++asked) {
    WatchedSource in(mesh, kNever);
    ReadAhead ahead(in, tasks);
    BatchView batch;
    for (size_t i = 0; i < asked; ++i) EXPECT_TRUE(ahead.next(batch));
  }
}

// Gives a mesh's first batches, then waits for a pipe that nobody writes to.
class StuckSource final : public Source {
 public:
  StuckSource(const TestMesh& mesh, size_t batches)
      : in_(mesh, smallExplicitBatches()), left_(batches) {
    if (::pipe(fds_) != 0) ADD_FAILURE() << "no pipe";
    pipe_ = openDescriptor(fds_[0], "pipe");
  }
  ~StuckSource() override {
    for (const int fd : fds_) ::close(fd);
  }
  std::shared_ptr<Waiting> waiting() const { return pipe_->waiting(); }
  const Schema& schema() const override { return in_.schema(); }
  bool next(BatchView& batch) override {
    if (std::this_thread::get_id() != caller_) read_elsewhere = true;
    if (left_-- > 0) return in_.next(batch);
    char byte;
    return pipe_->read(&byte, 1) > 0;
  }
  std::atomic<bool> read_elsewhere = false;

 private:
  MeshStream in_;
  size_t left_;
  int fds_[2];
  std::unique_ptr<ByteSource> pipe_;
  const std::thread::id caller_ = std::this_thread::get_id();
};

TEST(ReadAhead, ReadsByAThreadOfItsOwnWhatMayWait) {
  const TestMesh mesh = richMesh();
  StuckSource in(mesh, 20);
  ReadAhead ahead(in, in.waiting());
  BatchView batch;
  for (size_t i = 0; i < 10; ++i) EXPECT_TRUE(ahead.next(batch));
  while (!in.read_elsewhere) std::this_thread::yield();
}

TEST(ReadAhead, IsLeftWithoutWaitingForTheOtherEnd) {
  const TestMesh mesh = richMesh();
  for (size_t batches = 3; batches < 8; ++batches) {
    StuckSource in(mesh, batches);
    ReadAhead ahead(in, in.waiting());
    BatchView batch;
    for (size_t i = 0; i < batches; ++i) EXPECT_TRUE(ahead.next(batch));
  }
}

// Whichever thread waits for the other end.
TEST(ReadAhead, LeavesTimeForSomethingElse) {
  const TestMesh mesh = richMesh();
  for (size_t batches : {1, 6}) {
    StuckSource in(mesh, batches);
    int times = 0;
    in.waiting()->doMeanwhile([&] {
      if (++times == 3) fail(Status::kCancelled, "enough");
    });
    ReadAhead ahead(in, in.waiting());
    BatchView batch;
    for (size_t i = 0; i < batches; ++i) EXPECT_TRUE(ahead.next(batch));
    EXPECT_THROW(ahead.next(batch), Error);
    EXPECT_EQ(times, 3);
  }
}

TEST(ReadAhead, HoldsFewLargeBatches) {
  TestMesh mesh = fullGrid(20, 20, 20, 0);  // 48000 cells: 1.5 MB in one batch
  Cut cut;
  cut.batch_cells = 40000;
  MeshStream in(mesh, cut);
  BatchRing ring(in.schema(), kBatchesAhead);
  BatchView batch;
  EXPECT_TRUE(in.next(batch));
  ring.last().take(batch);
  ring.countLast();
  EXPECT_FALSE(ring.full());
  ring.last().take(ring.first().view());
  ring.countLast();
  EXPECT_TRUE(ring.full());
  ring.dropFirst();
  EXPECT_FALSE(ring.full());
}

// Each array of a copy is one of its own, whatever becomes of what it was made from.
TEST(BatchCopy, KeepsWhatBelongsToFaces) {
  Schema schema;
  Batch batch(schema);
  batch.clear(0);
  for (int64_t f = 0; f < 3; ++f) {
    const int64_t corners[3] = {f, f + 1, f + 2};
    batch.addFace(corners, 10 + f);
    batch.addFaceOrigin(70 + f);
  }
  Account account;
  BatchCopy copy(schema, account);
  copy.take(batch.view());
  const BatchView kept = copy.view();
  batch.clear(0);
  for (int64_t f = 0; f < 3; ++f) {
    const int64_t none[3] = {-1, -1, -1};
    batch.addFace(none, -1);
    batch.addFaceOrigin(-1);
  }
  ASSERT_EQ(kept.face_count, 3u);
  for (size_t f = 0; f < 3; ++f) {
    EXPECT_EQ(kept.faces[3 * f + 2], static_cast<int64_t>(f) + 2);
    EXPECT_EQ(kept.face_labels[f], static_cast<int64_t>(f) + 10);
    EXPECT_EQ(kept.face_origins[f], static_cast<int64_t>(f) + 70);
  }
}

}  // namespace
}  // namespace tetstream::test
