// stream: an indexed mesh that is another one but for what it overrides. Depends on source.h.
#pragma once

#include "source.h"

namespace tetstream {

class WrappedMesh : public IndexedSource {
 public:
  // The other one has to live as long.
  explicit WrappedMesh(IndexedSource& in) : in_(in) {}

  const Schema& schema() const override { return in_.schema(); }
  bool randomAccess() const override { return in_.randomAccess(); }
  const uint8_t* locked() const override { return in_.locked(); }
  uint64_t firstNumber() const override { return in_.firstNumber(); }
  int64_t faceNumber(uint64_t row) override { return in_.faceNumber(row); }
  bool hasOrigins() const override { return in_.hasOrigins(); }
  void readOrigins(uint64_t first, size_t count, int64_t* out) override {
    in_.readOrigins(first, count, out);
  }
  void readPositions(uint64_t first, size_t count, void* out) override {
    in_.readPositions(first, count, out);
  }
  void readField(size_t column, uint64_t first, size_t count, void* out) override {
    in_.readField(column, first, count, out);
  }
  void readCells(uint64_t first, size_t count, int64_t* out) override {
    in_.readCells(first, count, out);
  }
  void readCellData(size_t column, uint64_t first, size_t count, void* out) override {
    in_.readCellData(column, first, count, out);
  }
  void readFaces(uint64_t first, size_t count, int64_t* corners, int64_t* labels) override {
    in_.readFaces(first, count, corners, labels);
  }

 protected:
  IndexedSource& in_;
};

}  // namespace tetstream
