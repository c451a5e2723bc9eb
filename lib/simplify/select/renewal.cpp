#include "renewal.h"

#include <algorithm>
#include <utility>

#include "settled.h"

namespace tetstream {

template <class S>
void Renewal<S>::addCell(const uint32_t* corners) {
  const S* x[4];
  S* q[4];
  for (int j = 0; j < 4; ++j) {
    x[j] = patch_.values(corners[j]);
    q[j] = rowOf(corners[j]);
  }
  core_.kernels.addCell(x, core_.scale.data(), core_.plan.dimension, core_.shape_weight, q);
}

template <class S>
void Renewal<S>::addTaken() {
  double determinants[kCellLanes];
  const bool at_once = taken_ == kCellLanes &&
                       core_.kernels.addCells(core_.tableOf(patch_), patch_.quadric(0), corners_,
                                              rows_, core_.scale.data(), core_.plan.dimension,
                                              core_.shape_weight, determinants);
  for (int k = 0; !at_once && k < taken_; ++k) addCell(&corners_[4 * k]);
  taken_ = 0;
}

// The faces of a cell that may be parts of a sheet.
template <class S>
void Renewal<S>::takeFaces(uint32_t c) {
  for (uint32_t j = 0; j < 4; ++j) {
    uint32_t v[3];
    bool on_sheet = true, stale = false;
    for (int k = 0; k < 3; ++k) {
      v[k] = patch_.vertexOf(c, kOpposite[j][k]);
      on_sheet = on_sheet && (patch_.allFlags()[v[k]] & kOnSheet);
      stale = stale || isStale(v[k]);
    }
    if (!on_sheet || !stale) continue;
    if (v[0] > v[1]) std::swap(v[0], v[1]);
    if (v[1] > v[2]) std::swap(v[1], v[2]);
    if (v[0] > v[1]) std::swap(v[0], v[1]);
    if (face_count_ == faces_.size()) faces_.resize(2 * face_count_);
    faces_[face_count_++] = uint64_t{v[0]} << 48 | uint64_t{v[1]} << 32 | v[2] << 16 | c;
  }
}

template <class S>
void Renewal<S>::takeCell(uint32_t c) {
  uint32_t* const v = &corners_[4 * taken_];
  patch_.cornersOf(c, v);
  int on_sheet = 0;
  bool stale = false;
  for (int j = 0; j < 4; ++j) {
    rows_[4 * taken_ + j] = rows_of_[v[j]];
    stale = stale || isStale(v[j]);
    on_sheet += (patch_.allFlags()[v[j]] & kOnSheet) != 0;
  }
  if (!stale) return;
  if (on_sheet >= 3) takeFaces(c);
  if (++taken_ == kCellLanes) addTaken();
}

// `found`: the face as found from each of its cells. All cells of a stale vertex are here.
template <class S>
void Renewal<S>::addSheetFace(const uint64_t* found, size_t cells) {
  const auto v = [found](int k) {
    return static_cast<uint32_t>(found[0] >> (48 - 16 * k) & 0xffff);
  };
  const uint32_t corners[3] = {v(0), v(1), v(2)};
  uint32_t cell[2];
  for (size_t i = 0; i < 2; ++i)
    cell[i] = static_cast<uint32_t>(found[std::min(i, cells - 1)] & 0xffff);
  SheetFace kind = SheetFace::kOuter;
  if (cells == 2) {
    CellLabels labels = core_.cellLabels();
    labels.slots = patch_.cellSlots();
    if (labels.differ(cell[0], cell[1]))
      kind = SheetFace::kInterface;
    else if (isLabelled(cell, corners))
      kind = SheetFace::kInner;
    else
      return;
  }
  const S* x[3];
  S* q[3];
  for (int k = 0; k < 3; ++k) {
    x[k] = patch_.values(corners[k]);
    q[k] = rowOf(corners[k]);
  }
  addFaceQuadric(core_, x, kind, q);
  if (core_.window.curves.empty()) return;
  for (int k = 0; k < 3; ++k) {
    const uint32_t a = std::min(corners[k], corners[(k + 1) % 3]);
    const uint32_t b = std::max(corners[k], corners[(k + 1) % 3]);
    if ((isStale(a) || isStale(b)) && core_.window.curves.has(patch_.slotOf(a), patch_.slotOf(b)))
      curves_.push_back({a, b, kind == SheetFace::kInner});
  }
}

template <class S>
bool Renewal<S>::isLabelled(const uint32_t cells[2], const uint32_t corners[3]) const {
  if (!core_.window.faces.anyPlaced()) return false;
  for (int i = 0; i < 2; ++i) {
    uint32_t j = 0;
    while (std::find(corners, corners + 3, patch_.vertexOf(cells[i], j)) != corners + 3) ++j;
    if (core_.window.faces.labelOf(patch_.cornerSlot(4 * cells[i] + j))) return true;
  }
  return false;
}

template <class S>
void Renewal<S>::addSheets() {
  std::sort(faces_.data(), faces_.data() + face_count_);
  curves_.clear();
  for (size_t i = 0, j; i < face_count_; i = j) {
    for (j = i + 1; j < face_count_ && faces_[j] >> 16 == faces_[i] >> 16;) ++j;
    addSheetFace(&faces_[i], j - i);
  }
}

// An edge is inner if one of its faces is.
template <class S>
void Renewal<S>::addCurves() {
  std::sort(curves_.begin(), curves_.end());
  for (size_t i = 0, j; i < curves_.size(); i = j) {
    const CurveEdge& first = curves_[i];
    for (j = i + 1; j < curves_.size() && curves_[j].a == first.a && curves_[j].b == first.b;) ++j;
    const S* x[2] = {patch_.values(first.a), patch_.values(first.b)};
    S* q[2] = {rowOf(first.a), rowOf(first.b)};
    addCurveQuadric(core_, x, curves_[j - 1].inner, q);
  }
}

template <class S>
bool Renewal<S>::findStale() {
  if (rows_of_.size() < patch_.vertexEnd()) rows_of_.resize(patch_.vertexEnd() + 1024);
  const uint32_t none = patch_.ownedEnd();
  bool any = false;
  for (uint32_t v = 0; v < none; ++v) {
    const bool stale = settledOf(core_.window, patch_.slotOf(v)).stale;
    rows_of_[v] = stale ? v : none;
    any = any || stale;
  }
  std::fill(rows_of_.data() + none, rows_of_.data() + patch_.vertexEnd(), none);
  return any;
}

template <class S>
void Renewal<S>::renewStale() {
  if (!findStale()) return;
  const auto row = static_cast<size_t>(core_.window.shape().quadric);
  for (uint32_t v = 0; v < patch_.ownedEnd(); ++v) std::fill_n(rowOf(v), row, S(0));
  std::fill_n(patch_.quadric(patch_.ownedEnd()), row, S(0));  // of those that are not stale
  face_count_ = 0;
  for (uint32_t c = 0; c < patch_.cellEnd(); ++c)
    if (patch_.isLive(c)) takeCell(c);
  addTaken();
  addSheets();
  addCurves();
}

template class Renewal<float>;
template class Renewal<double>;

}  // namespace tetstream
