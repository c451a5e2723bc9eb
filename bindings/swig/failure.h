// swig: a status below 0 as an exception, and exceptions carried through the C library.
#pragma once

#include <tetstream/tetstream.h>

#include <exception>
#include <stdexcept>
#include <string>

#include "language.h"

namespace tetstream::swig {

// A status below 0 with its sentence.
class Failure : public std::runtime_error {
 public:
  Failure(tetstream_status status, const std::string& sentence)
      : std::runtime_error(sentence), status_(status) {}
  tetstream_status status() const { return status_; }

 private:
  tetstream_status status_;
};

// What the library said, without the C function that a sentence on misuse begins with: it is not
// the one that a user of a language called.
std::string withoutFunction(tetstream_status status, const std::string& sentence);

// Throws a TETSTREAM_BAD_ARGUMENT.
[[noreturn]] void failArgument(const std::string& sentence);

// Throws what a function without a handle failed with.
void check(tetstream_status status, const char* function);

// Around a call of the library that may take long or call functions of the language. Callbacks
// leave what they throw here, and return "stop"; it is thrown again when the call is over.
class LibraryCall {
 public:
  LibraryCall() : outer_(innermost_) { innermost_ = this; }
  LibraryCall(const LibraryCall&) = delete;
  LibraryCall& operator=(const LibraryCall&) = delete;
  ~LibraryCall() { innermost_ = outer_; }

  // The first one counts: the others are its consequences.
  static void keep(std::exception_ptr thrown) noexcept;
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  static thread_local LibraryCall* innermost_;  // of this thread: a callback may make another call
  LibraryCall* outer_;
  std::exception_ptr thrown_;
};

// Runs a call of the library without the language's lock.
template <class Work>
tetstream_status inLibrary(Work&& work) {
  const LibraryCall call;
  tetstream_status status = TETSTREAM_OK;
  {
    const Unlocked unlocked;
    status = work();
  }
  call.rethrow();
  return status;
}

// The body of a callback of the library: 0 to go on, 1 to stop.
template <class Body>
int32_t inCallback(Body&& body) noexcept {
  try {
    body();
    return 0;
  } catch (...) {
    LibraryCall::keep(std::current_exception());
    return 1;
  }
}

}  // namespace tetstream::swig
