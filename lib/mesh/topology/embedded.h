// mesh/topology: what is embedded in the cells and must keep its topology: sheets, where cells of
// different labels or the outside meet or a face is labelled, and curves in them. Depends on
// curves.h.
#pragma once

#include "curves.h"

namespace tetstream {

// The lowest stratum that a vertex lies in. Corners, where curves end or branch, are locked.
enum class Stratum : uint8_t { kInside, kSheet, kCurve };

// The labels of the window's cells, in rows of integers of which some columns count.
struct CellLabels {
  const int64_t* rows = nullptr;
  size_t stride = 0;
  const int* columns = nullptr;
  int count = 0;
  const uint32_t* slots = nullptr;  // of the cells of a patch, in the window; null: their own

  const int64_t* rowOf(uint32_t cell) const { return rows + (slots ? slots[cell] : cell) * stride; }
  bool differ(const int64_t* a, const int64_t* b) const {
    for (int i = 0; i < count; ++i)
      if (a[columns[i]] != b[columns[i]]) return true;
    return false;
  }
  bool differ(uint32_t a, uint32_t b) const { return differ(rowOf(a), rowOf(b)); }
};

struct Embedded {
  CellLabels labels;
  const Curves* curves = nullptr;
  bool inner_sheets = false;        // there are labelled faces between cells of one label
  const uint32_t* slots = nullptr;  // of the vertices of a patch, in the window; null: their own

  // Whether there is more than the boundary of the domain.
  bool any() const { return labels.count > 0 || inner_sheets || (curves && !curves->empty()); }
  uint32_t slotOf(uint32_t v) const { return slots ? slots[v] : v; }
  Stratum stratumOf(uint32_t v, bool on_sheet) const {
    if (!on_sheet) return Stratum::kInside;
    return curves && curves->passes(slotOf(v)) ? Stratum::kCurve : Stratum::kSheet;
  }
  bool onCurve(uint32_t u, uint32_t v) const { return curves && curves->has(slotOf(u), slotOf(v)); }
  // Whether two vertices of curves may become one, as far as the edge between them tells.
  bool alongCurve(uint32_t u, uint32_t v) const {
    return curves && curves->leads(slotOf(u), slotOf(v));
  }
};

}  // namespace tetstream
