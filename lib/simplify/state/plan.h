// simplify/state: what happens to each column of a stream. Depends on options.h, quadric, stream.
#pragma once

#include <vector>

#include "kernels.h"
#include "options.h"
#include "schema.h"

namespace tetstream {

enum class Treatment {
  kMeasured,  // part of the quadric metric
  kCarried,   // interpolated along
  kPicked,    // integers, and labels of regions: one of the merged values
};

struct ColumnPlan {
  Treatment treatment;
  int offset;  // of the column's first component: among the values, or among the picks
};

struct Plan {
  Schema schema;
  bool double_window = false;  // something is float64, or its values are much larger than its range
  int dimension = 3;           // 3 + measured components: the quadric's
  bool measures() const { return dimension > 3; }
  // Whether quadrics are in the fields' units.
  bool tellsErrors() const { return measures() && layout == QuadricLayout::kFields; }
  QuadricLayout layout = QuadricLayout::kFields;
  int values = 3;  // 3 + measured + carried components
  int picks = 0;
  int cell_means = 0, cell_picks = 0;
  bool traces_vertices = false, traces_points = false;  // for a map or a log; for a map
  std::vector<ColumnPlan> fields, cell_data;
  std::vector<double> weights;       // of each measured component
  std::vector<int> measured_column;  // of each measured component: its field
};

// The options by which all fields are carried, where more than can be would be measured by default.
SimplifyOptions carryingTooMany(const Schema& schema, SimplifyOptions options);

// Throws kBadArgument for fields that the stream does not have or that are no floats.
Plan makePlan(const Schema& schema, const SimplifyOptions& options);

}  // namespace tetstream
