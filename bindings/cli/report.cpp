#include "report.h"

#include <algorithm>
#include <cmath>

#include "json.h"
#include "text.h"

namespace tetstream::cli {

static std::string reductionText(int64_t in, int64_t out) {
  return countText(in) + " -> " + countText(out);
}

static std::string rateText(int64_t cells, double seconds) {
  std::string text = textOf("%.2f s", seconds);
  if (seconds > 0) text += ", " + shortCount(static_cast<double>(cells) / seconds) + " cells/s";
  return text;
}

template <class R>
static std::string frontText(const R& r) {
  const std::string cells =
      r.front_cells < 0 ? "cells not known" : countText(r.front_cells) + " cells";
  return "width " + countText(r.front_width) + ", span " + countText(r.front_span) + ", " + cells;
}

static std::string memoryText(const tetstream_report& r) {
  if (r.peak_resident_bytes == 0) return megabytes(r.peak_window_bytes) + " of it window";
  // What the window's arrays have and never touch takes no memory.
  const int64_t window = std::min(r.peak_window_bytes, r.peak_resident_bytes);
  return megabytes(r.peak_resident_bytes) + " at most, " + megabytes(window) + " of it window";
}

static std::string rejectionText(const tetstream_report& r) {
  return countText(r.rejected_orientation) + " orientation, " + countText(r.rejected_link) +
         " topology, " + countText(r.rejected_other) + " other";
}

// Percent of the range: fields with such errors may be of no use, and what is left of the domain
// neither.
constexpr double kLargeError = 20;

// An error above so many times the one that was asked for is no chance of the points at which it is
// estimated.
constexpr double kAboveAsked = 1.1;

static std::string cautionRow(const tetstream_report& r, double asked_error) {
  if (asked_error > 0 && r.estimated_error > kAboveAsked * asked_error)
    return row("caution",
               textOf("the error is above the %.3g %% that it may have: %s", asked_error,
                      r.locked_cells > 0
                          ? "where cells of the input lie on others the values of both count"
                          : "the last collapses made more than all before, a smaller limit ends "
                            "before them"));
  if (r.estimated_error > kLargeError)
    return row("caution",
               "the error is large: `tetstream compare` tells where, more cells make it less");
  return "";
}

// Percent: less than that is within what a boundary of fewer faces may mean.
constexpr double kVolumeChange = 0.1;

static std::string volumeRow(const tetstream_report& r) {
  const double percent = 100 * (r.volume_out - r.volume_in) / r.volume_in;
  if (!std::isfinite(percent) || std::fabs(percent) < kVolumeChange) return "";
  return row("volume", textOf("%.3g %% %s than in the input", std::fabs(percent),
                              percent < 0 ? "less" : "more"));
}

static std::string errorText(double percent) {
  if (std::isnan(percent)) return "no field is measured";
  return textOf("%.3g %% of the range (RMS, estimated)", percent);
}

std::string reportText(const tetstream_report& r, double asked_error) {
  std::string ratio;
  if (r.cells_in > 0)
    ratio =
        textOf(", ratio %.4g", static_cast<double>(r.cells_out) / static_cast<double>(r.cells_in));
  const std::string target = r.target_cells > 0 ? ", target " + countText(r.target_cells) : "";
  std::string text = row("cells", reductionText(r.cells_in, r.cells_out) + ratio + target) +
                     row("vertices", reductionText(r.vertices_in, r.vertices_out)) +
                     row("time", rateText(r.cells_in, r.seconds)) + row("memory", memoryText(r)) +
                     row("window", countText(r.window_cells) + " cells at most") +
                     row("front", frontText(r)) + row("collapses", countText(r.collapses)) +
                     row("rejected", rejectionText(r)) +
                     row("error", errorText(r.estimated_error)) +
                     row("quadric error", textOf("%.6g at most", r.largest_error)) +
                     row("order", oneLine(r.order ? r.order : "")) +
                     row("regions", oneLine(r.regions ? r.regions : ""));
  text += volumeRow(r);
  if (r.balance && *r.balance) text += row("balance", oneLine(r.balance));
  if (r.locked_cells > 0)
    text += row("passed on", countText(r.locked_cells) + " cells, flat or folded in the input");
  if (r.unused_vertices > 0)
    text += row("left out", countText(r.unused_vertices) + " vertices that are in no cell");
  text += cautionRow(r, asked_error);
  if (r.reached && *r.reached) text += row("reached", r.reached);
  if (r.limited_by && *r.limited_by) text += row("limited by", oneLine(r.limited_by));
  return text;
}

std::string layoutText(const tetstream_layout_report& r) {
  std::string text = row("order", oneLine(r.order ? r.order : "")) +
                     row("cells", countText(r.cells)) + row("vertices", countText(r.vertices)) +
                     row("front", frontText(r)) + row("time", rateText(r.cells, r.seconds)) +
                     row("temporary", megabytes(r.temporary_bytes) + " of disk at most");
  if (r.unused_vertices > 0)
    text += row("left out", countText(r.unused_vertices) + " vertices that are in no cell");
  return text;
}

std::string layoutJson(const tetstream_layout_report& r, const std::vector<std::string>& notes) {
  JsonText json;
  json.open('{');
  json.key("order").value(std::string_view(r.order ? r.order : ""));
  json.key("cells").value(r.cells);
  json.key("vertices").value(r.vertices);
  json.key("unused_vertices").value(r.unused_vertices);
  json.key("front_width").value(r.front_width);
  json.key("front_span").value(r.front_span);
  json.key("front_cells").value(r.front_cells);
  json.key("temporary_bytes").value(r.temporary_bytes);
  json.key("seconds").value(r.seconds);
  json.key("notes").values(notes);
  return json.close('}').take();
}

std::string reportJson(const tetstream_report& r, tetstream_status status,
                       const std::vector<std::string>& notes) {
  JsonText json;
  const auto add = [&](const char* name, auto value) { json.key(name).value(value); };
  const auto words = [](const char* text) { return std::string_view(text ? text : ""); };
  json.open('{');
  add("status", words(tetstream_status_name(status)));
  add("cells_in", r.cells_in);
  add("vertices_in", r.vertices_in);
  add("cells_out", r.cells_out);
  add("vertices_out", r.vertices_out);
  add("target_cells", r.target_cells);
  add("window_cells", r.window_cells);
  add("front_width", r.front_width);
  add("front_span", r.front_span);
  add("front_cells", r.front_cells);
  add("collapses", r.collapses);
  add("rejected_orientation", r.rejected_orientation);
  add("rejected_link", r.rejected_link);
  add("rejected_locked", r.rejected_locked);
  add("rejected_other", r.rejected_other);
  add("locked_cells", r.locked_cells);
  add("unused_vertices", r.unused_vertices);
  add("largest_error", r.largest_error);
  add("volume_in", r.volume_in);
  add("volume_out", r.volume_out);
  add("estimated_error", r.estimated_error);
  add("seconds", r.seconds);
  add("peak_window_bytes", r.peak_window_bytes);
  add("peak_resident_bytes", r.peak_resident_bytes);
  add("order", words(r.order));
  add("regions", words(r.regions));
  add("balance", words(r.balance));
  add("reached", words(r.reached));
  add("limited_by", words(r.limited_by));
  json.key("notes").values(notes);
  return json.close('}').take();
}

}  // namespace tetstream::cli
