#include "colour_map.h"

#include <algorithm>
#include <cmath>

#include "look.h"

namespace tetstream {

template <size_t N>
static Colour between(const Colour (&stops)[N], double share) {
  const double at = (share > 0 ? std::min(share, 1.0) : 0) * (N - 1);  // what is no number is 0
  const size_t first = std::min(static_cast<size_t>(at), N - 2);
  return mixed(stops[first], stops[first + 1], at - static_cast<double>(first));
}

Colour fieldColour(double share) {
  static constexpr Colour kStops[] = {{0.15, 0.12, 0.34}, {0.17, 0.27, 0.52}, {0.14, 0.43, 0.58},
                                      {0.17, 0.58, 0.57}, {0.35, 0.72, 0.49}, {0.66, 0.83, 0.41},
                                      {0.97, 0.92, 0.55}};
  return between(kStops, share);
}

Colour errorColour(double share) {
  static constexpr Colour kStops[] = {{0.99, 0.99, 0.98}, {0.99, 0.90, 0.72}, {0.97, 0.73, 0.46},
                                      {0.91, 0.50, 0.28}, {0.75, 0.26, 0.19}, {0.45, 0.09, 0.16}};
  return between(kStops, share);
}

}  // namespace tetstream
