// cli: the line that says how far a run is, and the way a signal stops it. Depends on process.h.
#pragma once

#include <tetstream/tetstream.h>

#include <chrono>
#include <string>

namespace tetstream::cli {

// On a terminal one line that is drawn over and over; elsewhere, if asked for, lines. Before them,
// unless nothing is shown at all, what large temporary files will take.
class ProgressBar {
 public:
  enum class Show { kNever, kOnTerminal, kAlways };
  explicit ProgressBar(Show show);
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // For the library, with a ProgressBar as `user`.
  static int32_t callback(void* user, const tetstream_progress* progress);
  // Removes the line; the next draw, if any, starts a new one.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  void update(const tetstream_progress& progress);
  void tellDisk(const tetstream_progress& progress);
  std::string lineOf(const tetstream_progress& progress, Clock::time_point now) const;
  void draw(std::string line);

  bool quiet_, shown_, terminal_, disk_told_ = false;
  Clock::time_point start_, drawn_, phase_start_;
  std::string phase_;
  int64_t phase_first_cell_ = 0;
  size_t length_ = 0;  // of the line on the terminal
};

}  // namespace tetstream::cli
