#include "vtu_run.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "base64.h"
#include "status.h"
#include "vtu_blocks.h"
#include "vtu_side_by_side.h"

namespace tetstream {

constexpr size_t kGroupsAtOnce = 2048;  // base64 groups of 4 characters, on the stack

void EncodedRun::failEnd(uint64_t byte) const {
  fail(Status::kBadData, "%s: byte %llu: the values end too early", what_.c_str(),
       static_cast<unsigned long long>(byte));
}

void EncodedRun::readAt(uint64_t offset, void* out, size_t size) {
  if (size == 0) return;
  if (offset > capacity() || size > capacity() - offset) failEnd(end_);
  if (base64_) return readText(offset, static_cast<unsigned char*>(out), size);
  const size_t got = bytes_->readAt(begin_ + offset, out, size);
  if (got != size) failEnd(begin_ + offset + got);
}

void EncodedRun::readText(uint64_t offset, unsigned char* out, size_t size) {
  char text[4 * kGroupsAtOnce];
  unsigned char decoded[3 * kGroupsAtOnce];
  uint64_t group = offset / 3;
  size_t skip = static_cast<size_t>(offset % 3);
  while (size > 0) {
    const size_t groups = std::min(kGroupsAtOnce, (skip + size - 1) / 3 + 1);
    const uint64_t at = begin_ + 4 * group;
    const size_t got = bytes_->readAt(at, text, 4 * groups);
    if (got != 4 * groups) failEnd(at + got);
    size_t used;
    const size_t count = decodeBase64(text, groups, decoded, &used);
    const size_t wanted = std::min(size, 3 * groups - skip);
    if (count < skip + wanted)
      fail(Status::kBadData, "%s: byte %llu: the base64 text ends or breaks off here",
           what_.c_str(), static_cast<unsigned long long>(at + 4 * used));
    std::memcpy(out, decoded + skip, wanted);
    out += wanted;
    size -= wanted;
    group += groups;
    skip = 0;
  }
}

EncodedRun EncodedRun::after(uint64_t size) const {
  EncodedRun rest = *this;
  rest.begin_ += base64_ ? (size + 2) / 3 * 4 : size;
  return rest;
}

bool EncodedRun::endsAt(uint64_t size) {
  char next = 0;
  const uint64_t characters = (4 * size + 2) / 3;  // without padding
  return base64_ && bytes_->readAt(begin_ + characters, &next, 1) == 1 && next == '=';
}

namespace {

// A length word and the values. VTK encodes both as one base64 text, others each on its own.
class PlainBytes final : public ValueBytes {
 public:
  PlainBytes(const EncodedRun& run, const VtuFile& file, uint64_t size) : run_(run) {
    const uint64_t held = readVtuWord(run_, 0, file);
    if (held != size)
      fail(Status::kBadData, "%s holds %llu bytes where the counts need %llu", run.what().c_str(),
           static_cast<unsigned long long>(held), static_cast<unsigned long long>(size));
    skip_ = file.word_bytes;
    if (run_.endsAt(skip_)) {
      run_ = run_.after(skip_);
      skip_ = 0;
    }
    if (size > run_.capacity() || skip_ > run_.capacity() - size)
      fail(Status::kBadData, "%s: the file ends before the values do", run.what().c_str());
  }
  void readAt(uint64_t offset, void* out, size_t size) override {
    run_.readAt(skip_ + offset, out, size);
  }

 private:
  EncodedRun run_;
  uint64_t skip_;
};

// Inline text lies between blanks.
VtuArray trimmed(ByteSource& bytes, VtuArray array) {
  char c;
  const auto blankAt = [&](uint64_t at) {
    return bytes.readAt(at, &c, 1) == 1 && (c == ' ' || c == '\n' || c == '\t' || c == '\r');
  };
  while (array.begin < array.end && blankAt(array.begin)) ++array.begin;
  while (array.begin < array.end && blankAt(array.end - 1)) --array.end;
  return array;
}

}  // namespace

std::unique_ptr<ValueBytes> openVtuBytes(ByteSource& bytes, const VtuFile& file,
                                         const VtuArray& array, uint64_t size) {
  const bool base64 = array.format != VtuFormat::kAppendedRaw;
  VtuArray place = array;
  if (array.format == VtuFormat::kInlineBase64) place = trimmed(bytes, array);
  const EncodedRun run(bytes, placeOf(bytes, array.name), place.begin, place.end, base64);
  if (file.compressor) {
    const OpenBytes open = [run, &file, size] { return file.compressor->open(run, file, size); };
    std::unique_ptr<ValueBytes> blocks = open();
    if (!file.helpers.areHere()) return blocks;
    EncodedRun table = run;
    return openSideBySide(file.helpers, size, readVtuWord(table, file.word_bytes, file),
                          std::move(blocks), open);
  }
  return std::make_unique<PlainBytes>(run, file, size);
}

std::unique_ptr<Values> openVtuValues(ByteSource& bytes, const VtuFile& file, const VtuArray& array,
                                      uint64_t count) {
  const std::string what = placeOf(bytes, array.name);
  if (array.format == VtuFormat::kAscii)
    return openTextValues(bytes, what, array.type, {array.begin, array.end, count}, file.helpers);
  return openBinaryValues(openVtuBytes(bytes, file, array, count * sizeOf(array.type)), what,
                          array.type, file.big_endian);
}

}  // namespace tetstream
