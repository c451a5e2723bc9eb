#include "sweep_page.h"

#include <algorithm>

#include "look.h"
#include "status.h"

namespace tetstream {

namespace {

constexpr size_t kPanelsInRow = 2;
constexpr Frame kFirstPanel{24, 100, 414, 250};
constexpr double kNextPanel = 438, kNextRow = 292;  // from panel to panel
constexpr double kPageWidth = 900, kPageHeight = 100 + 2 * kNextRow;
constexpr Frame kPage{24, 0, kPageWidth - 48, kPageHeight};

constexpr Colour kToComeColour{0.36, 0.44, 0.56};
constexpr Colour kGoneColour{0.86, 0.88, 0.91};

// What has no light is not quite black.
Colour lit(Colour colour, float light, double darkest) {
  return mixed({0.05, 0.07, 0.12}, colour, darkest + (1 - darkest) * static_cast<double>(light));
}

// Where the mesh is written away one sees through it, as through thin paper.
Colour colourAt(const DepthImage& whole, const DepthImage& left, size_t x, size_t y) {
  constexpr float kTouching = 1;  // pixels: the same surface
  constexpr double kPaper = 0.22;
  if (whole.tag(x, y) == DepthImage::kNothing) return kWhite;
  if (left.tag(x, y) == DepthImage::kNothing) return lit(kGoneColour, whole.light(x, y), 0.8);
  const bool core = left.tag(x, y) == SweepViews::kInCore;
  const Colour seen = lit(core ? kAccent : kToComeColour, left.light(x, y), core ? 0.7 : 0.42);
  const bool behind = whole.depth(x, y) + kTouching < left.depth(x, y);
  return behind ? mixed(seen, kGoneColour, kPaper) : seen;
}

void drawPanel(Canvas& canvas, const Frame& frame, const DepthImage& whole,
               const SweepViews::Moment& moment) {
  Image image(whole.width(), whole.height());
  for (size_t y = 0; y < image.height(); ++y)
    for (size_t x = 0; x < image.width(); ++x) image.set(x, y, colourAt(whole, moment.view, x, y));
  canvas.image(frame, image);
}

void drawLegend(Canvas& canvas, double baseline) {
  const struct {
    Colour colour;
    const char* words;
  } entries[] = {{kGoneColour, "written away"}, {kAccent, "in core"}, {kToComeColour, "to come"}};
  double x = kPage.left;
  for (const auto& entry : entries) {
    canvas.fill(Frame{x, baseline - 9, 10, 10}, entry.colour);
    canvas.text({x + 15, baseline}, entry.words, kTextStyle);
    x += canvas.textWidth(entry.words, kTextStyle) + 36;
  }
}

void drawCaption(Canvas& canvas, const Frame& panel, const SweepViews::Moment& moment) {
  TextStyle style = kTextStyle;
  const std::string read = "after " + grouped(static_cast<int64_t>(moment.cell)) + " cells:  ";
  const Point at{panel.left, panel.bottom() + 16};
  canvas.text(at, read, style);
  style.colour = kAccent;
  canvas.text({at.x + canvas.textWidth(read, style), at.y},
              grouped(static_cast<int64_t>(moment.cells_in_core)) + " cells, " +
                  grouped(static_cast<int64_t>(moment.vertices_in_core)) + " vertices in core",
              style);
}

}  // namespace

void drawSweep(const std::string& path, const SweepViews& views, const DiagramFigures& figures,
               const std::string& title) {
  drawPicture(path, kPageWidth, kPageHeight, [&](Canvas& canvas) {
    drawTitle(canvas, kPage, 36, title);
    canvas.text({kPage.left, 56},
                grouped(figures.cells) + " cells, " + grouped(figures.vertices) +
                    " vertices, front width " + grouped(figures.front.width),
                kTextStyle);
    drawLegend(canvas, 78);
    for (size_t i = 0; i < views.moments().size(); ++i) {
      const size_t row = i / kPanelsInRow, column = i % kPanelsInRow;
      Frame panel = kFirstPanel;
      panel.left += kNextPanel * static_cast<double>(column);
      panel.top += kNextRow * static_cast<double>(row);
      drawPanel(canvas, panel, views.whole(), views.moments()[i]);
      drawCaption(canvas, panel, views.moments()[i]);
    }
  });
}

}  // namespace tetstream
