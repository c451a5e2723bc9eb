// simplify/select: the quadrics of a patch, made anew. Depends on sheet_quadrics.h.
//
// A quadric that is only ever added to tells the error against the cells that were read, however
// far the mesh has left them behind: their linear fields are continued over cells in which the
// field is another. Made anew from the cells as they are it tells the error that the next step adds
// (memoryless simplification: Lindstrom and Turk 1998, for surfaces), and knows of nothing else.
#pragma once

#include <vector>

#include "patch.h"
#include "sheet_quadrics.h"

namespace tetstream {

template <class S>
class Renewal {
 public:
  Renewal(Core<S>& core, Patch<S>& patch, Account& account)
      : core_(core), patch_(patch), rows_of_(account), faces_(account, 256) {}

  // Those of owned vertices that are stale become the sums over the cells, faces of sheets and
  // edges of curves that there are. The errors made before are forgotten.
  void renewStale();

 private:
  bool findStale();
  bool isStale(uint32_t v) const { return rows_of_[v] < patch_.ownedEnd(); }
  S* rowOf(uint32_t v) { return patch_.quadric(rows_of_[v]); }
  void takeCell(uint32_t c);
  void addTaken();
  void addCell(const uint32_t* corners);
  void takeFaces(uint32_t c);
  void addSheets();
  void addSheetFace(const uint64_t* found, size_t cells);
  bool isLabelled(const uint32_t cells[2], const uint32_t corners[3]) const;
  void addCurves();

  // An edge of a curve that has a stale end, lower number first; as found from each of its faces.
  struct CurveEdge {
    uint32_t a, b;
    bool inner;
    auto operator<=>(const CurveEdge&) const = default;
  };

  Core<S>& core_;
  Patch<S>& patch_;
  Array<uint32_t> rows_of_;  // of each vertex: itself where it is stale, else the row of no use
  uint32_t corners_[4 * kCellLanes], rows_[4 * kCellLanes];  // of the cells taken
  int taken_ = 0;
  Array<uint64_t> faces_;  // between vertices of sheets: numbers, rising, and cell
  size_t face_count_ = 0;
  std::vector<CurveEdge> curves_;
};

}  // namespace tetstream
