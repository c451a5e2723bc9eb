#include "compressed_bytes.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "wrapping_parts.h"

namespace tetstream {

namespace {

constexpr size_t kMagicBytes = 4;

// In small or capital letters.
bool endsWith(const std::string& text, const std::string& end) {
  const auto is_same = [](unsigned char a, unsigned char b) { return a == std::tolower(b); };
  return text.size() > end.size() && std::equal(end.rbegin(), end.rend(), text.rbegin(), is_same);
}

Wrapping wrappingOf(const unsigned char* head, size_t size) {
  if (size >= 2 && head[0] == 0x1f && head[1] == 0x8b) return Wrapping::kGzip;
  if (size < kMagicBytes) return Wrapping::kNone;
  const auto goesOn = [head](unsigned char a, unsigned char b, unsigned char c) {
    return head[1] == a && head[2] == b && head[3] == c;
  };
  // A frame of data, or one that is skipped, which parallel packers begin with.
  const bool zstd = (head[0] == 0x28 && goesOn(0xb5, 0x2f, 0xfd)) ||
                    ((head[0] & 0xf0) == 0x50 && goesOn(0x2a, 0x4d, 0x18));
  return zstd ? Wrapping::kZstd : Wrapping::kNone;
}

}  // namespace

Wrapping wrappingOf(const std::string& path, std::string* rest) {
  *rest = path;
  const Wrapping wrapping = endsWith(path, ".gz")    ? Wrapping::kGzip
                            : endsWith(path, ".zst") ? Wrapping::kZstd
                                                     : Wrapping::kNone;
  if (wrapping != Wrapping::kNone) rest->resize(path.find_last_of('.'));
  return wrapping;
}

std::unique_ptr<ByteSource> unwrapped(std::unique_ptr<ByteSource> bytes) {
  unsigned char head[kMagicBytes];
  size_t size = 0;
  if (bytes->seekable()) {
    size = bytes->readAt(0, head, sizeof head);
  } else {
    while (size < sizeof head) {
      const size_t got = bytes->read(head + size, sizeof head - size);
      if (got == 0) break;
      size += got;
    }
    bytes = withPrefix(std::vector<unsigned char>(head, head + size), std::move(bytes));
  }
  switch (wrappingOf(head, size)) {
    case Wrapping::kGzip:
      return openGzip(std::move(bytes));
    case Wrapping::kZstd:
      return openZstd(std::move(bytes));
    case Wrapping::kNone:
      break;
  }
  return bytes;
}

std::unique_ptr<ByteSink> wrapped(std::unique_ptr<ByteSink> bytes, Wrapping wrapping) {
  if (wrapping == Wrapping::kGzip) return createGzip(std::move(bytes));
  if (wrapping == Wrapping::kZstd) return createZstd(std::move(bytes));
  return bytes;
}

}  // namespace tetstream
