#include "sheets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "folds.h"

namespace tetstream {

template <class S>
const typename Sheets<S>::Use* Sheets<S>::usesOf(uint32_t vertex) const {
  return &*std::lower_bound(uses_.begin(), uses_.end(), vertex,
                            [](const Use& use, uint32_t x) { return use.vertex < x; });
}

constexpr double kNever = 2;  // a cosine that no edge has, whatever its rounding

// In a plane sheet the faces at an edge lead in opposite directions.
template <class S>
Sheets<S>::Sheets(Core<S>& core)
    : core_(core),
      asks_(core.options.feature_angle > 0),
      least_cosine_(core.options.feature_angle < 180
                        ? -std::cos(core.options.feature_angle * std::numbers::pi / 180)
                        : kNever) {}

// Whether the two faces bend at va by as much as was asked for, or fold.
template <class S>
bool Sheets<S>::isRidge(uint32_t v, uint32_t a, const Face& one, const Face& other,
                        bool folds) const {
  const bool may_fold = folds && one.kind == SheetFace::kOuter && other.kind == SheetFace::kOuter;
  if (!asks_ && !may_fold) return false;
  const double bend = bendAt(core_.window, v, a, one.other(a), other.other(a));
  return asks_ ? bend > least_cosine_ : isFold(bend);
}

// An end that was resolved before has told of its curves; it may have moved since.
template <class S>
bool Sheets<S>::isCurve(uint32_t v, uint32_t a, const Use* uses, size_t degree, bool folds) const {
  if (core_.window.mesh.vertexFlags(a) & kResolved) return core_.window.curves.has(v, a);
  return divides(uses, degree) || isRidge(v, a, faces_[uses[0].face], faces_[uses[1].face], folds);
}

// Whether sheets meet at the edge, or faces of different labels.
template <class S>
bool Sheets<S>::divides(const Use* uses, size_t degree) const {
  if (degree != 2) return true;
  const Face &one = faces_[uses[0].face], &other = faces_[uses[1].face];
  return one.labelled != other.labelled || one.label != other.label;
}

// Along faces of the link from one of its vertices to the next node, or once round to the start;
// returns how many.
template <class S>
size_t Sheets<S>::walk(uint32_t from, uint32_t face, uint32_t* end) const {
  const auto is_node = [this](uint32_t x) {
    return std::find(nodes_.begin(), nodes_.end(), x) != nodes_.end();
  };
  uint32_t at = faces_[face].other(from);
  size_t walked = 1;
  for (; at != from && !is_node(at) && walked <= faces_.size(); ++walked) {
    const Use* uses = usesOf(at);
    face = uses[0].face != face ? uses[0].face : uses[1].face;
    at = faces_[face].other(at);
  }
  *end = at;
  return walked;
}

// Whether the sheets cut the link along one circle, or along arcs from one node to the other. All
// vertices but the nodes are on two faces.
template <class S>
bool Sheets<S>::isWhole(const std::vector<uint32_t>& nodes) const {
  const uint32_t from = nodes.empty() ? faces_[0].a : nodes[0];
  const uint32_t to = nodes.empty() ? from : nodes[1];
  size_t walked = 0;
  const Use* const end = uses_.data() + uses_.size();
  for (const Use* use = usesOf(from); use != end && use->vertex == from; ++use) {
    uint32_t reached;
    walked += walk(from, use->face, &reached);
    if (reached != to) return false;
    if (nodes.empty()) break;
  }
  return walked == faces_.size();
}

template <class S>
bool Sheets<S>::classify(uint32_t v, bool folds) {
  uses_.clear();
  nodes_.clear();
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    uses_.push_back({faces_[f].a, f});
    uses_.push_back({faces_[f].b, f});
  }
  std::sort(uses_.begin(), uses_.end(),
            [](const Use& a, const Use& b) { return a.vertex < b.vertex; });
  bool simple = true;
  for (size_t i = 0, j; i < uses_.size(); i = j) {
    const uint32_t a = uses_[i].vertex;
    for (j = i + 1; j < uses_.size() && uses_[j].vertex == a;) ++j;
    if (!isCurve(v, a, &uses_[i], j - i, folds)) {
      simple = simple && j - i == 2;
      continue;
    }
    // A fold that nobody asked for is held by its quadrics, wherever it ends or branches.
    const bool is_stratum = asks_ || divides(&uses_[i], j - i);
    if (is_stratum) nodes_.push_back(a);
    if (core_.window.curves.has(v, a)) continue;
    core_.window.curves.add(v, a, !is_stratum);
    const bool inner = std::any_of(&uses_[i], &uses_[i] + (j - i), [this](const Use& use) {
      return faces_[use.face].kind == SheetFace::kInner;
    });
    Window<S>& window = core_.window;
    const S* x[2] = {window.values(v), window.values(a)};
    S* q[2] = {window.quadric(v), window.quadric(a)};
    addCurveQuadric(core_, x, inner, q);
  }
  return simple && (nodes_.empty() || nodes_.size() == 2) && isWhole(nodes_);
}

template class Sheets<float>;
template class Sheets<double>;

}  // namespace tetstream
