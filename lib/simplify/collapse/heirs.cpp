#include "heirs.h"

#include <cmath>

namespace tetstream {

// A value that is not finite has no part in a mean: the one that weighs more stays.
static double meanOf(double to, double from, double share) {
  const double mean = to + (from - to) * share;
  if (std::isfinite(mean)) return mean;
  return share > 0.5 ? from : to;
}

template <class Mesh>
void Heirs::handOver(Mesh& mesh, uint32_t v, const Stars& stars, int means) {
  find(mesh, v, stars);
  for (const Of& h : heirs_) {
    const double* from = mesh.cellMeans(h.dying);
    for (uint32_t k = 0; k < h.count; ++k) {
      double* to = mesh.cellMeans(h.cell[k]);
      const double share = from[0] / h.count, sum = to[0] + share;
      for (int i = 1; i <= means && sum > 0; ++i) to[i] = meanOf(to[i], from[i], share / sum);
      to[0] = sum;
    }
  }
}

// A bit for each vertex, which others may share: most cells are passed over by these alone.
static uint64_t bitOf(uint32_t vertex) {
  return uint64_t{1} << (vertex & 63);
}

// Lists the cells beside the ring: with two of its vertices, and a few more.
void Heirs::listBeside(uint32_t v, const Stars& stars) {
  uint64_t ring = 0;
  for (const StarCell& dying : stars.ring)
    for (uint32_t t : dying.t) ring |= t == v ? 0 : bitOf(t);
  const auto isIn = [ring](uint32_t t) { return static_cast<unsigned>(ring >> (t & 63) & 1); };
  const size_t most = stars.u.size() + stars.v.size();
  if (beside_.size() < most + 1) beside_.resize(2 * most + 1);
  beside_count_ = 0;
  for (const Star* star : {&stars.u, &stars.v})
    for (const StarCell& s : *star) {
      beside_[beside_count_] = {bitOf(s.t[0]) | bitOf(s.t[1]) | bitOf(s.t[2]), &s};
      beside_count_ += isIn(s.t[0]) + isIn(s.t[1]) + isIn(s.t[2]) > 1;
    }
}

// All of them before any data is touched: that lies outside the patch, and is on its way meanwhile.
template <class Mesh>
void Heirs::find(Mesh& mesh, uint32_t v, const Stars& stars) {
  heirs_.clear();
  listBeside(v, stars);
  for (const StarCell& dying : stars.ring) {
    // Its corners beside u and v.
    const bool is_first = dying.t[0] == v;
    const uint32_t a = dying.t[is_first ? 1 : 0], b = dying.t[is_first || dying.t[1] == v ? 2 : 1];
    const uint64_t both = bitOf(a) | bitOf(b);
    Of& h = heirs_.emplace_back(Of{dying.cell, {}, 0});
    __builtin_prefetch(mesh.cellMeans(h.dying));
    for (size_t i = 0; i < beside_count_; ++i) {
      if ((beside_[i].bits & both) != both || h.count == 2) continue;
      const StarCell& s = *beside_[i].cell;
      if (!s.has(a) || !s.has(b)) continue;
      __builtin_prefetch(mesh.cellMeans(s.cell));
      h.cell[h.count++] = s.cell;
    }
  }
}

template void Heirs::handOver(Window<float>&, uint32_t, const Stars&, int);
template void Heirs::handOver(Window<double>&, uint32_t, const Stars&, int);
template void Heirs::handOver(Patch<float>&, uint32_t, const Stars&, int);
template void Heirs::handOver(Patch<double>&, uint32_t, const Stars&, int);

}  // namespace tetstream
