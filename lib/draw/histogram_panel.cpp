#include "histogram_panel.h"

#include <algorithm>
#include <cmath>

#include "colour_map.h"
#include "look.h"
#include "status.h"

namespace tetstream {

namespace {

constexpr int kSteps = ErrorHistogram::kSteps, kPerDecade = ErrorHistogram::kPerDecade;
constexpr double kSeen = 2e-3;   // smaller errors of less than this share are not shown
constexpr double kAbove = 1.08;  // the axis goes so far beyond the tallest bar
constexpr int kMostLabels = 7;   // of decades
constexpr double kNumbers = 10;  // size of what stands at the axes

class HistogramPanel {
 public:
  HistogramPanel(Canvas& canvas, const Frame& frame, const FieldComparison& field, double range)
      : canvas_(canvas),
        frame_(frame),
        field_(field),
        range_(range),
        unit_(range > 0 ? range : 1) {}
  void draw();

 private:
  void sum();
  void chooseSteps();
  void drawBars();
  void drawErrors();
  void drawShares();
  void mark(double error, const char* name);
  const double* volume() const { return field_.histogram.volume; }
  double left(int step) const { return frame_.left + (step - first_) * width_; }

  Canvas& canvas_;
  const Frame frame_;
  const FieldComparison& field_;
  const double range_, unit_;
  double all_ = 0, most_ = 0;
  int first_ = 0, last_ = kSteps - 1;  // of the steps that are shown, and past them
  double width_ = 0, top_ = 0;         // of a step; of the other axis, in percent
};

void HistogramPanel::draw() {
  TextStyle style = kTextStyle;
  style.colour = kInk;
  style.bold = true;
  canvas_.text({frame_.left - 40, frame_.top - 12}, "d  Volume by error", style);
  sum();
  if (!(all_ > 0 && std::isfinite(all_) && std::isfinite(range_))) return;
  chooseSteps();
  drawBars();
  drawErrors();
  drawShares();
  mark(field_.rms(), "RMS");
  mark(field_.largest, "largest");
}

void HistogramPanel::sum() {
  for (int s = 0; s < kSteps; ++s) {
    all_ += volume()[s];
    most_ = std::max(most_, volume()[s]);
  }
}

// Whole decades, up to the largest error.
void HistogramPanel::chooseSteps() {
  double below = 0;
  while (first_ < last_ && (below += volume()[first_]) < kSeen * all_) ++first_;
  while (last_ > first_ && field_.largest / unit_ < ErrorHistogram::lowerEnd(last_)) --last_;
  first_ -= first_ % kPerDecade;
  last_ += kPerDecade - last_ % kPerDecade;
  width_ = frame_.width / (last_ - first_);
  top_ = 100 * most_ / all_ * kAbove;
}

void HistogramPanel::drawBars() {
  for (int s = first_; s < last_; ++s) {
    const double height = frame_.height * 100 * volume()[s] / all_ / top_;
    canvas_.fill(Frame{left(s) + 0.4, frame_.bottom() - height, width_ - 0.8, height},
                 fieldColour(0.32));
  }
  canvas_.line({{frame_.left, frame_.top},
                {frame_.left, frame_.bottom()},
                {frame_.right(), frame_.bottom()}},
               kHair, kInk);
}

// The axis below.
void HistogramPanel::drawErrors() {
  TextStyle style = kTextStyle;
  style.size = kNumbers;
  style.anchor = 0.5;
  const int decades = (last_ - first_) / kPerDecade, skip = decades > kMostLabels ? 2 : 1;
  for (int d = 0; d <= decades; ++d) {
    const double x = left(first_ + d * kPerDecade), y = frame_.bottom();
    canvas_.line({{x, y}, {x, y + 3}}, kHair, kInk);
    const double percent = 100 * ErrorHistogram::lowerEnd(first_ + d * kPerDecade);
    if (d % skip == 0) canvas_.text({x, y + 14}, textOf("%.4g", percent), style);
  }
  const double middle = frame_.left + frame_.width / 2;
  canvas_.text({middle, frame_.bottom() + 31}, "error, percent of the range", style);
}

// The axis to the left.
void HistogramPanel::drawShares() {
  TextStyle style = kTextStyle;
  style.size = kNumbers;
  style.anchor = 1;
  for (const Tick& tick : ticksBetween(0, top_, 4)) {
    const double y = frame_.bottom() - frame_.height * tick.at / top_;
    canvas_.line({{frame_.left - 3, y}, {frame_.left, y}}, kHair, kInk);
    canvas_.text({frame_.left - 6, y + 3.5}, tick.label + " %", style);
  }
}

void HistogramPanel::mark(double error, const char* name) {
  if (!(error > 0 && std::isfinite(error))) return;
  if (error < ErrorHistogram::lowerEnd(first_) * unit_) return;  // not shown
  const double step = std::log10(error / unit_ / ErrorHistogram::kLowest) * kPerDecade;
  const double x =
      frame_.left + std::clamp(step - first_, 0.0, static_cast<double>(last_ - first_)) * width_;
  canvas_.line({{x, frame_.top - 2}, {x, frame_.bottom()}}, 1, kAccent, true);
  TextStyle style = kTextStyle;
  style.size = kNumbers;
  style.colour = kAccent;
  style.anchor = 0.5;
  canvas_.text({x, frame_.top - 6}, name, style);
}

}  // namespace

void drawHistogram(Canvas& canvas, const Frame& frame, const FieldComparison& field, double range) {
  HistogramPanel(canvas, frame, field, range).draw();
}

}  // namespace tetstream
