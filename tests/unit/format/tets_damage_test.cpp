// .tets: files that are damaged, cut off or lie are refused with a sentence that names the place.
#include "checksum.h"
#include "memory.h"
#include "slow_run.h"

#include "tets_streams.h"

namespace tetstream::test {
namespace {

// Some of everything in as few bytes as possible.
Stream smallStream() {
  Wanted wanted;
  wanted.fields = {{"f", 1, ScalarType::kFloat64}};
  wanted.cell_data = {{"region", 1, ScalarType::kInt32}};
  wanted.locked = wanted.faces = true;
  wanted.explicit_every = 3;
  wanted.batch_cells = 5;
  return streamOf(gridMesh(2, 2, 1), wanted);
}

bool isPlaced(const std::string& text) {
  return text.find("byte") != std::string::npos || text.find("not a .tets") != std::string::npos;
}

void expectEveryFlipFound(const Bytes& file) {
  Status status;
  ASSERT_EQ(failureOf(file, false, &status), "");
  Bytes bad = file;
  for (size_t bit = 0; bit < 8 * file.size(); bit += oneIn(9)) {
    bad[bit / 8] ^= static_cast<unsigned char>(1u << bit % 8);
    for (const bool piped : {false, true}) {
      const std::string text = failureOf(bad, piped, &status);
      ASSERT_EQ(status, Status::kBadData) << "byte " << bit / 8 << " bit " << bit % 8 << text;
      ASSERT_TRUE(isPlaced(text)) << text;
    }
    bad[bit / 8] = file[bit / 8];
  }
}

void expectEveryCutFound(const Bytes& file) {
  Status status;
  for (size_t size = 0; size < file.size(); size += oneIn(5)) {
    const Bytes cut(file.begin(), file.begin() + static_cast<ptrdiff_t>(size));
    for (const bool piped : {false, true}) {
      const std::string text = failureOf(cut, piped, &status);
      ASSERT_EQ(status, Status::kBadData) << size;
      const std::string words = size > 0 ? textOf("ends at byte %zu", size) : "is empty";
      ASSERT_NE(text.find(words), std::string::npos) << size << ": " << text;
    }
  }
}

TEST(TetsDamage, EveryFlippedBitOfAPlainFileIsFound) {
  Stream s = smallStream();
  expectEveryFlipFound(write(s, false));
}

TEST(TetsDamage, EveryFlippedBitOfACompressedFileIsFound) {
  Stream s = smallStream();
  const Bytes file = write(s, true);
  if (file.size() == write(s, false).size()) return;  // this build does not compress
  expectEveryFlipFound(file);
}

TEST(TetsDamage, EveryTruncationOfAPlainFileIsFound) {
  Stream s = smallStream();
  expectEveryCutFound(write(s, false));
}

TEST(TetsDamage, EveryTruncationOfACompressedFileIsFound) {
  Stream s = smallStream();
  expectEveryCutFound(write(s, true));
}

TEST(TetsDamage, EveryTruncationOfAPipedFileIsFound) {
  Stream s = smallStream();
  expectEveryCutFound(writePiped(s));
}

TEST(TetsDamage, TruncationNamesTheChunk) {
  Stream s = oneCellStream();
  Bytes file = write(s);
  const size_t header = sectionsOf(file)[0].head.length;
  file.resize(header + 100);
  for (const bool piped : {false, true}) {
    Status status;
    const std::string text = failureOf(file, piped, &status);
    EXPECT_NE(text.find("inside chunk 0, which begins at byte 256"), std::string::npos) << text;
  }
}

TEST(TetsDamage, BytesAfterTheEndAreFoundInFiles) {
  Stream s = oneCellStream();
  Bytes file = write(s);
  file.resize(file.size() + 64, 0);
  Status status;
  EXPECT_NE(failureOf(file, false, &status).find("follow the end marker"), std::string::npos);
  EXPECT_EQ(status, Status::kBadData);
  // What follows on a pipe belongs to somebody else.
  EXPECT_TRUE(readPiped(file) == s.events());
}

TEST(TetsDamage, OtherFilesAreNoTets) {
  Status status;
  for (const char* text : {"", "<?xml version=\"1.0\"?>", "solid"}) {
    const Bytes file(text, text + std::strlen(text));
    failureOf(file, false, &status);
    EXPECT_EQ(status, Status::kBadData);
  }
  EXPECT_NE(failureOf(Bytes(500, '#'), false, &status).find("not a .tets"), std::string::npos);
}

TEST(TetsDamage, AVersionFromTheFutureIsRefusedWithItsNumber) {
  Stream s = oneCellStream();
  std::vector<Section> sections = sectionsOf(write(s));
  sections[0].head.value = 7;
  for (const bool piped : {false, true}) {
    Status status;
    const std::string text = failureOf(joined(sections), piped, &status);
    EXPECT_EQ(status, Status::kUnsupported);
    EXPECT_NE(text.find("version 7"), std::string::npos) << text;
  }
}

TEST(TetsDamage, MissingSwappedAndDoubledSectionsAreFound) {
  Stream s = smallStream();
  const Bytes file = write(s);
  const std::vector<Section> whole = sectionsOf(file);
  for (size_t i = 0; i < whole.size(); ++i) {
    for (const bool again : {false, true}) {
      std::vector<Section> changed = whole;
      if (again)
        changed.insert(changed.begin() + static_cast<ptrdiff_t>(i), whole[i]);
      else
        changed.erase(changed.begin() + static_cast<ptrdiff_t>(i));
      Status status;
      failureOf(joined(changed), true, &status);
      // On a pipe nothing is read after the end, so that a second one does not matter.
      const bool harmless = again && whole[i].head.is(tets::kEnd);
      EXPECT_EQ(status, harmless ? Status::kOk : Status::kBadData) << i << again;
    }
  }
}

// ------------------------------------------------------------------------------------- lies

// Refused, and the process never had more than little memory.
void expectRefusedInLittleMemory(const Bytes& file) {
  for (const bool piped : {false, true}) {
    Status status;
    const std::string text = failureOf(file, piped, &status);
    EXPECT_TRUE(status == Status::kBadData || status == Status::kUnsupported) << text;
    EXPECT_FALSE(text.empty());
  }
  EXPECT_LT(peakResidentBytes(), uint64_t{1} << 30);
}

TEST(TetsDamage, LengthsOf2To60AreRefusedWithoutAllocating) {
  Stream s = oneCellStream();
  const Bytes file = write(s);
  for (size_t at = 0, i = 0; at < file.size(); ++i) {
    tets::SectionHead head;
    std::memcpy(&head, file.data() + at, sizeof head);
    const uint64_t length = head.length;
    head.length = uint64_t{1} << 60;
    head.head_checksum = checksum(0, &head, offsetof(tets::SectionHead, head_checksum));
    Bytes bad = file;
    std::memcpy(bad.data() + at, &head, sizeof head);
    expectRefusedInLittleMemory(bad);
    at += length;
  }
}

TEST(TetsDamage, CountsBeyondTheLimitsAreRefusedBeforeTheChunkIsRead) {
  Stream s = oneCellStream();
  const std::vector<Section> whole = sectionsOf(write(s));
  for (const uint32_t count : {0u, 2u, 65536u, 65537u, 0xffffffffu})
    for (int which = 0; which < 4; ++which) {
      std::vector<Section> sections = whole;
      tets::ChunkOwn own = sections[1].head.get<tets::ChunkOwn>();
      uint32_t* const counts[4] = {&own.vertices, &own.cells, &own.finalized, &own.faces};
      if (*counts[which] == count) continue;
      *counts[which] = count;
      sections[1].head.set(own);
      expectRefusedInLittleMemory(joined(sections));
    }
}

TEST(TetsDamage, LiesOfTheHeaderAreRefused) {
  Stream s = oneCellStream();
  const std::vector<Section> whole = sectionsOf(write(s));
  const auto expectRefused = [&](auto change) {
    std::vector<Section> sections = whole;
    tets::HeaderOwn own = sections[0].head.get<tets::HeaderOwn>();
    change(own, sections[0].body);
    sections[0].head.set(own);
    expectRefusedInLittleMemory(joined(sections));
  };
  using Own = tets::HeaderOwn;
  expectRefused([](Own& own, Bytes&) { own.byte_order = 0x04030201; });
  expectRefused([](Own& own, Bytes&) { own.position_type = 3; });
  expectRefused([](Own& own, Bytes&) { own.fields = 0xffffffffu; });
  expectRefused([](Own& own, Bytes&) { own.fields = 3; });
  expectRefused([](Own& own, Bytes&) { own.cell_arrays = 1024; });
  expectRefused([](Own& own, Bytes&) { own.box_offset = 0xfffffff0u; });
  expectRefused([](Own& own, Bytes&) { own.box_offset = 8; });
  expectRefused([](Own&, Bytes& body) { body.resize(64); });
  for (const size_t number : {0, 1})  // vertices, cells that are not there; -5
    for (const int64_t claim : {int64_t{1} << 60, int64_t{-5}})
      expectRefused([&](Own&, Bytes& body) { std::memcpy(&body[8 * number], &claim, 8); });
  for (const size_t at : {64, 68, 72, 76})  // the record: size, type, components, name
    for (const uint32_t value : {0u, 5u, 10u, 0xfffffff8u})
      expectRefused([&](Own&, Bytes& body) { std::memcpy(&body[at], &value, 4); });
}

TEST(TetsDamage, WrongContentsOfAChunkAreNamed) {
  Stream s = smallStream();
  const std::vector<Section> whole = sectionsOf(write(s));
  tets::ChunkShape shape(s.schema);
  shape.set(whole[1].head.get<tets::ChunkOwn>(), whole[1].head.flags);
  const auto expectRefused = [&](size_t column, auto value, const char* words) {
    std::vector<Section> sections = whole;
    std::memcpy(sections[1].body.data() + tets::chunkStartBytes(s.schema) + shape[column].offset,
                &value, sizeof value);
    Status status;
    const std::string text = failureOf(joined(sections), true, &status);
    EXPECT_EQ(status, Status::kBadData);
    EXPECT_NE(text.find("chunk 0 at byte"), std::string::npos) << text;
    EXPECT_NE(text.find(words), std::string::npos) << text;
  };
  expectRefused(shape.cells(), int32_t{18}, "cell 0 names vertex 18");
  expectRefused(shape.cells(), int32_t{-1}, "cell 0 names vertex -1");
  expectRefused(shape.lastUses(), uint8_t{16}, "last uses 0x10");
  expectRefused(shape.finalized(), int64_t{18}, "finalization 0 names vertex 18");
  expectRefused(shape.finalized(), int64_t{-1}, "finalization 0 names vertex -1");
  expectRefused(shape.finalizedAfter(), uint32_t{99}, "finalization 0 stands after 99");
  expectRefused(shape.faces(), int64_t{1} << 60, "face 0 names vertex");
  expectRefused(shape.facesAfter(), uint32_t{25}, "face 0 stands after 25");
}

TEST(TetsDamage, AnIndexOrTotalsThatDisagreeWithTheChunksAreRefused) {
  Stream s = smallStream();
  const std::vector<Section> whole = sectionsOf(write(s));
  ASSERT_EQ(whole.size(), 5u);
  for (size_t at = 16; at < sizeof(tets::IndexEntry); at += 4) {
    std::vector<Section> sections = whole;
    sections[2].body[at] ^= 1;
    Status status;
    failureOf(joined(sections), false, &status);
    EXPECT_EQ(status, Status::kBadData) << at;
  }
  for (const size_t at : {0, 8, 16, 24, 32, 64, 72, 96}) {
    std::vector<Section> sections = whole;
    sections[3].body[at + 6] ^= 0x10;
    Status status;
    failureOf(joined(sections), false, &status);
    EXPECT_EQ(status, Status::kBadData) << at;
  }
}

TEST(TetsDamage, UnknownFlagsAndMethodsOfAChunkAreRefused) {
  Stream s = oneCellStream();
  const std::vector<Section> whole = sectionsOf(write(s));
  for (const uint32_t flag : {1u << 1, 1u << 11, 1u << 24, 2u << 16, 255u << 16}) {
    std::vector<Section> sections = whole;
    sections[1].head.flags |= flag;
    Status status;
    const std::string text = failureOf(joined(sections), false, &status);
    EXPECT_EQ(status, Status::kUnsupported) << text;
  }
}

// Plain bytes that claim to be compressed: a sentence with or without zstd in the build.
TEST(TetsDamage, AChunkThatCannotBeDecompressedIsRefused) {
  Stream s = oneCellStream();
  std::vector<Section> sections = sectionsOf(write(s));
  sections[1].head.flags |= tets::kCodecZstd << tets::kCodecShift;
  Status status;
  const std::string text = failureOf(joined(sections), false, &status);
  EXPECT_NE(text.find("compress"), std::string::npos) << text;
  EXPECT_TRUE(status == Status::kBadData ||
              (status == Status::kUnsupported && text.find("without zstd") != std::string::npos));
}

}  // namespace
}  // namespace tetstream::test
