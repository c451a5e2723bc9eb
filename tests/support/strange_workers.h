// tests/support: workers as a caller may bring them: that refuse, that work at once, or too late.
#pragma once

#include <thread>
#include <vector>

#include "workers.h"

namespace tetstream::test {

class NoWorkers final : public Workers {
 public:
  size_t threads() const override { return 3; }
  bool submit(Kept<Work>) noexcept override {
    ++refused;
    return false;
  }
  size_t refused = 0;
};

class HastyWorkers final : public Workers {
 public:
  size_t threads() const override { return 3; }
  bool submit(Kept<Work> work) noexcept override {
    work->run();
    return true;
  }
};

// All is done, on another thread, before the caller begins.
class SwiftWorkers final : public Workers {
 public:
  size_t threads() const override { return 3; }
  bool submit(Kept<Work> work) noexcept override {
    std::thread([&work] { work->run(); }).join();
    return true;
  }
};

// They work when they are told to.
class LazyWorkers final : public Workers {
 public:
  size_t threads() const override { return 3; }
  bool submit(Kept<Work> work) noexcept override {
    waiting.push_back(std::move(work));
    return true;
  }
  void workAll() {
    for (const Kept<Work>& work : std::exchange(waiting, {})) work->run();
  }
  std::vector<Kept<Work>> waiting;
};

}  // namespace tetstream::test
