#include "front_meter.h"

#include <algorithm>

#include "status.h"

namespace tetstream {

constexpr size_t kFirstRows = 256;

FrontMeter::FrontMeter(Account& account)
    : front_(account), vertex_head_(account), corner_next_(account), pending_(account) {}

uint32_t FrontMeter::takeVertex() {
  if (vertex_free_ == kNone) {
    const size_t size = vertex_head_.size();
    vertex_head_.resize(size ? 2 * size : kFirstRows);
    for (size_t i = vertex_head_.size(); i-- > size;) {
      vertex_head_[i] = vertex_free_;
      vertex_free_ = static_cast<uint32_t>(i);
    }
  }
  const uint32_t vertex = vertex_free_;
  vertex_free_ = vertex_head_[vertex];
  return vertex;
}

uint32_t FrontMeter::takeCell() {
  if (cell_free_ == kNone) {
    const size_t size = pending_.size();
    pending_.resize(size ? 2 * size : kFirstRows);
    corner_next_.resize(4 * pending_.size());
    for (size_t i = pending_.size(); i-- > size;) {
      pending_[i] = 0;
      corner_next_[4 * i] = cell_free_;
      cell_free_ = static_cast<uint32_t>(i);
    }
  }
  const uint32_t cell = cell_free_;
  cell_free_ = corner_next_[4 * cell];
  return cell;
}

void FrontMeter::introduceUpTo(uint64_t vertex) {
  while (front_.introduced() <= vertex) {
    const uint32_t slot = takeVertex();
    vertex_head_[slot] = kNone;
    front_.introduce(slot);
  }
}

// One by one, to say what is wrong.
void FrontMeter::findCorners(const int64_t corners[4], uint32_t slots[4]) {
  const auto number = static_cast<unsigned long long>(cells_seen_);
  for (int j = 0; j < 4; ++j) {
    if (corners[j] < 0 || static_cast<uint64_t>(corners[j]) >= declared_)
      fail(Status::kBadData, "cell %llu: vertex %lld is not declared before it", number,
           static_cast<long long>(corners[j]));
    introduceUpTo(static_cast<uint64_t>(corners[j]));
    slots[j] = front_.find(static_cast<uint64_t>(corners[j]));
    if (slots[j] == kNoSlot)
      fail(Status::kBadData, "cell %llu: vertex %lld was finalized before it", number,
           static_cast<long long>(corners[j]));
    for (int i = 0; i < j; ++i)
      if (slots[i] == slots[j])
        fail(Status::kBadData, "cell %llu: vertex %lld is there twice", number,
             static_cast<long long>(corners[j]));
  }
}

static bool areFour(const uint32_t s[4]) {
  return s[0] != s[1] && s[0] != s[2] && s[0] != s[3] && s[1] != s[2] && s[1] != s[3] &&
         s[2] != s[3];
}

uint32_t FrontMeter::addCell(const int64_t corners[4]) {
  uint32_t slots[4];
  if (!front_.findFour(corners, slots) || !areFour(slots)) findCorners(corners, slots);
  const uint32_t cell = takeCell();
  pending_[cell] = 4;
  for (uint32_t j = 0; j < 4; ++j) {
    corner_next_[4 * cell + j] = vertex_head_[slots[j]];
    vertex_head_[slots[j]] = 4 * cell + j;
  }
  ++live_cells_;
  ++cells_seen_;
  return cell;
}

uint32_t FrontMeter::finalize(int64_t vertex) {
  const uint64_t rank = static_cast<uint64_t>(vertex);
  if (vertex < 0 || rank >= declared_)
    fail(Status::kBadData, "finalized vertex %lld is not declared", static_cast<long long>(vertex));
  introduceUpTo(rank);
  const uint32_t slot = front_.find(rank);
  if (slot == kNoSlot)
    fail(Status::kBadData, "vertex %lld is finalized twice", static_cast<long long>(vertex));
  front_.finalize(rank);
  for (uint32_t corner = vertex_head_[slot]; corner != kNone;) {
    const uint32_t next = corner_next_[corner], cell = corner / 4;
    if (--pending_[cell] == 0) {
      corner_next_[4 * cell] = cell_free_;
      cell_free_ = cell;
      --live_cells_;
    }
    corner = next;
  }
  vertex_head_[slot] = vertex_free_;
  vertex_free_ = slot;
  return slot;
}

void FrontMeter::declare(const BatchView& batch) {
  declared_ = std::max(declared_, batch.first_vertex + batch.vertex_count);
}

void FrontMeter::note() {
  statistics_.width = front_.width();
  statistics_.span = front_.span();
  statistics_.cells = std::max(statistics_.cells, live_cells_);
}

void FrontMeter::put(const BatchView& batch) {
  declare(batch);
  for (size_t i = 0; i < batch.cell_count; ++i) {
    const int64_t* corners = batch.cells + 4 * i;
    addCell(corners);
    for (unsigned uses = batch.last_uses ? batch.last_uses[i] & 15u : 0, j = 0; uses >> j; ++j)
      if (uses >> j & 1) finalize(corners[j]);
    statistics_.cells = std::max(statistics_.cells, live_cells_);
  }
  for (size_t i = 0; i < batch.finalized_count; ++i) finalize(batch.finalized[i]);
  note();
}

}  // namespace tetstream
