// base: memory that is counted against a budget. Depends on status.h.
//
// An Account is the budget of one handle, whose threads may charge it at the same time; every large
// array of the window and of the layout is an Array that charges it. Small things (names, headers)
// use the standard containers.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "status.h"

namespace tetstream {

// a * b, or throws kNoMemory when it does not fit.
size_t checkedMultiply(size_t a, size_t b);
size_t checkedAdd(size_t a, size_t b);

class Account {
 public:
  // Of a budget of so many bytes it has that share; messages speak of the budget.
  explicit Account(size_t budget_bytes = 0, double share = 1);
  Account(const Account&) = delete;
  Account& operator=(const Account&) = delete;

  void charge(size_t bytes);  // throws kNoMemory when the limit (0: none) would be passed
  void release(size_t bytes) noexcept { used_.fetch_sub(bytes, std::memory_order_relaxed); }
  size_t used() const noexcept { return used_.load(std::memory_order_relaxed); }
  size_t peak() const noexcept { return peak_.load(std::memory_order_relaxed); }
  size_t limit() const noexcept { return limit_; }
  // Whether what failed last was a charge that would have passed the limit.
  bool refused() const noexcept { return refused_.load(std::memory_order_relaxed); }
  void failedOtherwise() noexcept { refused_.store(false, std::memory_order_relaxed); }

 private:
  [[noreturn]] void refuse(size_t bytes);

  const size_t budget_;
  const double share_;
  const size_t limit_;
  std::atomic<size_t> used_ = 0, peak_ = 0;
  std::atomic<bool> refused_ = false;
};

void* reallocateBytes(Account& account, void* old, size_t old_bytes, size_t new_bytes);
void freeBytes(Account& account, void* old, size_t old_bytes) noexcept;
// Of memory that will be written soon the system gives all pages at once: where a page is dear that
// comes when it is first written, as in virtual machines, that takes a tenth of the time.
void askForPages(void* data, size_t bytes) noexcept;

// An array of plain data that never constructs, zeroes or touches its elements: memory that is
// not used is never paid for. Growing keeps the contents and, for large arrays, does not copy.
template <class T>
class Array {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  explicit Array(Account& account) : account_(&account) {}
  Array(Account& account, size_t size) : account_(&account) { resize(size); }
  ~Array() { freeBytes(*account_, data_, size_ * sizeof(T)); }
  Array(Array&& other) noexcept
      : account_(other.account_),
        data_(std::exchange(other.data_, nullptr)),
        size_(std::exchange(other.size_, 0)) {}
  Array(const Array&) = delete;
  Array& operator=(const Array&) = delete;
  Array& operator=(Array&&) = delete;

  void resize(size_t size) {
    data_ = static_cast<T*>(
        reallocateBytes(*account_, data_, size_ * sizeof(T), checkedMultiply(size, sizeof(T))));
    size_ = size;
  }
  // Elements [first, end) will be written soon. Under a budget no page comes before that.
  void expect(size_t first, size_t end) noexcept {
    if (account_->limit() == 0 && first < end)
      askForPages(data_ + first, (end - first) * sizeof(T));
  }
  // Resizes it, if need be, to so many elements, which will be written soon.
  void makeRoomFor(size_t size) {
    const size_t before = size_;
    if (before >= size) return;
    resize(size);
    expect(before, size);
  }
  void swap(Array& other) noexcept {
    std::swap(account_, other.account_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }
  Account& account() const noexcept { return *account_; }
  size_t size() const noexcept { return size_; }
  T* data() noexcept { return data_; }
  const T* data() const noexcept { return data_; }
  T& operator[](size_t i) noexcept { return data_[i]; }
  const T& operator[](size_t i) const noexcept { return data_[i]; }

 private:
  Account* account_;
  T* data_ = nullptr;
  size_t size_ = 0;
};

// An array that is full grows by `more`, or, where memory does not suffice for that, by the little
// that a budget may still allow. resize(size) resizes it, or throws and leaves it as it is.
template <class Resize>
void growArray(size_t size, size_t more, Resize resize) {
  try {
    resize(checkedAdd(size, more));
  } catch (const Error& error) {
    if (error.status() != Status::kNoMemory) throw;
    resize(checkedAdd(size, more / 16 + 1));
  }
}

// Peak resident set of this process in bytes, 0 where the system does not tell.
uint64_t peakResidentBytes();

}  // namespace tetstream
