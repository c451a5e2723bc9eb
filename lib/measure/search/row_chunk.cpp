#include "row_chunk.h"

#include <algorithm>

namespace tetstream {

RowChunk::RowChunk(SimplexRows& rows, uint64_t first, size_t count, Account& account)
    : shape_(rows.shape()), count_(count), doubles_(shape_.doubles()), copy_(account) {
  if (const double* all = rows.inCore()) {
    rows_ = all + static_cast<size_t>(first) * doubles_;
  } else {
    copy_.resize(count * doubles_);
    for (size_t i = 0; i < count; ++i)
      std::copy_n(rows.row(first + i), doubles_, copy_.data() + i * doubles_);
    rows_ = copy_.data();
  }
  const RowView all = {shape_, rows_, count_};
  hubs_ = std::make_unique<Hubs>(all, account);
  {
    Array<Box> boxes(account, count);
    for (size_t i = 0; i < count; ++i) boxes[i] = shape_.boxOf(row(i));
    tree_ = std::make_unique<BoxTree>(account, boxes.data(), count);
  }
  if (hubs_->count() == 0) return;
  hulls_ = std::make_unique<HubHulls>(*hubs_, account);  // in the room of the boxes
  hulls_->build(*tree_, all);
}

size_t RowChunk::rowsFor(const SimplexRows& rows, size_t bytes, size_t more) {
  const size_t copied = rows.inCore() ? 0 : rows.shape().doubles() * sizeof(double);
  const size_t each = copied + sizeof(Box) + BoxTree::bytesFor(1) + more;
  return std::clamp<size_t>(bytes / each, 1, uint32_t{1} << 30);
}

}  // namespace tetstream
