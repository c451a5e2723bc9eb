// api: the caller's callbacks as a Source and as a Sink. Depends on structs.h, source.h.
#pragma once

#include <memory>
#include <optional>

#include "source.h"
#include "structs.h"

namespace tetstream {

// Runs one callback of `whose` that returns 0 to go on. Throws kCallback, naming it, when it
// returns another value or lets an exception out.
template <class Call>
void callBack(const char* whose, const char* name, Call&& call) {
  int32_t value = 0;
  try {
    value = call();
  } catch (...) {
    fail(Status::kCallback, "an exception left the %s's %s callback", whose, name);
  }
  if (value != 0) fail(Status::kCallback, "the %s's %s callback returned %d", whose, name, value);
}

// An exception out of `close` has nowhere to go: what was to be said about the stream was said.
template <class Close>
void closeQuietly(Close close, void* user) noexcept {
  try {
    if (close) close(user);
  } catch (...) {
  }
}

// A table of the caller's that takes something: a writer, a map, a log. `close` is called once if
// `open` was or would have been, by the destructor.
template <class Callbacks>
class Taker {
 public:
  Taker(const Callbacks& callbacks, const char* whose) : callbacks_(callbacks), whose_(whose) {}
  ~Taker() {
    if (opened_) closeQuietly(callbacks_.close, callbacks_.user);
  }
  Taker(const Taker&) = delete;
  Taker& operator=(const Taker&) = delete;

  template <class... Info>
  void open(const Info*... info) {
    opened_ = true;
    if (!callbacks_.open) return;
    callBack(whose_, "open", [&] { return callbacks_.open(callbacks_.user, info...); });
  }
  template <class Shown>
  void put(const Shown& shown) {
    callBack(whose_, "put", [&] { return callbacks_.put(callbacks_.user, &shown); });
  }
  void finish() {
    if (!callbacks_.finish) return;
    callBack(whose_, "finish", [&] { return callbacks_.finish(callbacks_.user); });
  }

 private:
  Callbacks callbacks_;
  const char* whose_;
  bool opened_ = false;
};

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

class CallbackSink final : public Sink {
 public:
  explicit CallbackSink(const tetstream_writer_callbacks& callbacks)
      : taker_(callbacks, "writer") {}
  void begin(const Schema& schema) override;
  void put(const BatchView& batch) override;
  void finish() override { taker_.finish(); }

 private:
  Taker<tetstream_writer_callbacks> taker_;
};

}  // namespace tetstream
