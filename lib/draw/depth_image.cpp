#include "depth_image.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetstream {

// Faces reach so far past their edges, as a share of their height: rounding leaves no gaps.
static constexpr float kBeyondEdge = 1e-4f;

DepthImage::DepthImage(Account& account, size_t width, size_t height)
    : width_(width),
      height_(height),
      depths_(account, width * height),
      tags_(account, width * height) {
  std::fill_n(tags_.data(), tags_.size(), kNothing);
  std::fill_n(depths_.data(), depths_.size(), std::numeric_limits<float>::infinity());
}

// How many pixels of 0 .. size have centres up to `place`.
static size_t pixelsUpTo(float place, size_t size) {
  return static_cast<size_t>(std::clamp(place + 0.5f, 0.0f, static_cast<float>(size)));
}

// Those whose centres may be inside the corners; none if anything is not finite.
DepthImage::Pixels DepthImage::around(const Seen* corners, int count) const {
  Seen low = corners[0], high = corners[0];
  float sum = 0;
  for (int j = 0; j < count; ++j) {
    const Seen& p = corners[j];
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.depth, p.depth)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), 0};
    sum += p.x + p.y + p.depth;
  }
  if (!std::isfinite(sum)) return {0, 0, 0, 0, 0};
  return {pixelsUpTo(low.x, width_), pixelsUpTo(high.x, width_), pixelsUpTo(low.y, height_),
          pixelsUpTo(high.y, height_), low.depth};
}

// Whether something may be seen there that is no nearer than pixels.nearest.
bool DepthImage::isOpen(const Pixels& pixels) const {
  for (size_t y = pixels.top; y < pixels.bottom; ++y)
    for (size_t x = pixels.left; x < pixels.right; ++x)
      if (pixels.nearest < depths_[y * width_ + x]) return true;
  return false;
}

// Most cells of a large mesh meet no centre of a pixel, or are hidden: done at once.
void DepthImage::add(const Seen corners[4], uint8_t tag) {
  if (!isOpen(around(corners, 4))) return;
  for (int j = 0; j < 4; ++j) {
    const Seen face[3] = {corners[(j + 1) % 4], corners[(j + 2) % 4], corners[(j + 3) % 4]};
    addFace(face, corners[j], tag);
  }
}

namespace {

// 0 on the line through a and b, 1 at c, linear.
struct Weight {
  Weight(const Seen& a, const Seen& b, const Seen& c) {
    x = a.y - b.y;
    y = b.x - a.x;
    constant = -(x * a.x + y * a.y);
    const float at_c = x * c.x + y * c.y + constant;
    x /= at_c;
    y /= at_c;
    constant /= at_c;
  }
  float at(float px, float py) const { return x * px + y * py + constant; }
  float x, y, constant;
};

}  // namespace

// Of a face that does not look away from the eye: the fourth corner is behind it. Its edges belong
// to both sides, so that no gap is left between two faces. note: a face seen from its edge has
// weights that are not finite, and is in no pixel.
void DepthImage::addFace(const Seen face[3], const Seen& fourth, uint8_t tag) {
  const Seen &a = face[0], &b = face[1], &c = face[2];
  const Weight of_a(b, c, a), of_b(c, a, b);
  const auto depthAt = [&](float wa, float wb) {
    return c.depth + wa * (a.depth - c.depth) + wb * (b.depth - c.depth);
  };
  if (depthAt(of_a.at(fourth.x, fourth.y), of_b.at(fourth.x, fourth.y)) > fourth.depth) return;
  const Pixels pixels = around(face, 3);
  for (size_t y = pixels.top; y < pixels.bottom; ++y)
    for (size_t x = pixels.left; x < pixels.right; ++x) {
      const size_t at = y * width_ + x;
      if (depths_[at] <= pixels.nearest) continue;
      const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
      const float wa = of_a.at(px, py), wb = of_b.at(px, py);
      if (!(wa >= -kBeyondEdge && wb >= -kBeyondEdge && wa + wb <= 1 + kBeyondEdge)) continue;
      const float depth = std::max(depthAt(wa, wb), pixels.nearest);
      if (depths_[at] <= depth) continue;
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
