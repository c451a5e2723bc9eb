// format/vtk: the binary values of one array of a .vtu file, as they lie in memory: base64 and
// compressed blocks undone. Depends on vtu_file.h.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "vtu_file.h"

namespace tetstream {

// A run of bytes in the file, as they are or as base64 text.
class EncodedRun {
 public:
  EncodedRun(ByteSource& bytes, const std::string& what, uint64_t begin, uint64_t end, bool base64)
      : bytes_(&bytes), what_(what), begin_(begin), end_(end), base64_(base64) {}

  // Bytes [offset, offset + size) of the decoded run; throws kBadData if there are fewer.
  void readAt(uint64_t offset, void* out, size_t size);
  // The most bytes that the run can hold.
  uint64_t capacity() const { return base64_ ? (end_ - begin_) / 4 * 3 : end_ - begin_; }
  // The run that follows the first `size` bytes: base64 text is encoded anew from there on.
  EncodedRun after(uint64_t size) const;
  // Whether the text of the first `size` bytes, no multiple of 3, is padded, so that it ends there.
  bool endsAt(uint64_t size);
  const std::string& what() const { return what_; }

 private:
  void readText(uint64_t offset, unsigned char* out, size_t size);
  [[noreturn]] void failEnd(uint64_t byte) const;

  ByteSource* bytes_;
  std::string what_;  // file and array, for messages
  uint64_t begin_, end_;
  bool base64_;
};

// Opens the values of a binary array, which must take exactly `size` bytes, at least one.
std::unique_ptr<ValueBytes> openVtuBytes(ByteSource& bytes, const VtuFile& file,
                                         const VtuArray& array, uint64_t size);

// Opens an array that must have exactly `count` values, at least one. Nothing is believed: sizes
// that the file claims are compared with its length before anything is allocated.
std::unique_ptr<Values> openVtuValues(ByteSource& bytes, const VtuFile& file, const VtuArray& array,
                                      uint64_t count);

}  // namespace tetstream
