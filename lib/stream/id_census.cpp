#include "id_census.h"

#include "mix.h"

namespace tetstream {

void IdCensus::add(const int64_t* row, int components) {
  uint64_t label = 1;
  for (int i = 0; i < components; ++i) label = mix(label + static_cast<uint64_t>(row[i])) + 1;
  if (label % one_in_ == 0) ++rows_of_[label];
}

bool IdCensus::areIds() const {
  if (rows_of_.size() <= kNeverIds) return false;
  uint64_t of_few = 0;
  for (const auto& [label, rows] : rows_of_)
    if (rows < fewest_) of_few += rows;
  return 2 * of_few * one_in_ > rows_;
}

}  // namespace tetstream
