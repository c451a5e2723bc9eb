// file/text: numbers of a file that may be text or binary, on their way out. Depends on bytes.h,
// text_number.h.
#pragma once

#include <cstring>
#include <string>

#include "bytes.h"
#include "text_number.h"

namespace tetstream {

class NumberSink {
 public:
  NumberSink(ByteSink& bytes, bool binary) : sink_(bytes), binary_(binary) {}

  bool binary() const { return binary_; }
  uint64_t written() const { return sink_.written(); }
  // Text as it is, in both kinds of files.
  void text(const std::string& text) { sink_.write(text.data(), text.size()); }
  // In text a number and a blank; else its bytes, in the machine's order.
  template <class Stored>
  void integer(int64_t value) {
    const auto stored = static_cast<Stored>(value);
    if (binary_) return sink_.write(&stored, sizeof stored);
    number(&value, ScalarType::kInt64);
  }
  template <class Stored>
  void real(Stored value) {
    if (binary_) return sink_.write(&value, sizeof value);
    number(&value, sizeof value == 4 ? ScalarType::kFloat32 : ScalarType::kFloat64);
  }
  // A value of any type as a float64.
  void real(const void* value, ScalarType type);
  void endRow() {
    if (!binary_) sink_.write("\n", 1);
  }
  void flush() { sink_.flush(); }

 private:
  void number(const void* value, ScalarType type) {
    word_.clear();
    printNumber(value, type, word_);
    word_ += ' ';
    sink_.write(word_.data(), word_.size());
  }

  BufferedSink sink_;
  bool binary_;
  std::string word_;
};

// note: text of a float32 has the digits of the float64, so that whoever reads that gets the same.
inline void NumberSink::real(const void* value, ScalarType type) {
  if (!binary_ && !isFloat(type)) return number(value, type);
  double wide;
  convertScalars(value, type, &wide, ScalarType::kFloat64, 1);
  real(wide);
}

}  // namespace tetstream
