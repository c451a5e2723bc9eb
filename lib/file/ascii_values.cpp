// Values that stand in a file as text, read in sequence. So that a reader can go back without
// starting anew, the place of every n-th value is kept.
#include <algorithm>
#include <cstring>
#include <optional>
#include <string_view>

#include "status.h"
#include "text_values.h"
#include "values.h"
#include "values_ahead.h"

namespace tetstream {

namespace {

constexpr size_t kTextBytes = 1 << 16;
constexpr size_t kMaxMarks = 4096;  // when there are more, every second one is dropped

// A mesh has several arrays, each of which is read ahead by itself: less of each, and by fewer,
// than of rows.
constexpr size_t kMostPieceBytes = 64 << 10;
constexpr size_t kMostThreads = 4;
// Values that are read in sequence, after a leap, before anything is read ahead.
constexpr uint64_t kSequence = 1 << 14;

TextThreads threadsOf(const Helpers& helpers) {
  TextThreads threads = helpers.threads;
  threads.piece_bytes = std::min(threads.piece_bytes, kMostPieceBytes);
  threads.most = std::min(threads.most, kMostThreads);
  return threads;
}

class AsciiValues final : public Values {
 public:
  AsciiValues(ByteSource& bytes, const std::string& what, ValueType type, const TextPlace& place,
              const Helpers& helpers)
      : bytes_(bytes),
        what_(what),
        type_(type),
        helpers_{threadsOf(helpers), helpers.thread},
        end_(place.end),
        count_(place.count),
        text_at_(place.begin) {
    // A digit each and blanks between them.
    if (end_ - text_at_ < 2 * count_ - 1)
      fail(Status::kBadData, "%s has not enough text for the %llu values that the counts need",
           what_.c_str(), static_cast<unsigned long long>(count_));
    text_.resize(static_cast<size_t>(std::min<uint64_t>(kTextBytes, end_ - text_at_)) + 1);
  }

  void read(uint64_t first, size_t count, void* out, ScalarType type) override {
    if (first != next_) seek(first);
    withTextType(type_, [&](auto t) { readAs<decltype(t)>(count, out, type); });
  }

 private:
  template <class In>
  void readAs(size_t count, void* out, ScalarType type) {
    switch (type) {
      case ScalarType::kFloat32:
        return readValues<In>(count, static_cast<float*>(out));
      case ScalarType::kFloat64:
        return readValues<In>(count, static_cast<double*>(out));
      case ScalarType::kInt32:
        return readValues<In>(count, static_cast<int32_t*>(out));
      case ScalarType::kInt64:
        return readValues<In>(count, static_cast<int64_t*>(out));
    }
  }

  template <class In, class Out>
  void readValues(size_t count, Out* out) {
    const size_t ahead = takeAhead<In>(count, out);
    readWords<In>(count - ahead, out + ahead);
    if (next_ == count_) checkEnd();
  }

  template <class In, class Out>
  void readWords(size_t count, Out* out) {
    while (count > 0) {
      const size_t plain = plainValues<In>(count, out);
      out += plain;
      count -= plain;
      if (count == 0) break;
      readWord<In>(out++);
      --count;
    }
  }

  // Of the values that follow those that are plain, and whole in what is in memory, up to one that
  // is to be marked. Returns how many.
  template <class In, class Out>
  size_t plainValues(size_t count, Out* out) {
    if (next_ >= mark_from_ || filled_ - at_ < kPlainNumberBytes) return 0;
    count = static_cast<size_t>(std::min<uint64_t>(count, mark_from_ - next_));
    const char* at = text_.data() + at_;
    const char* const last = text_.data() + filled_ - kPlainNumberBytes;
    size_t done = 0;
    for (; done < count; ++done) {
      while (isBlank(*at)) ++at;
      if (at > last) break;
      In value;
      const char* const end = readPlain(at, &value);
      if (!end || !isBlank(*end) || !holds<Out>(value)) break;
      out[done] = static_cast<Out>(value);
      at = end;
    }
    at_ = static_cast<size_t>(at - text_.data());
    next_ += done;
    return done;
  }

  template <class In, class Out>
  void readWord(Out* out) {
    In value;
    const std::string_view word = nextWord();
    if (!parseValue(word, &value) || !holds<Out>(value)) failWord(word);
    *out = static_cast<Out>(value);
  }

