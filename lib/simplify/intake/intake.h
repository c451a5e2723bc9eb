// simplify/intake: READ. Takes events into the window and checks them. Depends on core.h.
#pragma once

#include "batch.h"
#include "core.h"
#include "lone_values.h"

namespace tetstream {

template <class S>
class Intake {
 public:
  Intake(Core<S>& core, Account& account)
      : core_(core), lone_values_(core.plan), face_order_(account), finalized_(account, 1024) {}

  // A batch is taken in steps, so that the caller can stop after any cell: vertices are introduced
  // with the first cell that needs them, labelled faces with the last of their vertices. The view
  // must stay valid until finishBatch.
  void startBatch(const BatchView& batch);
  void takeCell(size_t row);
  void finishBatch();  // the vertices left over and the explicit finalizations
  void finalizeAll();  // at the end of the stream

  uint64_t cellsRead() const { return cells_read_; }
  uint64_t facesRead() const { return faces_read_; }
  // Once all vertices are resolved: labelled faces of no cell, and those that came twice, are
  // kBadData.
  void checkFaces() const;
  const LoneValues& loneValues() const { return lone_values_; }
  // Vertices in the window that came with a batch before any cell that has them.
  size_t waiting() const { return static_cast<size_t>(core_.front.introduced() - core_.reached); }
  // The vertices finalized since the last clear, by slot.
  const uint32_t* finalized() const { return finalized_.data(); }
  size_t finalizedCount() const { return finalized_count_; }
  void clearFinalized() { finalized_count_ = 0; }

 private:
  void startFaces();
  void takeFaces();
  void takeFace(size_t row);
  int64_t lastVertexOf(size_t face) const;
  int64_t numberOf(size_t face) const;
  void takeLocks();
  void lock(uint32_t slot);
  void checkEarly(const char* what, int64_t number, int64_t vertex) const;
  void introduceUpTo(uint64_t vertex);
  void growVertices();
  void takeVertex(size_t row);
  void readColumn(size_t column, size_t row, uint32_t slot);
  void takeCellData(size_t row, uint32_t cell);
  uint32_t slotOf(int64_t vertex);
  uint32_t newSlotOf(int64_t vertex);
  void failTwice(const int64_t ids[4]);
  void finalize(int64_t vertex);
  void queueFinal(uint32_t slot);

  Core<S>& core_;
  BatchView batch_;
  uint64_t declared_ = 0, cells_read_ = 0, faces_read_ = 0, edges_read_ = 0;
  LoneValues lone_values_;
  Array<size_t> face_order_;  // of the batch, by their last vertices
  size_t faces_taken_ = 0;    // of those
  Array<uint32_t> finalized_;
  size_t finalized_count_ = 0;
};

}  // namespace tetstream
