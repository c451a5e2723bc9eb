#include "medit_scan.h"

#include <cctype>
#include <cstring>

#include "status.h"
#include "text_number.h"

namespace tetstream {

// Binary files begin with the integer 1, text with a word; versions 1 and 2 have 32-bit places,
// versions 1 to 3 32-bit integers, and version 1 float32.
MeditScan::MeditScan(std::unique_ptr<ByteSource> bytes, const TextThreads& threads)
    : file_(std::move(bytes), '#', threads), numbers_(file_) {
  const std::string_view head = file_.peekBytes(4);
  uint32_t first = 0;
  if (head.size() == sizeof first) std::memcpy(&first, head.data(), sizeof first);
  if (first == 1 || first == 0x01000000) {
    numbers_.setBinary(first != 1);
    numbers_.integer(4, "the integer 1");
  } else {
    file_.expect("MeshVersionFormatted");
  }
  version_ = static_cast<int>(numbers_.integer(4, "the version"));
  if (version_ < 1 || version_ > 4)
    file_.failHere(Status::kUnsupported, textOf("version %d; 1 to 4 are read", version_));
  integer_bytes_ = version_ == 4 ? 8 : 4;
  real_bytes_ = version_ == 1 ? 4 : 8;
  place_bytes_ = version_ >= 3 ? 8 : 4;
  next_ = file_.offset();
}

bool MeditScan::next(MeditSection* section) {
  return binary() ? nextBinary(section) : nextText(section);
}

bool MeditScan::nextBinary(MeditSection* section) {
  if (next_ == 0) return false;
  if (file_.offset() > next_) file_.failBad("a section runs into the next one");
  file_.skipTo(next_, "a section");
  const int64_t number = small("the keyword of a section");
  if (number == kMeditEnd) return false;
  const int64_t place = numbers_.integer(place_bytes_, "the place of the next section");
  if (place != 0 && (place < 0 || static_cast<uint64_t>(place) < file_.offset()))
    file_.failBad(textOf("the next section is said to begin at byte %lld, which is not ahead",
                         static_cast<long long>(place)));
  next_ = static_cast<uint64_t>(place);
  const MeditKeyword* keyword = meditKeyword(number);
  section->number = keyword ? keyword->number : 0;
  section->name = keyword ? keyword->name : "keyword " + std::to_string(number);
  return true;
}

// A file that was cut in a number would be read with another one.
static bool endsWithLine(ByteSource* file) {
  char last = 0;
  return file && file->size() > 0 && file->readAt(file->size() - 1, &last, 1) == 1 && last == '\n';
}

bool MeditScan::nextText(MeditSection* section) {
  const std::string_view word = file_.word();
  if (word.empty()) {
    if (!endsWithLine(file_.source().get()))
      file_.failBad("the file ends without the word End: is all of it here?");
    says_end_ = false;
    return false;
  }
  const MeditKeyword* keyword = meditKeyword(word);
  if (keyword && keyword->number == kMeditEnd) return false;
  if (!std::isalpha(static_cast<unsigned char>(word[0])))
    file_.failBad(quoted(word) + " where a keyword should be");
  section->number = keyword ? keyword->number : 0;
  section->name = word;
  return true;
}

// Numbers go on up to the next word of letters.
void MeditScan::skip() {
  if (binary()) return;  // next finds its place
  for (;;) {
    const std::string_view word = file_.peekWord();
    if (word.empty()) return;
    if (std::isalpha(static_cast<unsigned char>(word[0])) && word != "nan" && word != "inf") return;
    file_.word();
  }
}

uint64_t MeditScan::rows(size_t integers, size_t reals, const char* what) {
  const size_t least =
      binary() ? integers * integer_bytes_ + reals * real_bytes_ : 2 * (integers + reals);
  return numbers_.count(integer_bytes_, least, what);
}

}  // namespace tetstream