  // ------------------------------------------------------------------------------ reading ahead

  // Returns how many; those that follow are read from the text.
  template <class In, class Out>
  size_t takeAhead(size_t count, Out* out) {
    if (!ahead_ && !startAhead()) return 0;
    const size_t taken = ahead_->take<In>(count, out);
    next_ += taken;
    markAt(ahead_first_ + ahead_->piece().value, ahead_->piece().place);
    if (taken < count || next_ == count_) leaveAhead();
    return taken;
  }

  bool startAhead() {
    if (next_ < ahead_from_ || !helpers_.areHere()) return false;
    if (end_ - place() < 2 * helpers_.threads.piece_bytes) return false;
    markAt(next_, place());
    ahead_.emplace(helpers_.threads, bytes_, type_, place(), end_);
    ahead_first_ = next_;
    return true;
  }

  void leaveAhead() {
    goTo({next_, ahead_->place()});
    ahead_.reset();
  }

  // On from a place that is known; it may be that it is the only one here that is wanted.
  void goTo(ValuePlace place) {
    next_ = place.value;
    text_at_ = place.place;
    at_ = filled_ = 0;
    ahead_from_ = next_ + kSequence;
  }

  // -------------------------------------------------------------------------------------- words

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

  // The next word, empty at the end; it lives until the next call.
  std::string_view nextWord() {
    markAt(next_, place());
    if (!findWord()) return {};
    size_t size = 0;
    for (;;) {
      while (at_ + size < filled_ && !isBlank(text_[at_ + size])) ++size;
      if (at_ + size < filled_ || size > kMostValueBytes || !refill()) break;
    }
    if (size > kMostValueBytes)
      fail(Status::kBadData, "%s: byte %llu: a word of more than %zu characters is no number",
           what_.c_str(), static_cast<unsigned long long>(place()), kMostValueBytes);
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
        static_cast<size_t>(std::min<uint64_t>(text_.size() - 1 - filled_, end_ - from));
    const size_t got = wanted ? bytes_.readAt(from, text_.data() + filled_, wanted) : 0;
    filled_ += got;
    text_[filled_] = 0;
    return got > 0;
  }

  // Where to go on for that value, if that is wanted.
  void markAt(uint64_t value, uint64_t place) {
    if (value < mark_from_) return;
    if (marks_.size() == kMaxMarks) {
      for (size_t i = 0; i < kMaxMarks / 2; ++i) marks_[i] = marks_[2 * i];
      marks_.resize(kMaxMarks / 2);
      stride_ *= 2;
    }
    marks_.push_back({value, place});
    mark_from_ = value + stride_;
  }

  void seek(uint64_t first) {
    if (ahead_) leaveAhead();
    const auto behind =
        std::upper_bound(marks_.begin(), marks_.end(), first,
                         [](uint64_t value, const ValuePlace& mark) { return value < mark.value; });
    if (behind != marks_.begin() && (first < next_ || behind[-1].value > next_)) goTo(behind[-1]);
    while (next_ < first)
      if (nextWord().empty()) failWord({});
    ahead_from_ = first + kSequence;
  }

  ByteSource& bytes_;
  std::string what_;
  ValueType type_;
  const Helpers helpers_;
  uint64_t end_, count_;
  uint64_t next_ = 0;  // index of the value after the last one read
  uint64_t stride_ = 256,
           mark_from_ = 0;  // between marks; the next value to be marked, or a later one
  std::vector<ValuePlace> marks_;
  std::vector<char> text_;      // one more than filled_: a zero ends what was read
  uint64_t text_at_;            // place in the file of text_[0]
  size_t at_ = 0, filled_ = 0;  // read, and filled, of text_
  // While it is there, it has next_, and text_ is empty.
  std::optional<ValuesAhead> ahead_;
  uint64_t ahead_first_ = 0, ahead_from_ = 0;  // its first value; of which value on it may start
};

}  // namespace

std::unique_ptr<Values> openTextValues(ByteSource& bytes, const std::string& what, ValueType type,
                                       const TextPlace& place, const Helpers& helpers) {
  return std::make_unique<AsciiValues>(bytes, what, type, place, helpers);
}

}  // namespace tetstream
