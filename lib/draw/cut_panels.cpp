#include "cut_panels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "colour_map.h"
#include "look.h"

namespace tetstream {

// Edges are as dark as this where cells are wide, and fade to none where they are no wider than
// kNarrow places.
constexpr double kEdge = 0.55, kNarrow = 3, kWide = 16;
constexpr double kShown = 0.995;  // of the places have errors inside the scale

static double normOf(const float* values, size_t components, const float* less) {
  double square = 0;
  for (size_t c = 0; c < components; ++c) {
    const double d = static_cast<double>(values[c]) - (less ? static_cast<double>(less[c]) : 0);
    square += d * d;
  }
  return std::sqrt(square);
}

static double valueOf(const CutComparison& cut, const float* values) {
  if (cut.components > 1) return normOf(values, cut.components, nullptr);
  return static_cast<double>(values[0]) + cut.zero[0];
}

Scale fieldScale(const CutComparison& cut) {
  Scale scale = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  if (cut.field.empty()) return {0, 1};
  for (const CutImage* image : {cut.original.get(), cut.simplified.get()})
    for (size_t y = 0; y < image->height(); ++y)
      for (size_t x = 0; x < image->width(); ++x) {
        if (!image->cell(x, y)) continue;
        const double value = valueOf(cut, image->values(x, y));
        if (!std::isfinite(value)) continue;  // of a field beyond the range of floats
        scale.low = std::min(scale.low, value);
        scale.high = std::max(scale.high, value);
      }
  return scale.low <= scale.high ? scale : Scale{0, 1};
}

// In percent of the range, at each place that both meshes have.
template <class Visit>
static void forEachError(const CutComparison& cut, double range, Visit&& visit) {
  const CutImage &a = *cut.original, &b = *cut.simplified;
  const double unit = 100 / (range > 0 ? range : 1);
  for (size_t y = 0; y < a.height(); ++y)
    for (size_t x = 0; x < a.width(); ++x)
      if (a.cell(x, y) && b.cell(x, y))
        visit(x, y, unit * normOf(a.values(x, y), cut.components, b.values(x, y)));
}

static double roundedUp(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (double digit : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (digit * power >= value) return digit * power;
  return 10 * power;
}

Scale errorScale(const CutComparison& cut, double range) {
  std::vector<float> errors;
  if (!cut.field.empty())
    forEachError(cut, range, [&](size_t, size_t, double e) {
      if (std::isfinite(e)) errors.push_back(static_cast<float>(e));
    });
  if (errors.empty()) return {0, 1};
  const auto at =
      errors.begin() + static_cast<std::ptrdiff_t>(kShown * static_cast<double>(errors.size() - 1));
  std::nth_element(errors.begin(), at, errors.end());
  const auto shown = static_cast<double>(*at);
  return {0, shown > 0 && std::isfinite(shown) ? roundedUp(shown) : 1};
}

// How dark edges are: by the mean width of the cells.
static double edgeTone(const CutImage& image) {
  double places = 0;
  for (size_t y = 0; y < image.height(); ++y)
    for (size_t x = 0; x < image.width(); ++x) places += image.cell(x, y) != 0;
  const double width =
      std::sqrt(places / static_cast<double>(std::max<uint64_t>(image.cellsCut(), 1)));
  return kEdge * std::clamp((width - kNarrow) / (kWide - kNarrow), 0.0, 1.0);
}

static bool isEdge(const CutImage& image, size_t x, size_t y) {
  const uint32_t cell = image.cell(x, y);
  const bool right = x + 1 < image.width() && image.cell(x + 1, y) != cell;
  return right || (y + 1 < image.height() && image.cell(x, y + 1) != cell);
}

// Dark on light colours, light on dark ones.
static Colour withEdge(const CutImage& image, size_t x, size_t y, Colour colour, double tone) {
  if (!isEdge(image, x, y)) return colour;
  const double lightness = 0.3 * colour.red + 0.6 * colour.green + 0.1 * colour.blue;
  return mixed(colour, lightness < 0.42 ? kWhite : kInk, lightness < 0.42 ? 0.6 * tone : tone);
}

Image fieldPanel(const CutComparison& cut, const CutImage& mesh, const Scale& scale) {
  Image panel(mesh.width(), mesh.height());
  const double tone = edgeTone(mesh);
  for (size_t y = 0; y < mesh.height(); ++y)
    for (size_t x = 0; x < mesh.width(); ++x) {
      Colour colour = kWhite;
      if (mesh.cell(x, y))
        colour =
            cut.field.empty() ? kFaint : fieldColour(scale.share(valueOf(cut, mesh.values(x, y))));
      panel.set(x, y, withEdge(mesh, x, y, colour, tone));
    }
  return panel;
}

Image errorPanel(const CutComparison& cut, double range, const Scale& scale) {
  const CutImage &a = *cut.original, &b = *cut.simplified;
  Image panel(a.width(), a.height());
  const double tone = 0.5 * edgeTone(b);
  const Colour added = cut.is_whole ? kAdded : kWhite;
  for (size_t y = 0; y < a.height(); ++y)
    for (size_t x = 0; x < a.width(); ++x)
      panel.set(x, y,
                a.cell(x, y) == 0   ? (b.cell(x, y) == 0 ? kWhite : added)
                : b.cell(x, y) == 0 ? kLeftOut
                                    : errorColour(0));
  if (!cut.field.empty())
    forEachError(cut, range, [&](size_t x, size_t y, double error) {
      panel.set(x, y, withEdge(b, x, y, errorColour(scale.share(error)), tone));
    });
  return panel;
}

}  // namespace tetstream
