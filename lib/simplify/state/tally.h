// simplify/state: what became of edges that were tried, and what was done. Depends on nothing.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>

namespace tetstream {

// kOrientation: a cell would be turned over, or flat; kThin: more cells would be thin; kCrossing:
// the boundary would pass through itself where it does not; kVolume: no place that is near keeps
// the volumes; kTooLarge: the error, for the target.
enum class Outcome {
  kDone,
  kLocked,
  kTooMany,
  kTooFar,
  kVolume,
  kTooLarge,
  kTopology,
  kCrossing,
  kOrientation,
  kThin,
  kDear,
  kNotFinite
};

// Whether an edge that was refused at one place may be legal at another.
inline bool mayFitElsewhere(Outcome outcome) {
  return outcome == Outcome::kOrientation || outcome == Outcome::kThin ||
         outcome == Outcome::kCrossing || outcome == Outcome::kNotFinite;
}

// Collapses that have no place that keeps the volumes may take, or add, this share of a region in
// all, and a larger one where the target cannot be reached otherwise: each takes little, but thin
// tubes whose rims are labelled would lose a quarter.
constexpr double kMostDrift = 0.01, kLastDrift = 0.03;

// What collapses did: to the whole mesh, or to a part of the window that is worked on beside others
// and is added when its turn comes. Sums of errors are added part by part, whoever worked on them.
struct Tally {
  int64_t collapses = 0, flips = 0;
  int64_t rejected_orientation = 0, rejected_link = 0, rejected_locked = 0, rejected_other = 0;
  int64_t rejected_thin = 0;                        // of those for orientation
  int64_t rejected_large = 0, rejected_volume = 0;  // of the others
  double error = 0;                                 // made: volume times squared error, normalised
  double largest_error = 0;                         // in the report's unit
  bool error_reached = false;  // a collapse was refused for the limit on the error
  bool drift_reached = false;  // or for the one on what follows
  // By region, null for the body: what its volume has grown by where nothing makes up for it.
  std::map<const void*, double> drifts;

  double driftOf(const void* region) const {
    const auto found = drifts.find(region);
    return found == drifts.end() ? 0 : found->second;
  }

  int64_t rejected() const {
    return rejected_orientation + rejected_link + rejected_locked + rejected_other;
  }
  void count(Outcome outcome);
  void add(const Tally& part);
};

}  // namespace tetstream
