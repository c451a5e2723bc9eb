// api: the caller's callbacks for a vertex map and for a log of collapses. Depends on structs.h,
// traces.h.
#pragma once

#include "structs.h"
#include "traces.h"

namespace tetstream {

// `close` is called once if `begin` was, by the destructor.
class CallbackMap final : public MapSink {
 public:
  explicit CallbackMap(const tetstream_map_callbacks& callbacks);  // throws kBadArgument
  ~CallbackMap() override;
  void begin() override;
  void put(const MapRows& rows) override;
  void finish() override;

 private:
  tetstream_map_callbacks callbacks_;
  bool begun_ = false;
};

class CallbackLog final : public LogSink {
 public:
  explicit CallbackLog(const tetstream_log_callbacks& callbacks);  // throws kBadArgument
  ~CallbackLog() override;
  void begin(const Schema& input) override;
  void put(const LogRows& rows) override;
  void finish() override;

 private:
  tetstream_log_callbacks callbacks_;
  bool begun_ = false;
};

}  // namespace tetstream
