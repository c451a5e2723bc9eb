// swig: what the methods of all handles share: statuses, creation, structs that are filled,
// progress. Depends on handles.h, failure.h.
#pragma once

#include <chrono>

#include "failure.h"
#include "handles.h"

namespace tetstream::swig {

inline const char* messageOf(const tetstream_options* h) {
  return tetstream_options_message(h);
}
inline const char* messageOf(const tetstream_reader* h) {
  return tetstream_reader_message(h);
}
inline const char* messageOf(const tetstream_writer* h) {
  return tetstream_writer_message(h);
}
inline const char* messageOf(const tetstream_simplifier* h) {
  return tetstream_simplifier_message(h);
}
inline const char* messageOf(const tetstream_diagram* h) {
  return tetstream_diagram_message(h);
}
inline const char* messageOf(const tetstream_comparison* h) {
  return tetstream_comparison_message(h);
}

// Throws the handle's sentence if the status is a failure.
template <class T>
tetstream_status check(tetstream_status status, const Handle<T>& handle) {
  if (status >= 0) return status;
  const char* const sentence = handle ? messageOf(handle.get()) : nullptr;
  if (!sentence || !*sentence) throw Failure(status, tetstream_status_name(status));
  throw Failure(status, withoutFunction(status, sentence));
}

// A creating function gives a handle also when it fails, for the message.
template <class T, class Create>
void createInto(Handle<T>& handle, Create&& create) {
  T* made = nullptr;
  const tetstream_status status = inLibrary([&] { return create(&made); });
  handle.reset(made);
  check(status, handle);
}

// A struct of the library's that a function fills.
template <class S, class Fill>
S filled(Fill&& fill) {
  S out = {};
  out.struct_size = sizeof out;
  fill(out);
  return out;
}

// Between the library's progress callback, which may come often, and the language's function: the
// function is called when a phase begins or ends and some times a second; also without a function,
// the user can interrupt.
class ProgressRelay {
 public:
  explicit ProgressRelay(const Function& function) : function_(function) {}

  static int32_t callback(void* user, const tetstream_progress* progress) {
    return inCallback([&] { static_cast<ProgressRelay*>(user)->tell(*progress); });
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kPause{50};

  void tell(const tetstream_progress& progress) {
    const Clock::time_point now = Clock::now();
    const bool is_due = now - last_ >= kPause || progress.phase != phase_ || progress.fraction >= 1;
    if (!is_due) return;
    last_ = now;
    phase_ = progress.phase;
    checkInterrupt();
    tetstream_progress shown = progress;
    if (function_) function_("tetstream_progress *", &shown);
  }

  Function function_;
  Clock::time_point last_;
  const char* phase_ = nullptr;  // static texts
};

}  // namespace tetstream::swig
