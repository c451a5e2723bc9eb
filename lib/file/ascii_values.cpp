// Values that stand in a file as text, read in sequence. So that a reader can go back without
// starting anew, the place of every so-manieth value is kept.
#include <algorithm>
#include <charconv>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <utility>

#include "plain_number.h"
#include "status.h"
#include "values.h"

namespace tetstream {

namespace {

constexpr size_t kTextBytes = 1 << 16;
constexpr size_t kMaxWord = 512;    // characters of one number
constexpr size_t kMaxMarks = 4096;  // when there are more, every second one is dropped

bool isWhole(std::string_view word, std::from_chars_result r) {
  return r.ec == std::errc() && r.ptr == word.data() + word.size();
}

// Too small for T is 0; too large is an error.
template <class T>
bool parseWord(std::string_view word, T* value) {
  if (!word.empty() && word[0] == '+') word.remove_prefix(1);
  const std::from_chars_result r = std::from_chars(word.data(), word.data() + word.size(), *value);
  if (isWhole(word, r)) return true;
  if constexpr (std::is_floating_point_v<T>) {
    const bool tiny = word.find("e-") != word.npos || word.find("E-") != word.npos;
    if (r.ec == std::errc::result_out_of_range && r.ptr == word.data() + word.size() && tiny) {
      *value = word[0] == '-' ? -T(0) : T(0);
      return true;
    }
  }
  return false;
}

using tetstream::readPlain;

const char* readPlain(const char* at, uint64_t* value) {
  int64_t found;
  const char* end = readPlain(at, &found);
  if (end) *value = static_cast<uint64_t>(found);
  return end;
}

class AsciiValues final : public Values {
 public:
  AsciiValues(ByteSource& bytes, const std::string& what, ValueType type, const TextPlace& place)
      : bytes_(bytes),
        what_(what),
        type_(type),
        begin_(place.begin),
        end_(place.end),
        count_(place.count),
        text_at_(begin_) {
    // A digit each and blanks between them.
    if (end_ - begin_ < 2 * count_ - 1)
      fail(Status::kBadData, "%s has not enough text for the %llu values that the counts need",
           what_.c_str(), static_cast<unsigned long long>(count_));
    text_.resize(static_cast<size_t>(std::min<uint64_t>(kTextBytes, end_ - begin_)));
  }

  void read(uint64_t first, size_t count, void* out, ScalarType type) override {
    if (first != next_) seek(first);
    if (type_ == ValueType::kFloat32) return readAs<float>(count, out, type);
    if (type_ == ValueType::kFloat64) return readAs<double>(count, out, type);
    if (type_ == ValueType::kUInt64) return readAs<uint64_t>(count, out, type);
    readAs<int64_t>(count, out, type);
  }

 private:
  template <class In>
  void readAs(size_t count, void* out, ScalarType type) {
    switch (type) {
      case ScalarType::kFloat32:
        return readWords<In>(count, static_cast<float*>(out));
      case ScalarType::kFloat64:
        return readWords<In>(count, static_cast<double*>(out));
      case ScalarType::kInt32:
        return readWords<In>(count, static_cast<int32_t*>(out));
      case ScalarType::kInt64:
        return readWords<In>(count, static_cast<int64_t*>(out));
    }
  }

  template <class In, class Out>
  void readWords(size_t count, Out* out) {
    for (size_t i = 0; i < count; ++i) {
      In value;
      std::string_view word;
      bool good = nextPlain(&value);
      if (!good) {
        word = nextWord();
        good = parseWord(word, &value);
      }
      if constexpr (std::is_integral_v<In> && std::is_integral_v<Out>)
        good = good && std::in_range<Out>(value);
      if (!good) failWord(word);
      out[i] = static_cast<Out>(value);
    }
    if (next_ == count_) checkEnd();
  }

  uint64_t place() const { return text_at_ + at_; }

