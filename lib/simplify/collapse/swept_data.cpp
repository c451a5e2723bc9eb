#include "swept_data.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

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
    const auto cell = static_cast<uint32_t>(cells_.size());
    addSide(kind, cell, pairOf(s.t[0], s.t[1]), swept[0]);
    addSide(kind, cell, pairOf(s.t[1], s.t[2]), swept[1]);
    addSide(kind, cell, pairOf(s.t[2], s.t[0]), swept[2]);
    const double volume = sign * after;
    cells_.push_back({s.cell, false, row, volume - (swept[0] + swept[1] + swept[2]), volume});
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
    const auto cell = static_cast<uint32_t>(cells_.size());
    addSide(kOfU, cell, pairOf(a, b), sign * of_u);
    addSide(kOfV, cell, pairOf(a, b), -sign * of_v);
    addSide(kOfBoth, cell, a, sign * with_a);
    addSide(kOfBoth, cell, b, -sign * with_b);
    cells_.push_back({s.cell, true, at.mesh.cellMeans(s.cell), sign * whole, 0});
  }
}

void SweptData::start(size_t sides) {
  cells_.clear();
  sides_.clear();
  pairs_.clear();
  const size_t places = std::bit_ceil(2 * sides + 2);
  place_of_.assign(places, 0);
}

void SweptData::addSide(Kind kind, uint32_t cell, uint64_t others, double gain) {
  const auto number = static_cast<uint32_t>(sides_.size());
  sides_.push_back({others, kind, cell, gain, false});
  const size_t mask = place_of_.size() - 1;
  for (size_t at = ((others + kind) * uint64_t{0x9e3779b97f4a7c15} >> 32) & mask;;
       at = (at + 1) & mask) {
    if (place_of_[at] == 0) {
      place_of_[at] = number + 1;
      return;
    }
    Side& other = sides_[place_of_[at] - 1];
    if (other.is_met || other.others != others || other.kind != kind) continue;
    other.is_met = sides_.back().is_met = true;
    pairs_.insert(pairs_.end(), {place_of_[at] - 1, number});
    return;
  }
}

void SweptData::addFlow(uint32_t from, uint32_t to, double volume) {
  if (volume < 0) {
    std::swap(from, to);
    volume = -volume;
  }
  if (!(volume > 0)) return;
  if (!isRegion(from)) cells_[from].out += volume;
  if (!isRegion(to)) cells_[to].in += volume;
  if (leavesAsItWas(from, to)) cells_[from].own -= volume;
  (isRegion(to)      ? into_regions_
   : cells_[to].dies ? into_dying_
                     : into_kept_)
      .push_back({from, to, volume});
}

uint32_t SweptData::regionOf(const Cell& cell, const CellLabels& labels) {
  size_t r = 0;
  while (r < regions_.size() && labels.count > 0 && labels.differ(regions_[r], cell.cell)) ++r;
  if (r == regions_.size()) regions_.push_back(cell.cell);
  return static_cast<uint32_t>(cells_.size() + r);
}

// Each face that two cells of one region share; the others of cells that stay are the region's, and
// so is what is left of those that die.
void SweptData::listFlows(const CellLabels& labels) {
  into_dying_.clear();
  into_regions_.clear();
  into_kept_.clear();
  regions_.clear();
  for (Cell& cell : cells_) cell.own = cell.before;
  for (size_t i = 0; i < pairs_.size(); i += 2) {
    Side &a = sides_[pairs_[i]], &b = sides_[pairs_[i + 1]];
    if (labels.count == 0 || !labels.differ(cells_[a.cell].cell, cells_[b.cell].cell))
      addFlow(b.cell, a.cell, a.gain);
    else
      a.is_met = b.is_met = false;
  }
  for (const Side& side : sides_)
    if (!side.is_met && !cells_[side.cell].dies)
      addFlow(regionOf(cells_[side.cell], labels), side.cell, side.gain);
  for (uint32_t c = 0; c < cells_.size(); ++c)
    if (const Cell& cell = cells_[c]; cell.dies && cell.before + cell.in > cell.out)
      addFlow(c, regionOf(cell, labels), cell.before + cell.in - cell.out);
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
    if (!as_it_was && !(mixed_volume_[flow.from] > 0)) continue;  // nothing has come in
    const double* const from = &(as_it_was ? old_ : mixed_)[flow.from * means_];
    double* const to = &mixed_[flow.to * means_];
    const double share = flow.volume / (mixed_volume_[flow.to] += flow.volume);
    for (size_t i = 0; i < means_; ++i) to[i] = meanOf(to[i], from[i], share);
  }
}

// A cell that loses more than it has gives what comes in besides, which is not followed: what the
// region has too much then, or too little, is taken from all within the range of what was there.
void SweptData::repair(size_t mean, uint32_t region, const CellLabels& labels) {
  const auto isIn = [&](const Cell& cell) {
    return labels.count == 0 || !labels.differ(cell.cell, region);
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

void SweptData::repair(const CellLabels& labels) {
  if (std::none_of(cells_.begin(), cells_.end(), [](const Cell& c) { return c.own < 0; })) return;
  for (const Cell& cell : cells_) regionOf(cell, labels);
  for (uint32_t region : regions_)
    for (size_t i = 0; i < means_; ++i) repair(i, region, labels);
}

template <class Mesh>
void SweptData::handOver(Mesh& mesh, uint32_t u, uint32_t v, const Stars& stars,
                         const double place[3], double scale, const CellLabels& labels, int means) {
  means_ = static_cast<size_t>(means);
  start(3 * (stars.u.size() + stars.v.size()) + 4 * stars.ring.size());
  const Places<Mesh> at{mesh, place, scale};
  listKept(at, u, stars.u, kOfU);
  listKept(at, v, stars.v, kOfV);
  listDying(at, u, v, stars.ring);
  listFlows(labels);
  copyMeans();
  mix(into_dying_);
  mix(into_regions_);
  mix(into_kept_);
  repair(labels);
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
