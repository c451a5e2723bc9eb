// api: the caller's callbacks as a Source and as a Sink. Depends on structs.h, source.h.
#pragma once

#include <memory>
#include <optional>

#include "source.h"
#include "structs.h"

namespace tetstream {

// Runs one callback that returns 0 to go on. Throws kCallback, naming it, when it returns another
// value or lets an exception out.
template <class Call>
void callBack(const char* name, Call&& call) {
  int32_t value = 0;
  try {
    value = call();
  } catch (...) {
    fail(Status::kCallback, "an exception left the %s callback", name);
  }
  if (value != 0) fail(Status::kCallback, "the %s callback returned %d", name, value);
}

// An exception out of `close` has nowhere to go: what was to be said about the stream was said.
template <class Close>
void closeQuietly(Close close, void* user) noexcept {
  try {
    if (close) close(user);
  } catch (...) {
  }
}

// A reader of the caller's. `close` is called once if `open` was, here or by the destructor.
class CallbackSource final : public Source {
 public:
  explicit CallbackSource(const tetstream_reader_callbacks& callbacks);
  ~CallbackSource() override;

  void open();  // once, before anything else
  bool opened() const { return opened_; }
  bool indexed() const { return indexed_; }
  const Schema& schema() const override { return schema_; }
  bool next(BatchView& batch) override;

 private:
  tetstream_reader_callbacks callbacks_;
  Schema schema_;
  bool opened_ = false, indexed_ = false, ended_ = false;
  std::optional<BatchChecker> checker_;
};

// A writer of the caller's. `close` is called once if `begin` was, by the destructor.
class CallbackSink final : public Sink {
 public:
  explicit CallbackSink(const tetstream_writer_callbacks& callbacks) : callbacks_(callbacks) {}
  ~CallbackSink() override;

  void begin(const Schema& schema) override;
  void put(const BatchView& batch) override;
  void finish() override;

 private:
  tetstream_writer_callbacks callbacks_;
  bool begun_ = false;
};

}  // namespace tetstream
