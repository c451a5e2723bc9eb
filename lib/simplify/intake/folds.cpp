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

// From the edge va into the faces vab and vac, normal to it.
struct IntoFaces {
  double b[3], c[3];
};

template <class S>
static IntoFaces intoFaces(const Window<S>& window, uint32_t v, uint32_t a, uint32_t b,
                           uint32_t c) {
  double along[3];
  IntoFaces into;
  difference(window, a, v, along);
  const auto setNormal = [&](uint32_t to, double out[3]) {
    difference(window, to, v, out);
    const double share = dot(out, along) / dot(along, along);
    for (int i = 0; i < 3; ++i) out[i] -= share * along[i];
  };
  setNormal(b, into.b);
  setNormal(c, into.c);
  return into;
}

// note: of lengths of any unit; the squares' product could be 0.
static double bendOf(const IntoFaces& into) {
  return dot(into.b, into.c) / std::sqrt(dot(into.b, into.b)) / std::sqrt(dot(into.c, into.c));
}

template <class S>
double bendAt(const Window<S>& window, uint32_t v, uint32_t a, uint32_t b, uint32_t c) {
  return bendOf(intoFaces(window, v, a, b, c));
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
      const IntoFaces into = intoFaces(window, v, shared, from_a ? b : a, shared == c ? d : c);
      const bool is_less_than_square = dot(into.b, into.c) > 0;  // as of few
      if (is_less_than_square && isFold(bendOf(into))) return true;
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
