#include "vtk_scan.h"

#include <cstring>

#include "status.h"
#include "values.h"

namespace tetstream {

constexpr size_t kVtkScanBytes = 1 << 16;
// Characters that are counted together: the first one, and what is behind it by vectors.
typedef unsigned char Characters __attribute__((vector_size(16)));
constexpr size_t kVtkStretch = 1 + 15 * sizeof(Characters);
constexpr size_t kMaxVtkWord = 4096;  // what is longer is no name, keyword or number

VtkScan::VtkScan(ByteSource& bytes) : bytes_(bytes), text_(kVtkScanBytes) {}

bool VtkScan::fill() {
  if (at_ < filled_) return true;
  begin_ += at_;
  at_ = 0;
  filled_ = bytes_.readAt(begin_, text_.data(), text_.size());
  return filled_ > 0;
}

void VtkScan::seek(uint64_t place) {
  if (place >= begin_ && place - begin_ <= filled_) {
    at_ = static_cast<size_t>(place - begin_);
    return;
  }
  begin_ = place;
  at_ = filled_ = 0;
}

void VtkScan::fail(uint64_t place, const std::string& text) const {
  tetstream::fail(Status::kBadData, "%s: byte %llu: %s", bytes_.name().c_str(),
                  static_cast<unsigned long long>(place), text.c_str());
}

std::string VtkScan::word(bool same_line) {
  std::string word;
  while (fill() && isBlank(text_[at_])) {
    if (same_line && text_[at_] == '\n') return word;
    ++at_;
  }
  while (fill() && !isBlank(text_[at_])) {
    if (word.size() == kMaxVtkWord) fail(place() - word.size(), "there is no end to this word");
    word += text_[at_++];
  }
  return word;
}

std::string VtkScan::line() {
  std::string line;
  while (fill()) {
    const char c = text_[at_++];
    if (c == '\n') break;
    if (line.size() < kMaxVtkWord) line += c;
  }
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line;
}

// 255 in each place of a blank, else 0.
static Characters blanksIn(const char* text) {
  Characters c;
  std::memcpy(&c, text, sizeof c);
  return static_cast<Characters>((c == ' ') | (c == '\n') | (c == '\t') | (c == '\r'));
}

// How many words begin in so many characters, of which the one before may be in a word.
static unsigned beginsIn(const char* text, bool inside) {
  Characters begins = {};
  for (size_t i = 1; i < kVtkStretch; i += sizeof begins)
    begins -= blanksIn(text + i - 1) & ~blanksIn(text + i);
  unsigned sum = !inside && !isBlank(text[0]);
  for (size_t i = 0; i < sizeof begins; ++i) sum += begins[i];
  return sum;
}

bool VtkScan::skipWords(uint64_t count) {
  bool inside = false;
  while (count > 0 || inside) {
    if (!fill()) return count == 0;
    for (; count > kVtkStretch && filled_ - at_ >= kVtkStretch; at_ += kVtkStretch) {
      count -= beginsIn(text_.data() + at_, inside);
      inside = !isBlank(text_[at_ + kVtkStretch - 1]);
    }
    for (; at_ < filled_ && (count > 0 || inside); ++at_) {
      const bool blank = isBlank(text_[at_]);
      count -= !blank && !inside;
      inside = !blank;
      if (blank && count == 0) return true;
    }
  }
  return true;
}

}  // namespace tetstream
