// format/medit: a MEDIT file as sections, text or binary, of meshes and of solutions. Depends on
// medit_keywords.h, number_scan.h, placed_numbers.h.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "medit_keywords.h"
#include "number_scan.h"
#include "placed_numbers.h"

namespace tetstream {

struct MeditSection {
  int number = 0;    // 0: it is not known
  std::string name;  // "keyword 99" where that is all there is
};

// What is noted of a file that several programs write so, and others after a cut.
constexpr char kNoEnd[] = "ends after a whole line, without the word End: is all of it here?";

class MeditScan {
 public:
  // Reads the version and the byte order.
  explicit MeditScan(std::unique_ptr<ByteSource> bytes, const TextThreads& threads = {});

  // The next section, whose contents come next; false at the end.
  bool next(MeditSection* section);
  bool saysEnd() const { return says_end_; }  // then
  void skip();                                // the contents, or what is left of them
  // The number of rows, each of so many integers and reals.
  uint64_t rows(size_t integers, size_t reals, const char* what);
  // Before they are read.
  void expectRows(uint64_t rows, const RowPattern& pattern) { numbers_.expectRows(rows, pattern); }
  void integers(int64_t* out, size_t count, const char* what) {
    numbers_.integers(out, count, integer_bytes_, what);
  }
  const int64_t* integersHere(int64_t* room, size_t count, const char* what) {
    return numbers_.integersHere(room, count, integer_bytes_, what);
  }
  // Where so many rows of a binary file lie, which are the next ones, and what their numbers are
  // from a byte of the row on.
  std::optional<RowsPlace> rowsHere(uint64_t rows, size_t integers, size_t reals) const {
    return numbers_.rowsHere(rows, integers * integer_bytes_ + reals * real_bytes_);
  }
  void pass(const RowsPlace& rows, const char* what) { numbers_.pass(rows, what); }
  NumbersOfRow integersOfRow(size_t at_byte, size_t count) const {
    return {at_byte, count, integer_bytes_, false, false};
  }
  NumbersOfRow realsOfRow(size_t at_byte, size_t count) const {
    return {at_byte, count, real_bytes_, true, false};
  }
  int64_t small(const char* what) { return numbers_.integer(4, what); }  // 32 bits in any version
  void reals(double* out, size_t count, const char* what) {
    numbers_.reals(out, count, real_bytes_, what);
  }

  bool binary() const { return numbers_.binary(); }
  int version() const { return version_; }
  FileScan& file() { return file_; }

 private:
  bool nextBinary(MeditSection* section);
  bool nextText(MeditSection* section);

  FileScan file_;
  NumberScan numbers_;
  int version_ = 0;
  bool says_end_ = true;
  size_t integer_bytes_ = 4, real_bytes_ = 8, place_bytes_ = 4;
  uint64_t next_ = 0;  // binary: where the next section begins; 0: the end
};

}  // namespace tetstream
