// Blocks of .vtu files compressed with what VTK offers beside zlib.
#include <gtest/gtest.h>
#include <cstring>

#include "slow_run.h"
#include "status.h"
#include "tasks.h"
#include "vtu_encode.h"
#include "vtu_read.h"
#include "vtu_side_by_side.h"

namespace tetstream {
namespace {

using namespace test;

const std::vector<const char*> kCodecs = {
#ifdef TETSTREAM_WITH_LZ4
    "lz4",
#endif
#ifdef TETSTREAM_WITH_LZMA
    "lzma",
#endif
    "zlib",
};

VtuStyle styleOf(const char* codec, VtuCoding coding, size_t block_bytes) {
  VtuStyle style;
  style.coding = coding;
  style.zlib = true;
  style.codec = codec;
  style.header_bits = 64;
  style.block_bytes = block_bytes;
  return style;
}

TEST(VtuCodecs, ReadBlocksOfAnySizeInAnyCoding) {
  const VtuMesh plain = readVtu(makeVtu({twoCellPiece()}, {}));
  for (const char* codec : kCodecs)
    for (const VtuCoding coding :
         {VtuCoding::kInline, VtuCoding::kAppendedBase64, VtuCoding::kAppendedRaw})
      for (const size_t block_bytes : {1, 7, 16, 32768}) {
        const std::string file = makeVtu({twoCellPiece()}, styleOf(codec, coding, block_bytes));
        for (const size_t step : {1, 3, 1000}) {
          if (slowRun() && step == 1) continue;
          EXPECT_TRUE(readVtu(file, step) == plain) << codec << " in blocks of " << block_bytes;
        }
      }
}

TEST(VtuCodecs, SurviveDamageOfEveryByte) {
  for (const char* codec : kCodecs) {
    const std::string good =
        makeVtu({twoCellPiece("Float32", "UInt8")}, styleOf(codec, VtuCoding::kAppendedRaw, 16));
    for (size_t byte = 0; byte < good.size(); byte += oneIn(23))
      for (const int bit : {0, 3, 7}) {
        std::string bad = good;
        bad[byte] = static_cast<char>(bad[byte] ^ (1 << bit));
        const std::string text = vtuFailure(bad);
        EXPECT_TRUE(text.empty() || text.starts_with("TETSTREAM_BAD_DATA: test.vtu: ") ||
                    text.starts_with("TETSTREAM_UNSUPPORTED: test.vtu: "))
            << codec << ", byte " << byte << ": " << text;
      }
    for (size_t size = 0; size < good.size(); size += oneIn(11))
      EXPECT_TRUE(vtuFailure(good.substr(0, size)) != "" || size >= good.rfind("\n</AppendedData>"))
          << codec << ", cut to " << size;
  }
}

TEST(VtuCodecs, NameTheDamagedBlock) {
  for (const char* codec : kCodecs) {
    std::string file = makeVtu({twoCellPiece()}, styleOf(codec, VtuCoding::kAppendedRaw, 1 << 10));
    const size_t begin = file.find("\n _") + 3;
    for (size_t i = begin + 4 * 8; i < begin + 4 * 8 + 6; ++i) file[i] = '\x5A';
    const std::string text = vtuFailure(file);
    EXPECT_NE(text.find("compressed block 0 (byte 0 of the values): "), std::string::npos) << text;
  }
}

// Also where another library has refused the block.
TEST(VtuCodecs, SayWhatZlibSaysOfABlock) {
  std::string file = makeVtu({twoCellPiece()}, styleOf("zlib", VtuCoding::kAppendedRaw, 1 << 10));
  const size_t begin = file.find("\n _") + 3;
  uint64_t size;
  std::memcpy(&size, file.data() + begin + 3 * sizeof size, sizeof size);
  file[begin + 4 * sizeof size + size - 1] ^= 1;  // of the checksum
  EXPECT_NE(vtuFailure(file).find("compressed block 0 (byte 0 of the values): "),
            std::string::npos);
  EXPECT_NE(vtuFailure(file).find("incorrect data check"), std::string::npos) << vtuFailure(file);
}

// The two cells so many times, each time with points of their own.
VtuTestPiece manyCellPiece(int64_t times) {
  VtuTestPiece piece = twoCellPiece();
  VtuTestArray& connectivity = piece.cells_element[0];
  for (VtuTestArray* array : {&piece.point_data[0], &piece.points_element[0]}) {
    const std::vector<double> once = array->reals;
    for (int64_t i = 1; i < times; ++i)
      for (const double value : once) array->reals.push_back(value + 0.01 * static_cast<double>(i));
  }
  for (int64_t i = 1; i < times; ++i) {
    for (size_t k = 0; k < 8; ++k)
      connectivity.integers.push_back(connectivity.integers[k] + 5 * i);
    for (const int64_t end : {8 * i + 4, 8 * i + 8}) piece.cells_element[1].integers.push_back(end);
    for (int k = 0; k < 2; ++k) {
      piece.cells_element[2].integers.push_back(10);
      piece.cell_data[0].integers.push_back(i % 7 - k);
    }
  }
  piece.points *= static_cast<uint64_t>(times);
  piece.cells *= static_cast<uint64_t>(times);
  return piece;
}

std::string failureWith(const std::string& file, const Tasks* tasks) {
  ReadOptions options;
  options.threads.tasks = tasks;
  try {
    readVtu(file, 1000, options);
  } catch (const Error& error) {
    return error.text();
  }
  return "";
}

TEST(VtuCodecs, GiveTheSameToAnyNumberOfThreads) {
  const VtuTestPiece piece = manyCellPiece(slowRun() ? 1200 : 3000);
  const VtuMesh plain = readVtu(makeVtu({piece}, {VtuCoding::kAppendedRaw}));
  const Tasks two(2), three(3), eight(8);
  for (const char* codec : kCodecs)
    for (const size_t block_bytes : {5000, 65536, 2000000}) {
      const VtuCoding coding = block_bytes == 5000 ? VtuCoding::kInline : VtuCoding::kAppendedRaw;
      const std::string file = makeVtu({piece}, styleOf(codec, coding, block_bytes));
      for (const Tasks* tasks : {&two, &three, &eight}) {
        ReadOptions options;
        options.threads.tasks = tasks;
        EXPECT_TRUE(readVtu(file, 777, options) == plain)
            << codec << " in blocks of " << block_bytes << ", " << tasks->threads() << " threads";
      }
    }
}

// Byte i is 7 i.
struct Sevens final : ValueBytes {
  void readAt(uint64_t offset, void* out, size_t size) override {
    for (size_t i = 0; i < size; ++i)
      static_cast<unsigned char*>(out)[i] = static_cast<unsigned char>((offset + i) * 7);
  }
};

TEST(VtuCodecs, AreReadByThreadsInAnyOrder) {
  const Tasks eight(8);
  const auto open = [] { return std::make_unique<Sevens>(); };
  const uint64_t size = 8 << 20;
  const auto bytes =
      openSideBySide({{&eight}, std::this_thread::get_id()}, size, 32768, open(), open);
  // Two in sequence, by which what follows is held: of the end, and then of much more.
  for (const uint64_t offset : {size - 3000, size - 2000, uint64_t{0}, uint64_t{1000}}) {
    unsigned char row[1000];
    bytes->readAt(offset, row, sizeof row);
    for (size_t i = 0; i < sizeof row; ++i)
      ASSERT_EQ(row[i], static_cast<unsigned char>((offset + i) * 7)) << offset;
  }
}

TEST(VtuCodecs, NameTheFirstProblemOfAnyNumberOfThreads) {
  const Tasks two(2), eight(8);
  const VtuTestPiece good = manyCellPiece(slowRun() ? 1200 : 3000);
  VtuTestPiece wrong = good;  // in a part that is decompressed with those that are damaged
  wrong.cells_element[0].integers[9000] = 123456;
  for (const char* codec : kCodecs)
    for (const VtuTestPiece* piece : std::initializer_list<const VtuTestPiece*>{&good, &wrong}) {
      const std::string file = makeVtu({*piece}, styleOf(codec, VtuCoding::kAppendedRaw, 10000));
      for (size_t byte = file.size() / 40; byte < file.size(); byte += file.size() / 9) {
        std::string damaged = file;
        for (size_t i = byte; i < std::min(byte + 8, file.size()); ++i) damaged[i] ^= '\x55';
        const std::string alone = failureWith(damaged, nullptr);
        EXPECT_EQ(failureWith(damaged, &two), alone) << codec << " " << byte;
        EXPECT_EQ(failureWith(damaged, &eight), alone) << codec << " " << byte;
      }
    }
}

#ifdef TETSTREAM_WITH_LZ4
TEST(VtuCodecs, RefuseLz4BlocksThatWouldNotFitMemory) {
  VtuTestPiece piece = twoCellPiece();
  std::string file = makeVtu({piece}, styleOf("lz4", VtuCoding::kAppendedRaw, 32768));
  // The types claim to be one block of 2^31 bytes, in 2^24: just what LZ4 could hold.
  const uint64_t cells = uint64_t{1} << 31;
  const std::string counted = "NumberOfCells=\"2\"";
  file.replace(file.find(counted), counted.size(),
               "NumberOfCells=\"" + std::to_string(cells) + "\"");
  const size_t tag = file.find("Name=\"types\"");
  const size_t offset = std::stoul(file.substr(file.find("offset=\"", tag) + 8, 12));
  const uint64_t words[4] = {1, cells, 0, uint64_t{1} << 24};
  file.replace(file.find("\n _") + 3 + offset, 32, reinterpret_cast<const char*>(words), 32);
  file.resize(file.size() + (size_t{1} << 24));
  const std::string text = vtuFailure(file);
  EXPECT_NE(text.find("LZ4 blocks of 2147483648 bytes are not read"), std::string::npos) << text;
}
#endif

}  // namespace
}  // namespace tetstream
