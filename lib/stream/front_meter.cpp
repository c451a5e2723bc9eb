#include "front_meter.h"

#include <algorithm>

#include "status.h"

namespace tetstream {

FrontMeter::FrontMeter(Account& account)
    : front_(account),
      vertex_rows_(account),
      cell_rows_(account),
      block_rows_(account),
      vertices_(account),
      blocks_(account),
      pending_(account) {}

void FrontMeter::introduceUpTo(uint64_t vertex) {
  while (front_.introduced() <= vertex) {
    const uint32_t slot = vertex_rows_.take([this](size_t rows) { vertices_.resize(rows); });
    vertices_[slot] = {kNoBlock, kBlockCells};
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

void FrontMeter::use(Vertex& vertex, uint32_t cell) {
  if (vertex.in_last == kBlockCells) {
    const uint32_t block = block_rows_.take([this](size_t rows) { blocks_.resize(rows); });
    blocks_[block].before = vertex.last_block;
    vertex = {block, 0};
  }
  blocks_[vertex.last_block].cells[vertex.in_last++] = cell;
}

uint32_t FrontMeter::addCell(const int64_t corners[4]) {
  uint32_t slots[4];
  if (!front_.findFour(corners, slots) || !areFour(slots)) findCorners(corners, slots);
  const uint32_t cell = cell_rows_.take([this](size_t rows) {
    const size_t before = pending_.size();
    pending_.resize(rows);
    std::fill(pending_.data() + before, pending_.data() + rows, uint8_t{0});
  });
  pending_[cell] = 4;
  for (uint32_t slot : slots) use(vertices_[slot], cell);
  ++live_cells_;
  ++cells_seen_;
  return cell;
}

// One of its vertices is final.
void FrontMeter::settle(uint32_t cell) {
  if (--pending_[cell] > 0) return;
  cell_rows_.giveBack(cell);
  --live_cells_;
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
  uint32_t count = vertices_[slot].in_last;
  for (uint32_t block = vertices_[slot].last_block; block != kNoBlock; count = kBlockCells) {
    for (uint32_t i = 0; i < count; ++i) settle(blocks_[block].cells[i]);
    block_rows_.giveBack(block);
    block = blocks_[block].before;
  }
  vertex_rows_.giveBack(slot);
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
