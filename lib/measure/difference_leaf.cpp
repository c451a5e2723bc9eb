#include "difference_leaf.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "last_met.h"
#include "random.h"
#include "row_number.h"
#include "vector3.h"

namespace tetstream {

// Rounding leaves of a cell that is covered some 1e-15.
constexpr double kCoveredWhole = 1e-9;
// Common parts as small as this are rounding, too: corners of theirs are corners of others.
constexpr double kTinyPart = 1e-10;
constexpr size_t kRowsOfPart = 512;

MappedCells::MappedCells(const RowChunk& chunk, Account& account)
    : chunk_(chunk), maps_(account, chunk.count()), has_map_(account, chunk.count()) {
  for (size_t i = 0; i < chunk.count(); ++i) has_map_[i] = maps_[i].set(chunk.row(i));
}

FieldDifference::Leaf::Leaf(FieldDifference& whole, SimplexRows& cells, uint64_t others)
    : whole_(whole),
      shape_(cells.shape()),
      others_(static_cast<double>(others)),
      count_(static_cast<size_t>(cells.count())),
      doubles_(shape_.doubles()),
      copy_(whole.budget_.account),
      rows_(cells.inCore()),
      covered_(whole.budget_.account),
      uncovered_(whole.budget_.account),
      samples_(whole.budget_.account),
      found_(whole.budget_.account),
      values_(shape_.values) {
  if (rows_) return;
  copy_.resize(count_ * doubles_);
  for (size_t i = 0; i < count_; ++i)
    std::copy_n(cells.row(i), doubles_, copy_.data() + i * doubles_);
  rows_ = copy_.data();
}

double FieldDifference::Leaf::volumeOf(size_t i) const {
  const double* p = cell(i);
  return std::fabs(sixVolume(p, p + 3, p + 6, p + 9)) / 6;
}

// Uniform in a cell: the gaps between three sorted numbers, as coordinates.
static void anywhere(Random& random, double coordinates[4]) {
  double at[3] = {shareOf(random.next()), shareOf(random.next()), shareOf(random.next())};
  std::sort(at, at + 3);
  coordinates[0] = at[0];
  coordinates[1] = at[1] - at[0];
  coordinates[2] = at[2] - at[1];
  coordinates[3] = 1 - at[2];
}

void FieldDifference::Leaf::spread(size_t i, int index, double coordinates[4]) const {
  if (index < kCorners) {
    for (int k = 0; k < 4; ++k) coordinates[k] = k == index;
    return;
  }
  Random random(mix(numberOf(cell(i), 12, whole_.sampling_.seed) + static_cast<uint64_t>(index)));
  anywhere(random, coordinates);
}

void FieldDifference::Leaf::placeAt(size_t i, const double coordinates[4], double place[3]) const {
  const double* p = cell(i);
  for (int k = 0; k < 3; ++k)
    place[k] = coordinates[0] * p[k] + coordinates[1] * p[3 + k] + coordinates[2] * p[6 + k] +
               coordinates[3] * p[9 + k];
}

void FieldDifference::Leaf::valuesAt(size_t i, const double coordinates[4], double* values) const {
  for (size_t c = 0; c < shape_.values; ++c) {
    values[c] = 0;
    for (size_t j = 0; j < 4; ++j) values[c] += coordinates[j] * shape_.value(cell(i), j)[c];
  }
}

// ------------------------------------------------------------------------------------- exactly

void FieldDifference::Leaf::integrate(const MappedCells& others) {
  if (covered_.size() == 0) {
    covered_.resize(count_);
    std::fill_n(covered_.data(), count_, 0.0);
  }
  parts_.resize(kPiecesAtOnce);
  inPieces(
      whole_.budget_.tasks, count_, kRowsOfPart,
      [&](size_t p, size_t begin, size_t end) { integrateCells(parts_[p], begin, end, others); },
      [&](size_t parts) {
        addParts(parts);
        tellOf(parts * kRowsOfPart, count_, others);
      });
}

// Of as many rows, or points, so many were held against some of the others.
void FieldDifference::Leaf::tellOf(size_t rows, size_t of, const MappedCells& others) {
  const double share = static_cast<double>(others.count()) / std::max(others_, 1.0) *
                       std::min(static_cast<double>(rows) / static_cast<double>(of), 1.0);
  const double cells = std::floor(std::min(share, 1.0) * static_cast<double>(count_));
  told_ += cells;
  whole_.tell(cells);
}

// What is smaller than the largest error so far is not looked for.
void FieldDifference::Leaf::integrateCells(Part& part, size_t begin, size_t end,
                                           const MappedCells& others) {
  part.sums.assign(whole_.fields_.size(), {});
  part.differences.resize(4 * shape_.values);
  for (size_t f = 0; f < part.sums.size(); ++f) part.sums[f].largest = whole_.inside_[f].largest;
  for (size_t i = begin; i < end; ++i) {
    const double* p = cell(i);
    part.volume = volumeOf(i);
    others.forEachNear(p, [&](const double* other, const CellMap& map) {
      double planes[4][4];
      if (!map.planesOf(p, planes) || !part.overlap.set(planes)) return;
      covered_[i] += part.overlap.volume;
      integratePair(part, i, other, planes);
    });
  }
}

void FieldDifference::Leaf::addParts(size_t count) {
  for (size_t p = 0; p < count; ++p)
    for (size_t f = 0; f < parts_[p].sums.size(); ++f) whole_.inside_[f].add(parts_[p].sums[f]);
}

// Work on rows that depend on nothing but themselves; tell(rows) when so many more are done.
template <class Work, class Tell>
void FieldDifference::Leaf::inParts(size_t count, Work work, Tell tell) {
  inPieces(
      whole_.budget_.tasks, count, kRowsOfPart,
      [&](size_t, size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) work(i);
      },
      [&](size_t parts) { tell(parts * kRowsOfPart); });
}

