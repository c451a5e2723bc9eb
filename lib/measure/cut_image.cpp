#include "cut_image.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "cell_overlap.h"
#include "status.h"

namespace tetstream {

// The axis and, after "=", the place; false where there is none.
struct CutWord {
  int axis = -1;  // auto
  bool has_place = false;
  double place = 0;
};

static CutWord parseCut(const std::string& word) {
  CutWord cut;
  if (word == "auto") return cut;
  const auto refuse = [&] {
    fail(Status::kBadArgument, "a cut is auto, x, y, z or a plane as x=0.3, not \"%s\"",
         word.c_str());
  };
  if (word.empty() || word[0] < 'x' || word[0] > 'z') refuse();
  cut.axis = word[0] - 'x';
  if (word.size() == 1) return cut;
  cut.has_place = true;
  const char* end = word.data() + word.size();
  if (word[1] != '=') refuse();
  const auto parsed = std::from_chars(word.data() + 2, end, cut.place);
  if (parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(cut.place)) refuse();
  return cut;
}

void checkCut(const std::string& word) {
  parseCut(word);
}

CutPlane cutPlaneOf(const std::string& word, const Box& box) {
  const CutWord cut = parseCut(word);
  int axis = cut.axis;
  if (axis < 0) {
    axis = 2;
    for (int k = 1; k >= 0; --k)
      if (box.high[k] - box.low[k] < box.high[axis] - box.low[axis]) axis = k;
  }
  CutPlane plane = {};
  plane.axis = axis;
  plane.at = cut.has_place ? cut.place : box.low[axis] / 2 + box.high[axis] / 2;
  plane.across = axis == 0 ? 1 : 0;
  plane.up = axis == 2 ? 1 : 2;
  showBox(box, plane);
  return plane;
}

void showBox(const Box& box, CutPlane& plane) {
  const auto size = [&](int k) { return box.high[k] - box.low[k]; };
  if (!(size(plane.across) > 0 && size(plane.up) > 0)) return;
  if (size(plane.up) > 1.5 * size(plane.across)) std::swap(plane.across, plane.up);
  for (int k = 0; k < 2; ++k) {
    plane.low[k] = box.low[k == 0 ? plane.across : plane.up];
    plane.high[k] = box.high[k == 0 ? plane.across : plane.up];
  }
}

// From the places where the plane meets the cells' edges.
Box cutBoxOf(SimplexRows& cells, const CutPlane& plane) {
  Box box;
  for (uint64_t i = 0; i < cells.count(); ++i) {
    const double* p = cells.row(i);
    for (int a = 0; a < 4; ++a)
      for (int b = a + 1; b < 4; ++b) {
        const double from = p[3 * a + plane.axis] - plane.at, to = p[3 * b + plane.axis] - plane.at;
        if ((from < 0) == (to < 0)) continue;
        double place[3];
        for (int k = 0; k < 3; ++k)
          place[k] = p[3 * a + k] + from / (from - to) * (p[3 * b + k] - p[3 * a + k]);
        box.add(place);
      }
  }
  return box;
}

CutImage::CutImage(Account& account, const CutPlane& plane, size_t width, size_t height,
                   const Shown& shown)
    : plane_(plane),
      width_(width),
      height_(height),
      shown_(shown),
      pixel_{(plane.high[0] - plane.low[0]) / static_cast<double>(width),
             (plane.high[1] - plane.low[1]) / static_cast<double>(height)},
      cells_(account, width * height),
      values_(account, width * height * shown.components) {
  std::fill_n(cells_.data(), cells_.size(), 0u);
}

void CutImage::add(SimplexRows& cells) {
  for (uint64_t i = 0; i < cells.count(); ++i) {
    const double* row = cells.row(i);
    const double* p = row + plane_.axis;
    const auto [low, high] = std::minmax({p[0], p[3], p[6], p[9]});
    if (low <= plane_.at && plane_.at <= high) addCell(cells.shape(), row);
  }
}

// Pixels whose centres are in the cell.
void CutImage::addCell(const RowShape& shape, const double* row) {
  CellMap map;
  if (!map.set(row)) return;
  ++cut_;
  const Box box = shape.boxOf(row);
  const auto pixelsOf = [&](int axis, int k, size_t count, size_t& from, size_t& to) {
    const double unit = pixel_[k] > 0 ? 1 / pixel_[k] : 0;
    const auto most = static_cast<double>(count);
    from = static_cast<size_t>(
        std::clamp(std::ceil((box.low[axis] - plane_.low[k]) * unit - 0.51), 0.0, most));
    to = static_cast<size_t>(
        std::clamp(std::floor((box.high[axis] - plane_.low[k]) * unit - 0.49) + 1, 0.0, most));
  };
  size_t left, right, bottom, top;
  pixelsOf(plane_.across, 0, width_, left, right);
  pixelsOf(plane_.up, 1, height_, bottom, top);
  if (right <= left) return;
  for (size_t y = bottom; y < top; ++y) addRow(shape, row, map, y, left, right);
}

// Coordinates in the cell are linear along the pixels: those at the first two of them tell which
// may be in it. One more at each end, for rounding.
static void narrow(const double first[4], const double second[4], size_t& left, size_t& right) {
  const auto count = static_cast<double>(right - left);
  double from = 0, to = count;
  for (int j = 0; j < 4; ++j) {
    const double slope = second[j] - first[j], border = (kInside - first[j]) / slope;
    if (slope > 0) from = std::max(from, std::floor(border));
    if (slope < 0) to = std::min(to, std::floor(border) + 2);
  }
  from = std::min(from, count);
  right = left + static_cast<size_t>(std::max(to, from));
  left += static_cast<size_t>(from);
}

void CutImage::addRow(const RowShape& shape, const double* row, const CellMap& map, size_t y,
                      size_t left, size_t right) {
  double place[3];
  place[plane_.axis] = plane_.at;
  place[plane_.up] = plane_.low[1] + (static_cast<double>(y) + 0.5) * pixel_[1];
  const auto coordinatesAt = [&](size_t x, double at[4]) {
    place[plane_.across] = plane_.low[0] + (static_cast<double>(x) + 0.5) * pixel_[0];
    map.coordinates(place, at);
  };
  constexpr size_t kFew = 4;  // of fewer, each is looked at
  double at[4];
  if (right - left > kFew) {
    double first[4], second[4];
    coordinatesAt(left, first);
    coordinatesAt(left + 1, second);
    narrow(first, second, left, right);
  }
  for (size_t x = left; x < right; ++x) {
    coordinatesAt(x, at);
    if (*std::min_element(at, at + 4) < kInside) continue;
    const size_t pixel = (height_ - 1 - y) * width_ + x;
    cells_[pixel] = static_cast<uint32_t>(cut_);
    float* values = values_.data() + pixel * shown_.components;
    for (size_t c = 0; c < shown_.components; ++c) {
      double value = -shown_.zero[c];
      for (size_t j = 0; j < 4; ++j) value += at[j] * shape.value(row, j)[shown_.first + c];
      values[c] = static_cast<float>(value);
    }
  }
}

}  // namespace tetstream
