#include "crossing.h"

#include <algorithm>
#include <cmath>

#include "vertex_pair.h"

namespace tetstream {

// Of the least height of a face: a place that is not as far in front of it is beside it. New faces
// turn by less than three degrees then.
constexpr double kInFront = 0.05;
// Round one vertex. What has more faces, or cells, is left alone: in a fan of n faces all pairs
// would be looked at for each of its n edges.
constexpr size_t kMostFaces = 100, kMostCells = 1000;

// The faces of the boundary round a centre, which sees them from inside: edges of its link that one
// cell has. Where the star is not whole they may be faces inside, which nothing may cross either.
template <class Mesh>
void BoundaryCrossing<Mesh>::listFaces(uint32_t centre, const Star& star, const Star* more,
                                       Faces& faces) {
  edges_.clear();
  const uint8_t* const flags = mesh_.allFlags();
  for (const Star* part : {&star, more}) {
    if (!part) break;
    for (const StarCell& s : *part) {
      const unsigned on[3] = {flags[s.t[0]] & unsigned{kBoundary},
                              flags[s.t[1]] & unsigned{kBoundary},
                              flags[s.t[2]] & unsigned{kBoundary}};
      if (on[0] + on[1] + on[2] < 2 * kBoundary) continue;
      for (int i = 0; i < 3; ++i) {
        const uint32_t a = s.t[i], b = s.t[(i + 1) % 3];
        if (on[i] & on[(i + 1) % 3]) edges_.push_back({pairOf(a, b), a, b});
      }
    }
  }
  std::sort(edges_.begin(), edges_.end(),
            [](const LinkEdge& a, const LinkEdge& b) { return a.pair < b.pair; });
  for (size_t i = 0, next; i < edges_.size(); i = next) {
    for (next = i + 1; next < edges_.size() && edges_[next].pair == edges_[i].pair;) ++next;
    if (next > i + 1) continue;
    PlacedFace& face = faces.emplace_back();
    uint32_t* const corner = face.corner;
    corner[0] = centre;
    corner[1] = edges_[i].from;
    corner[2] = edges_[i].to;
    for (int k = 0; k < 3; ++k)
      for (int x = 0; x < 3; ++x)
        face.at[k][x] = scale_ * (static_cast<double>(mesh_.values(corner[k])[x]) - origin_[x]);
  }
}

// How far the origin lies in front of one of the faces, at most, of its least height.
static double inFrontOf(const std::vector<PlacedFace>& faces) {
  double most = 0;
  for (const PlacedFace& face : faces) {
    double a[3], b[3], edges[3] = {}, square = 0, height = 0;
    for (int i = 0; i < 3; ++i) {
      a[i] = face.at[1][i] - face.at[0][i];
      b[i] = face.at[2][i] - face.at[0][i];
      edges[0] += a[i] * a[i];
      edges[1] += b[i] * b[i];
      edges[2] += (b[i] - a[i]) * (b[i] - a[i]);
    }
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const double normal = a[j] * b[k] - a[k] * b[j];
      square += normal * normal;
      height += normal * face.at[0][i];
    }
    const double longest = std::max({edges[0], edges[1], edges[2]});
    if (height > 0 && square > 0)
      most = std::max(most, height * height * longest / (square * square));
  }
  return std::sqrt(most);
}

// The faces round the merged vertex, as u, and the vertices of their rim.
template <class Mesh>
void BoundaryCrossing<Mesh>::listMade(uint32_t u, const Stars& stars) {
  made_.clear();
  rim_.clear();
  listFaces(u, stars.u, &stars.v, made_);
  for (PlacedFace& face : made_) {
    std::fill_n(face.at[0], 3, 0.0);
    face.bound();
    rim_.insert(rim_.end(), face.corner + 1, face.corner + 3);
  }
  std::sort(rim_.begin(), rim_.end());
  rim_.erase(std::unique(rim_.begin(), rim_.end()), rim_.end());
}

// Each once: by the first of its vertices that is of the rim.
template <class Mesh>
void BoundaryCrossing<Mesh>::listBeside(uint32_t u, uint32_t v) {
  beside_.clear();
  for (uint32_t w : rim_) {
    if (!mesh_.gatherOnBoundary(w, kMostCells, star_)) continue;
    const size_t before = beside_.size();
    listFaces(w, star_, nullptr, beside_);
    const auto is_known = [&](const PlacedFace& face) {
      const auto came = [&](uint32_t x) {
        return x < w && std::binary_search(rim_.begin(), rim_.end(), x);
      };
      return face.has(u) || face.has(v) || came(face.corner[1]) || came(face.corner[2]);
    };
    const auto first = beside_.begin() + static_cast<std::ptrdiff_t>(before);
    beside_.erase(std::remove_if(first, beside_.end(), is_known), beside_.end());
  }
  for (PlacedFace& face : beside_) face.bound();
}

template <class Mesh>
bool BoundaryCrossing<Mesh>::find(uint32_t u, uint32_t v, const Stars& stars, const S* place,
                                  double scale) {
  scale_ = scale;
  for (int i = 0; i < 3; ++i) origin_[i] = static_cast<double>(place[i]);
  gone_.clear();
  if (mesh_.isBoundary(u)) listFaces(u, stars.u, &stars.ring, gone_);
  if (mesh_.isBoundary(v)) listFaces(v, stars.v, &stars.ring_from_v, gone_);
  if (inFrontOf(gone_) <= kInFront) return false;
  listMade(u, stars);
  if (made_.size() > kMostFaces) return false;
  listBeside(u, v);
  for (size_t i = 0; i < made_.size(); ++i) {
    const auto crosses = [&](const PlacedFace& face) { return cross(made_[i], face); };
    const auto next = made_.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    if (std::any_of(next, made_.end(), crosses)) return true;
    if (std::any_of(beside_.begin(), beside_.end(), crosses)) return true;
  }
  return false;
}

template class BoundaryCrossing<Window<float>>;
template class BoundaryCrossing<Window<double>>;
template class BoundaryCrossing<Patch<float>>;
template class BoundaryCrossing<Patch<double>>;

}  // namespace tetstream
