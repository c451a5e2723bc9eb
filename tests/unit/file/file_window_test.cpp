// Bytes of a file by range: they are the file's, and an end that comes too early is told.
#include "file_window.h"

#include <gtest/gtest.h>

#include <cstring>

#include "status.h"

namespace tetstream {
namespace {

using Bytes = std::vector<unsigned char>;

Bytes someBytes(size_t size) {
  Bytes bytes(size);
  for (size_t i = 0; i < size; ++i) bytes[i] = static_cast<unsigned char>(i * 2654435761u >> 13);
  return bytes;
}

std::shared_ptr<ByteSource> sourceOf(const Bytes& bytes) {
  return openMemory(bytes.data(), bytes.size(), "bytes");
}

void expectSequence(FileWindow& window, const Bytes& bytes, size_t step) {
  for (size_t at = 0; at < bytes.size(); at += step) {
    const size_t n = std::min(step, bytes.size() - at);
    ASSERT_EQ(std::memcmp(window.bytes(at, n), bytes.data() + at, n), 0) << at;
  }
}

// In sequence, as columns of the same rows one after the other, from the front again, at random.
TEST(FileWindow, GivesTheFilesBytes) {
  const Bytes bytes = someBytes(3000000);
  FileWindow window(sourceOf(bytes));
  for (size_t step : {size_t{100}, size_t{65536}, size_t{100000}, FileWindow::kMostBytes})
    for (int again = 0; again < 2; ++again) expectSequence(window, bytes, step);
  for (size_t i = 0; i < 300; ++i) {
    const size_t n = i * 12345 % FileWindow::kMostBytes;
    const size_t at = i * 7654321 % (bytes.size() - n);
    ASSERT_EQ(std::memcmp(window.bytes(at, n), bytes.data() + at, n), 0) << i;
  }
}

// A file of which less and less is there, or that cannot be read.
class BadSource final : public ByteSource {
 public:
  explicit BadSource(const Bytes& bytes) : ByteSource("bytes"), bytes_(bytes) {}
  size_t read(void*, size_t) override { return 0; }
  size_t readAt(uint64_t offset, void* out, size_t size) override {
    if (fails) fail(Status::kIo, "bytes: broken");
    if (offset >= end) return 0;
    const size_t n = std::min(size, end - static_cast<size_t>(offset));
    std::memcpy(out, bytes_.data() + offset, n);
    return n;
  }
  bool seekable() const override { return true; }
  uint64_t size() const override { return bytes_.size(); }
  size_t end = SIZE_MAX;
  bool fails = false;

 private:
  const Bytes& bytes_;
};

TEST(FileWindow, TellsWhereTheFileEndsOrCannotBeRead) {
  const Bytes bytes = someBytes(1000000);
  const auto source = std::make_shared<BadSource>(bytes);
  FileWindow window(source);
  window.bytes(0, 100000);
  source->end = 150000;
  try {
    window.bytes(100000, 100000);
    ADD_FAILURE() << "it gave bytes that are not there";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::kBadData);
    EXPECT_NE(error.text().find("bytes: byte 150000: the file ends here"), std::string::npos);
  }
  source->end = bytes.size();
  EXPECT_EQ(std::memcmp(window.bytes(0, 100000), bytes.data(), 100000), 0);
  source->fails = true;
  window.bytes(0, 100000);  // which are held
  EXPECT_THROW(window.bytes(100000, 100000), Error);
  source->fails = false;
  EXPECT_EQ(std::memcmp(window.bytes(100000, 100000), bytes.data() + 100000, 100000), 0);
}

}  // namespace
}  // namespace tetstream
