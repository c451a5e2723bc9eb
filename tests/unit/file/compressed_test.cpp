// gzip and zstd around a file: by its first bytes when read, by its name when written.
#include <gtest/gtest.h>

#include "compressed_bytes.h"
#include "pipes.h"
#include "slow_run.h"
#include "status.h"

namespace tetstream {
namespace {

using namespace test;

std::string numbers(size_t count) {
  std::string text;
  for (size_t i = 0; i < count; ++i) text += std::to_string(i * i) + "\n";
  return text;
}

Bytes wrap(const std::string& text, Wrapping wrapping) {
  Bytes out;
  const std::unique_ptr<ByteSink> sink = wrapped(createMemory(out), wrapping);
  for (size_t at = 0; at < text.size(); at += 1000)
    sink->write(text.data() + at, std::min<size_t>(1000, text.size() - at));
  sink->commit();
  return out;
}

std::string readAll(std::unique_ptr<ByteSource> source) {
  std::string text;
  char part[777];
  while (const size_t got = source->read(part, sizeof part)) text.append(part, got);
  return text;
}

std::string unwrap(const Bytes& data, size_t pipe_step = 0) {
  if (pipe_step > 0)
    return readAll(unwrapped(std::make_unique<PipeSource>(data, pipe_step, "mesh")));
  return readAll(unwrapped(openMemory(data.data(), data.size(), "mesh")));
}

std::vector<Wrapping> kinds() {
#ifdef TETSTREAM_WITH_ZSTD
  return {Wrapping::kNone, Wrapping::kGzip, Wrapping::kZstd};
#else
  return {Wrapping::kNone, Wrapping::kGzip};
#endif
}

TEST(Compressed, GivesBackWhatWasWrapped) {
  for (Wrapping wrapping : kinds())
    for (const std::string& text :
         {std::string(), std::string("v"), numbers(slowRun() ? 20000 : 50000)}) {
      const Bytes data = wrap(text, wrapping);
      EXPECT_EQ(unwrap(data), text);
      EXPECT_EQ(unwrap(data, 1000), text);
      EXPECT_EQ(unwrap(data, 1), text);
    }
}

TEST(Compressed, ReadsSeveralMembersAndPadding) {
  for (Wrapping wrapping : kinds()) {
    if (wrapping == Wrapping::kNone) continue;
    Bytes data = wrap("one ", wrapping);
    const Bytes more = wrap("two", wrapping);
    data.insert(data.end(), more.begin(), more.end());
    EXPECT_EQ(unwrap(data), "one two");
    if (wrapping == Wrapping::kZstd) continue;
    data.resize(data.size() + 512, 0);
    EXPECT_EQ(unwrap(data), "one two");
  }
}

#ifdef TETSTREAM_WITH_ZSTD
Bytes bytesOf(const std::string& text) {
  return Bytes(text.begin(), text.end());
}

TEST(Compressed, PassesFramesThatAreToBeSkipped) {
  Bytes data = bytesOf(std::string("\x5e\x2a\x4d\x18\x03\0\0\0abc", 11));
  const Bytes frame = wrap("one", Wrapping::kZstd);
  data.insert(data.end(), frame.begin(), frame.end());
  EXPECT_EQ(unwrap(data), "one");
  EXPECT_EQ(unwrap(data, 1), "one");
}

// A frame of one byte, whose window would be 256 MiB.
TEST(Compressed, WindowsThatAreTooLargeAreNoDamage) {
  try {
    unwrap(bytesOf(std::string("\x28\xb5\x2f\xfd\0\x90\x09\0\0v", 10)));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::kUnsupported) << error.text();
  }
}
#endif

TEST(Compressed, RefusesWhatIsCutOrDamaged) {
  for (Wrapping wrapping : kinds()) {
    if (wrapping == Wrapping::kNone) continue;
    const Bytes data = wrap(numbers(100), wrapping);
    for (size_t size = 4; size < data.size(); ++size)
      EXPECT_THROW(unwrap(Bytes(data.begin(), data.begin() + static_cast<std::ptrdiff_t>(size))),
                   Error);
    Bytes damaged = data;
    damaged[damaged.size() / 2] ^= 0x10;
    EXPECT_THROW(unwrap(damaged), Error);
  }
}

TEST(Compressed, TakesTheEndingOffAName) {
  std::string rest;
  EXPECT_EQ(wrappingOf("dir.gz/a.msh.gz", &rest), Wrapping::kGzip);
  EXPECT_EQ(rest, "dir.gz/a.msh");
  EXPECT_EQ(wrappingOf("a.sva.zst", &rest), Wrapping::kZstd);
  EXPECT_EQ(rest, "a.sva");
  EXPECT_EQ(wrappingOf("a.vtu", &rest), Wrapping::kNone);
  EXPECT_EQ(rest, "a.vtu");
}

}  // namespace
}  // namespace tetstream
