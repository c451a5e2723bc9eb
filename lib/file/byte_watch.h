// file: tells how much of a file was read while it is opened, and that one is being written.
// Depends on bytes.h.
#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include "bytes.h"

namespace tetstream {

// Whoever is told of each step of something long wants to hear of it some times a second.
class TellingPause {
 public:
  bool isOver();  // and then the next one begins

 private:
  std::chrono::steady_clock::time_point told_{};
};

// `tell` is called by reads of the thread that made the watch, until that ends, some times a
// second, also while they wait for bytes of a pipe; what it throws leaves the read.
class ByteWatch {
 public:
  // `fraction` of the bytes of all that is watched so far; -1 where a size is not known.
  using Tell = std::function<void(double fraction)>;

  explicit ByteWatch(Tell tell);  // empty: nothing is watched
  ~ByteWatch();                   // sources may live longer
  ByteWatch(const ByteWatch&) = delete;
  ByteWatch& operator=(const ByteWatch&) = delete;

  // The same bytes; nothing for nothing.
  std::unique_ptr<ByteSource> watched(std::unique_ptr<ByteSource> bytes) const;

 private:
  struct State;
  std::shared_ptr<State> state_;  // null where nothing is watched
};

// The same sink; `tell`, if there is any, is called before each write, by the thread that writes;
// what it throws leaves the write.
std::unique_ptr<ByteSink> watched(std::unique_ptr<ByteSink> bytes, std::function<void()> tell);

}  // namespace tetstream
