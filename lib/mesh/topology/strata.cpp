#include "strata.h"

#include <algorithm>

namespace tetstream {

// By the lower and the higher kind of two ends: what the edge has to lie in.
namespace {
enum class Within { kAnything, kSheet, kCurve };
}
static constexpr Within kWithin[3][3] = {
    // inside            sheet              curve
    {Within::kAnything, Within::kAnything, Within::kAnything},  // inside
    {Within::kAnything, Within::kSheet, Within::kSheet},        // sheet
    {Within::kAnything, Within::kSheet, Within::kCurve},        // curve
};

bool StrataCondition::mayHold(End u, End v, const Star& ring, const Embedded& embedded,
                              bool in_labelled) {
  switch (kWithin[static_cast<int>(u.stratum)][static_cast<int>(v.stratum)]) {
    case Within::kAnything:
      return true;
    case Within::kCurve:
      return embedded.alongCurve(u.vertex, v.vertex);
    case Within::kSheet:
      if (in_labelled || (u.outside && v.outside)) return true;
      for (const StarCell& s : ring)
        if (embedded.labels.differ(ring[0].cell, s.cell)) return true;
      return false;
  }
  return false;
}

// The faces of X2 round an end, sorted: those of one cell only, those of two that differ, and the
// labelled ones.
void StrataCondition::listSheets(const Star& star, const Star& ring, const uint8_t* flags,
                                 const CellLabels& labels, const std::vector<uint64_t>& labelled,
                                 std::vector<uint64_t>& faces) {
  edges_.clear();
  for (const Star* part : {&star, &ring})
    for (const StarCell& s : *part)
      for (int i = 0; i < 3; ++i) {
        const uint32_t a = s.t[i], b = s.t[(i + 1) % 3];
        if ((flags[a] & kOnSheet) && (flags[b] & kOnSheet))
          edges_.push_back({pairOf(a, b), s.cell});
      }
  std::sort(edges_.begin(), edges_.end(),
            [](const Edge& a, const Edge& b) { return a.ends < b.ends; });
  for (size_t i = 0, j; i < edges_.size(); i = j) {
    for (j = i + 1; j < edges_.size() && edges_[j].ends == edges_[i].ends;) ++j;
    if (j - i == 1 || labels.differ(edges_[i].cell, edges_[i + 1].cell) ||
        std::binary_search(labelled.begin(), labelled.end(), edges_[i].ends))
      faces.push_back(edges_[i].ends);
  }
}

// uv is in X2, and the links there have in common what is in the link of uv.
bool StrataCondition::linksAgree(uint32_t v) {
  shared_.clear();
  for (uint64_t face : faces_u_)
    if (lowOf(face) == v || highOf(face) == v)
      shared_.push_back(lowOf(face) == v ? highOf(face) : lowOf(face));
  if (shared_.empty()) return false;
  for (uint64_t face : faces_u_) {
    if (std::binary_search(faces_v_.begin(), faces_v_.end(), face)) return false;
    for (uint32_t a : {lowOf(face), highOf(face)})
      if (a != v && std::find(shared_.begin(), shared_.end(), a) == shared_.end() &&
          holdsVertex(faces_v_, a))
        return false;
  }
  return true;
}

void StrataCondition::list(End u, End v, const Stars& stars, const uint8_t* flags,
                           const Embedded& embedded, const Labelled& labelled) {
  faces_u_.clear();
  faces_v_.clear();
  if (u.stratum != Stratum::kInside)
    listSheets(stars.u, stars.ring, flags, embedded.labels, labelled.u, faces_u_);
  if (v.stratum != Stratum::kInside)
    listSheets(stars.v, stars.ring_from_v, flags, embedded.labels, labelled.v, faces_v_);
}

bool StrataCondition::holds(End u, End v, const Embedded& embedded) {
  if (u.stratum == Stratum::kInside || v.stratum == Stratum::kInside) return true;
  if (!linksAgree(v.vertex)) return false;
  if (u.stratum != Stratum::kCurve || v.stratum != Stratum::kCurve) return true;
  if (!embedded.alongCurve(u.vertex, v.vertex)) return false;
  for (uint32_t a : shared_)
    if (embedded.onCurve(u.vertex, a) && embedded.onCurve(v.vertex, a)) return false;
  return true;
}

}  // namespace tetstream
