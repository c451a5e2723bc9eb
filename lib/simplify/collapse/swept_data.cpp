#include "swept_data.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "vector3.h"
#include "vertex_pair.h"

namespace tetstream {

// A value that is not finite has no part in a mean: the one that weighs more stays.
static double meanOf(double to, double from, double share) {
  const double mean = to + (from - to) * share;
  if (std::isfinite(mean)) return mean;
  return share > 0.5 ? from : to;
}

namespace {

// Relative to the place where both ends go.
template <class Mesh>
struct Places {
  Mesh& mesh;
  const double* origin;
  double scale;

  void of(uint32_t vertex, double out[3]) const {
    for (int i = 0; i < 3; ++i)
      out[i] = (static_cast<double>(mesh.values(vertex)[i]) - origin[i]) * scale;
  }
};

}  // namespace

// Of five points c x a b d the volumes of the five cells of four sum up to nothing, with signs in
// turn: of the cell c a b d, whose corner c goes to x, each face with c sweeps one of them. All is
// relative to x; volumes are six times what they are.
template <class At>
void SweptData::listKept(const At& at, uint32_t centre, const Star& star, Kind kind) {
  double c[3];
  at.of(centre, c);
  for (const StarCell& s : star) {
    double t[3][3], normal[3][3];
    double* const row = at.mesh.cellMeans(s.cell);
    __builtin_prefetch(row);
    for (int k = 0; k < 3; ++k) at.of(s.t[k], t[k]);
    cross(t[0], t[1], normal[0]);
    cross(t[1], t[2], normal[1]);
    cross(t[2], t[0], normal[2]);
    const double after = dot(normal[0], t[2]), sign = after < 0 ? -1 : 1;
    const double swept[3] = {sign * dot(c, normal[0]), sign * dot(c, normal[1]),
                             sign * dot(c, normal[2])};
    const double volume = sign * after, before = volume - (swept[0] + swept[1] + swept[2]);
    cells_.push_back({s.cell, false, row, before, volume, before, 0});
    addSide(kind, pairOf(s.t[0], s.t[1]), swept[0]);
    addSide(kind, pairOf(s.t[1], s.t[2]), swept[1]);
    addSide(kind, pairOf(s.t[2], s.t[0]), swept[2]);
  }
}

// Of the cells u v a b, in that order; the faces with both ends sweep, too, where x is not on uv.
template <class At>
void SweptData::listDying(const At& at, uint32_t u, uint32_t v, const Star& ring) {
  double ends[2][3], both[3];
  at.of(u, ends[0]);
  at.of(v, ends[1]);
  cross(ends[0], ends[1], both);
  for (const StarCell& s : ring) {
    const int k = s.t[0] == v ? 0 : s.t[1] == v ? 1 : 2;
    const uint32_t a = s.t[(k + 1) % 3], b = s.t[(k + 2) % 3];
    double p[2][3], normal[3];
    at.of(a, p[0]);
    at.of(b, p[1]);
    cross(p[0], p[1], normal);
    const double of_u = dot(ends[0], normal), of_v = dot(ends[1], normal);
    const double with_a = dot(both, p[0]), with_b = dot(both, p[1]);
    const double whole = of_v - of_u + with_b - with_a, sign = whole < 0 ? -1 : 1;
    const double before = sign * whole;
    cells_.push_back({s.cell, true, at.mesh.cellMeans(s.cell), before, 0, before, before});
    addSide(kOfU, pairOf(a, b), sign * of_u);
    addSide(kOfV, pairOf(a, b), -sign * of_v);
    addSide(kOfBoth, a, sign * with_a);
    addSide(kOfBoth, b, -sign * with_b);
  }
}

void SweptData::start(size_t sides, const CellLabels& labels) {
  labels_ = labels;
  cells_.clear();
  opened_.clear();
  into_dying_.clear();
  into_regions_.clear();
  into_kept_.clear();
  regions_.clear();
  const size_t places = std::bit_ceil(2 * sides + 2);
  if (sides_.size() < places || ++round_ == 0) {
    sides_.assign(std::max(places, sides_.size()), Side{});
    round_ = 1;
  }
}

constexpr uint64_t kMet = ~uint64_t{0};  // from both sides

// note: a window has fewer than 2^30 vertices, so that two vertices and a kind fit.
void SweptData::addSide(Kind kind, uint64_t others, double gain) {
  const uint64_t key = others << 2 | kind;
  const auto cell = static_cast<uint32_t>(cells_.size() - 1);
  const size_t mask = sides_.size() - 1;
  for (size_t at = (key * uint64_t{0x9e3779b97f4a7c15} >> 32) & mask;; at = (at + 1) & mask) {
    Side& side = sides_[at];
    if (side.round != round_) {
      side = {key, gain, cell, round_};
      opened_.push_back(at);
      return;
    }
    if (side.key != key) continue;
    side.key = kMet;
    return meet(side.cell, cell, gain);
  }
}

// Through a face that two cells share; between regions it is as one of the boundary.
void SweptData::meet(uint32_t from, uint32_t to, double volume) {
  if (labels_.count == 0 || !labels_.differ(cells_[from].cell, cells_[to].cell))
    return addFlow(from, to, volume);
  leave(from, -volume);
  leave(to, volume);
}

// Through another face. What is left of cells that die is told by all their faces.
void SweptData::leave(uint32_t cell, double gain) {
  if (!cells_[cell].dies) addFlow(regionOf(cells_[cell]), cell, gain);
}

void SweptData::leaveRest() {
  for (size_t at : opened_)
    if (sides_[at].key != kMet) leave(sides_[at].cell, sides_[at].gain);
  for (uint32_t c = 0; c < cells_.size(); ++c)
    if (cells_[c].dies && cells_[c].left > 0) addFlow(c, regionOf(cells_[c]), cells_[c].left);
}

void SweptData::addFlow(uint32_t from, uint32_t to, double volume) {
  const bool is_back = volume < 0;
  const Flow flow = {is_back ? to : from, is_back ? from : to, std::fabs(volume)};
  if (!(flow.volume > 0)) return;
  if (leavesAsItWas(flow.from, flow.to)) cells_[flow.from].own -= flow.volume;
  if (isDying(flow.from)) cells_[flow.from].left -= flow.volume;
  if (isRegion(flow.to)) return into_regions_.push_back(flow);
  if (!cells_[flow.to].dies) return into_kept_.push_back(flow);
  cells_[flow.to].left += flow.volume;
  into_dying_.push_back(flow);
}

uint32_t SweptData::regionOf(const Cell& cell) {
  size_t r = 0;
  while (r < regions_.size() && labels_.count > 0 && labels_.differ(regions_[r], cell.cell)) ++r;
  if (r == regions_.size()) regions_.push_back(cell.cell);
  return static_cast<uint32_t>(r) | kRegion;
}

void SweptData::copyMeans() {
  const size_t all = cells_.size() + regions_.size();
  old_.assign(all * means_, 0);
  mixed_volume_.assign(all, 0);
  for (size_t c = 0; c < cells_.size(); ++c) {
    for (size_t i = 0; i < means_; ++i) old_[c * means_ + i] = cells_[c].row[i + 1];
    mixed_volume_[c] = std::max(cells_[c].own, 0.0);
  }
  mixed_ = old_;
}

void SweptData::mix(const std::vector<Flow>& flows) {
  for (const Flow& flow : flows) {
    const bool as_it_was = leavesAsItWas(flow.from, flow.to);
    const size_t from_row = rowOf(flow.from), to_row = rowOf(flow.to);
    if (!as_it_was && !(mixed_volume_[from_row] > 0)) continue;  // nothing has come in
    const double* const from = &(as_it_was ? old_ : mixed_)[from_row * means_];
    double* const to = &mixed_[to_row * means_];
    const double share = flow.volume / (mixed_volume_[to_row] += flow.volume);
    for (size_t i = 0; i < means_; ++i) to[i] = meanOf(to[i], from[i], share);
  }
}

// A cell that loses more than it has gives what comes in besides, which is not followed: what the
// region has too much then, or too little, is taken from all within the range of what was there.
void SweptData::repair(size_t mean, uint32_t region) {
  const auto isIn = [&](const Cell& cell) {
    return labels_.count == 0 || !labels_.differ(cell.cell, region);
  };
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  double before = 0, after = 0, wanted = 0, there = 0, least = kInfinite, most = -kInfinite;
  for (size_t c = 0; c < cells_.size(); ++c) {
    if (!isIn(cells_[c])) continue;
    const double old = old_[c * means_ + mean];
    before += cells_[c].before;
    after += cells_[c].after;
    wanted += cells_[c].before * old;
    if (!cells_[c].dies) there += cells_[c].after * mixed_[c * means_ + mean];
    least = std::min(least, old);
    most = std::max(most, old);
  }
  const double missing = wanted * (after / before) - there, end = missing > 0 ? most : least;
  const double share = missing / (end * after - there);
  if (!(share > 0)) return;  // nothing is missing, or not finite
  for (size_t c = 0; c < cells_.size(); ++c)
    if (double& value = mixed_[c * means_ + mean]; isIn(cells_[c]))
      value += std::min(share, 1.0) * (end - value);
}

void SweptData::repair() {
  if (std::none_of(cells_.begin(), cells_.end(), [](const Cell& c) { return c.own < 0; })) return;
  for (const Cell& cell : cells_) regionOf(cell);
  for (uint32_t region : regions_)
    for (size_t i = 0; i < means_; ++i) repair(i, region);
}

template <class Mesh>
void SweptData::handOver(Mesh& mesh, uint32_t u, uint32_t v, const Stars& stars,
                         const double place[3], double scale, const CellLabels& labels, int means) {
  means_ = static_cast<size_t>(means);
  start(3 * (stars.u.size() + stars.v.size()) + 4 * stars.ring.size(), labels);
  const Places<Mesh> at{mesh, place, scale};
  listKept(at, u, stars.u, kOfU);
  listKept(at, v, stars.v, kOfV);
  listDying(at, u, v, stars.ring);
  leaveRest();
  copyMeans();
  mix(into_dying_);
  mix(into_regions_);
  mix(into_kept_);
  repair();
  for (size_t c = 0; c < cells_.size(); ++c) {
    if (cells_[c].dies) continue;
    for (size_t i = 0; i < means_; ++i) cells_[c].row[i + 1] = mixed_[c * means_ + i];
    cells_[c].row[0] = cells_[c].after / 6;
  }
}

#define TETSTREAM_SWEPT(Mesh)                                                                 \
  template void SweptData::handOver(Mesh&, uint32_t, uint32_t, const Stars&, const double[3], \
                                    double, const CellLabels&, int);
TETSTREAM_SWEPT(Window<float>)
TETSTREAM_SWEPT(Window<double>)
TETSTREAM_SWEPT(Patch<float>)
TETSTREAM_SWEPT(Patch<double>)
#undef TETSTREAM_SWEPT

}  // namespace tetstream
