// The bytes of a fuzz target's input as a row of choices; when they end, every choice is the first.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>

namespace fuzz {

class Choices {
 public:
  Choices(const uint8_t* data, size_t size) : data_(data), left_(size) {}

  bool atEnd() const { return left_ == 0; }
  uint8_t byte() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  // Below `end`, from one byte, or two where one is not enough.
  size_t below(size_t end) {
    const size_t drawn = end > 256 ? byte() + size_t{256} * byte() : byte();
    return end ? drawn % end : 0;
  }
  uint64_t bits() {
    uint64_t out = 0;
    for (int i = 0; i < 8; ++i) out = out << 8 | byte();
    return out;
  }
  std::string word() {
    std::string out(below(20), ' ');
    for (char& c : out) c = static_cast<char>(byte());
    return out;
  }
  // Mostly of a coarse lattice, where points coincide and cells are flat; else any bits there are.
  double real() {
    const uint8_t kind = byte();
    if (kind < 250) return static_cast<int8_t>(kind) / 8;
    const uint64_t number = bits();
    double out;
    std::memcpy(&out, &number, sizeof out);
    return out;
  }

 private:
  const uint8_t* data_;
  size_t left_;
};

}  // namespace fuzz
