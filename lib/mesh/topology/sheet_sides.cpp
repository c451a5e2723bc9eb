#include "sheet_sides.h"

#include <algorithm>
#include <numeric>

#include "vertex_pair.h"

namespace tetstream {

void SheetSides::addFaces(const StarCell& cell, uint32_t place) {
  for (int i = 0; i < 3; ++i)
    faces_.push_back({pairOf(cell.t[i], cell.t[(i + 1) % 3]), cell.cell, place});
}

uint32_t SheetSides::first(uint32_t place) {
  while (above_[place] != place) place = above_[place] = above_[above_[place]];
  return place;
}

// The cells on both sides of each listed face that is in no sheet.
void SheetSides::join(const CellLabels& labels, const std::vector<uint64_t>& labelled) {
  std::sort(faces_.begin(), faces_.end(),
            [](const Face& a, const Face& b) { return a.link < b.link; });
  for (size_t i = 0; i + 1 < faces_.size(); ++i) {
    const Face &a = faces_[i], &b = faces_[i + 1];
    if (a.link != b.link || labels.differ(a.cell, b.cell)) continue;
    if (std::binary_search(labelled.begin(), labelled.end(), a.link)) continue;
    const uint32_t x = first(a.place), y = first(b.place);
    above_[std::max(x, y)] = std::min(x, y);
  }
}

size_t SheetSides::find(const Stars& stars, const CellLabels& labels,
                        const StrataCondition::Labelled& labelled) {
  const auto ring = static_cast<uint32_t>(stars.u.size());
  const auto v = static_cast<uint32_t>(ring + stars.ring.size());
  above_.resize(v + stars.v.size());
  std::iota(above_.begin(), above_.end(), 0u);
  faces_.clear();
  for (uint32_t c = 0; c < ring; ++c) addFaces(stars.u[c], c);
  for (uint32_t c = ring; c < v; ++c) addFaces(stars.ring[c - ring], c);
  join(labels, labelled.u);
  faces_.clear();
  for (uint32_t c = v; c < above_.size(); ++c) addFaces(stars.v[c - v], c);
  for (const StarCell& s : stars.ring_from_v) {
    uint32_t place = ring;
    while (stars.ring[place - ring].cell != s.cell) ++place;
    addFaces(s, place);
  }
  join(labels, labelled.v);
  uint32_t parts = 0;
  part_.resize(above_.size());
  for (uint32_t place = 0; place < above_.size(); ++place) {
    const uint32_t f = first(place);
    part_[place] = f == place ? parts++ : part_[f];
  }
  return parts;
}

}  // namespace tetstream
