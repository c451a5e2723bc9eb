// draw: cells seen from far away: of each pixel the nearest one. Depends on base.
#pragma once

#include "memory.h"

namespace tetstream {

// A corner of a cell in pixels from the upper left corner; depth grows away from the eye.
struct Seen {
  float x, y, depth;
};

class DepthImage {
 public:
  static constexpr uint8_t kNothing = 0;

  DepthImage(Account& account, size_t width, size_t height);

  // The pixels whose centres lie inside get `tag`, where nothing is nearer. Cells that have no
  // place, whose coordinates are not finite, are left out.
  void add(const Seen corners[4], uint8_t tag);

  size_t width() const { return width_; }
  size_t height() const { return height_; }
  uint8_t tag(size_t x, size_t y) const { return tags_[y * width_ + x]; }
  float depth(size_t x, size_t y) const { return depths_[y * width_ + x]; }  // where there is a tag
  // How much light the place gets, 0 to 1, by its slope; where there is a tag.
  float light(size_t x, size_t y) const;

 private:
  struct Pixels {
    size_t left, right, top, bottom;  // right and bottom are past the last
    float nearest;                    // depth of what they may show
  };
  Pixels around(const Seen* corners, int count) const;
  bool isOpen(const Pixels& pixels) const;
  void addFace(const Seen face[3], const Seen& fourth, uint8_t tag);
  float slope(size_t x, size_t y, bool across) const;

  size_t width_, height_;
  Array<float> depths_;
  Array<uint8_t> tags_;
};

}  // namespace tetstream
