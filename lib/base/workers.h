// base: threads that work beside the caller's. Depends on nothing.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <utility>

namespace tetstream {

// A piece of work, which may be run late, when nobody waits for it any more: it finds out by itself
// whether anything is left to do. It is gone when nobody keeps it.
class Work {
 public:
  Work() = default;
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;
  virtual void run() noexcept = 0;

  void keep() noexcept { ++keepers_; }
  void drop() noexcept {
    if (--keepers_ == 0) delete this;
  }

 protected:
  virtual ~Work() = default;

 private:
  std::atomic<size_t> keepers_ = 0;
};

// Keeps a piece of work. note: std::shared_ptr would do, but for helgrind, which takes its plain
// look at the counts for a race.
template <class T>
class Kept {
 public:
  explicit Kept(T* work) noexcept : work_(work) { work_->keep(); }
  Kept(const Kept& other) noexcept : Kept(other.work_) {}
  Kept(Kept&& other) noexcept : work_(std::exchange(other.work_, nullptr)) {}
  Kept& operator=(Kept other) noexcept {
    std::swap(work_, other.work_);
    return *this;
  }
  ~Kept() {
    if (work_) work_->drop();
  }
  T* get() const { return work_; }
  T* operator->() const { return work_; }

 private:
  T* work_;
};

class Workers {
 public:
  virtual ~Workers() = default;
  virtual size_t threads() const = 0;
  // Has the work run once, at any time, by one of the threads or at once. False: nobody will. Only
  // the caller's thread submits.
  virtual bool submit(Kept<Work> work) noexcept = 0;
};

// Threads of our own. Each starts when there is work that no other waits for; what nobody has begun
// when they end is dropped. Signals are left to the other threads of the process.
std::unique_ptr<Workers> startWorkers(size_t threads);

}  // namespace tetstream
