#include "depth_image.h"

#include <algorithm>
#include <cmath>

namespace tetstream {

DepthImage::DepthImage(Account& account, size_t width, size_t height)
    : width_(width),
      height_(height),
      depths_(account, width * height),
      tags_(account, width * height) {
  std::fill_n(tags_.data(), tags_.size(), kNothing);
}

void DepthImage::add(const Seen p[4], uint8_t tag) {
  float sum = 0;
  for (int j = 0; j < 4; ++j) sum += p[j].x + p[j].y + p[j].depth;
  if (!std::isfinite(sum)) return;
  for (int j = 0; j < 4; ++j) addFace(p[(j + 1) % 4], p[(j + 2) % 4], p[(j + 3) % 4], tag);
}

// The pixels whose centres are between `low` and `high`, within 0 .. size: [first, end).
static void pixelsBetween(float low, float high, size_t size, size_t* first, size_t* end) {
  const auto limit = static_cast<float>(size);
  *first = static_cast<size_t>(std::ceil(std::clamp(low - 0.5f, 0.0f, limit)));
  *end = static_cast<size_t>(std::floor(std::clamp(high + 0.5f, 0.0f, limit)));
}

// Twice the area of a, b, (x, y).
static float turn(const Seen& a, const Seen& b, float x, float y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

// Most faces of a large mesh meet no centre of a pixel, and are done after the first lines. The
// edges belong to both sides: no gap is left between two faces.
void DepthImage::addFace(const Seen& a, const Seen& b, const Seen& c, uint8_t tag) {
  size_t left, right, top, bottom;
  pixelsBetween(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), width_, &left, &right);
  if (left >= right) return;
  pixelsBetween(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), height_, &top, &bottom);
  const float area = turn(a, b, c.x, c.y);
  if (top >= bottom || area == 0) return;
  for (size_t y = top; y < bottom; ++y)
    for (size_t x = left; x < right; ++x) {
      const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
      const float wa = turn(b, c, px, py) / area, wb = turn(c, a, px, py) / area;
      const float wc = turn(a, b, px, py) / area;
      if (!(wa >= 0 && wb >= 0 && wc >= 0)) continue;
      const float depth = wa * a.depth + wb * b.depth + wc * c.depth;
      const size_t at = y * width_ + x;
      if (tags_[at] != kNothing && depths_[at] <= depth) continue;
      depths_[at] = depth;
      tags_[at] = tag;
    }
}

// The gentler one of the steps to both sides: the other one may lead to another part of the mesh.
float DepthImage::slope(size_t x, size_t y, bool across) const {
  const size_t at = y * width_ + x, step = across ? 1 : width_;
  const size_t place = across ? x : y, size = across ? width_ : height_;
  float best = 0;
  bool found = false;
  const auto offer = [&](float rise) {
    if (found && std::fabs(rise) >= std::fabs(best)) return;
    best = rise;
    found = true;
  };
  if (place > 0 && tags_[at - step] != kNothing) offer(depths_[at] - depths_[at - step]);
  if (place + 1 < size && tags_[at + step] != kNothing) offer(depths_[at + step] - depths_[at]);
  return best;
}

// The surface depth(x, y) faces the eye with (slope x, slope y, 1); light comes from above the
// eye's left shoulder.
float DepthImage::light(size_t x, size_t y) const {
  constexpr float kLight[3] = {-0.37f, -0.56f, 0.74f};
  const float dx = slope(x, y, true), dy = slope(x, y, false);
  const float toward =
      (kLight[0] * dx + kLight[1] * dy + kLight[2]) / std::sqrt(dx * dx + dy * dy + 1);
  return std::max(toward, 0.0f);
}

}  // namespace tetstream
