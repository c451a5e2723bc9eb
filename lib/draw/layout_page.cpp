#include "layout_page.h"

#include <algorithm>
#include <cmath>

#include "look.h"
#include "status.h"

namespace tetstream {

namespace {

constexpr Frame kWithinMargins{24, 0, 852, 724};  // what is between the margins
constexpr Frame kDiagram{84, 96, 792, 470};       // the lines of the vertices
constexpr Frame kStrip{84, 580, 792, 88};         // the width of the front
constexpr double kCurve = 1.1;                    // the width of its line
constexpr Colour kPlate{1, 1, 1, 0.88};           // below words that lie on lines
constexpr size_t kFewColumns = 300;               // so few are drawn as steps
constexpr size_t kFineImage = 900;                // so many places are not seen one by one

// A share of 0 is white. A single line among many must still be seen, so any other has some tone.
double toneOf(float covered) {
  constexpr double kFaintest = 0.13, kGamma = 0.5;
  return covered > 0 ? kFaintest + (1 - kFaintest) * std::pow(covered, kGamma) : 0;
}

class LayoutPage {
 public:
  LayoutPage(Canvas& canvas, const LayoutDiagram& diagram)
      : canvas_(canvas), diagram_(diagram), figures_(diagram.figures()) {}
  void draw(const std::string& title);

 private:
  // From cells and vertices to the page.
  double across(double cell) const {
    return kDiagram.left + kDiagram.width * cell / static_cast<double>(figures_.cells);
  }
  double down(double vertex) const {
    return kDiagram.top + kDiagram.height * vertex / static_cast<double>(figures_.vertices);
  }
  double high(double width) const { return kStrip.bottom() - kStrip.height * width / stripTop(); }
  double cellsPerColumn() const { return static_cast<double>(diagram_.cellsPerColumn()); }
  double stripTop() const { return 1.12 * static_cast<double>(figures_.front.width); }

  void drawHead(const std::string& title);
  void drawRaster();
  void separateLines();
  void drawAxes();
  void drawFrame(const Frame& frame);
  template <class Value>
  std::vector<Point> curve(Value&& value) const;
  void drawFront();
  size_t widestColumn() const;
  void drawWidest();
  void drawStrip();

