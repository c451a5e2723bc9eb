// simplify/intake: the units of the metric, and the quadrics of what was read. Depends on core.h.
//
// No unit of the user's may change the result. Lengths are divided by a power of two near the
// first cells' edges, so that no product over- or underflows. A field is brought to the extent of
// the mesh (paper, section 3: "normalised to the geometry range"). Where the stream does not say
// its box, or one that is too small, extent and ranges are those met so far; when they grow, the
// quadrics in the window are carried over into the new units. Several fields are weighed against
// each other (field_weights.h).
#pragma once

#include "core.h"

namespace tetstream {

template <class S>
class Metric {
 public:
  explicit Metric(Core<S>& core);

  // Cells [first, end) of the window are new. First the units are chosen.
  void prepare(uint32_t first, uint32_t end);
  // Then all of them, some at a time: their orientation is settled, flat ones are marked, and their
  // quadrics are added. A thread that follows waits for it: it cannot fail.
  void addCells(uint32_t first, uint32_t end) noexcept;
  // In the end the vertices of flat ones are locked.
  void settle(uint32_t first, uint32_t end);

  // Of every dimension: the extent, or the range of the field; 0 of one that is constant.
  std::vector<double> ranges() const;

 private:
  void growBox(uint32_t first, uint32_t end);
  bool liesOutside() const;
  double rangeOf(size_t component) const;  // of the field it belongs to
  ScalarType typeOf(size_t component) const;
  double weightOf(size_t component) const;
  double extent() const;
  double fieldsTogether() const;
  bool canWeighFields(uint32_t cells) const;
  void chooseLengthUnit(uint32_t first, uint32_t end);
  void updateScales();
  void noteVariations();
  void keepRange();
  double slackOf(size_t component) const;
  double largestNumberOf(size_t component) const;
  void rescaleQuadrics(const std::vector<S>& factor);
  double addCell(uint32_t cell, double volume);
  bool addLanes(uint32_t first, double* volume);
  double volumeOf(uint32_t cell, double determinant);
  void lockFlat(uint32_t cell);

  Core<S>& core_;
  bool box_known_, unit_known_ = false;
  double length_unit_ = 1, fields_together_ = 1;
  std::vector<double> low_, high_;  // x y z, then measured components
  std::vector<double> used_range_;  // that the scales were made for; [0]: the extent
};

}  // namespace tetstream
