#include "trace_callbacks.h"

namespace tetstream {

void CallbackMap::put(const MapRows& rows) {
  tetstream_map_rows shown = {};
  shown.struct_size = sizeof shown;
  shown.count = static_cast<int64_t>(rows.count);
  shown.vertices = rows.vertices;
  shown.cells = rows.cells;
  shown.weights = rows.weights;
  taker_.put(shown);
}

void CallbackLog::begin(const Schema& input) {
  const PublicSchema shown(input, false);
  taker_.open(&shown.info());
}

void CallbackLog::put(const LogRows& rows) {
  tetstream_log_rows shown = {};
  shown.struct_size = sizeof shown;
  shown.count = static_cast<int64_t>(rows.count);
  shown.kept = rows.kept;
  shown.removed = rows.removed;
  shown.positions = rows.positions;
  shown.values = rows.values;
  shown.errors = rows.errors;
  taker_.put(shown);
}

}  // namespace tetstream
