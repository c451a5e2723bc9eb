// format/trace: what the files of a vertex map and of a log of collapses have in common, whatever
// their form: columns, and the numbers of a row in the columns' order. Depends on stream (traces).
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "bytes.h"
#include "traces.h"

namespace tetstream {

// A row's numbers are two of 64 bits, and floats: those named here, then the fields' components.
struct TraceColumns {
  const char* names[6];
  std::vector<Column> fields;

  size_t components() const {
    size_t sum = 0;
    for (const Column& c : fields) sum += static_cast<size_t>(c.components);
    return sum;
  }
};

// Rows: begin(columns); add(number) for each of a row, then endRow(); finish().
template <class Rows>
class MapFile final : public MapSink {
 public:
  explicit MapFile(Rows rows) : rows_(std::move(rows)) {}
  void begin() override { rows_.begin({{"vertex", "cell", "w0", "w1", "w2", "w3"}, {}}); }
  void put(const MapRows& rows) override {
    for (size_t i = 0; i < rows.count; ++i) {
      rows_.add(rows.vertices[i]);
      rows_.add(rows.cells[i]);
      for (size_t k = 0; k < 4; ++k) rows_.add(rows.weights[4 * i + k]);
      rows_.endRow();
    }
  }
  void finish() override { rows_.finish(); }

 private:
  Rows rows_;
};

template <class Rows>
class LogFile final : public LogSink {
 public:
  explicit LogFile(Rows rows) : rows_(std::move(rows)) {}
  void begin(const Schema& input) override {
    TraceColumns columns{{"kept", "removed", "x", "y", "z", "error"}, {}};
    for (const Column& c : input.fields)
      if (isFloat(c.type)) columns.fields.push_back(c);
    values_ = columns.components();
    rows_.begin(columns);
  }
  void put(const LogRows& rows) override {
    for (size_t i = 0; i < rows.count; ++i) {
      rows_.add(rows.kept[i]);
      rows_.add(rows.removed[i]);
      for (size_t k = 0; k < 3; ++k) rows_.add(rows.positions[3 * i + k]);
      rows_.add(rows.errors[i]);
      for (size_t k = 0; k < values_; ++k) rows_.add(rows.values[values_ * i + k]);
      rows_.endRow();
    }
  }
  void finish() override { rows_.finish(); }

 private:
  Rows rows_;
  size_t values_ = 0;
};

}  // namespace tetstream
