#include "look.h"

#include <algorithm>
#include <cmath>

#include "status.h"

namespace tetstream {

static constexpr const char* kThinSpace = "\xe2\x80\x89";
static constexpr const char* kEllipsis = "\xe2\x80\xa6";

std::string grouped(int64_t count) {
  std::string digits = textOf("%lld", static_cast<long long>(count)), out;
  for (size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0 && digits[i - 1] != '-') out += kThinSpace;
    out += digits[i];
  }
  return out;
}

std::string groupedMean(double number) {
  return number < 1000 ? textOf("%.1f", number) : grouped(std::llround(number));
}

void drawTitle(Canvas& canvas, const Frame& page, double baseline, const std::string& title) {
  const double room = 0.75 * page.width;
  std::string shown = title;
  const auto startOfLetter = [&](size_t at) {
    while (at < title.size() && (title[at] & 0xc0) == 0x80) ++at;
    return std::min(at, title.size());
  };
  for (size_t cut = 0; cut < title.size();) {  // out of its middle
    const double width = canvas.textWidth(shown, kTitleStyle);
    if (width <= room) break;
    cut += 1 + static_cast<size_t>((1 - room / width) * static_cast<double>(title.size() - cut));
    const size_t from = startOfLetter((title.size() - std::min(cut, title.size())) / 2);
    shown = title.substr(0, from) + kEllipsis + title.substr(startOfLetter(from + cut));
  }
  canvas.text({page.left, baseline}, shown, kTitleStyle);
}

// 1, 2 or 5 times a power of ten.
static double roundStep(double step) {
  const double power = std::pow(10, std::floor(std::log10(step)));
  for (double factor : {1.0, 2.0, 5.0})
    if (factor * power >= step) return factor * power;
  return 10 * power;
}

static std::string tickLabel(double at) {
  constexpr struct {
    double size;
    const char* name;
  } kUnits[] = {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}};
  for (const auto& unit : kUnits)
    if (at >= unit.size) return textOf("%g%s%s", at / unit.size, kThinSpace, unit.name);
  return textOf("%g", at);
}

std::vector<Tick> ticksUpTo(double end, int wanted) {
  const double step = roundStep(std::max(end / wanted, 1.0));  // what is counted is whole
  std::vector<Tick> ticks;
  for (double at = 0; at <= end; at += step) ticks.push_back({at, tickLabel(at)});
  return ticks;
}

std::vector<Tick> ticksBetween(double low, double high, int wanted) {
  // Numbers that hardly a digit tells apart are one.
  const double largest = std::max(std::fabs(low), std::fabs(high));
  if (!(high - low > std::max(1e-13 * largest, 1e-300)) || !std::isfinite(high - low))
    return {{low, textOf("%.4g", low)}};
  std::vector<Tick> ticks;
  const double step = roundStep((high - low) / wanted);
  // As many as tell ticks apart, and no power of ten for what is as short in full.
  const auto digitsOf = [](double number) {
    return static_cast<int>(std::ceil(std::log10(number))) + 1;
  };
  const int whole = largest >= 1 && largest < 1e5 ? digitsOf(largest) : 1;
  const int digits = std::clamp(digitsOf(largest / step), whole, 15);
  for (double n = std::ceil(low / step); n * step <= high + 1e-9 * step; ++n)
    ticks.push_back({n * step, textOf("%.*g", digits, n == 0 ? 0.0 : n * step)});
  return ticks;
}

}  // namespace tetstream
