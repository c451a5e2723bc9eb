// simplify/intake: values as far from all others of their field as numbers are that stand for
// missing ones. Errors count by the range of a field: with 1e20 on land, what the sea has counts as
// nothing. Depends on plan.h.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "plan.h"

namespace tetstream {

class LoneValues {
 public:
  explicit LoneValues(const Plan& plan)
      : plan_(plan), ends_(static_cast<size_t>(plan.dimension - 3)) {}

  // Of a vertex: x y z, then the measured components.
  template <class S>
  void add(const S* values) {
    for (size_t i = 0; i < ends_.size(); ++i) ends_[i].add(static_cast<double>(values[3 + i]));
  }

  // The measured fields of which all values but one lie close together, in words, or "". `ranges`:
  // of x y z, then of the field of each measured component.
  std::string inWords(const std::vector<double>& ranges) const;

 private:
  // The lowest and the highest value, and those next to them.
  struct Ends {
    double lowest = std::numeric_limits<double>::infinity(), low = lowest;
    double highest = -lowest, high = highest;

    void add(double value) {
      if (value < low && value != lowest) {
        low = value < lowest ? lowest : value;
        lowest = value < lowest ? value : lowest;
      }
      if (value > high && value != highest) {
        high = value > highest ? highest : value;
        highest = value > highest ? value : highest;
      }
    }
    bool isHighestLone() const { return highest - high > low - lowest; }
    double width() const { return highest - lowest; }
    double loneValue() const { return isHighestLone() ? highest : lowest; }
    // Of all others; 0 of a component with two values or one.
    double range() const {
      return !(width() > 0) ? 0 : isHighestLone() ? high - lowest : highest - low;
    }
  };

  const Plan& plan_;
  std::vector<Ends> ends_;  // of each measured component
};

}  // namespace tetstream
