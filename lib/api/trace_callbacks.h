// api: the caller's callbacks for a vertex map and for a log of collapses. Depends on callbacks.h,
// traces.h.
#pragma once

#include "callbacks.h"
#include "traces.h"

namespace tetstream {

class CallbackMap final : public MapSink {
 public:
  explicit CallbackMap(const tetstream_map_callbacks& callbacks) : taker_(callbacks, "map") {}
  void begin() override { taker_.open(); }
  void put(const MapRows& rows) override;
  void finish() override { taker_.finish(); }

 private:
  Taker<tetstream_map_callbacks> taker_;
};

class CallbackLog final : public LogSink {
 public:
  explicit CallbackLog(const tetstream_log_callbacks& callbacks) : taker_(callbacks, "log") {}
  void begin(const Schema& input) override;
  void put(const LogRows& rows) override;
  void finish() override { taker_.finish(); }

 private:
  Taker<tetstream_log_callbacks> taker_;
};

}  // namespace tetstream
