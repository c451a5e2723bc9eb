// measure: the field difference over cells that are in core. Depends on
// field_difference.h, cell_overlap.h.
#pragma once

#include "cell_overlap.h"
#include "field_difference.h"

namespace tetstream {

// Simplified cells with their barycentric coordinates; those that are too flat have none.
class MappedCells {
 public:
  MappedCells(const RowChunk& chunk, Account& account);
  // visit(cell's row, map) for those whose boxes are near a place,
  template <class Visit>
  void forEachAt(const double place[3], Visit&& visit) const {
    Box box;
    box.add(place);
    chunk_.tree().forEachNear(box, [&](uint32_t i) { visitMapped(i, visit); });
  }
  // or which may have something in common with a cell.
  template <class Visit>
  void forEachNear(const double* corners, Visit&& visit) const {
    chunk_.forEachNear(corners, [&](uint32_t i) { visitMapped(i, visit); });
  }
  size_t count() const { return chunk_.count(); }
  // Whether very many cells have the place as a corner: they may not be near a cell that has it.
  bool isHub(const double place[3]) const { return chunk_.hubs().find(place) != Hubs::kNone; }

 private:
  template <class Visit>
  void visitMapped(uint32_t i, Visit&& visit) const {
    if (has_map_[i]) visit(chunk_.row(i), maps_[i]);
  }

  const RowChunk& chunk_;
  Array<CellMap> maps_;
  Array<uint8_t> has_map_;
};

class FieldDifference::Leaf {
 public:
  Leaf(FieldDifference& whole, SimplexRows& cells, uint64_t others);

  // Exactly: with each chunk of simplified cells; then, for what they leave over, once more.
  void integrate(const MappedCells& others);
  void sumVolumes();
  void markCovered(const MappedCells& others);
  void keepOutside();

  // By points.
  void spreadSamples();
  void locateSamples(const MappedCells& others);
  void takeSamples();

 private:
  // Of a cell that is not covered whole: its corners, then places spread in it; a bit for each
  // that is in a simplified cell.
  static constexpr int kTrials = 64, kCorners = 4;
  static constexpr int kKept = 8;  // places of a cell, at most
  struct Uncovered {
    uint32_t cell;
    uint64_t seen;
  };
  // A point of the sample, its values and those found: `depth` is its least coordinate.
  struct Sample {
    uint32_t cell;
    double coordinates[4], depth;
  };

  // What some of the cells add, and what it takes to find that.
  struct Part {
    std::vector<FieldSums> sums;
    CellOverlap overlap;
    std::vector<double> differences;
    double volume = 0;  // of the cell in hand
  };

  const double* cell(size_t i) const { return rows_ + i * doubles_; }
  double volumeOf(size_t i) const;
  void spread(size_t cell, int index, double coordinates[4]) const;
  void placeAt(size_t cell, const double coordinates[4], double place[3]) const;
  void valuesAt(size_t cell, const double coordinates[4], double* values) const;
  void integrateCells(Part& part, size_t begin, size_t end, const MappedCells& others);
  void integratePair(Part& part, size_t cell, const double* other, const double planes[4][4]);
  void searchMaximum(Part& part, size_t cell, size_t field, const double* differences) const;
  void addParts(size_t count);
  void tellOf(size_t rows, size_t of, const MappedCells& others);
  void tellRest() { whole_.tell(static_cast<double>(count_) - told_); }
  void lookAt(Uncovered& cell, const MappedCells& others) const;
  void locate(size_t sample, const MappedCells& others);
  template <class Work, class Tell>
  void inParts(size_t count, Work work, Tell tell);
  bool keepPlaces(const Uncovered& cell, double volume);

  FieldDifference& whole_;
  RowShape shape_;
  double others_;    // simplified cells in all
  double told_ = 0;  // of the cells: how many are done
  size_t count_, doubles_;
  Array<double> copy_;  // of the cells, unless they are in core anyway
  const double* rows_;
  Array<double> covered_;  // share of each cell
  Array<Uncovered> uncovered_;
  size_t uncovered_count_ = 0;
  Array<Sample> samples_;
  Array<double> found_;  // values at the samples
  size_t sample_count_ = 0;
  std::vector<Part> parts_;
  std::vector<double> values_;
};

}  // namespace tetstream
