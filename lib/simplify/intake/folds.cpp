#include "folds.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vector3.h"

namespace tetstream {

constexpr size_t kManyFaces = 64;  // of which not all pairs are looked at

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
static bool isFoldAt(const Window<S>& window, uint32_t v, uint32_t a, uint32_t b, uint32_t c) {
  const IntoFaces into = intoFaces(window, v, a, b, c);
  const bool is_less_than_square = dot(into.b, into.c) > 0;  // as of few
  return is_less_than_square && isFold(bendOf(into));
}

static std::pair<uint32_t, uint32_t> endsOf(uint64_t face) {
  return {static_cast<uint32_t>(face >> 32), static_cast<uint32_t>(face)};
}

// The faces by each of their ends: those that share it follow each other.
template <class S>
static bool hasFoldOfMany(const Window<S>& window, uint32_t v, const std::vector<uint64_t>& faces) {
  std::vector<uint64_t> turned(faces);
  for (const uint64_t face : faces) turned.push_back(face << 32 | face >> 32);
  std::sort(turned.begin(), turned.end());
  for (size_t i = 0; i < turned.size(); ++i)
    for (size_t j = i; j-- > 0 && turned[j] >> 32 == turned[i] >> 32;) {
      const auto [shared, b] = endsOf(turned[i]);
      if (isFoldAt(window, v, shared, b, endsOf(turned[j]).second)) return true;
    }
  return false;
}

template <class S>
bool hasFold(const Window<S>& window, uint32_t v, const std::vector<uint64_t>& faces) {
  if (faces.size() > kManyFaces) return hasFoldOfMany(window, v, faces);
  for (size_t i = 0; i < faces.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      const auto [a, b] = endsOf(faces[i]);
      const auto [c, d] = endsOf(faces[j]);
      const bool from_a = a == c || a == d;
      if (!from_a && b != c && b != d) continue;
      const uint32_t shared = from_a ? a : b;
      if (isFoldAt(window, v, shared, from_a ? b : a, shared == c ? d : c)) return true;
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
