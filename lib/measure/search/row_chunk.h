// measure/search: some of the rows in core, to be found by their place. Depends on hub_hulls.h.
#pragma once

#include "hub_hulls.h"

namespace tetstream {

class RowChunk {
 public:
  RowChunk(SimplexRows& rows, uint64_t first, size_t count, Account& account);

  size_t count() const { return count_; }
  const double* row(size_t i) const { return rows_ + i * doubles_; }
  const RowShape& shape() const { return shape_; }
  const BoxTree& tree() const { return *tree_; }
  // Where very many rows meet.
  const Hubs& hubs() const { return *hubs_; }

  // visit(i) for the rows that have something in common with a cell, and for some near it.
  template <class Visit>
  void forEachNear(const double* corners, Visit&& visit) const {
    const Box box = RowShape{4, 0}.boxOf(corners);
    if (hubs_->count() == 0) {
      tree_->forEachNear(box, visit);
      return;
    }
    const CellSides sides(corners);
    tree_->forEachNear(
        box, [&](uint32_t node) { return hulls_->isBeyond(node, sides); }, visit);
  }
  // As the tree's.
  template <class Visit>
  void forEachWithin(const double place[3], double within, Visit&& visit) const {
    if (hubs_->count() == 0) {
      tree_->forEachWithin(place, within, visit);
      return;
    }
    const auto bound = [&](uint32_t node, double distance, double limit) {
      return std::max(distance, hulls_->leastSquared(node, place, limit));
    };
    tree_->forEachWithin(place, within, bound, visit);
  }

  // How many rows a chunk of that many bytes may have; `more`: bytes that the user adds to each.
  static size_t rowsFor(const SimplexRows& rows, size_t bytes, size_t more);

 private:
  RowShape shape_;
  size_t count_, doubles_;
  Array<double> copy_;  // unless the rows are in core anyway
  const double* rows_;
  std::unique_ptr<Hubs> hubs_;
  std::unique_ptr<BoxTree> tree_;
  std::unique_ptr<HubHulls> hulls_;  // where there are hubs
};

// visit(chunk) for all rows, in as few chunks as the bytes allow; stops for no rows.
template <class Visit>
void forEachChunk(SimplexRows& rows, size_t bytes, size_t more, Account& account, Visit&& visit) {
  const size_t at_once = RowChunk::rowsFor(rows, bytes, more);
  for (uint64_t first = 0; first < rows.count(); first += at_once) {
    const uint64_t left = rows.count() - first;
    const RowChunk chunk(rows, first, left < at_once ? static_cast<size_t>(left) : at_once,
                         account);
    visit(chunk);
  }
}

}  // namespace tetstream
