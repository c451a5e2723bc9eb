#include "progress.h"

#include <unistd.h>

#include <algorithm>

#include "process.h"
#include "text.h"

namespace tetstream::cli {

// Ten a second look smooth; a log wants fewer lines.
static constexpr std::chrono::milliseconds kRedraw{100}, kLogInterval{1000};
static constexpr int kBarCharacters = 20;

ProgressBar::ProgressBar(Show show)
    : quiet_(show == Show::kNever),
      terminal_(::isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      drawn_(start_),
      phase_start_(start_) {
  shown_ = show == Show::kAlways || (show == Show::kOnTerminal && terminal_);
}

int32_t ProgressBar::callback(void* user, const tetstream_progress* progress) {
  static_cast<ProgressBar*>(user)->update(*progress);
  return interrupted() ? 1 : 0;
}

// Small files are nobody's concern.
static constexpr int64_t kWorthTelling = int64_t{100} << 20;

void ProgressBar::tellDisk(const tetstream_progress& progress) {
  if (disk_told_ || progress.temporary_bytes < kWorthTelling) return;
  disk_told_ = true;
  printNote("temporary files will take about " +
            megabytes(static_cast<uint64_t>(progress.temporary_bytes)) + " of disk");
}

void ProgressBar::update(const tetstream_progress& progress) {
  if (!quiet_) tellDisk(progress);
  if (!shown_) return;
  const Clock::time_point now = Clock::now();
  const char* phase = progress.phase ? progress.phase : "";
  if (phase_ != phase) {
    if (phase_ == "open") start_ = now;  // whose fraction is its own
    phase_ = phase;
    phase_start_ = now;
    phase_first_cell_ = progress.cells_read;
  }
  if (now - drawn_ < (terminal_ ? kRedraw : kLogInterval)) return;
  drawn_ = now;
  draw(lineOf(progress, now));
}

static double secondsBetween(std::chrono::steady_clock::time_point from,
                             std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

static std::string cellsOf(const tetstream_progress& progress) {
  std::string text = " " + shortCount(static_cast<double>(progress.cells_read));
  if (progress.cells_total >= 0)
    text.append(" of ").append(shortCount(static_cast<double>(progress.cells_total)));
  return text + " cells";
}

std::string ProgressBar::lineOf(const tetstream_progress& progress, Clock::time_point now) const {
  std::string line = phase_;
  const double fraction = std::min(progress.fraction, 1.0);
  if (fraction >= 0) {
    const size_t filled = static_cast<size_t>(fraction * kBarCharacters);
    line += textOf(" %3d%% [", static_cast<int>(fraction * 100));
    line += std::string(filled, '#') + std::string(kBarCharacters - filled, ' ') + "]";
  }
  const double seconds = secondsBetween(phase_start_, now);
  if (phase_ == "write") return line + " for " + clockText(seconds);  // all cells have come
  if (phase_ != "open") line += cellsOf(progress);
  const int64_t cells = progress.cells_read - phase_first_cell_;
  if (seconds > 0 && cells > 0)
    line.append(", ").append(shortCount(static_cast<double>(cells) / seconds)).append("/s");
  if (fraction > 0)
    line.append(", ETA ").append(
        clockText(secondsBetween(start_, now) * (1 - fraction) / fraction));
  return line;
}

void ProgressBar::draw(std::string line) {
  if (!terminal_) {
    printError("tetstream: " + line + "\n");
    return;
  }
  // A line of the full width would wrap.
  line.resize(std::min(line.size(), terminalWidth(STDERR_FILENO) - 1));
  const size_t length = line.size();
  if (length < length_) line.append(length_ - length, ' ');
  length_ = length;
  printError('\r' + line);
}

void ProgressBar::clear() {
  if (length_ == 0) return;
  printError('\r' + std::string(length_, ' ') + '\r');
  length_ = 0;
}

}  // namespace tetstream::cli
