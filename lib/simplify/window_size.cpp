#include "window_size.h"

#include <algorithm>
#include <limits>
#include <string>

#include "status.h"

namespace tetstream {

// A window holds at least this many cells, some tiles: smaller ones save no memory worth having.
constexpr int64_t kLeastWindow = 1 << 17, kLeastPaperWindow = 1 << 14;
// A mesh of so many cells is held whole: finding out about it beforehand would take as much. Larger
// ones have 0.93 times the RMS error that a window and a sample leave (eight generated meshes of
// 5e5 and 1e6 cells at 0.1; 0.95 to 1.03 times from 0.05 to 0.01, but a fifth where a field is zero
// nearly everywhere), and at 0.5 0.77 times (eighteen of 2.7e5 to 9e5 cells: 0.11 to 1.11), in as
// much time, with 75 MB for 1e6. Up to an error they leave 0.65 to 1.01 times the cells, in 1.0 to
// 1.6 times the time.
constexpr int64_t kSmallMesh = 1 << 18, kLargestWhole = 1 << 20;
// Of the paper's modes, without knowledge of the front: it grows as the front is met.
constexpr int64_t kFirstPaperWindow = 32768;
// A header that claims more is not believed: the window grows when such a front comes.
constexpr int64_t kWidestFront = 1 << 23;
// Of a memory budget, not for cells and vertices: stars, lists; a patch beside. Thin meshes of
// 10,000 to 60,000 cells take up to 0.1 MB more, of budgets of 1 to 2 MB; with that off them all,
// windows of little more than a front, as of a ball of 1e5 cells in 1.2 MB, would miss targets.
constexpr int64_t kFixedBytes = 400 << 10;
constexpr int64_t kSpareBytes = 256 << 10;  // of a budget that is told to users
constexpr int64_t kLargestTold = int64_t{1} << 50;
constexpr int64_t kUnknownCells = 4096;  // of a window, where nobody knows the front
constexpr int64_t kMapBytes = 16;        // a rank of the span: the next power of two of 8 bytes
constexpr int64_t kLeastCells = 64;
constexpr int64_t kRoomyHalfFronts = 5;  // of a window that is not mostly front

uint64_t expectedSpan(const Schema& schema) {
  if (schema.front_span < 0) return 0;
  const int64_t most = 1 << 20;  // a header that claims more is not believed: the map grows
  const int64_t wide = schema.front_width < 0
                           ? schema.front_span
                           : std::min(schema.front_span / 8, schema.front_width) * 8;
  return static_cast<uint64_t>(std::min(wide, most));
}

size_t verticesOf(int64_t cells) {
  return static_cast<size_t>(cells) / kCellsPerVertex + 64;
}

int64_t WindowSize::knownFront() const {
  return std::min(schema_.front_cells, kWidestFront);
}

int64_t WindowSize::forFront(int64_t front) const {
  const int64_t cells =
      front < kWideFront ? kFrontsPerWindow * front : kQuarterFrontsOfWide * front / 4;
  return std::min(cells, kMostCells);
}

// A larger mesh: where cells are to go, and it is not kept to an error, for which it takes longer
// than it gains.
bool WindowSize::gainsWhole() const {
  return !(options_.error > 0) && options_.ratio < 1 && options_.cells < schema_.cell_count;
}

// Where nobody knows how long the stream is, a small mesh shall be held whole.
int64_t WindowSize::least() const {
  const int64_t count = schema_.cell_count;
  if (followsPaper(options_.mode)) return knownFront() < 0 ? kFirstPaperWindow : kLeastPaperWindow;
  if (count < 0) return knownFront() < 0 ? kSmallMesh : kLeastWindow;
  return count <= (gainsWhole() ? kLargestWhole : kSmallMesh) ? kLargestWhole : kLeastWindow;
}

// It grows as a front is met that is not known.
int64_t WindowSize::first() const {
  int64_t cells = options_.window_cells > 0
                      ? std::max(options_.window_cells, kLeastCells)
                      : std::max(forFront(std::max<int64_t>(knownFront(), 0)), least());
  if (schema_.cell_count >= 0) cells = std::min(cells, std::max(schema_.cell_count, kLeastCells));
  if (options_.window_cells > 0) return cells;
  return std::min(cells, fitting());
}

// A sixth is left for meshes with more vertices to a cell than usual. Where much of the window is
// front, which no patch owns, patches have as much of it around them again as they own.
int64_t WindowSize::fitting() const {
  if (options_.memory_bytes == 0) return std::numeric_limits<int64_t>::max();
  const int64_t map = kMapBytes * static_cast<int64_t>(expectedSpan(schema_));
  const int64_t patch = followsPaper(options_.mode)
                            ? 0
                            : tileVertices(options_, patch_vertex_bytes_) * patch_vertex_bytes_;
  const auto beside = [&](int64_t patches) {
    const int64_t left = options_.memory_bytes - kFixedBytes - patches - map;
    const int64_t five_sixths = left - (left + 5) / 6;  // of any number
    return std::max(five_sixths / cell_bytes_, kLeastCells);
  };
  const int64_t cells = beside(patch);
  return 2 * cells < kRoomyHalfFronts * knownFront() ? beside(2 * patch) : cells;
}

bool WindowSize::isTight() const {
  return options_.memory_bytes > 0 && (schema_.cell_count < 0 || fitting() < schema_.cell_count);
}

// None where the window may grow, or has many vertices to a cell. Beside it and the patches there
// are batches that are read ahead, and of a longer stream a sample, and cells that wait for its
// end.
int64_t WindowSize::sparePatches() const {
  constexpr int64_t kBesideWhole = int64_t{8} << 20, kBeside = int64_t{48} << 20;
  if (options_.memory_bytes == 0 || followsPaper(options_.mode) || schema_.cell_count < 0 ||
      schema_.vertex_count > schema_.cell_count / 2)
    return 0;
  SimplifyOptions without = options_;
  without.memory_bytes = 0;
  const int64_t cells = WindowSize(schema_, without, cell_bytes_, patch_vertex_bytes_).first();
  if (cells < schema_.cell_count && knownFront() < 0) return 0;
  // Walls take twice what is planned for a patch.
  const int64_t patch = 2 * tileVertices(without, patch_vertex_bytes_) * patch_vertex_bytes_;
  const int64_t beside = cells < schema_.cell_count ? kBeside : kBesideWhole;
  const int64_t left = options_.memory_bytes / 2 - beside;
  return cells < left / cell_bytes_ ? (left - cells * cell_bytes_) / patch : 0;
}

int64_t WindowSize::foreseen(int64_t cells) const {
  const bool may_grow = options_.window_cells == 0 && knownFront() < 0;
  return may_grow ? std::max(cells, fitting()) : cells;
}

// A quarter is for meshes with more vertices to a cell than usual, for patches that become larger,
// and for the way between cells, which has no memory before it is needed.
int64_t WindowSize::heldBack(int64_t cells) const {
  return kFixedBytes + options_.memory_bytes / 4 + (foreseen(cells) - cells) * cell_bytes_;
}

// What a window leaves of a larger budget is a sixth, unless it holds all cells. 0: no budget that
// anybody has does.
int64_t WindowSize::budgetFor(int64_t front, double waiting) const {
  SimplifyOptions larger = options_;
  const WindowSize size(schema_, larger, cell_bytes_, patch_vertex_bytes_);
  const int64_t asked = options_.window_cells > 0 ? first() : 0;
  if (asked > kMostCells || waiting > static_cast<double>(kLargestTold)) return 0;
  const int64_t roomy = front > 0 ? kRoomyHalfFronts * std::min(front, kWidestFront) / 2
                                  : std::min(kUnknownCells, least());
  const int64_t cells = std::max(roomy, asked);
  const auto isTooSmall = [&] {
    const bool holds_all = schema_.cell_count >= 0 && size.fitting() >= schema_.cell_count;
    return size.fitting() < cells ||
           (static_cast<double>(larger.memory_bytes) < 6 * waiting && !holds_all);
  };
  do larger.memory_bytes += larger.memory_bytes / 8 + 1;
  while (isTooSmall() && larger.memory_bytes < kLargestTold);
  return larger.memory_bytes < kLargestTold ? larger.memory_bytes + kSpareBytes : 0;
}

void WindowSize::fail(const char* why, int64_t front, double waiting) const {
  const auto enough = static_cast<long long>(budgetFor(front, waiting));
  if (enough == 0) tetstream::fail(Status::kNoMemory, "%s", why);
  if (front <= 0) tetstream::fail(Status::kNoMemory, "%s; %lld should do", why, enough);
  tetstream::fail(Status::kNoMemory, "%s; for a front of %lld cells %lld should do", why,
                  static_cast<long long>(front), enough);
}

void WindowSize::failForFront(int64_t window, int64_t front, double waiting) const {
  const std::string why = textOf("the front of the stream does not fit a window of %lld cells",
                                 static_cast<long long>(window));
  if (options_.memory_bytes == 0) tetstream::fail(Status::kNoMemory, "%s", why.c_str());
  const std::string most = textOf("%s, and the memory budget of %lld bytes allows no more",
                                  why.c_str(), static_cast<long long>(options_.memory_bytes));
  fail(most.c_str(), front, waiting);
}

}  // namespace tetstream
