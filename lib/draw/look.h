// draw: the colours, the letters and the numbers of all pages. Depends on canvas.h.
#pragma once

#include "canvas.h"

namespace tetstream {

constexpr Colour kInk{0.10, 0.16, 0.25};     // lines of the mesh, axes, words
constexpr Colour kMuted{0.42, 0.46, 0.52};   // what is beside the point
constexpr Colour kFaint{0.88, 0.90, 0.92};   // rules, empty ground
constexpr Colour kAccent{0.83, 0.26, 0.16};  // the front

constexpr double kHair = 0.6;  // the width of rules and axes

constexpr TextStyle kTitleStyle{17, kInk, 0, true, false};
constexpr TextStyle kTextStyle{11, kMuted, 0, false, false};

// `share` of the way from a to b.
constexpr Colour mixed(Colour a, Colour b, double share) {
  return {a.red + share * (b.red - a.red), a.green + share * (b.green - a.green),
          a.blue + share * (b.blue - a.blue)};
}

std::string grouped(int64_t count);      // "1 234 567"
std::string groupedMean(double number);  // the same with one digit after the point, if small

// Three quarters of the width of a page for its name: the end of a long one is what matters.
void drawTitle(Canvas& canvas, const Frame& page, double baseline, const std::string& title);

// The places of an axis from 0 to `end` at round numbers, about `wanted`, and what is written
// there: "0", "500 k", "1 M".
struct Tick {
  double at;
  std::string label;
};
std::vector<Tick> ticksUpTo(double end, int wanted);
// The same between two numbers of any size, with as many digits as tell them apart.
std::vector<Tick> ticksBetween(double low, double high, int wanted);

}  // namespace tetstream
