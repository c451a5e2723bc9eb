#include "plan.h"

#include <algorithm>
#include <cmath>

#include "status.h"

namespace tetstream {

static std::string namesOf(const std::vector<Column>& columns) {
  std::string names;
  for (const Column& c : columns) names += (names.empty() ? "" : ", ") + c.name;
  return names.empty() ? "none" : names;
}

// The weight of each field; 0 where it is carried. They tell fields from each other alone: the
// largest becomes 1, so that errors, and what the boundary counts, are in units of that field's
// range.
static std::vector<double> fieldWeights(const Schema& schema, const SimplifyOptions& options) {
  std::vector<double> weights(schema.fields.size(), options.fields.empty() ? 1.0 : 0.0);
  for (const auto& [name, weight] : options.fields) {
    const int i = findColumn(schema.fields, name);
    if (i < 0)
      fail(Status::kBadArgument, "there is no field \"%s\"; the stream has: %s", name.c_str(),
           namesOf(schema.fields).c_str());
    if (!isFloat(schema.fields[static_cast<size_t>(i)].type))
      fail(Status::kBadArgument, "field \"%s\" holds integers, which are picked, not measured",
           name.c_str());
    if (!(weight >= 0 && std::isfinite(weight)))
      fail(Status::kBadArgument, "field \"%s\": a weight is finite and not negative", name.c_str());
    weights[static_cast<size_t>(i)] = weight;
  }
  const double largest = weights.empty() ? 0 : *std::max_element(weights.begin(), weights.end());
  for (double& weight : weights)
    if (largest > 0) weight /= largest;
  return weights;
}

// float32 has 2^-24 of a value, and every merge rounds: of what spans less than this part of its
// values rounding would be the largest error (an absolute pressure with a range of 1e-6 of it: 2.1
// % at 0.1 for 0.93).
constexpr double kLeastSpan = 1e-4;

static bool isNarrow(const Schema& schema, size_t first, size_t count) {
  double span = 0, most = 0;
  for (size_t i = first; i < first + count; ++i) {
    span = std::max(span, schema.box_max[i] - schema.box_min[i]);
    most = std::max({most, std::fabs(schema.box_min[i]), std::fabs(schema.box_max[i])});
  }
  return span > 0 && std::isfinite(most) && span < kLeastSpan * most;
}

// As far as the limits are known.
static bool hasNarrow(const Schema& schema, const std::vector<double>& weights) {
  if (!schema.hasBox()) return false;
  if (isNarrow(schema, 0, 3)) return true;
  size_t at = 3;
  for (size_t f = 0; f < schema.fields.size(); ++f) {
    const auto components = static_cast<size_t>(schema.fields[f].components);
    if (weights[f] > 0 && isFloat(schema.fields[f].type) && isNarrow(schema, at, components))
      return true;
    at += components;
  }
  return false;
}

static void placeField(Plan& plan, const Column& column, double weight, Treatment pass,
                       ColumnPlan& place) {
  const Treatment treatment = !isFloat(column.type) ? Treatment::kPicked
                              : weight > 0          ? Treatment::kMeasured
                                                    : Treatment::kCarried;
  if (treatment != pass) return;
  int& end = treatment == Treatment::kPicked ? plan.picks : plan.values;
  place = {treatment, end};
  end += column.components;
  if (column.type == ScalarType::kFloat64) plan.double_window = true;
}

SimplifyOptions carryingTooMany(const Schema& schema, SimplifyOptions options) {
  if (!options.fields.empty()) return options;
  int dimension = 3;
  for (const Column& c : schema.fields) dimension += isFloat(c.type) ? c.components : 0;
  if (dimension <= kMaxDimension) return options;
  for (const Column& c : schema.fields)
    if (isFloat(c.type)) options.fields.emplace_back(c.name, 0);
  return options;
}

// Measured components come first, so that the quadric's part of a vertex is one piece.
Plan makePlan(const Schema& schema, const SimplifyOptions& options) {
  checkSchema(schema);
  Plan plan;
  plan.schema = schema;
  plan.double_window = schema.position_type == ScalarType::kFloat64;
  if (options.quadric == QuadricForm::kGarlandZhou) plan.layout = QuadricLayout::kFull;
  plan.fields.resize(schema.fields.size());
  const std::vector<double> weights = fieldWeights(schema, options);
  plan.double_window |= hasNarrow(schema, weights);
  for (Treatment pass : {Treatment::kMeasured, Treatment::kCarried, Treatment::kPicked}) {
    for (size_t i = 0; i < schema.fields.size(); ++i) {
      placeField(plan, schema.fields[i], weights[i], pass, plan.fields[i]);
      while (pass == Treatment::kMeasured &&
             static_cast<int>(plan.weights.size()) + 3 < plan.values) {
        plan.weights.push_back(weights[i]);
        plan.measured_column.push_back(static_cast<int>(i));
      }
    }
    if (pass == Treatment::kMeasured) plan.dimension = plan.values;
  }
  if (plan.dimension > kMaxDimension)
    fail(Status::kUnsupported,
         "%d field components are measured, %d are possible: name the fields that matter",
         plan.dimension - 3, kMaxDimension - 3);
  if (options.error > 0 && !plan.measures())
    fail(Status::kBadArgument,
         "an error of %g %% is asked for (option error), and no field is measured; the stream has: "
         "%s",
         options.error, namesOf(schema.fields).c_str());
  for (const Column& c : schema.cell_data) {
    const bool is_picked = !isFloat(c.type) || options.takesAsRegions(c.name);
    int& end = is_picked ? plan.cell_picks : plan.cell_means;
    plan.cell_data.push_back({is_picked ? Treatment::kPicked : Treatment::kCarried, end});
    end += c.components;
  }
  return plan;
}

}  // namespace tetstream
