#include "hub_hulls.h"

#include <algorithm>
#include <cmath>

#include "barycentric.h"
#include "vector3.h"

namespace tetstream {

// In barycentric coordinates. What is no farther beyond a side may touch the cell otherwise than at
// a hub, as for kInside; a hub that is on it is so by rounding, relative to the terms of the sum.
constexpr double kBeyond = 1e-9, kRounding = 1e-14;
// A bound of the distance is as good as this, of the distance, or what so many steps give. Rounding
// puts it above none of those that are found.
constexpr double kGoodBound = 0.7, kBelow = 1 - 1e-12;
constexpr int kMostSteps = 6;

CellSides::CellSides(const double* corners) : upon{corners + 3, corners, corners, corners} {
  CellFrame frame;
  frame.set(corners);
  for (int k = 0; k < 3; ++k) {
    gradient[0][k] = -(frame.row[0][k] + frame.row[1][k] + frame.row[2][k]);
    for (int side = 1; side < 4; ++side) gradient[side][k] = frame.row[side - 1][k];
  }
}

// --------------------------------------------------------------------------------- their making

// A hull with too many hubs is that of their box, too, and so are those that it becomes part of.
void HubHulls::addHub(Hull& hull, uint32_t hub) const {
  const auto end = hull.hubs + hull.count;
  if (std::find(hull.hubs, end, hub) != end) return;
  if (hull.count < kMostHubs) {
    hull.hubs[hull.count++] = static_cast<uint16_t>(hub);
    return;
  }
  for (uint32_t i = 0; i < hull.count; ++i) hull.others.add(this->hub(hull, i));
  hull.others.add(hubs_.place(hub));
  hull.count = 0;
}

void HubHulls::addCorner(Hull& hull, const double place[3]) const {
  const uint32_t hub = hubs_.find(place);
  if (hub == Hubs::kNone)
    hull.others.add(place);
  else
    addHub(hull, hub);
}

void HubHulls::build(const BoxTree& tree, const RowView& rows) {
  hulls_.resize(tree.nodes());
  tree.forEachNodeUp(
      [&](uint32_t node, const uint32_t* items, uint32_t count) {
        Hull hull = {};
        for (uint32_t i = 0; i < count; ++i)
          for (size_t c = 0; c < rows.shape.corners; ++c)
            addCorner(hull, rows.shape.place(rows.row(items[i]), c));
        hulls_[node] = hull;
      },
      [&](uint32_t node, uint32_t child, uint32_t other) {
        Hull hull = hulls_[child];
        hull.others.add(hulls_[other].others);
        for (uint32_t i = 0; i < hulls_[other].count; ++i) addHub(hull, hulls_[other].hubs[i]);
        hulls_[node] = hull;
      });
}

// --------------------------------------------------------------------------------- beyond a side

bool HubHulls::isBeyond(const Hull& hull, const double gradient[3], const double upon[3]) const {
  double most = 0;
  for (int k = 0; k < 3; ++k) {
    const double* const end = gradient[k] > 0 ? hull.others.high : hull.others.low;
    most += gradient[k] * (end[k] - upon[k]);
  }
  if (!(most < -kBeyond)) return false;
  for (uint32_t i = 0; i < hull.count; ++i) {
    double at = 0, terms = 0;
    for (int k = 0; k < 3; ++k) {
      const double term = gradient[k] * (hub(hull, i)[k] - upon[k]);
      at += term;
      terms += std::fabs(term);
    }
    if (!(at <= kRounding * terms)) return false;
  }
  return true;
}

bool HubHulls::isBeyond(uint32_t node, const CellSides& sides) const {
  const Hull& hull = hulls_[node];
  for (int side = 0; hull.count > 0 && side < 4; ++side)
    if (isBeyond(hull, sides.gradient[side], sides.upon[side])) return true;
  return false;
}

// -------------------------------------------------------------------------------- their distance

// Of the hull's corners that which lies least far along.
void HubHulls::leastAlong(const Hull& hull, const double from[3], const double along[3],
                          double out[3]) const {
  double to[3], least;
  for (int k = 0; k < 3; ++k) out[k] = along[k] > 0 ? hull.others.low[k] : hull.others.high[k];
  subtract(out, from, to);
  least = dot(along, to);
  for (uint32_t i = 0; i < hull.count; ++i) {
    subtract(hub(hull, i), from, to);
    if (dot(along, to) >= least) continue;
    least = dot(along, to);
    std::copy_n(hub(hull, i), 3, out);
  }
}

// A point of the hull steps towards the corner that is nearest in the direction of the place, as
// long as that helps (Gilbert, SIAM J. Control 4(1), 1966): beyond the plane through that corner,
// across the direction, lies the whole hull.
double HubHulls::leastSquared(uint32_t node, const double place[3], double within) const {
  const Hull& hull = hulls_[node];
  if (hull.count == 0) return 0;
  double at[3], best = 0;
  std::copy_n(hub(hull, 0), 3, at);
  for (int step = 0; step < kMostSteps; ++step) {
    double away[3], corner[3], to[3];
    subtract(at, place, away);
    leastAlong(hull, place, away, corner);
    subtract(corner, place, to);
    const double square = dot(away, away), along = dot(away, to);
    if (!(square > 0) || (square <= within && std::isfinite(within))) return 0;
    if (along > 0) best = std::max(best, kBelow * along * (along / square));
    if (along > kGoodBound * square) break;
    subtract(corner, at, to);
    const double share = std::min(-dot(away, to) / dot(to, to), 1.0);
    if (!(share > 0)) break;
    for (int k = 0; k < 3; ++k) at[k] += share * to[k];
  }
  return best;
}

}  // namespace tetstream
