#include "comparison_page.h"

#include <algorithm>
#include <cmath>

#include "colour_map.h"
#include "cut_panels.h"
#include "histogram_panel.h"
#include "look.h"
#include "status.h"

namespace tetstream {

namespace {

constexpr double kMargin = 28, kWidth = 960, kGap = 26;
constexpr double kHead = 78;         // title and what is cut
constexpr double kCaption = 22;      // above a panel
constexpr double kBar = 11;          // thickness of a colour bar
constexpr double kBarRoom = 64;      // of a bar with its numbers and words
constexpr double kFoot = 232;        // histogram and figures
constexpr double kTallest = 400;     // panel
constexpr double kSideBySide = 1.7;  // wider ones stand one upon another
constexpr double kStackTallest = 250, kBeside = 96;
constexpr double kRounding = 1e-10;  // percent: less is no change of a volume that is a sum
constexpr const char* kAxes[] = {"x", "y", "z"};

// Where the three panels lie.
struct Layout {
  bool stacked;
  Frame panels[3];
  double bottom;  // of panels and bars
};

Layout layoutOf(const CutPlane& plane) {
  const double wide = plane.high[0] - plane.low[0], tall = plane.high[1] - plane.low[1];
  const double ratio = std::clamp(wide / tall, 0.05, 20.0);
  Layout out = {};
  out.stacked = ratio > kSideBySide;
  const double inner = kWidth - 2 * kMargin;
  if (out.stacked) {
    double width = inner - kBeside, height = width / ratio;
    if (height > kStackTallest) {
      height = kStackTallest;
      width = height * ratio;
    }
    for (int i = 0; i < 3; ++i)
      out.panels[i] = {kMargin, kHead + kCaption + i * (height + kCaption + 12), width, height};
    out.bottom = out.panels[2].bottom();
    return out;
  }
  double width = (inner - 2 * kGap) / 3, height = width / ratio;
  if (height > kTallest) {
    height = kTallest;
    width = height * ratio;
  }
  const double each = (inner - 2 * kGap) / 3;
  for (int i = 0; i < 3; ++i)
    out.panels[i] = {kMargin + i * (each + kGap) + (each - width) / 2, kHead + kCaption, width,
                     height};
  out.bottom = out.panels[2].bottom() + kBarRoom;
  return out;
}

std::string percentText(double value) {
  return textOf("%.3g %%", value);
}

std::string cpsnrText(double cpsnr) {
  if (std::isnan(cpsnr)) return "none, of a constant field";
  return std::isinf(cpsnr) && cpsnr > 0 ? "no error" : textOf("%.1f dB", cpsnr);
}

// Of both ways the larger ones.
std::string distanceText(const Comparison& c) {
  const DistanceFigures &there = c.toSimplified(), &back = c.toOriginal();
  if (!there.areThere() && !back.areThere()) return c.isWhole() ? "none" : "none in the box";
  const double unit = 100 / (c.diagonal() > 0 ? c.diagonal() : 1);
  return percentText(unit * std::fmax(there.largest, back.largest)) + " of the diagonal at most, " +
         percentText(unit * std::fmax(there.rms, back.rms)) + " RMS";
}

std::string volumeText(const Comparison& c) {
  const double before = c.original().shapes.volume, after = c.simplified().shapes.volume;
  const double compared = c.volumeCompared() > 0 ? c.volumeCompared() : 1;
  const double change = 100 * (after - before) / (before > 0 ? before : 1);
  return (std::fabs(change) < kRounding ? "0 %" : textOf("%+.3g %%", change)) + ", " +
         percentText(100 * c.volumes().outside / compared) +
         (c.isWhole() ? " of the original outside" : " of the part outside");
}

class ComparisonPage {
 public:
  ComparisonPage(Canvas& canvas, const Comparison& comparison)
      : canvas_(canvas),
        comparison_(comparison),
        cut_(*comparison.cut()),
        field_(comparison.firstField()),
        layout_(layoutOf(cut_.plane)),
        range_(field_ ? field_->range : 1),
        values_(fieldScale(cut_)),
        errors_(errorScale(cut_, range_)) {}
  void draw(const std::string& title);

