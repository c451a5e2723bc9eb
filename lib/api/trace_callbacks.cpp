#include "trace_callbacks.h"

#include "callbacks.h"

namespace tetstream {

CallbackMap::CallbackMap(const tetstream_map_callbacks& callbacks) : callbacks_(callbacks) {
  needPlace(reinterpret_cast<const void*>(callbacks_.put), "the callback put");
}

CallbackMap::~CallbackMap() {
  if (begun_) closeQuietly(callbacks_.close, callbacks_.user);
}

void CallbackMap::begin() {
  begun_ = true;
  if (callbacks_.open) callBack("map's open", [&] { return callbacks_.open(callbacks_.user); });
}

void CallbackMap::put(const MapRows& rows) {
  tetstream_map_rows shown = {};
  shown.struct_size = sizeof shown;
  shown.count = static_cast<int64_t>(rows.count);
  shown.vertices = rows.vertices;
  shown.cells = rows.cells;
  shown.weights = rows.weights;
  callBack("map's put", [&] { return callbacks_.put(callbacks_.user, &shown); });
}

void CallbackMap::finish() {
  if (callbacks_.finish)
    callBack("map's finish", [&] { return callbacks_.finish(callbacks_.user); });
}

CallbackLog::CallbackLog(const tetstream_log_callbacks& callbacks) : callbacks_(callbacks) {
  needPlace(reinterpret_cast<const void*>(callbacks_.put), "the callback put");
}

CallbackLog::~CallbackLog() {
  if (begun_) closeQuietly(callbacks_.close, callbacks_.user);
}

void CallbackLog::begin(const Schema& input) {
  const PublicSchema shown(input, false);
  begun_ = true;
  if (callbacks_.open)
    callBack("log's open", [&] { return callbacks_.open(callbacks_.user, &shown.info()); });
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
  callBack("log's put", [&] { return callbacks_.put(callbacks_.user, &shown); });
}

void CallbackLog::finish() {
  if (callbacks_.finish)
    callBack("log's finish", [&] { return callbacks_.finish(callbacks_.user); });
}

}  // namespace tetstream
