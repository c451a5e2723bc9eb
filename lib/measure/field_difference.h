// measure: how far the fields of two meshes are from each other, over the cells of the first one.
// Depends on row_chunk.h, nearest_points.h, in_pieces.h.
//
// The part that an original and a simplified cell have in common is convex, and on it the
// difference of the two piecewise linear fields is linear: its square is integrated exactly, and
// its largest norm is that at a corner. Each original cell is looked at once, with all simplified
// cells that meet its box; meshes that are larger than the memory are split in space first, by the
// centres of the original's cells. What is left of a cell is outside the simplified mesh: places
// spread in it are kept for a search of the nearest boundary point, each with its share of the
// volume, and so are those corners of the cell that are outside.
#pragma once

#include <vector>

#include "nearest_points.h"

namespace tetstream {

// A field: some components of the values of a corner. Its errors are told in units: what a power of
// two turns the values into, whose squares are numbers whatever the values are.
struct ComparedField {
  size_t first, components;
  double range;     // of the original, in units; 0: it is constant
  double per_unit;  // by which a difference of values is multiplied
  double squareBetween(const double* values, const double* others) const;
};

// By the size of the error relative to the range: steps of a quarter of a decade from 1e-10 to 10;
// what is smaller or larger counts in the first or the last one.
struct ErrorHistogram {
  static constexpr int kPerDecade = 4, kSteps = 11 * kPerDecade;
  static constexpr double kLowest = 1e-10;
  double volume[kSteps] = {};
  void add(double error, double more);
  void add(const ErrorHistogram& other);
  static double lowerEnd(int step);
};

// In units of the field.
struct FieldSums {
  double squares = 0;  // of the error's norm, times volume
  double largest = 0;  // norm of the error, where that is found exactly
  double place[3] = {0, 0, 0};
  ErrorHistogram histogram;
  void take(double norm, const double at[3]);
  void add(const FieldSums& other);
};

struct VolumeSums {
  double original = 0;  // all of it
  double covered = 0;   // of the original, by cells of the other mesh, each counted
  double outside = 0;   // not covered
  double twice = 0;     // covered by more than one cell
};

class FieldDifference {
 public:
  struct Budget {
    Account& account;
    std::string temp_dir;
    size_t bytes;
    const Tasks* tasks = nullptr;
  };
  // `samples` 0: exactly. Otherwise by about that many points, uniform by volume, of the original,
  // whose volume is told.
  struct Sampling {
    int64_t samples = 0;
    uint64_t seed = 1;
    double volume = 0;
  };
  FieldDifference(const std::vector<ComparedField>& fields, size_t values, const Sampling& sampling,
                  const Budget& budget);

  void measure(SimplexRows& original, SimplexRows& simplified,
               const std::function<void(double)>& share);
  // Then the places outside, by the nearest point of the simplified boundary.
  void measureOutside(SimplexRows& boundary, const std::function<void(double)>& share);

  const VolumeSums& volumes() const { return volumes_; }
  const FieldSums& inside(size_t field) const { return inside_[field]; }
  const FieldSums& outside(size_t field) const { return outside_[field]; }

 private:
  class Leaf;
  friend class Leaf;
  void split(SimplexRows& original, SimplexRows& simplified, int depth);
  void measureLeaf(SimplexRows& original, SimplexRows& simplified);
  void addOutside(const double place[3], double volume, const double* values);
  void tell(double cells);

  const std::vector<ComparedField>& fields_;
  size_t values_;
  Sampling sampling_;
  Budget budget_;
  std::vector<FieldSums> inside_, outside_;
  VolumeSums volumes_;
  NearestPoints outside_places_;
  std::vector<double> carried_;
  std::function<void(double)> share_;
  double cells_done_ = 0, cells_ = 1;
};

}  // namespace tetstream