 private:
  void drawHead(const std::string& title);
  void drawPanels();
  void drawPanel(int index, const Image& image, const std::string& caption,
                 const std::string& more);
  void drawBars();
  void drawBar(const Frame& bar, const Scale& scale, Colour (*colour)(double),
               const std::string& words, bool is_open);
  void drawFigures(double left, double top);

  Canvas& canvas_;
  const Comparison& comparison_;
  const CutComparison& cut_;
  const FieldComparison* field_;
  Layout layout_;
  double range_;
  Scale values_, errors_;
};

constexpr double kLeastPlace = 1e-12;  // of the diagonal: less is 0

void ComparisonPage::drawHead(const std::string& title) {
  drawTitle(canvas_, {kMargin, 0, kWidth - 2 * kMargin, 0}, 36, title);
  const CutPlane& plane = cut_.plane;
  const bool is_none = std::fabs(plane.at) < kLeastPlace * comparison_.diagonal();
  std::string words = textOf("Cut at %s = %.5g", kAxes[plane.axis], is_none ? 0 : plane.at);
  if (field_) words += ", coloured by " + field_->name;
  words += textOf("; %s to the right, %s upwards.", kAxes[plane.across], kAxes[plane.up]);
  if (!comparison_.isWhole())
    words += textOf(" A part of the original, %llu cells; topology and shapes are of all.",
                    static_cast<unsigned long long>(comparison_.cellsCompared()));
  canvas_.text({kMargin, 57}, words, kTextStyle);
}

void ComparisonPage::drawPanel(int index, const Image& image, const std::string& caption,
                               const std::string& more) {
  const Frame& frame = layout_.panels[index];
  TextStyle style = kTextStyle;
  style.colour = kInk;
  style.bold = true;
  canvas_.text({frame.left, frame.top - 8}, caption, style);
  const double after = frame.left + canvas_.textWidth(caption, style) + 8;
  canvas_.text({after, frame.top - 8}, more, kTextStyle);
  canvas_.image(frame, image);
}

void ComparisonPage::drawPanels() {
  const auto cells = [](const MeshFigures& mesh) {
    return grouped(mesh.topology.cells) + " cells";
  };
  drawPanel(0, fieldPanel(cut_, *cut_.original, values_), "a  Original",
            cells(comparison_.original()));
  drawPanel(1, fieldPanel(cut_, *cut_.simplified, values_), "b  Simplified",
            cells(comparison_.simplified()));
  drawPanel(2, errorPanel(cut_, range_, errors_), "c  Error",
            field_ ? "|a \xe2\x88\x92 b| in percent of the range" : "there is no common field");
}

void ComparisonPage::drawBar(const Frame& bar, const Scale& scale, Colour (*colour)(double),
                             const std::string& words, bool is_open) {
  constexpr size_t kSteps = 256;
  const bool upright = bar.height > bar.width;
  // Each to the end, the next one upon it: no gap is left between two.
  for (size_t i = 0; i < kSteps; ++i) {
    const double done = static_cast<double>(i) / kSteps;
    const double left = upright ? 0 : done * bar.width, top = upright ? done * bar.height : 0;
    canvas_.fill(Frame{bar.left + left, bar.top + top, bar.width - left, bar.height - top},
                 colour(upright ? 1 - done : done));
  }
  canvas_.line({{bar.left, bar.top},
                {bar.right(), bar.top},
                {bar.right(), bar.bottom()},
                {bar.left, bar.bottom()},
                {bar.left, bar.top}},
               kHair, kInk);
  TextStyle style = kTextStyle;
  style.size = 10;
  style.anchor = upright ? 0 : 0.5;
  for (Tick& tick : ticksBetween(scale.low, scale.high, upright ? 4 : 6)) {
    const double share = scale.share(tick.at);
    if (is_open && share > 1 - 1e-6) tick.label = "\xe2\x89\xa5" + tick.label;
    if (upright) {
      const double y = bar.bottom() - share * bar.height;
      canvas_.line({{bar.right(), y}, {bar.right() + 3, y}}, kHair, kInk);
      canvas_.text({bar.right() + 6, y + 3.5}, tick.label, style);
    } else {
      const double x = bar.left + share * bar.width;
      canvas_.line({{x, bar.bottom()}, {x, bar.bottom() + 3}}, kHair, kInk);
      canvas_.text({x, bar.bottom() + 14}, tick.label, style);
    }
  }
  style = kTextStyle;
  style.anchor = 0.5;
  style.upwards = upright;
  if (upright)
    canvas_.text({bar.right() + 52, bar.top + bar.height / 2}, words, style);
  else
    canvas_.text({bar.left + bar.width / 2, bar.bottom() + 31}, words, style);
}

void ComparisonPage::drawBars() {
  if (!field_) return;
  const Frame &a = layout_.panels[0], &b = layout_.panels[1], &c = layout_.panels[2];
  const std::string name = field_->components > 1 ? "norm of " + field_->name : field_->name;
  const std::string error = "error, percent of the range";
  if (layout_.stacked) {
    const double left = a.right() + 16;
    drawBar({left, a.top, kBar, b.bottom() - a.top}, values_, fieldColour, name, false);
    drawBar({left, c.top, kBar, c.height}, errors_, errorColour, "error, %", true);
    return;
  }
  const double top = a.bottom() + 16;
  drawBar({a.left + a.width / 2, top, b.right() - a.left - a.width / 2 - b.width / 2, kBar},
          values_, fieldColour, name, false);
  drawBar({c.left + 10, top, c.width - 20, kBar}, errors_, errorColour, error, true);
}

void ComparisonPage::drawFigures(double left, double top) {
  const Comparison& c = comparison_;
  const MeshFigures &a = c.original(), &b = c.simplified();
  std::vector<std::pair<std::string, std::string>> rows;
  if (field_) {
    rows.emplace_back("RMS error", percentText(field_->percent(field_->rms())) +
                                       textOf(" of the range %.4g", field_->range));
    rows.emplace_back("Largest error", percentText(field_->percent(field_->largest)));
    rows.emplace_back("CPSNR", cpsnrText(field_->cpsnr()));
  }
  rows.emplace_back("Cells kept",
                    percentText(100 * static_cast<double>(b.topology.cells) /
                                static_cast<double>(std::max<int64_t>(a.topology.cells, 1))));
  rows.emplace_back("Boundary distance", distanceText(c));
  rows.emplace_back("Volume", volumeText(c));
  rows.emplace_back("Topology", c.topologyKept() ? "kept" : "changed");
  rows.emplace_back("Least dihedral angle",
                    textOf("%.3g\xc2\xb0 (%.3g\xc2\xb0 before), %.3g %% below 10\xc2\xb0",
                           b.shapes.least_angle, a.shapes.least_angle, 100 * b.shapes.below_10));
  if (!c.regions().empty()) {
    size_t changed = 0;
    for (const RegionComparison& r : c.regions()) changed += r.original.parts != r.simplified.parts;
    rows.emplace_back("Regions", textOf("%zu, parts changed in %zu", c.regions().size(), changed));
  }
  TextStyle name = kTextStyle, value = kTextStyle;
  value.colour = kInk;
  for (const auto& [what, how] : rows) {
    canvas_.text({left, top}, what, name);
    canvas_.text({left + 126, top}, how, value);
    canvas_.line({{left, top + 5.5}, {kWidth - kMargin, top + 5.5}}, 0.4, kFaint);
    top += 19;
  }
}

void ComparisonPage::draw(const std::string& title) {
  drawHead(title);
  drawPanels();
  drawBars();
  const double top = layout_.bottom + 46;
  const double half = kWidth / 2 - kMargin;
  if (field_) drawHistogram(canvas_, {kMargin + 40, top, half - 64, 120}, *field_, range_);
  drawFigures(kMargin + half + 24, top - 12);
}

}  // namespace

void drawComparison(const std::string& path, const Comparison& comparison,
                    const std::string& title) {
  checkPicture(path);
  if (!comparison.cut())
    fail(Status::kUnsupported, "the original has no extent across the cut: there is no picture");
  const Layout layout = layoutOf(comparison.cut()->plane);
  drawPicture(path, kWidth, layout.bottom + kFoot,
              [&](Canvas& canvas) { ComparisonPage(canvas, comparison).draw(title); });
}

}  // namespace tetstream
