#include "angles.h"

#include <algorithm>
#include <cmath>

#include "dear_angles.h"

namespace tetstream {

// Cells with a dihedral angle below the floor harm a solver: as few as the input has are made. The
// floor is the largest of these, in degrees, that hardly any cell of the input is below: stretched
// meshes would lose their field for angles that they never had. Where shapes come first there is a
// higher one; where the input has too many cells below that, each that is made has a high price
// (price.h): floors between had 1.1 to 3.7 times the error, and as many such cells. The paper's
// mode has the least only.
constexpr double kFloors[] = {3, 2, 1.4, 1.01, 0.5, 0.2, kLeastFloor, 0.02, 0.008, 0.003};
constexpr double kSolverFloor = 10, kShareBelow = 0.01;
// Cells just above a floor can hardly become others: of stretched meshes, all of whose cells are
// alike, nearly every edge would be refused for it. No more than this share may be below so many
// floors. Where shapes come first the floor is what was asked for.
constexpr double kShareNear = 0.05, kNearFloor = 3;
// Where the input has more than this share of cells below one of these, making the share larger has
// its price. Other meshes are spared the time, unless effort is asked for, shapes come first or
// walls are thin, until few cells are left: then the first counts.
constexpr double kDear[] = {10, 1.01};
constexpr double kShareToSpare = 0.002;
// Where more than this share is below the first of them, flips that bring some above leave as many
// behind: sixteen layers of one cell took twenty times as long for nothing.
constexpr double kShareThin = 0.5;
// Walls are thin where more than this share of the cells have all corners on the boundary, on
// interfaces or on labelled faces. There a cell that has become flat cannot move into the wall:
// without a price on such cells collapses end at two and a half times the target (21 tubes in a
// shell), or take two to three times the error. Bodies have 0.001 to 0.02 of such cells, gears,
// grains and walls 0.08 to 1. Of few cells it tells nothing; under a memory budget small targets
// alone have that price (dear_angles.h). Where regions meet less is enough: without the price 27
// spheres in a block had 1.17 times the RMS error at 0.1, nine cylinders in a cube twice that at
// 0.05, 40 inclusions 1.6 times that at 0.03 and nine times the distance of the boundary, in as
// much time.
constexpr double kShareOfWalls = 0.05, kShareBetweenRegions = 0.001;
constexpr int64_t kLeastForWalls = 400;
// A prime: cells often come in patterns of 5, 6, 12 or 24, a hexahedron after the other.
constexpr int64_t kCellsPerSample = 17;
// Of fewer cells more, for their angles: of 11,000 Delaunay cells the share below a degree would be
// known by a few of them, and their order decide whether a solver's shapes can be had.
constexpr int64_t kEveryCell = 1 << 14, kCellsPerSampleOfSome = 7;

template <class S>
Angles<S>::Angles(Core<S>& core) : core_(core) {
  if (followsPaper(core.options.mode))
    floors_.emplace_back(kLeastFloor);
  else {
    if (core.options.shape == Shape::kSolver) floors_.emplace_back(kSolverFloor);
    for (double degrees : kFloors) floors_.emplace_back(degrees);
  }
  below_.assign(floors_.size(), 0);
  if (!followsPaper(core.options.mode))
    for (const ThinAngle& floor : floors_) near_.emplace_back(kNearFloor * floor.degrees);
  below_near_.assign(near_.size(), 0);
  if (!followsPaper(core.options.mode))
    for (double degrees : kDear) dear_.emplace_back(degrees);
  below_dear_.assign(dear_.size(), 0);
  core.thin = floors_.back();
}

// Whether no angle is below the largest that is asked for, beyond what rounding may change: so it
// is with most cells.
template <class S>
bool Angles<S>::isRegular(uint32_t cell) const {
  const double shape = std::max(floors_.front().shape, dear_.empty() ? 0 : dear_.front().shape);
  double p[4][3];
  cornersIn(core_.window, cell, p);
  return regularity(p, static_cast<double>(core_.scale[0])) > 1.01 * shape;
}

static int64_t stepOf(const Schema& schema) {
  if (schema.cell_count < 0 || schema.cell_count > kCellsPerSampleOfSome * kEveryCell)
    return kCellsPerSample;
  return schema.cell_count > kEveryCell ? kCellsPerSampleOfSome : 1;
}

// Counts cells, not windows: the floor depends on what was read, not on how.
template <class S>
void Angles<S>::sample(uint32_t first, uint32_t end) {
  const Topology& mesh = core_.window.mesh;
  const int64_t before = seen_ - first, step = stepOf(core_.plan.schema);
  seen_ += end - first;
  for (uint32_t c = first; c < end; ++c) {
    if ((before + c) % step != 0 || (mesh.cellFlags(c) & kFlat)) continue;
    ++sampled_;
    if (isRegular(c)) continue;
    const StarCell cell = mesh.starCell(4 * c);
    double x[3];
    positionOf(core_.window, mesh.corners(c)[0], x);
    const auto count = [&](const std::vector<ThinAngle>& angles, std::vector<int64_t>& below) {
      for (size_t i = 0; i < angles.size(); ++i) {
        const StarShape shape = starShape(x, core_.window.allValues(), core_.window.valueStride(),
                                          static_cast<double>(core_.scale[0]), &cell, 1, angles[i]);
        if (shape.thin == 0) break;
        ++below[i];
      }
    };
    count(floors_, below_);
    count(near_, below_near_);
    count(dear_, below_dear_);
  }
}

// Of what is new in each window every 17th cell; those at its front, with corners that are not
// known yet, are passed over. What is locked stays as it is, as do the cuts round a sample, which
// are no boundary.
template <class S>
void Angles<S>::sampleWalls(uint32_t first, uint32_t end) {
  const Topology& mesh = core_.window.mesh;
  for (uint32_t c = first; c < end; c += kCellsPerSample) {
    const uint32_t* v = mesh.corners(c);
    int counted = 0, on_faces = 0;
    for (int j = 0; j < 4; ++j) {
      const unsigned flags = mesh.vertexFlags(v[j]);
      counted += (flags & (kResolved | kLocked)) == kResolved;
      on_faces += (flags & kOnSheet) != 0;
    }
    wall_sampled_ += counted == 4;
    wall_cells_ += counted == 4 && on_faces == 4;
  }
}

template <class S>
bool Angles<S>::isWall() const {
  const double share = core_.interfaces ? kShareBetweenRegions : kShareOfWalls;
  return core_.options.memory_bytes == 0 && wall_sampled_ >= kLeastForWalls &&
         static_cast<double>(wall_cells_) > share * static_cast<double>(wall_sampled_);
}

template <class S>
bool Angles<S>::isTooHigh(size_t floor) const {
  const auto all = static_cast<double>(sampled_);
  if (static_cast<double>(below_[floor]) > kShareBelow * all) return true;
  const bool is_solvers = core_.options.shape == Shape::kSolver && !core_.is_thin;
  return !near_.empty() && !is_solvers &&
         static_cast<double>(below_near_[floor]) > kShareNear * all;
}

template <class S>
void Angles<S>::choose(uint32_t first, uint32_t end) {
  if (first == end) return;
  sampleWalls(first, end);
  const auto all = static_cast<double>(sampled_);
  core_.is_thin = !dear_.empty() && static_cast<double>(below_dear_.front()) > kShareThin * all;
  size_t i = 0;
  while (i + 1 < floors_.size() && isTooHigh(i)) ++i;
  core_.thin = floors_[i];
  std::vector<ThinAngle> dear;
  core_.dear_when_few.clear();
  for (size_t k = 0; k < dear_.size(); ++k) {
    if (!(dear_[k].cos2 < core_.thin.cos2)) continue;  // not above
    const auto below = static_cast<double>(below_dear_[k]);
    const bool is_wanted =
        k == 0 && (core_.options.shape == Shape::kSolver || core_.options.effort == Effort::kHigh ||
                   isWall() || leavesFewInParts(core_));
    if (is_wanted || below > kShareToSpare * all)
      dear.push_back(dear_[k]);
    else if (k == 0 && core_.options.shape == Shape::kField)
      core_.dear_when_few.push_back(dear_[k]);
  }
  setDear(core_, dear);
}

template class Angles<float>;
template class Angles<double>;

}  // namespace tetstream
