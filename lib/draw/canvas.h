// draw: a page to draw on, which becomes an SVG or a PNG file. Depends on base.
//
// Lengths are points from the upper left corner; in a PNG a point is two by two pixels.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tetstream {

struct Point {
  double x, y;
};

struct Frame {
  double left, top, width, height;
  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

struct Colour {
  double red, green, blue, alpha = 1;
};

constexpr Colour kWhite{1, 1, 1};

// A colour of its own for each place.
class Image {
 public:
  Image(size_t width, size_t height) : width_(width), height_(height), pixels_(width * height) {}
  void set(size_t x, size_t y, Colour colour);  // alpha is not looked at
  size_t width() const { return width_; }
  size_t height() const { return height_; }
  const uint32_t* pixels() const { return pixels_.data(); }  // 0x00rrggbb

 private:
  size_t width_, height_;
  std::vector<uint32_t> pixels_;
};

struct TextStyle {
  double size = 11;
  Colour colour = {0, 0, 0};
  double anchor = 0;  // of its width: 0 begins at the place, 0.5 is centred there, 1 ends there
  bool bold = false, upwards = false;
};

class Canvas {
 public:
  virtual ~Canvas() = default;
  virtual void fill(const Frame& frame, Colour colour) = 0;
  virtual void fill(const std::vector<Point>& outline, Colour colour) = 0;
  virtual void line(const std::vector<Point>& path, double width, Colour colour,
                    bool dashed = false) = 0;
  // UTF-8 on one line; what is none is shown as question marks.
  virtual void text(Point at, const std::string& text, const TextStyle& style) = 0;
  virtual double textWidth(const std::string& text, const TextStyle& style) = 0;
  virtual void image(const Frame& frame, const Image& image) = 0;
};

// Throws kUnsupported if the path ends in neither .svg nor .png, or this build draws nothing.
void checkPicture(const std::string& path);

// Draws a page of that size and writes it to `path`, which takes its name when it is complete.
void drawPicture(const std::string& path, double width, double height,
                 const std::function<void(Canvas&)>& draw);

}  // namespace tetstream
