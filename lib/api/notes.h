// api: what a reader or a writer has to say besides its figures. Depends on nothing.
#pragma once

#include <cstdint>
#include <deque>
#include <string>

namespace tetstream {

// A text stays where it is while others are added. A file has as many notes as it has names that
// are not read: after some hundreds the last one says that there are more.
class Notes {
 public:
  void add(const std::string& note) {
    if (notes_.size() < kMost)
      notes_.push_back(note);
    else if (notes_.size() == kMost)
      notes_.emplace_back("further notes are left out");
  }
  // Note `index`, or null.
  const char* at(int32_t index) const noexcept {
    const auto i = static_cast<size_t>(index);
    return index >= 0 && i < notes_.size() ? notes_[i].c_str() : nullptr;
  }

 private:
  static constexpr size_t kMost = 999;
  std::deque<std::string> notes_;
};

}  // namespace tetstream
