// base: what can go wrong, as one number and one sentence. Depends on nothing.
//
// Kernels return values; plumbing throws Error; lib/api turns an Error into a
// status code and a message. The numbers equal TETSTREAM_* of the public header
// (lib/api asserts it).
#pragma once

#include <cstdint>
#include <exception>
#include <string>
#include <utility>

namespace tetstream {

enum class Status : int32_t {
  kOk = 0,
  kEnd = 1,           // a stream has no more events
  kTargetMissed = 2,  // the output is complete and valid but larger than asked for
  kBadArgument = -1,  // an argument is out of its documented range
  kBadState = -2,     // the call is not allowed now
  kNoMemory = -3,     // memory, or the budget set for it, is used up
  kBadData = -4,      // a file or a stream breaks its format's rules
  kIo = -5,           // the system refused a read, a write or an open
  kUnsupported = -6,  // valid input that this build or this format cannot hold
  kCancelled = -7,    // the progress callback asked to stop
  kCallback = -8,     // a callback of the caller's returned non-zero
  kInternal = -9,     // a defect of the library
};

class Error : public std::exception {
 public:
  Error(Status status, std::string text) : status_(status), text_(std::move(text)) {}
  Status status() const noexcept { return status_; }
  const std::string& text() const noexcept { return text_; }
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  Status status_;
  std::string text_;
};

// Throws Error{status, text formatted as by printf}.
[[noreturn]] void fail(Status status, const char* format, ...)
    __attribute__((format(printf, 2, 3)));

// The formatted text, as by printf, in the C locale's digits.
std::string textOf(const char* format, ...) __attribute__((format(printf, 1, 2)));

// "TETSTREAM_BAD_DATA" and the like; never null.
const char* statusName(Status status) noexcept;

}  // namespace tetstream
