#include "field_difference.h"

#include <algorithm>
#include <cmath>

#include "difference_leaf.h"

namespace tetstream {

constexpr double kTinyError = 1e-300;

void ErrorHistogram::add(double error, double more) {
  const double decades = std::log10(std::max(error, kTinyError) / kLowest);
  const double step = std::floor(decades * kPerDecade), last = kSteps - 1;
  volume[step < last ? static_cast<int>(std::max(step, 0.0)) : kSteps - 1] += more;  // NaN: largest
}

void ErrorHistogram::add(const ErrorHistogram& other) {
  for (int step = 0; step < kSteps; ++step) volume[step] += other.volume[step];
}

double ErrorHistogram::lowerEnd(int step) {
  return kLowest * std::pow(10, static_cast<double>(step) / kPerDecade);
}

double ComparedField::squareBetween(const double* values, const double* others) const {
  double square = 0;
  for (size_t c = first; c < first + components; ++c) {
    const double d = (values[c] - others[c]) * per_unit;
    square += d * d;
  }
  return square;
}

void FieldSums::take(double norm, const double at[3]) {
  if (!(norm > largest)) return;
  largest = norm;
  std::copy_n(at, 3, place);
}

void FieldSums::add(const FieldSums& other) {
  squares += other.squares;
  take(other.largest, other.place);
  histogram.add(other.histogram);
}

FieldDifference::FieldDifference(const std::vector<ComparedField>& fields, size_t values,
                                 const Sampling& sampling, const Budget& budget)
    : fields_(fields),
      values_(values),
      sampling_(sampling),
      budget_(budget),
      inside_(fields.size()),
      outside_(fields.size()),
      outside_places_(1 + values, values, budget.temp_dir),
      carried_(1 + values) {}

void FieldDifference::tell(double cells) {
  cells_done_ += cells;
  share_(std::min(cells_done_ / cells_, 1.0));
}

void FieldDifference::measure(SimplexRows& original, SimplexRows& simplified,
                              const std::function<void(double)>& share) {
  share_ = share;
  cells_ = static_cast<double>(std::max<uint64_t>(original.count(), 1));
  split(original, simplified, 0);
}

// ------------------------------------------------------------- meshes larger than the memory

namespace {

constexpr uint64_t kParts = 16;   // into which a mesh is split at once, at most
constexpr size_t kSlices = 4096;  // in which its cells are counted
constexpr int kDeepest = 40;      // cells that cannot be told apart by place: by number

int longestSide(const Box& box) {
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (box.high[k] - box.low[k] > box.high[axis] - box.low[axis]) axis = k;
  return axis;
}

// The part to which each cell belongs: slabs across an axis with about equal numbers of centres.
class Slabs {
 public:
  Slabs(SimplexRows& rows, uint64_t parts, bool by_place)
      : rows_(rows), parts_(parts), axis_(longestSide(rows.centres())), slices_(kSlices) {
    const Box& box = rows.centres();
    low_ = box.low[axis_];
    const double width = box.high[axis_] - low_;
    by_place_ = by_place && width > 0 && std::isfinite(width);
    if (!by_place_) return;
    scale_ = static_cast<double>(kSlices) / width;
    std::vector<uint64_t> counts(kSlices);
    for (uint64_t i = 0; i < rows.count(); ++i) ++counts[sliceOf(rows.row(i))];
    uint64_t before = 0;
    for (size_t s = 0; s < kSlices; ++s) {
      slices_[s] = static_cast<uint8_t>(before * parts / rows.count());
      before += counts[s];
    }
  }
  uint64_t partOf(uint64_t index, const double* row) const {
    return by_place_ ? slices_[sliceOf(row)] : index * parts_ / rows_.count();
  }