// The difference is linear on the whole cell: its value at corner i is the cell's own less the
// other one's, carried on beyond it by its barycentric coordinates.
void FieldDifference::Leaf::integratePair(Part& part, size_t i, const double* other,
                                          const double planes[4][4]) {
  const double *u = shape_.value(cell(i), 0), *v = shape_.value(other, 0);
  const size_t n = shape_.values;
  for (size_t c = 0; c < n; ++c)
    for (size_t j = 0; j < 4; ++j)
      part.differences[4 * c + j] = u[n * j + c] - planes[0][j] * v[c] - planes[1][j] * v[n + c] -
                                    planes[2][j] * v[2 * n + c] - planes[3][j] * v[3 * n + c];
  for (size_t f = 0; f < whole_.fields_.size(); ++f) {
    const ComparedField& field = whole_.fields_[f];
    FieldSums& sums = part.sums[f];
    double* d = part.differences.data() + 4 * field.first;
    for (size_t k = 0; k < 4 * field.components; ++k) d[k] *= field.per_unit;
    double squares = 0, norms[4] = {};
    for (size_t c = 0; c < field.components; ++c) {
      squares += part.overlap.integralOfSquare(d + 4 * c);
      for (size_t j = 0; j < 4; ++j) norms[j] += d[4 * c + j] * d[4 * c + j];
    }
    sums.squares += part.volume * squares;
    if (field.range > 0)
      sums.histogram.add(std::sqrt(squares / part.overlap.volume) / field.range,
                         part.volume * part.overlap.volume);
    if (*std::max_element(norms, norms + 4) > sums.largest * sums.largest &&
        part.overlap.volume > kTinyPart)
      searchMaximum(part, i, f, d);
  }
}

void FieldDifference::Leaf::searchMaximum(Part& part, size_t i, size_t f, const double* d) const {
  for (int piece = 0; piece < part.overlap.pieces; ++piece)
    for (const auto& corner : part.overlap.piece[piece]) {
      double square = 0;
      for (size_t c = 0; c < whole_.fields_[f].components; ++c) {
        const double* e = d + 4 * c;
        const double value =
            corner[0] * e[0] + corner[1] * e[1] + corner[2] * e[2] + corner[3] * e[3];
        square += value * value;
      }
      double place[3];
      placeAt(i, corner, place);
      part.sums[f].take(std::sqrt(square), place);
    }
}

void FieldDifference::Leaf::sumVolumes() {
  if (covered_.size() == 0) {  // there are no others
    covered_.resize(count_);
    std::fill_n(covered_.data(), count_, 0.0);
  }
  VolumeSums& sums = whole_.volumes_;
  for (size_t i = 0; i < count_; ++i) {
    const double volume = volumeOf(i), covered = covered_[i];
    sums.original += volume;
    sums.covered += volume * covered;
    if (covered - 1 > kCoveredWhole) sums.twice += volume * (covered - 1);
    if (1 - covered > kCoveredWhole) {
      sums.outside += volume * (1 - covered);
      if (uncovered_count_ == uncovered_.size())
        uncovered_.resize(std::max<size_t>(256, uncovered_count_ * 3 / 2));
      uncovered_[uncovered_count_++] = {static_cast<uint32_t>(i), 0};
    }
  }
  tellRest();
}

void FieldDifference::Leaf::markCovered(const MappedCells& others) {
  inParts(
      uncovered_count_, [&](size_t n) { lookAt(uncovered_[n], others); },
      [&](size_t) { whole_.tell(0); });
}

// Which of its places are in one of the cells.
void FieldDifference::Leaf::lookAt(Uncovered& u, const MappedCells& others) const {
  double places[kTrials][3];
  for (int t = 0; t < kTrials; ++t) {
    double coordinates[4];
    spread(u.cell, t, coordinates);
    placeAt(u.cell, coordinates, places[t]);
    if (t < kCorners && others.isHub(places[t])) u.seen |= uint64_t{1} << t;
  }
  others.forEachNear(cell(u.cell), [&](const double*, const CellMap& map) {
    for (int t = 0; t < kTrials; ++t) {
      if (u.seen >> t & 1) continue;
      double at[4];
      map.coordinates(places[t], at);
      if (*std::min_element(at, at + 4) >= kInside) u.seen |= uint64_t{1} << t;
    }
  });
}

