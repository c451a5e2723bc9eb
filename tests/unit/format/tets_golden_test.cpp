// .tets: the bytes themselves, as tetstream-formats(5) gives them.
#include <cstdio>

#include "tets_streams.h"

namespace tetstream::test {
namespace {

// Lines "place  16 bytes" in hexadecimal; the lines between are zeros.
constexpr char kExample[] =
    "0000  89 54 45 54 48 45 41 44  00 01 00 00 00 00 00 00\n"
    "0010  00 00 00 00 00 00 00 00  01 00 00 00 01 00 00 00\n"
    "0020  04 03 02 01 01 00 00 00  01 00 00 00 00 00 00 00\n"
    "0030  58 00 00 00 00 00 00 00  f7 60 ce f4 a6 33 8a 7f\n"
    "0040  04 00 00 00 00 00 00 00  01 00 00 00 00 00 00 00\n"
    "0050  04 00 00 00 00 00 00 00  04 00 00 00 00 00 00 00\n"
    "0060  00 00 00 00 00 00 00 00  01 00 00 00 00 00 00 00\n"
    "0080  18 00 00 00 01 00 00 00  01 00 00 00 01 00 00 00\n"
    "0090  66 00 00 00 00 00 00 00  00 00 00 00 00 00 00 00\n"
    "00b0  00 00 00 00 00 00 e0 3f  00 00 00 00 00 00 f0 3f\n"
    "00c0  00 00 00 00 00 00 f0 3f  00 00 00 00 00 00 f0 3f\n"
    "00d0  00 00 00 00 00 00 00 40  00 00 00 00 00 00 00 00\n"
    "0100  89 54 45 54 43 48 4e 4b  c0 01 00 00 00 00 00 00\n"
    "0110  01 00 00 00 00 00 00 00  01 02 00 00 00 01 00 00\n"
    "0120  00 00 00 00 00 00 00 00  04 00 00 00 01 00 00 00\n"
    "0130  00 00 00 00 00 00 00 00  71 bf e0 56 b2 d2 ea c8\n"
    "0160  00 00 00 00 00 00 00 00  00 00 00 00 00 00 e0 3f\n"
    "0170  00 00 00 00 00 00 f0 3f  00 00 00 00 00 00 f0 3f\n"
    "0180  00 00 00 00 00 00 f0 3f  00 00 00 00 00 00 00 40\n"
    "01c0  00 00 00 00 00 00 00 00  00 00 00 00 00 00 80 3f\n"
    "01d0  00 00 00 00 00 00 00 00  00 00 00 00 00 00 80 3f\n"
    "01e0  00 00 00 00 00 00 00 00  00 00 00 00 00 00 80 3f\n"
    "0200  00 00 00 3f 00 00 80 3f  00 00 c0 3f 00 00 00 40\n"
    "0240  00 00 00 00 01 00 00 00  02 00 00 00 03 00 00 00\n"
    "0280  0f 00 00 00 00 00 00 00  00 00 00 00 00 00 00 00\n"
    "02c0  89 54 45 54 49 4e 44 58  c0 00 00 00 00 00 00 00\n"
    "02d0  02 00 00 00 00 00 00 00  00 00 00 00 01 00 00 00\n"
    "02f0  60 00 00 00 00 00 00 00  d5 94 ef 61 96 31 84 45\n"
    "0300  00 01 00 00 00 00 00 00  c0 01 00 00 00 00 00 00\n"
    "0320  04 00 00 00 01 00 00 00  00 00 00 00 00 00 00 00\n"
    "0340  00 00 00 00 00 00 00 00  00 00 00 00 00 00 f0 3f\n"
    "0350  00 00 00 00 00 00 f0 3f  00 00 00 00 00 00 f0 3f\n"
    "0380  89 54 45 54 53 54 41 54  c0 00 00 00 00 00 00 00\n"
    "0390  03 00 00 00 00 00 00 00  00 00 00 00 00 00 00 00\n"
    "03b0  00 00 00 00 00 00 00 00  f6 8e 55 77 e7 b2 8a 8f\n"
    "03c0  04 00 00 00 00 00 00 00  01 00 00 00 00 00 00 00\n"
    "03e0  01 00 00 00 00 00 00 00  04 00 00 00 00 00 00 00\n"
    "03f0  04 00 00 00 00 00 00 00  00 00 00 00 00 00 00 00\n"
    "0410  00 00 00 00 00 00 00 00  00 00 00 00 00 00 e0 3f\n"
    "0420  00 00 00 00 00 00 f0 3f  00 00 00 00 00 00 f0 3f\n"
    "0430  00 00 00 00 00 00 f0 3f  00 00 00 00 00 00 00 40\n"
    "0440  89 54 45 54 45 4e 44 20  40 00 00 00 00 00 00 00\n"
    "0450  04 00 00 00 00 00 00 00  01 00 00 00 00 00 00 00\n"
    "0460  80 03 00 00 00 00 00 00  c0 02 00 00 00 00 00 00\n"
    "0470  80 04 00 00 00 00 00 00  00 00 00 00 04 59 f5 0b\n";
constexpr size_t kExampleBytes = 1152;

Bytes bytesOfDump(const char* dump, size_t size) {
  Bytes out(size, 0);
  for (const char* line = dump; *line; line = std::strchr(line, '\n') + 1) {
    const size_t at = std::strtoul(std::string(line, 4).c_str(), nullptr, 16);
    const char* digits = line + 4;
    for (size_t i = 0; i < 16; ++i) {
      while (*digits == ' ') ++digits;
      EXPECT_LT(at + i, size);
      out.at(at + i) =
          static_cast<unsigned char>(std::strtoul(std::string(digits, 2).c_str(), nullptr, 16));
      digits += 2;
    }
  }
  return out;
}

TEST(TetsGolden, TheExampleIsWrittenByteForByte) {
  Stream s = example();
  EXPECT_TRUE(write(s, false) == bytesOfDump(kExample, kExampleBytes));
}

TEST(TetsGolden, TheExampleIsRead) {
  const Bytes file = bytesOfDump(kExample, kExampleBytes);
  Stream s = example();
  Schema schema;
  EXPECT_TRUE(readPiped(file, &schema) == s.events());
  EXPECT_EQ(schema.position_type, ScalarType::kFloat32);
  ASSERT_EQ(schema.fields.size(), 1u);
  EXPECT_EQ(schema.fields[0].name, "f");
  EXPECT_EQ(schema.cell_count, 1);
  EXPECT_EQ(schema.box_max, (std::vector<double>{1, 1, 1, 2}));
}

// Lines of the manual that look like those of the example are those of the example.
TEST(TetsGolden, TheManualHasTheSameExample) {
  std::string path = __FILE__;
  for (int up = 0; up < 4; ++up) path.resize(path.rfind('/'));
  path += "/man/man5/tetstream-formats.5";
  FILE* file = std::fopen(path.c_str(), "r");
  ASSERT_NE(file, nullptr) << path;
  std::string found;
  char line[512];
  while (std::fgets(line, sizeof line, file)) {
    const std::string text(line);
    const bool place =
        text.find_first_not_of("0123456789abcdef") == 4 && text.compare(4, 2, "  ") == 0;
    if (place && text.size() >= 54) found += text.substr(0, 54) + '\n';
  }
  std::fclose(file);
  EXPECT_EQ(found, kExample);
}

// ----------------------------------------------------------------------- compressed columns

// A second writing of what the manual says about compressed columns, byte by byte.
void appendTransposed(const std::vector<uint64_t>& numbers, size_t width, Bytes& out) {
  for (size_t byte = 0; byte < width; ++byte)
    for (const uint64_t number : numbers)
      out.push_back(static_cast<unsigned char>(number >> 8 * byte));
}

std::vector<uint64_t> numbersOf(const void* data, size_t count, size_t width) {
  std::vector<uint64_t> out(count, 0);
  for (size_t i = 0; i < count; ++i)
    std::memcpy(&out[i], static_cast<const char*>(data) + i * width, width);
  return out;
}

std::vector<uint64_t> differences(const std::vector<int64_t>& ids, size_t components) {
  std::vector<uint64_t> out;
  for (size_t i = 0; i < ids.size(); ++i) {
    const int64_t d = ids[i] - (i < components ? 0 : ids[i - components]);
    out.push_back(d < 0 ? 2 * static_cast<uint64_t>(-(d + 1)) + 1 : 2 * static_cast<uint64_t>(d));
  }
  return out;
}

// A frame of zstd (RFC 8878) that holds its content as it is: one segment, one raw block.
Bytes zstdFrame(const Bytes& content) {
  EXPECT_LT(content.size(), 256u);
  const size_t block = content.size() << 3 | 1;
  Bytes out = {0x28, 0xb5, 0x2f, 0xfd, 0x20, static_cast<unsigned char>(content.size())};
  for (int shift = 0; shift < 24; shift += 8)
    out.push_back(static_cast<unsigned char>(block >> shift));
  out.insert(out.end(), content.begin(), content.end());
  return out;
}

TEST(TetsGolden, CompressedColumnsAreAsTheManualSays) {
  SmallMesh mesh;
  mesh.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
  mesh.cells = {0, 1, 2, 3, 4, 2, 1, 3};
  Wanted wanted;
  wanted.explicit_every = 3;
  Stream s = streamOf(mesh, wanted);
  const Events events = s.events();
  ASSERT_EQ(events.finalized.size(), 2u);

  std::vector<Section> sections = sectionsOf(write(s, false));
  Section& chunk = sections[1];
  Bytes content;
  appendTransposed(numbersOf(events.positions.data(), 15, 4), 4, content);
  appendTransposed(differences(events.cells, 4), 4, content);
  content.insert(content.end(), events.last_uses.begin(), events.last_uses.end());
  appendTransposed(differences({events.finalized[0]}, 1), 8, content);
  appendTransposed({2}, 4, content);
  const Bytes frame = zstdFrame(content);
  chunk.body.resize(tets::chunkStartBytes(s.schema));
  chunk.body.insert(chunk.body.end(), frame.begin(), frame.end());
  chunk.head.flags |= 1u << 16;
  chunk.head.value = static_cast<uint32_t>(frame.size());
  const Bytes file = joined(sections);

  Status status;
  const std::string text = failureOf(file, true, &status);
  if (status == Status::kUnsupported) {
    EXPECT_NE(text.find("without zstd"), std::string::npos);
    Stream large = streamOf(gridMesh(4, 4, 4), wanted);  // then nothing is compressed, either
    EXPECT_TRUE(write(large, true) == write(large, false));
    return;
  }
  ASSERT_EQ(text, "");
  EXPECT_TRUE(read(file) == events);
}

}  // namespace
}  // namespace tetstream::test
