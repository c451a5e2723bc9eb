#include "crossing.h"

#include <algorithm>
#include <cmath>

#include "vector3.h"

namespace tetstream {

// Of the least height of a face: a place that is not as far in front of it is beside it. New faces
// turn by less than six degrees then.
constexpr double kInFront = 0.1;
// And one that is this far stays out where not all faces beside are known.
constexpr double kFarInFront = 1;
// Faces that share an edge lie on each other where their normals are farther apart than 178
// degrees; only one that turns by more than 30 can come to that, unless it has folded already.
constexpr double kOnEachOther = -0.9994, kTurnsMuch = 0.866;
// Round one vertex. What has more cells, or faces, or neighbours on the boundary than a link takes,
// is left alone: all pairs of faces are looked at for each edge that is collapsed.
constexpr size_t kMostCells = 200, kMostFaces = 100;

static double cosine(const PlacedFace& a, const PlacedFace& b) {
  const double lengths = std::sqrt(dot(a.normal, a.normal) * dot(b.normal, b.normal));
  return dot(a.normal, b.normal) / lengths;
}

// The faces of the boundary round a centre, which sees them from inside: edges of its link that one
// cell has. Where the star is not whole they may be faces inside, which nothing may cross either.
// Returns whether they are all.
template <class Mesh>
bool BoundaryCrossing<Mesh>::listFaces(uint32_t centre, const Star& star, const Star* more,
                                       Faces& faces) {
  link_.start();
  const uint8_t* const flags = mesh_.allFlags();
  constexpr uint32_t kNoNumber = LinkEdges::kNoNumber;
  for (const Star* part : {&star, more}) {
    if (!part) break;
    for (const StarCell& s : *part) {
      uint32_t n[3];
      for (int k = 0; k < 3; ++k)
        n[k] = flags[s.t[k]] & kBoundary ? link_.numberOf(s.t[k]) : kNoNumber;
      if ((n[0] | n[1]) != kNoNumber) link_.add(n[0], n[1]);
      if ((n[1] | n[2]) != kNoNumber) link_.add(n[1], n[2]);
      if ((n[2] | n[0]) != kNoNumber) link_.add(n[2], n[0]);
    }
  }
  if (!link_.isWhole()) return false;
  link_.forSingle([&](uint32_t from, uint32_t to) { faces.emplace_back(centre, from, to); });
  return true;
}

// Their corners, relative to the new place.
template <class Mesh>
void BoundaryCrossing<Mesh>::put(Faces& faces) const {
  for (PlacedFace& face : faces)
    for (int k = 0; k < 3; ++k) {
      const S* const at = mesh_.values(face.corner[k]);
      for (int x = 0; x < 3; ++x)
        face.at[k][x] = scale_ * (static_cast<double>(at[x]) - origin_[x]);
    }
}

// The faces that go, each once.
template <class Mesh>
void BoundaryCrossing<Mesh>::list(uint32_t u, uint32_t v, const Stars& stars) {
  u_ = u;
  v_ = v;
  gone_.clear();
  is_large_ = stars.u.size() > kMostCells || stars.v.size() > kMostCells;
  is_whole_ = !mesh_.isBoundary(v) || listFaces(v, stars.v, &stars.ring_from_v, gone_);
  std::erase_if(gone_, [u](const PlacedFace& face) { return face.has(u); });
  if (mesh_.isBoundary(u)) is_whole_ &= listFaces(u, stars.u, &stars.ring, gone_);
}

template <class Mesh>
void BoundaryCrossing<Mesh>::addTo(AxisPlanes<S>& planes) const {
  if (!is_whole_) return;
  for (const PlacedFace& face : gone_)
    planes.add(mesh_.values(face.corner[0]), mesh_.values(face.corner[1]),
               mesh_.values(face.corner[2]));
}

// Of the faces that go. Returns how far in front of them the new place lies, at most, of a face's
// least height.
template <class Mesh>
double BoundaryCrossing<Mesh>::putGone() {
  put(gone_);
  double most = 0;
  for (PlacedFace& face : gone_) {
    face.setNormal();
    const double height = dot(face.normal, face.at[0]);
    most = std::max(most, height * face.longest / dot(face.normal, face.normal));
  }
  return most;
}

// All but the ends of the faces that go: where the new place is that of one end, its own faces stay
// as they are, and those of the other reach beyond them.
template <class Mesh>
void BoundaryCrossing<Mesh>::listRim() {
  rim_.clear();
  for (const PlacedFace& face : gone_)
    for (uint32_t x : face.corner)
      if (x != u_ && x != v_) rim_.push_back(x);
  std::sort(rim_.begin(), rim_.end());
  rim_.erase(std::unique(rim_.begin(), rim_.end()), rim_.end());
}

// Whether the rim's vertices have all of their cells here: none is at a seam, of patches or of what
// has been written, or has cells that have not come. (Where a patch touches a locked one, it owns
// the free vertices round that.)
template <class Mesh>
bool BoundaryCrossing<Mesh>::knowsBeside() const {
  const uint8_t* const flags = mesh_.allFlags();
  return std::none_of(rim_.begin(), rim_.end(), [&](uint32_t w) {
    return (flags[w] & (kFinal | kWritten)) != kFinal || mesh_.isFreeElsewhere(w);
  });
}

// The faces round the merged vertex, as u: those that go but for the ones of both ends. Returns
// whether one of them turns by much.
template <class Mesh>
bool BoundaryCrossing<Mesh>::listMade() {
  made_.clear();
  bool turns = false;
  for (const PlacedFace& face : gone_) {
    if (face.has(u_) && face.has(v_)) continue;
    PlacedFace& made = made_.emplace_back(face);
    made.corner[0] = u_;
    std::fill_n(made.at[0], 3, 0.0);
    made.setNormal();
    turns |= !(cosine(made, face) > kTurnsMuch);
  }
  return turns;
}

// Those round the rim that stay, each once.
template <class Mesh>
void BoundaryCrossing<Mesh>::listBeside() {
  beside_.clear();
  seen_.clear();
  for (uint32_t w : rim_) {
    if (!mesh_.gatherOnBoundary(w, kMostCells, star_)) continue;
    const size_t before = beside_.size();
    listFaces(w, star_, nullptr, beside_);
    const auto is_known = [&](const PlacedFace& face) {
      const auto was_seen = [&](uint32_t x) {
        return std::binary_search(seen_.begin(), seen_.end(), x);
      };
      return face.has(u_) || face.has(v_) || was_seen(face.corner[1]) || was_seen(face.corner[2]);
    };
    const auto first = beside_.begin() + static_cast<std::ptrdiff_t>(before);
    beside_.erase(std::remove_if(first, beside_.end(), is_known), beside_.end());
    seen_.push_back(w);
  }
  put(beside_);
  for (PlacedFace& face : beside_) face.setPlane();
}

// Pairs of these faces that cross, and of them and those beside.
template <class Mesh>
size_t BoundaryCrossing<Mesh>::crossings(const Faces& faces) const {
  size_t count = 0;
  for (size_t i = 0; i < faces.size(); ++i) {
    for (size_t j = 0; j < i; ++j) count += cross(faces[i], faces[j]);
    for (const PlacedFace& face : beside_) count += cross(faces[i], face);
  }
  return count;
}

// Edges of these faces at which two of them lie on each other, or one on one beside.
template <class Mesh>
size_t BoundaryCrossing<Mesh>::folds(const Faces& faces) const {
  const auto fold = [](const PlacedFace& a, const PlacedFace& b) {
    const auto common =
        std::count_if(a.corner, a.corner + 3, [&b](uint32_t x) { return b.has(x); });
    return common == 2 && cosine(a, b) < kOnEachOther;
  };
  size_t count = 0;
  for (size_t i = 0; i < faces.size(); ++i) {
    for (size_t j = 0; j < i; ++j) count += fold(faces[i], faces[j]);
    for (const PlacedFace& face : beside_) count += fold(faces[i], face);
  }
  return count;
}

template <class Mesh>
bool BoundaryCrossing<Mesh>::find(const S* place, double scale) {
  if (is_large_) return false;
  scale_ = scale;
  for (int i = 0; i < 3; ++i) origin_[i] = static_cast<double>(place[i]);
  const double in_front = putGone();
  const bool turns = listMade(), is_in_front = in_front > kInFront;
  if ((!turns && !is_in_front) || made_.size() > kMostFaces) return false;
  listRim();
  if (in_front > kFarInFront && !knowsBeside()) return true;
  listBeside();
  if (turns && folds(made_) > folds(gone_)) return true;
  if (!is_in_front) return false;
  for (Faces* faces : {&gone_, &made_})
    for (PlacedFace& face : *faces) face.setPlane();
  const size_t made = crossings(made_);
  return made > 0 && made > crossings(gone_);
}

template class BoundaryCrossing<Window<float>>;
template class BoundaryCrossing<Window<double>>;
template class BoundaryCrossing<Patch<float>>;
template class BoundaryCrossing<Patch<double>>;

}  // namespace tetstream