  [[noreturn]] void failWord(std::string_view word) {
    if (word.empty())
      fail(Status::kBadData, "%s: byte %llu: there are %llu values where the counts need %llu",
           what_.c_str(), static_cast<unsigned long long>(place()),
           static_cast<unsigned long long>(next_), static_cast<unsigned long long>(count_));
    const std::string shown(word.substr(0, 40));
    fail(Status::kBadData, "%s: byte %llu: \"%s\" is no number of the array's type", what_.c_str(),
         static_cast<unsigned long long>(place() - word.size()), shown.c_str());
  }

  void checkEnd() {
    if (!findWord()) return;
    fail(Status::kBadData,
         "%s: byte %llu: there are more values than the %llu that the counts need", what_.c_str(),
         static_cast<unsigned long long>(place()), static_cast<unsigned long long>(count_));
  }

  // The next word as nearly all are; false, with nothing taken, if it is another one.
  template <class In>
  bool nextPlain(In* value) {
    if (next_ == marks_.size() * stride_) return false;  // to be marked
    while (at_ < filled_ && isBlank(text_[at_])) ++at_;
    if (filled_ - at_ < kPlainNumberBytes) return false;
    const char* end = readPlain(text_.data() + at_, value);
    if (!end || !isBlank(*end)) return false;
    at_ = static_cast<size_t>(end - text_.data());
    ++next_;
    return true;
  }

  // The next word, empty at the end; it lives until the next call.
  std::string_view nextWord() {
    if (next_ == marks_.size() * stride_) mark();
    if (!findWord()) return {};
    size_t size = 0;
    for (;;) {
      while (at_ + size < filled_ && !isBlank(text_[at_ + size])) ++size;
      if (at_ + size < filled_ || size > kMaxWord || !refill()) break;
    }
    if (size > kMaxWord)
      fail(Status::kBadData, "%s: byte %llu: a word of more than %zu characters is no number",
           what_.c_str(), static_cast<unsigned long long>(place()), kMaxWord);
    const std::string_view word(text_.data() + at_, size);
    at_ += size;
    ++next_;
    return word;
  }

  // Passes blanks; false at the end.
  bool findWord() {
    for (;;) {
      while (at_ < filled_ && isBlank(text_[at_])) ++at_;
      if (at_ < filled_) return true;
      if (!refill()) return false;
    }
  }

  // Keeps what was not yet read and adds to it; false at the end.
  bool refill() {
    std::memmove(text_.data(), text_.data() + at_, filled_ - at_);
    filled_ -= at_;
    text_at_ += at_;
    at_ = 0;
    const uint64_t from = text_at_ + filled_;
    const size_t wanted =
        static_cast<size_t>(std::min<uint64_t>(text_.size() - filled_, end_ - from));
    const size_t got = wanted ? bytes_.readAt(from, text_.data() + filled_, wanted) : 0;
    filled_ += got;
    return got > 0;
  }

  void mark() {
    if (marks_.size() == kMaxMarks) {
      for (size_t i = 0; i < kMaxMarks / 2; ++i) marks_[i] = marks_[2 * i];
      marks_.resize(kMaxMarks / 2);
      stride_ *= 2;
      if (next_ % stride_ != 0) return;
    }
    marks_.push_back(place());
  }

  void seek(uint64_t first) {
    if (!marks_.empty()) {
      const uint64_t mark = std::min<uint64_t>(first / stride_, marks_.size() - 1);
      if (first < next_ || mark * stride_ > next_) {
        next_ = mark * stride_;
        text_at_ = marks_[mark];
        at_ = filled_ = 0;
      }
    }
    while (next_ < first)
      if (nextWord().empty()) failWord({});
  }

  ByteSource& bytes_;
  std::string what_;
  ValueType type_;
  uint64_t begin_, end_, count_;
  uint64_t next_ = 0;  // index of the value after the last one read
  uint64_t stride_ = 256;
  std::vector<uint64_t> marks_;  // where to go on for value i * stride
  std::vector<char> text_;
  uint64_t text_at_;            // place in the file of text_[0]
  size_t at_ = 0, filled_ = 0;  // read, and filled, of text_
};

}  // namespace

std::unique_ptr<Values> openTextValues(ByteSource& bytes, const std::string& what, ValueType type,
                                       const TextPlace& place) {
  return std::make_unique<AsciiValues>(bytes, what, type, place);
}

}  // namespace tetstream
