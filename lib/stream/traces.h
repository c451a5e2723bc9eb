// stream: where a simplification tells what became of the vertices of its input. Depends on
// schema.h.
//
// Vertices are named by their origins: their ranks in the input, or, where that was put into
// another order on its way, in the input as it was.
#pragma once

#include <cstddef>
#include <cstdint>

#include "schema.h"

namespace tetstream {

constexpr size_t kTraceRows = 4096;  // at once, at most

// Vertices of the input and where each lies now: the cell's rank in the output and the weights of
// the cell's corners, as they are stored there. Weights add up to 1; one is below 0 for a point
// outside of the simplified mesh.
struct MapRows {
  size_t count = 0;
  const int64_t* vertices = nullptr;
  const int64_t* cells = nullptr;
  const double* weights = nullptr;  // [count][4]
};

// Collapses in the order in which they were done: the vertex `removed` was merged into `kept`,
// which has the new position and values then.
struct LogRows {
  size_t count = 0;
  const int64_t* kept = nullptr;
  const int64_t* removed = nullptr;
  const double* positions = nullptr;  // [count][3]
  const double* values = nullptr;     // [count][components of the float fields, in order]
  const double* errors = nullptr;     // in the report's unit
};

// Each is called as a Sink is. The rows' arrays live during the call.
class MapSink {
 public:
  virtual ~MapSink() = default;
  virtual void begin() = 0;
  virtual void put(const MapRows& rows) = 0;
  virtual void finish() = 0;
};

class LogSink {
 public:
  virtual ~LogSink() = default;
  virtual void begin(const Schema& input) = 0;
  virtual void put(const LogRows& rows) = 0;
  virtual void finish() = 0;
};

// What is not asked for is null. Borrowed.
struct TraceSinks {
  MapSink* map = nullptr;
  LogSink* log = nullptr;
  bool any() const { return map || log; }
};

}  // namespace tetstream
