// stream: a stream whose float64 positions and fields are rounded to float32, for outputs that hold
// no more. What is decided on the rounded values then holds for what is written. Depends on
// wrapped_mesh.h.
#pragma once

#include <utility>
#include <vector>

#include "wrapped_mesh.h"

namespace tetstream {

// Cell data and integers stay as they are.
class Rounding {
 public:
  static bool needed(const Schema& schema);

  explicit Rounding(const Schema& schema);
  const Schema& schema() const { return rounded_; }
  // Borrows the batch's other arrays; the rounded ones live until the next call. Throws
  // kUnsupported, naming the vertex, where a finite value has no finite float32 beside it.
  BatchView round(const BatchView& batch);
  // The same for `count` rows of the positions (column -1) or of a field, from vertex `first`.
  void roundRows(int column, uint64_t first, const double* in, size_t count, float* out) const;
  bool rounds(int column) const;
  size_t components(int column) const;

 private:
  Schema exact_, rounded_;
  std::vector<float> positions_;
  std::vector<std::vector<float>> fields_;
  std::vector<const void*> pointers_;
};

class RoundingSource final : public Source {
 public:
  explicit RoundingSource(Source& in) : in_(in), rounding_(in.schema()) {}
  const Schema& schema() const override { return rounding_.schema(); }
  bool next(BatchView& batch) override;
  std::unique_ptr<Source> again(Part part) override;

 private:
  explicit RoundingSource(std::unique_ptr<Source> in)
      : own_(std::move(in)), in_(*own_), rounding_(in_.schema()) {}

  std::unique_ptr<Source> own_;  // of a second reading
  Source& in_;
  Rounding rounding_;
};

class RoundingIndexedSource final : public WrappedMesh {
 public:
  explicit RoundingIndexedSource(IndexedSource& in) : WrappedMesh(in), rounding_(in.schema()) {}
  const Schema& schema() const override { return rounding_.schema(); }
  void readPositions(uint64_t first, size_t count, void* out) override;
  void readField(size_t column, uint64_t first, size_t count, void* out) override;

 private:
  void readRounded(int column, uint64_t first, size_t count, void* out);

  Rounding rounding_;
  std::vector<double> exact_;
};

}  // namespace tetstream