 private:
  size_t sliceOf(const double* row) const {
    double centre[3];
    rows_.shape().centreOf(row, centre);
    const double at = (centre[axis_] - low_) * scale_;
    return std::min(static_cast<size_t>(std::max(at, 0.0)), kSlices - 1);
  }
  SimplexRows& rows_;
  uint64_t parts_;
  int axis_;
  std::vector<uint8_t> slices_;
  double low_ = 0, scale_ = 0;
  bool by_place_;
};

}  // namespace

void FieldDifference::split(SimplexRows& original, SimplexRows& simplified, int depth) {
  const size_t most = budget_.bytes / 2;
  if (original.inCore() || original.bytes() <= most || original.count() < 2)
    return measureLeaf(original, simplified);
  const uint64_t parts = std::min(kParts, 2 * original.bytes() / most + 1);
  const Slabs slabs(original, parts, depth < kDeepest);
  const RowBudget rows{budget_.account, budget_.temp_dir, most / (4 * kParts)};
  std::vector<std::unique_ptr<SimplexRows>> ours, theirs;
  for (uint64_t p = 0; p < parts; ++p) {
    ours.push_back(std::make_unique<SimplexRows>(original.shape(), rows));
    theirs.push_back(std::make_unique<SimplexRows>(simplified.shape(), rows));
  }
  for (uint64_t i = 0; i < original.count(); ++i) {
    const double* row = original.row(i);
    ours[slabs.partOf(i, row)]->add(row);
    if (i % 65536 == 0) tell(0);
  }
  for (uint64_t i = 0; i < simplified.count(); ++i) {
    const double* row = simplified.row(i);
    const Box box = simplified.shape().boxOf(row);
    for (uint64_t p = 0; p < parts; ++p)
      if (box.meets(ours[p]->box())) theirs[p]->add(row);
    if (i % 65536 == 0) tell(0);
  }
  for (uint64_t p = 0; p < parts; ++p) {
    ours[p]->finish();
    theirs[p]->finish();
  }
  for (uint64_t p = 0; p < parts; ++p) {
    split(*ours[p], *theirs[p], depth + 1);
    ours[p].reset();
    theirs[p].reset();
  }
}

// --------------------------------------------------------------------------- those that fit it

void FieldDifference::measureLeaf(SimplexRows& original, SimplexRows& simplified) {
  if (original.count() == 0) return;
  Leaf leaf(*this, original, simplified.count());
  const size_t bytes = budget_.bytes / 4, more = sizeof(CellMap) + 1;
  const bool at_once = simplified.count() <= RowChunk::rowsFor(simplified, bytes, more);
  const auto each_chunk = [&](auto&& visit) {
    forEachChunk(simplified, bytes, more, budget_.account,
                 [&](const RowChunk& chunk) { visit(MappedCells(chunk, budget_.account)); });
  };
  if (sampling_.samples > 0) {
    leaf.spreadSamples();
    each_chunk([&](const MappedCells& cells) { leaf.locateSamples(cells); });
    return leaf.takeSamples();
  }
  each_chunk([&](const MappedCells& cells) {
    leaf.integrate(cells);
    if (!at_once) return;
    leaf.sumVolumes();
    leaf.markCovered(cells);
  });
  if (!at_once || simplified.count() == 0) {
    leaf.sumVolumes();
    each_chunk([&](const MappedCells& cells) { leaf.markCovered(cells); });
  }
  leaf.keepOutside();
}

void FieldDifference::addOutside(const double place[3], double volume, const double* values) {
  carried_[0] = volume;
  std::copy_n(values, values_, carried_.data() + 1);
  outside_places_.add(place, carried_.data());
}

void FieldDifference::measureOutside(SimplexRows& boundary,
                                     const std::function<void(double)>& share) {
  outside_places_.search(
      boundary, {budget_.account, budget_.bytes / 2, budget_.tasks},
      [&](const NearestPoints::Found& found) {
        const double volume = found.carried[0];
        for (size_t f = 0; f < fields_.size(); ++f) {
          const double square = std::isinf(found.distance)  // there is no boundary
                                    ? found.distance
                                    : fields_[f].squareBetween(found.carried + 1, found.values);
          FieldSums& sums = outside_[f];
          if (volume > 0) sums.squares += volume * square;
          sums.take(std::sqrt(square), found.place);
          if (volume > 0 && fields_[f].range > 0)
            sums.histogram.add(std::sqrt(square) / fields_[f].range, volume);
        }
      },
      share);
}

}  // namespace tetstream
