// file: a file read from front to end: words and numbers of text, and binary numbers between
// them. Depends on bytes.h, numbers_ahead.h.
#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bytes.h"
#include "numbers_ahead.h"
#include "status.h"

namespace tetstream {

// A byte-order mark before text is passed over. Memory is one buffer, and pieces of text where
// several threads read rows of numbers, which gives the same numbers and the same errors. Errors
// name the file and the line, or the byte once anything binary was read; what is asked for is said
// in the words of `what`.
class FileScan {
 public:
  // From `comment` (0: none) to the end of the line is blank.
  FileScan(std::unique_ptr<ByteSource> bytes, char comment, const TextThreads& threads = {});

  // The next word between blanks; empty at the end of the file. Views live until the next call.
  std::string_view word();
  std::string_view peekWord();  // the same, which stays the next one
  // The rest of the line, without its end; the next call starts on the next line.
  std::string_view line();
  bool atEnd();
  // True, with nothing taken, if no word is left before the end of the line.
  bool lineEnds();

  int64_t integer(const char* what) {
    int64_t value;
    integers(&value, 1, what);
    return value;
  }
  int64_t integer(const char* what, int64_t least, int64_t most) {
    int64_t value;
    integers(&value, 1, what, least, most);
    return value;
  }
  double real(const char* what) {
    double value;
    reals(&value, 1, what);
    return value;
  }
  // Many in a row, which is faster.
  void integers(int64_t* out, size_t count, const char* what) { take(out, count, what); }
  void integers(int64_t* out, size_t count, const char* what, int64_t least, int64_t most) {
    const int64_t* const here = integersHere(out, count, what);
    for (size_t i = 0; i < count; ++i) {
      if (here[i] < least || here[i] > most) failRange(here[i], what, least, most);
      out[i] = here[i];
    }
  }
  void reals(double* out, size_t count, const char* what) { take(out, count, what); }
  // The next ones where they lie, until the next call, or else in `room`.
  const int64_t* integersHere(int64_t* room, size_t count, const char* what) {
    if (const uint64_t* here = ahead_ ? ahead_->takeHere(count) : nullptr)
      return reinterpret_cast<const int64_t*>(here);
    numbers(room, count, what);
    return room;
  }
  // Says that so many rows come, which integers, reals and passLine are to read, in their order and
  // nothing else: other threads may begin. Where the number of rows is not known, it may be larger.
  void expectRows(uint64_t rows, const RowPattern& pattern);
  void endRows() { leaveAhead(); }
  // The rest of a row's line.
  void passLine() {
    if (ahead_)
      ahead_->passLine();
    else
      line();
  }
  // A text between quotes, or a word.
  std::string text(const char* what);
  void expect(const char* word);

  // Binary: exactly `size` bytes.
  void bytes(void* out, size_t size, const char* what);
  // The next `size` bytes where they lie, until the next call; null, with nothing taken, unless all
  // of them are in the buffer.
  const char* bytesInBuffer(size_t size) {
    if (ahead_ || filled_ - at_ < size) return nullptr;
    binary_ = true;
    at_ += size;
    return buffer_.data() + at_ - size;
  }
  // Up to `size` bytes, fewer at the end, which stay the next ones.
  std::string_view peekBytes(size_t size);
  // Passes everything up to the end of the next `mark`.
  void skipPast(std::string_view mark);
  void skipTo(uint64_t offset, const char* what);  // forward; not read where the file can seek

  uint64_t offset() const { return origin_ + at_ + (ahead_ ? ahead_->place().bytes : 0); }
  // Bytes from here to the end, as far as that is known: else the largest number.
  uint64_t bytesLeft() const;
  // The file itself, for those who come back to what was passed over; null unless it can seek.
  std::shared_ptr<ByteSource> source() const { return bytes_->seekable() ? bytes_ : nullptr; }
  const std::string& name() const { return bytes_->name(); }
  // "NAME: line 12", "NAME: byte 345"
  std::string place() const;
  [[noreturn]] void failHere(Status status, const std::string& text) const;
  [[noreturn]] void failBad(const std::string& text) const { failHere(Status::kBadData, text); }
  // Throws kBadData if `count` things of at least `least_bytes` each cannot be in the rest.
  void checkClaim(uint64_t count, uint64_t least_bytes, const char* what) const;

 private:
  bool refill();  // adds to the buffer; false at the end of the file
  void passByteOrderMark();
  size_t readText(char* out, size_t size);
  size_t readFile(char* out, size_t size);
  size_t readTextAhead(char* out, size_t size, bool* fails);
  // What was read ahead and not taken is text again.
  void leaveAhead() {
    if (ahead_) stopAhead();
  }
  void stopAhead();
  [[noreturn]] void failRange(int64_t value, const char* what, int64_t least, int64_t most) const;
  bool passBlanks();
  template <class Number>
  size_t plainNumbers(Number* out, size_t count);
  template <class Number>
  Number number(const char* what);  // which need not be plain
  template <class Number>
  size_t otherNumbers(Number* out, size_t count, const char* what);
  template <class Number>
  void numbers(Number* out, size_t count, const char* what);
  // Of a few that were read ahead: a copy that is inlined.
  template <class Number>
  void take(Number* out, size_t count, const char* what) {
    const uint64_t* const here = ahead_ ? ahead_->takeHere(count) : nullptr;
    if (here)
      std::memcpy(out, here, count * sizeof *out);
    else
      numbers(out, count, what);
  }
  size_t wordSize();
  [[noreturn]] void failWord(std::string_view word, const char* what) const;

  std::shared_ptr<ByteSource> bytes_;
  bool has_jumped_ = false;  // then the file is read from read_to_ on, and not in sequence
  uint64_t read_to_ = 0;
  char comment_;
  const TextThreads threads_;
  std::unique_ptr<NumbersAhead> ahead_;  // of the text behind the buffer, which is empty then
  std::vector<char> unread_;             // text that was taken ahead in vain
  size_t unread_at_ = 0;
  std::exception_ptr error_;  // of the text behind that
  bool binary_ = false, ended_ = false;
  uint64_t origin_ = 0, line_ = 1;  // of buffer_[0] in the file; of at_
  size_t at_ = 0, filled_ = 0;
  std::vector<char> buffer_;  // one more than filled_: a zero ends what was read
};

}  // namespace tetstream
