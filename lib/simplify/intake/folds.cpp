#include "folds.h"

#include <cmath>
#include <utility>

#include "vector3.h"

namespace tetstream {

template <class S>
static void difference(const Window<S>& window, uint32_t to, uint32_t from, double out[3]) {
  for (int i = 0; i < 3; ++i)
    out[i] =
        static_cast<double>(window.values(to)[i]) - static_cast<double>(window.values(from)[i]);
}

template <class S>
double bendAt(const Window<S>& window, uint32_t v, uint32_t a, uint32_t b, uint32_t c) {
  double along[3], into[2][3];
  difference(window, a, v, along);
  for (int k = 0; k < 2; ++k) {
    difference(window, k == 0 ? b : c, v, into[k]);
    const double share = dot(into[k], along) / dot(along, along);
    for (int i = 0; i < 3; ++i) into[k][i] -= share * along[i];
  }
  // note: of lengths of any unit; the squares' product could be 0.
  return dot(into[0], into[1]) / std::sqrt(dot(into[0], into[0])) /
         std::sqrt(dot(into[1], into[1]));
}

template <class S>
bool hasFold(const Window<S>& window, uint32_t v, const std::vector<uint64_t>& faces) {
  const auto ends = [&](size_t i) {
    return std::pair(static_cast<uint32_t>(faces[i] >> 32), static_cast<uint32_t>(faces[i]));
  };
  for (size_t i = 0; i < faces.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      const auto [a, b] = ends(i);
      const auto [c, d] = ends(j);
      const bool from_a = a == c || a == d;
      if (!from_a && b != c && b != d) continue;
      const uint32_t shared = from_a ? a : b;
      if (isFold(bendAt(window, v, shared, from_a ? b : a, shared == c ? d : c))) return true;
    }
  return false;
}

#define TETSTREAM_FOLDS(S)                                                          \
  template double bendAt(const Window<S>&, uint32_t, uint32_t, uint32_t, uint32_t); \
  template bool hasFold(const Window<S>&, uint32_t, const std::vector<uint64_t>&);
TETSTREAM_FOLDS(float)
TETSTREAM_FOLDS(double)
#undef TETSTREAM_FOLDS

}  // namespace tetstream
