#include "tally.h"

namespace tetstream {

void Tally::count(Outcome outcome) {
  switch (outcome) {
    case Outcome::kDone:
      ++collapses;
      break;
    case Outcome::kLocked:
      ++rejected_locked;
      break;
    case Outcome::kTopology:
    case Outcome::kCrossing:
      ++rejected_link;
      break;
    case Outcome::kThin:
      ++rejected_thin;
      [[fallthrough]];
    case Outcome::kOrientation:
      ++rejected_orientation;
      break;
    case Outcome::kTooLarge:
      ++rejected_large;
      ++rejected_other;
      break;
    case Outcome::kVolume:
      ++rejected_volume;
      [[fallthrough]];
    case Outcome::kTooMany:
    case Outcome::kTooFar:
    case Outcome::kDear:
    case Outcome::kNotFinite:
      ++rejected_other;
      break;
  }
}

void Tally::add(const Tally& part) {
  collapses += part.collapses;
  flips += part.flips;
  rejected_orientation += part.rejected_orientation;
  rejected_link += part.rejected_link;
  rejected_locked += part.rejected_locked;
  rejected_other += part.rejected_other;
  rejected_thin += part.rejected_thin;
  rejected_large += part.rejected_large;
  rejected_volume += part.rejected_volume;
  error += part.error;
  largest_error = std::max(largest_error, part.largest_error);
  error_reached |= part.error_reached;
  drift_reached |= part.drift_reached;
  for (const auto& [region, drift] : part.drifts) drifts[region] += drift;
}

}  // namespace tetstream
