#include "thin_counts.h"

#include <algorithm>

#include "thinness.h"

namespace tetstream {

template <class Mesh>
void ThinCounts<Mesh>::start() {
  const size_t cells = mesh_.cellEnd();
  if (known_.size() < cells) known_.resize(cells + cells / 4);
  std::fill_n(known_.data(), cells, uint8_t{0});
  for (const Angle angle : {kFloor, kFirstDear, kLastDear}) cos2_[angle] = angleOf(angle).cos2;
  size_ = cells;
}

// Up to kThinLanes cells; returns how many are below the angle.
template <class Mesh>
size_t ThinCounts<Mesh>::measure(const uint32_t* cells, size_t count, Angle angle) {
  uint32_t corners[kThinLanes][4];
  double thinness[kThinLanes];
  for (size_t i = 0; i < kThinLanes; ++i)
    for (uint32_t j = 0; j < 4; ++j)
      corners[i][j] = mesh_.vertexOf(cells[std::min(i, count - 1)], j);
  thinnessOfFour(mesh_.allValues(), mesh_.valueStride(), corners, thinness);
  size_t thin = 0;
  for (size_t i = 0; i < count; ++i) {
    unsigned known = kKnown;
    for (unsigned a = 0; a < kAngles; ++a) known |= unsigned{thinness[i] > cos2_[a]} << a;
    known_[cells[i]] = static_cast<uint8_t>(known);
    thin += known >> angle & 1;
  }
  return thin;
}

template <class Mesh>
size_t ThinCounts<Mesh>::measureIn(const Star& star, uint32_t centre, Angle angle) const {
  const S* at = mesh_.values(centre);
  const double x[3] = {static_cast<double>(at[0]), static_cast<double>(at[1]),
                       static_cast<double>(at[2])};
  return starShape(x, mesh_.allValues(), mesh_.valueStride(), static_cast<double>(core_.scale[0]),
                   star.begin(), star.size(), angleOf(angle))
      .thin;
}

template <class Mesh>
size_t ThinCounts<Mesh>::countIn(const Star& star, uint32_t centre, Angle angle) {
  if (!remembers()) return measureIn(star, centre, angle);
  if (size_ == 0) start();
  uint32_t unknown[kThinLanes];
  size_t thin = 0, count = 0;
  for (const StarCell& s : star) {
    const unsigned known = known_[s.cell];
    thin += known >> angle & 1;
    if (known & kKnown) continue;
    unknown[count++] = s.cell;
    if (count < kThinLanes) continue;
    thin += measure(unknown, count, angle);
    count = 0;
  }
  return count > 0 ? thin + measure(unknown, count, angle) : thin;
}

template class ThinCounts<Window<float>>;
template class ThinCounts<Window<double>>;
template class ThinCounts<Patch<float>>;
template class ThinCounts<Patch<double>>;

}  // namespace tetstream