// A volume that no place was found in is thin: the cell's corners that are outside stand for it,
// or, if there are none, the cell's covered part does.
bool FieldDifference::Leaf::keepPlaces(const Uncovered& u, double volume) {
  int first = kCorners, last = kTrials;
  int count = std::popcount(~u.seen >> kCorners);
  if (count == 0) {
    first = 0;
    last = kCorners;
    count = std::popcount(~u.seen & 15);
  }
  const int kept = std::min(count, kKept);
  for (int t = first, taken = 0; t < last && taken < kept; ++t) {
    if (u.seen >> t & 1) continue;
    double coordinates[4], place[3];
    spread(u.cell, t, coordinates);
    placeAt(u.cell, coordinates, place);
    valuesAt(u.cell, coordinates, values_.data());
    whole_.addOutside(place, volume / kept, values_.data());
    ++taken;
  }
  return kept > 0;
}

void FieldDifference::Leaf::keepOutside() {
  LastMet corners(whole_.budget_.account, whole_.budget_.bytes);  // which many cells share
  for (size_t n = 0; n < uncovered_count_; ++n) {
    const Uncovered& u = uncovered_[n];
    const double volume = volumeOf(u.cell) * (1 - covered_[u.cell]);
    if (!keepPlaces(u, volume)) whole_.volumes_.outside -= volume;
    for (int t = 0; t < kCorners; ++t) {
      if (u.seen >> t & 1) continue;
      const double* place = cell(u.cell) + 3 * t;
      if (corners.meet(numberOf(place, 3, 0))) continue;
      whole_.addOutside(place, 0, shape_.value(cell(u.cell), static_cast<size_t>(t)));
    }
  }
}

// ----------------------------------------------------------------------------------- by points

void FieldDifference::Leaf::spreadSamples() {
  const Sampling& s = whole_.sampling_;
  for (size_t i = 0; i < count_; ++i) {
    const double volume = volumeOf(i);
    whole_.volumes_.original += volume;
    Random random(numberOf(cell(i), 12, s.seed));
    const double wanted = s.volume > 0 ? static_cast<double>(s.samples) * volume / s.volume : 0;
    const auto points = static_cast<uint64_t>(wanted + shareOf(random.next()));
    for (uint64_t n = 0; n < points; ++n) {
      if (sample_count_ == samples_.size())
        samples_.resize(std::max<size_t>(256, sample_count_ * 3 / 2));
      Sample& sample = samples_[sample_count_++];
      sample.cell = static_cast<uint32_t>(i);
      sample.depth = -1;
      anywhere(random, sample.coordinates);
    }
  }
  found_.resize(sample_count_ * shape_.values);
}

void FieldDifference::Leaf::locateSamples(const MappedCells& others) {
  inParts(
      sample_count_, [&](size_t n) { locate(n, others); },
      [&](size_t rows) { tellOf(rows, sample_count_, others); });
}

void FieldDifference::Leaf::locate(size_t n, const MappedCells& others) {
  Sample& sample = samples_[n];
  double place[3];
  placeAt(sample.cell, sample.coordinates, place);
  others.forEachAt(place, [&](const double* other, const CellMap& map) {
    double at[4];
    map.coordinates(place, at);
    const double depth = *std::min_element(at, at + 4);
    if (!(depth >= kInside && depth > sample.depth)) return;
    sample.depth = depth;
    double* found = found_.data() + n * shape_.values;
    for (size_t c = 0; c < shape_.values; ++c) {
      found[c] = 0;
      for (size_t j = 0; j < 4; ++j) found[c] += at[j] * shape_.value(other, j)[c];
    }
  });
}

// Each stands for an equal part of the volume.
void FieldDifference::Leaf::takeSamples() {
  const double each = whole_.sampling_.volume / static_cast<double>(whole_.sampling_.samples);
  for (size_t n = 0; n < sample_count_; ++n) {
    const Sample& sample = samples_[n];
    double place[3];
    placeAt(sample.cell, sample.coordinates, place);
    valuesAt(sample.cell, sample.coordinates, values_.data());
    if (sample.depth < kInside) {
      whole_.volumes_.outside += each;
      whole_.addOutside(place, each, values_.data());
      continue;
    }
    whole_.volumes_.covered += each;
    const double* found = found_.data() + n * shape_.values;
    for (size_t f = 0; f < whole_.fields_.size(); ++f) {
      const ComparedField& field = whole_.fields_[f];
      const double square = field.squareBetween(values_.data(), found);
      FieldSums& sums = whole_.inside_[f];
      sums.squares += each * square;
      sums.take(std::sqrt(square), place);
      if (field.range > 0) sums.histogram.add(std::sqrt(square) / field.range, each);
    }
  }
  tellRest();
}

}  // namespace tetstream
