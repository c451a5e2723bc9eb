#include "nearest_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "triangle.h"

namespace tetstream {

constexpr SpoolShape kInSequence = {2, 64 << 10};
constexpr size_t kPlacesOfPiece = 64, kPlacesAtOnce = kPiecesAtOnce * kPlacesOfPiece;

// A row: place, carried numbers, the squared distance so far, the values there.
NearestPoints::NearestPoints(size_t carried, size_t values, const std::string& temp_dir)
    : carried_(carried),
      values_(values),
      doubles_(3 + carried + 1 + values),
      temp_dir_(temp_dir),
      places_(spool()),
      row_(doubles_) {}

std::unique_ptr<RowSpool> NearestPoints::spool() const {
  return std::make_unique<RowSpool>(doubles_ * sizeof(double), temp_dir_, kInSequence);
}

void NearestPoints::add(const double place[3], const double* carried) {
  std::copy_n(place, 3, row_.data());
  std::copy_n(carried, carried_, row_.data() + 3);
  row_[3 + carried_] = std::numeric_limits<double>::infinity();
  std::fill_n(row_.data() + 4 + carried_, values_, 0.0);
  places_->append(row_.data(), 1);
}

void NearestPoints::improve(const RowChunk& chunk, double* row) const {
  double& least = row[3 + carried_];
  double* values = row + 4 + carried_;
  chunk.forEachWithin(row, least, [&](uint32_t i) {
    double at[3];
    const double* triangle = chunk.row(i);
    const double found = squaredDistance(triangle, row, at);
    if (!(found < least)) return least;
    least = found;
    for (size_t k = 0; k < values_; ++k) {
      values[k] = 0;
      for (size_t j = 0; j < 3; ++j) values[k] += at[j] * chunk.shape().value(triangle, j)[k];
    }
    return least;
  });
}

NearestPoints::Found NearestPoints::foundIn(const double* row) const {
  return {row, row + 3, std::sqrt(row[3 + carried_]), row + 4 + carried_};
}

// Some places, from that one on, into `rows_`; returns how many.
size_t NearestPoints::improveFrom(const RowChunk& chunk, uint64_t first, const Tasks* tasks) {
  const auto some = static_cast<size_t>(std::min<uint64_t>(kPlacesAtOnce, count() - first));
  for (size_t i = 0; i < some; ++i)
    std::copy_n(static_cast<const double*>(places_->row(first + i)), doubles_,
                rows_.data() + i * doubles_);
  inPieces(
      tasks, some, kPlacesOfPiece,
      [&](size_t, size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) improve(chunk, rows_.data() + i * doubles_);
      },
      [](size_t) {});
  return some;
}

void NearestPoints::search(SimplexRows& surface, const Budget& budget, const Take& take,
                           const std::function<void(double)>& share) {
  places_->finish();
  rows_.resize(kPlacesAtOnce * doubles_);
  const auto work = static_cast<double>(std::max<uint64_t>(surface.count() * count(), 1));
  uint64_t searched = 0;  // triangles
  forEachChunk(surface, budget.bytes, 0, budget.account, [&](const RowChunk& chunk) {
    const bool is_last = searched + chunk.count() == surface.count();
    std::unique_ptr<RowSpool> next = is_last ? nullptr : spool();
    for (uint64_t first = 0; first < count();) {
      const size_t found = improveFrom(chunk, first, budget.tasks);
      if (!is_last) next->append(rows_.data(), found);
      for (size_t i = 0; is_last && i < found; ++i) take(foundIn(rows_.data() + i * doubles_));
      first += found;
      share((static_cast<double>(searched) * static_cast<double>(count()) +
             static_cast<double>(chunk.count()) * static_cast<double>(first)) /
            work);
    }
    if (is_last) return;
    next->finish();
    places_ = std::move(next);
    searched += chunk.count();
  });
  if (surface.count() > 0) return;
  for (uint64_t i = 0; i < count(); ++i) take(foundIn(static_cast<const double*>(places_->row(i))));
}

}  // namespace tetstream
