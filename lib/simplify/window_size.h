// simplify: how many cells the window holds, by the front and the memory budget. Depends on core.h.
#pragma once

#include "core.h"

namespace tetstream {

constexpr int64_t kFrontsPerWindow = 4;
// Of such a front, as streams of 2e8 cells have: its window takes some 70 MB. What stays in it is
// looked at again at every turn, which is less beside what is new where there are two fronts more:
// 14 % of the time of two threads at a ratio of 0.01. Errors are those of four, as no more stays.
// Of 1e9 cells with four components six fronts would take 260 MB, these less than 256.
constexpr int64_t kWideFront = 1 << 18, kQuarterFrontsOfWide = 23;

constexpr auto kMostCells = static_cast<int64_t>(Topology::kMost);  // of any window

// What the map from ranks to slots should expect: the span, unless few of its vertices are active.
uint64_t expectedSpan(const Schema& schema);

// Of a window of so many cells.
size_t verticesOf(int64_t cells);

class WindowSize {
 public:
  // What a run takes for a cell of its window, and for a vertex of a patch, in bytes.
  WindowSize(const Schema& schema, const SimplifyOptions& options, int64_t cell_bytes,
             int64_t patch_vertex_bytes)
      : schema_(schema),
        options_(options),
        cell_bytes_(cell_bytes),
        patch_vertex_bytes_(patch_vertex_bytes) {}

  int64_t cellBytes() const { return cell_bytes_; }
  // Patches, worked on at a time, that fit beside all else that a run takes without a budget; half
  // of the budget is kept free.
  int64_t sparePatches() const;
  // Whether there is a budget that the whole does not fit into, or may not.
  bool isTight() const;
  // Cells of the first window. A budget that is smaller than four fronts gets what fits; whether
  // that is enough shows later.
  int64_t first() const;
  // Cells of one that was not asked for, where the front has so many.
  int64_t forFront(int64_t front) const;
  // The cells that the memory budget allows.
  int64_t fitting() const;
  // The cells that a window of so many may come to have: where nobody knows the front, all that
  // fit.
  int64_t foreseen(int64_t cells) const;
  // Bytes of a budget that points of a map beyond those it is made for leave free then.
  int64_t heldBack(int64_t cells) const;
  // Throws kNoMemory: why this budget does not do, and a larger one for a front of so many cells,
  // unless it is not known (0 or less), for vertices that wait for their cells, in bytes, and for a
  // window that was asked for; if there is one.
  [[noreturn]] void fail(const char* why, int64_t front, double waiting) const;
  // The same of a window of so many cells, which the front fills and which may not grow.
  [[noreturn]] void failForFront(int64_t window, int64_t front, double waiting) const;

 private:
  int64_t budgetFor(int64_t front, double waiting) const;
  int64_t knownFront() const;
  bool gainsWhole() const;
  int64_t least() const;

  const Schema& schema_;
  const SimplifyOptions& options_;
  int64_t cell_bytes_, patch_vertex_bytes_;
};

template <class S>
WindowSize windowSize(const Plan& plan, const SimplifyOptions& options) {
  return {plan.schema, options, static_cast<int64_t>(Core<S>::budgetPerCell(plan, options)),
          Core<S>::tileVertexBytes(plan)};
}

}  // namespace tetstream