  Canvas& canvas_;
  const LayoutDiagram& diagram_;
  const DiagramFigures& figures_;
};

void LayoutPage::drawHead(const std::string& title) {
  drawTitle(canvas_, kWithinMargins, 36, title);
  canvas_.text({kWithinMargins.left, 56},
               grouped(figures_.cells) + " cells, " + grouped(figures_.vertices) + " vertices",
               kTextStyle);
  const FrontStatistics& front = figures_.front;
  TextStyle style = kTextStyle;
  style.colour = kAccent;
  const std::string words = "front: width " + grouped(front.width) + ", mean " +
                            groupedMean(figures_.mean_width) + "; span " + grouped(front.span) +
                            ", mean " + groupedMean(figures_.mean_span) + "; " +
                            grouped(front.cells) + " cells";
  canvas_.text({kWithinMargins.left, 74}, words, style);
  canvas_.text({kWithinMargins.left + canvas_.textWidth(words, style), 74},
               ".  A vertex lives " + groupedMean(figures_.mean_life) + " cells, " +
                   grouped(figures_.longest_life) + " at most",
               kTextStyle);
}

// Few places become blocks: whoever shows the picture would blur them.
void LayoutPage::drawRaster() {
  const size_t columns = diagram_.columns(), rows = diagram_.rows();
  const size_t wide = (kFineImage + columns - 1) / columns, tall = (kFineImage + rows - 1) / rows;
  Image image(columns * wide, rows * tall);
  for (size_t y = 0; y < image.height(); ++y)
    for (size_t x = 0; x < image.width(); ++x)
      image.set(x, y,
                mixed(kWhite, kInk, toneOf(diagram_.coverage()[y / tall * columns + x / wide])));
  const double right = across(static_cast<double>(columns) * cellsPerColumn());
  const double bottom =
      down(static_cast<double>(rows) * static_cast<double>(diagram_.verticesPerRow()));
  canvas_.image({kDiagram.left, kDiagram.top, right - kDiagram.left, bottom - kDiagram.top}, image);
  // The last column and row may stand for less than the others: what is too much is wiped off.
  canvas_.fill(Frame{kDiagram.right(), 0, right - kDiagram.left, bottom}, kWhite);
  canvas_.fill(Frame{0, kDiagram.bottom(), right, bottom - kDiagram.top}, kWhite);
}

// Where each vertex has a row that can be seen, its line is one.
void LayoutPage::separateLines() {
  constexpr size_t kMostLines = 120;
  constexpr double kRowGap = 0.15;  // of a row
  const size_t rows = diagram_.rows();
  if (diagram_.verticesPerRow() > 1 || rows > kMostLines) return;
  const double gap = kRowGap * kDiagram.height / static_cast<double>(rows);
  for (size_t r = 1; r < rows; ++r)
    canvas_.fill(Frame{kDiagram.left, down(static_cast<double>(r)) - gap / 2, kDiagram.width, gap},
                 kWhite);
}

void LayoutPage::drawFrame(const Frame& f) {
  canvas_.line({{f.left, f.top}, {f.left, f.bottom()}, {f.right(), f.bottom()}}, kHair, kInk);
}

void LayoutPage::drawAxes() {
  TextStyle style = kTextStyle;
  style.anchor = 0.5;
  for (const Tick& tick : ticksUpTo(static_cast<double>(figures_.cells), 10)) {
    const double x = across(tick.at);
    canvas_.line({{x, kDiagram.bottom()}, {x, kDiagram.bottom() + 4}}, kHair, kInk);
    canvas_.line({{x, kStrip.bottom()}, {x, kStrip.bottom() + 4}}, kHair, kInk);
    canvas_.text({x, kStrip.bottom() + 17}, tick.label, style);
  }
  canvas_.text({kStrip.left + kStrip.width / 2, kStrip.bottom() + 36},
               "cells, in order of the stream", style);
  style.upwards = true;
  canvas_.text({kWithinMargins.left + 8, kDiagram.top + kDiagram.height / 2},
               "vertices, in order of the stream", style);
  canvas_.text({kWithinMargins.left + 8, kStrip.top + kStrip.height / 2}, "active", style);
  style.upwards = false;
  style.anchor = 1;
  for (const Tick& tick : ticksUpTo(static_cast<double>(figures_.vertices), 6)) {
    const double y = down(tick.at);
    canvas_.line({{kDiagram.left - 4, y}, {kDiagram.left, y}}, kHair, kInk);
    canvas_.text({kDiagram.left - 8, y + 4}, tick.label, style);
  }
  for (const Tick& tick : ticksUpTo(static_cast<double>(figures_.front.width), 2)) {
    const double y = high(tick.at);
    canvas_.line({{kStrip.left - 4, y}, {kStrip.left, y}}, kHair, kInk);
    canvas_.text({kStrip.left - 8, y + 4}, tick.label, style);
  }
}

// value(column) as a height on the page.
template <class Value>
std::vector<Point> LayoutPage::curve(Value&& value) const {
  std::vector<Point> points;
  const double width = cellsPerColumn();
  const auto cells = static_cast<double>(figures_.cells);
  const bool steps = diagram_.columns() <= kFewColumns;
  for (size_t c = 0; c < diagram_.columns(); ++c) {
    const double from = static_cast<double>(c) * width, to = std::min(from + width, cells);
    const double y = value(diagram_.front()[c]);
    points.push_back({across(steps ? from : (from + to) / 2), y});
    if (steps) points.push_back({across(to), y});
  }
  return points;
}

// Thinner where the front is narrow, so as not to hide what is between.
void LayoutPage::drawFront() {
  const double band = kDiagram.height * figures_.mean_span / static_cast<double>(figures_.vertices);
  const double width = std::clamp(band / 6, 0.35, kCurve);
  canvas_.line(curve([&](const DiagramColumn& c) { return down(static_cast<double>(c.lowest)); }),
               width, kAccent);
  canvas_.line(
      curve([&](const DiagramColumn& c) { return down(static_cast<double>(c.newest + 1)); }), width,
      kAccent);
}

// Of the columns of the greatest width, the one nearest to the middle.
size_t LayoutPage::widestColumn() const {
  const auto distance = [&](size_t c) {
    const size_t middle = diagram_.columns() / 2;
    return c < middle ? middle - c : c - middle;
  };
  size_t best = static_cast<size_t>(figures_.widest_cell / diagram_.cellsPerColumn());
  for (size_t c = 0; c < diagram_.columns(); ++c)
    if (diagram_.front()[c].width == diagram_.front()[best].width && distance(c) < distance(best))
      best = c;
  return best;
}

// The front where it is widest. Its words stand where there is no line: below the newest vertex, to
// the left; or, where that is too narrow, at the bottom. In a bad order there is no such place:
// they have a plate.
void LayoutPage::drawWidest() {
  const size_t column = widestColumn();
  const DiagramColumn& front = diagram_.front()[column];
  const double width = cellsPerColumn();
  const double x = across((static_cast<double>(column) + 0.5) * width);
  const double top = down(static_cast<double>(front.lowest));
  const double bottom = down(static_cast<double>(front.newest + 1));
  canvas_.line({{x, kDiagram.top}, {x, kStrip.bottom()}}, kHair, kAccent, true);
  canvas_.line({{x, top}, {x, bottom}}, 2.4, kAccent);
  const std::string words = grouped(front.width) + " active vertices";
  TextStyle style = kTextStyle;
  style.colour = kAccent;
  const double length = canvas_.textWidth(words, style), lowest_line = kDiagram.bottom() - 7;
  const bool fits = x - kDiagram.left > length + 12;
  const Point at{fits ? x - 6 - length : x + 6,
                 fits ? std::min(bottom + 15, lowest_line) : lowest_line};
  canvas_.fill(Frame{at.x - 3, at.y - 11, length + 6, 15}, kPlate);
  canvas_.text(at, words, style);
}

void LayoutPage::drawStrip() {
  std::vector<Point> top =
      curve([&](const DiagramColumn& c) { return high(static_cast<double>(c.width)); });
  std::vector<Point> area = top;
  area.push_back({top.back().x, kStrip.bottom()});
  area.push_back({top.front().x, kStrip.bottom()});
  canvas_.fill(area, mixed(kWhite, kInk, 0.25));
  canvas_.line(top, kHair, kInk);
  const double mean = high(figures_.mean_width);
  canvas_.line({{kStrip.left, mean}, {kStrip.right(), mean}}, kHair, kAccent, true);
  TextStyle style = kTextStyle;
  style.colour = kAccent;
  style.anchor = 1;
  canvas_.text({kStrip.right() - 2, mean - 4}, "mean", style);
}

void LayoutPage::draw(const std::string& title) {
  drawHead(title);
  if (figures_.cells > 0) {
    drawRaster();
    separateLines();
    drawStrip();
    drawFront();
    drawWidest();
    drawAxes();
  }
  drawFrame(kDiagram);
  drawFrame(kStrip);
}

}  // namespace

void drawLayout(const std::string& path, const LayoutDiagram& diagram, const std::string& title) {
  drawPicture(path, kWithinMargins.width + 2 * kWithinMargins.left, kWithinMargins.height,
              [&](Canvas& canvas) { LayoutPage(canvas, diagram).draw(title); });
}

}  // namespace tetstream
