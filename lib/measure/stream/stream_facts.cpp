#include "stream_facts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetstream {

StreamFacts::StreamFacts(const Schema& schema)
    : schema_(schema), diagram_(schema, 1, 1), not_finite_(schema.fields.size()) {
  schema_.box_min.assign(schema.boxSize(), std::numeric_limits<double>::infinity());
  schema_.box_max.assign(schema.boxSize(), -std::numeric_limits<double>::infinity());
}

// Returns how many values are not finite.
static int64_t growColumn(const void* rows, ScalarType type, size_t components, size_t count,
                          double* low, double* high) {
  std::vector<double> values(components * count);
  convertScalars(rows, type, values.data(), ScalarType::kFloat64, values.size());
  int64_t strange = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      ++strange;
      continue;
    }
    low[i % components] = std::min(low[i % components], values[i]);
    high[i % components] = std::max(high[i % components], values[i]);
  }
  return strange;
}

void StreamFacts::growBox(const BatchView& batch) {
  growColumn(batch.positions, schema_.position_type, 3, batch.vertex_count, schema_.box_min.data(),
             schema_.box_max.data());
  size_t at = 3;
  for (size_t f = 0; f < schema_.fields.size(); ++f) {
    const Column& c = schema_.fields[f];
    not_finite_[f] +=
        growColumn(batch.fields[f], c.type, static_cast<size_t>(c.components), batch.vertex_count,
                   schema_.box_min.data() + at, schema_.box_max.data() + at);
    at += static_cast<size_t>(c.components);
  }
}

void StreamFacts::put(const BatchView& batch) {
  diagram_.put(batch);
  vertices_ += batch.vertex_count;
  for (size_t i = 0; i < batch.face_count; ++i) face_labels_.add(batch.face_labels[i], 0);
  if (batch.vertex_count > 0) growBox(batch);
}

void StreamFacts::finish() {
  diagram_.finish();
}

Schema StreamFacts::schema() const {
  Schema s = schema_;
  s.vertex_count = static_cast<int64_t>(vertices_);
  s.cell_count = figures().cells;
  s.face_count = face_labels_.faces();
  s.front_width = figures().front.width;
  s.front_span = figures().front.span;
  s.front_cells = figures().front.cells;
  if (vertices_ == 0) {
    s.box_min.clear();
    s.box_max.clear();
  }
  return s;
}

}  // namespace tetstream
