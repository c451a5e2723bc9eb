// .tets: one file read in several parts at once.
#include "tets_stretches.h"

#include "slow_run.h"
#include "source.h"
#include "tets_format.h"
#include "tets_streams.h"

namespace tetstream::test {
namespace {

// Cells so wide that few go into a chunk: a dozen chunks.
Stream manyChunks() {
  Wanted wanted;
  wanted.fields = {{"f", 1, ScalarType::kFloat32}};
  for (int i = 0; i < 57; ++i)
    wanted.cell_data.push_back({"w" + std::to_string(i), 9, ScalarType::kFloat64});
  wanted.explicit_every = 7;
  wanted.locked = true;
  return streamOf(gridMesh(8, 8, 8), wanted);
}

Input opened(const Bytes& file) {
  return openTets(openMemory(file.data(), file.size(), "memory"), {});
}

std::vector<tets::IndexEntry> indexOf(const Bytes& file) {
  return tets::readIndex(*openMemory(file.data(), file.size(), "memory"));
}

std::vector<tets::IndexEntry> evenChunks(size_t count, uint32_t cells, uint32_t vertices) {
  std::vector<tets::IndexEntry> chunks(count);
  for (size_t k = 0; k < count; ++k) {
    chunks[k].offset = 100 * (k + 1);
    chunks[k].cells = cells;
    chunks[k].vertices = vertices;
    chunks[k].first_cell = k * cells;
    chunks[k].first_vertex = k * vertices;
  }
  return chunks;
}

TEST(TetsStretches, FollowEachOtherAndTakeTheSameTime) {
  const std::vector<tets::IndexEntry> chunks = evenChunks(60, 1000, 200);
  for (const size_t most : {2, 3, 5})
    for (const uint64_t before : {0, 1, 200, 700}) {
      const std::vector<tets::ChunkRange> ranges = tets::cutChunks(chunks, most, before);
      ASSERT_EQ(ranges.size(), most);
      uint64_t own = 0, longest = 0, shortest = 60;
      for (const tets::ChunkRange& range : ranges) {
        const tets::IndexEntry& first = chunks[range.first];
        EXPECT_EQ(range.own_cell, 1000 * own);
        EXPECT_EQ(range.own_vertex, 200 * own);
        EXPECT_EQ(range.offset, first.offset);
        EXPECT_EQ(range.cells, first.first_cell);
        EXPECT_EQ(range.vertices, first.first_vertex);
        EXPECT_LE(range.vertices, range.own_vertex - std::min(range.own_vertex, before));
        EXPECT_LE(range.own_vertex - range.vertices, before + 200);  // no chunk too many
        longest = std::max(longest, range.end - range.first);
        shortest = std::min(shortest, range.end - range.first);
        own = range.end;
      }
      EXPECT_EQ(own, chunks.size());
      EXPECT_LE(longest, shortest + 2) << most << ", " << before;
    }
}

// Fewer where each would have to read much of the others', or had next to nothing to read.
TEST(TetsStretches, AreNoMoreThanPay) {
  const std::vector<tets::IndexEntry> chunks = evenChunks(60, 1000, 200);
  EXPECT_EQ(tets::cutChunks(chunks, 6, 2000).size(), 5u);
  EXPECT_TRUE(tets::cutChunks(chunks, 4, 12000).empty());
  EXPECT_TRUE(tets::cutChunks(evenChunks(7, 1000, 200), 2, 0).empty());
  EXPECT_TRUE(tets::cutChunks(chunks, 1, 0).empty());
  EXPECT_TRUE(tets::cutChunks({}, 2, 0).empty());
}

// A stretch's own events, behind what comes again of the one before; all of it once.
struct Parts {
  Bytes positions;
  std::vector<int64_t> cells;
  std::vector<double> first_of_cell;
};
void addOwn(const Stretch& stretch, Parts& parts, uint64_t* first_rank) {
  uint64_t cell = stretch.begin.first_cell, rank = 0;
  bool any = false;
  BatchView batch;
  while (stretch.source->next(batch)) {
    if (any)
      EXPECT_EQ(batch.first_vertex, rank);
    else
      *first_rank = batch.first_vertex;
    any = true;
    rank = batch.first_vertex + batch.vertex_count;
    const auto* from = static_cast<const unsigned char*>(batch.positions);
    for (size_t row = 0; row < batch.vertex_count; ++row)
      if (batch.first_vertex + row >= stretch.begin.vertex)
        parts.positions.insert(parts.positions.end(), from + 12 * row, from + 12 * row + 12);
    for (size_t row = 0; row < batch.cell_count; ++row, ++cell) {
      if (cell < stretch.begin.cell) continue;
      parts.cells.insert(parts.cells.end(), batch.cells + 4 * row, batch.cells + 4 * row + 4);
      parts.first_of_cell.push_back(static_cast<const double*>(batch.cell_data[0])[9 * row]);
    }
  }
  EXPECT_FALSE(stretch.source->next(batch));
}

TEST(TetsStretches, AreTheStreamTogether) {
  Stream s = manyChunks();
  const Events events = s.events();
  for (const bool compress : {false, true}) {
    const Bytes file = write(s, compress);
    const Input input = opened(file);
    for (const uint64_t before : {0, 40}) {
      std::vector<Stretch> stretches = input.stream->againInStretches(Part::kAll, 2, before);
      ASSERT_EQ(stretches.size(), 2u);
      Parts parts;
      uint64_t first_rank[2];
      for (size_t k : {0, 1}) addOwn(stretches[k], parts, &first_rank[k]);
      EXPECT_TRUE(parts.positions == events.positions);
      EXPECT_TRUE(parts.cells == events.cells);
      for (size_t c = 0; c < parts.first_of_cell.size(); ++c)
        ASSERT_EQ(std::memcmp(&parts.first_of_cell[c], &events.cell_data[0][9 * 8 * c], 8), 0);
      EXPECT_EQ(first_rank[0], 0u);
      EXPECT_LE(first_rank[1] + before, stretches[1].begin.vertex);
      EXPECT_EQ(first_rank[1]<stretches[1].begin.vertex, before> 0);
    }
  }
}

TEST(TetsStretches, HaveThePlacesTogether) {
  Stream s = manyChunks();
  const Bytes file = write(s, true);
  const Input input = opened(file);
  Bytes places;
  const std::vector<Stretch> stretches = input.stream->againInStretches(Part::kPositions, 3, 1000);
  ASSERT_EQ(stretches.size(), 3u);
  BatchView batch;
  for (const Stretch& stretch : stretches)
    while (stretch.source->next(batch)) {
      EXPECT_EQ(12 * batch.first_vertex, places.size());
      const auto* from = static_cast<const unsigned char*>(batch.positions);
      places.insert(places.end(), from, from + 12 * batch.vertex_count);
    }
  EXPECT_TRUE(places == s.events().positions);
}

// Whoever reads from end to end says what is wrong.
TEST(TetsStretches, AreNoneWithoutAWholeIndex) {
  Stream s = manyChunks();
  const Bytes file = write(s);
  EXPECT_GE(indexOf(file).size(), 12u);
  std::vector<Section> sections = sectionsOf(file);
  for (size_t k = 0; k < sections.size(); ++k) {
    if (!sections[k].head.is(tets::kIndex)) continue;
    for (const size_t byte : {16, 24, 32, 36, 112}) {  // of two entries
      std::vector<Section> wrong = sections;
      wrong[k].body[byte] ^= 1;
      const Bytes damaged = joined(wrong);  // with checksums that fit
      EXPECT_TRUE(opened(damaged).stream->againInStretches(Part::kAll, 2, 0).empty()) << byte;
    }
  }
  Bytes cut(file.begin(), file.end() - 64);
  EXPECT_TRUE(indexOf(cut).empty());
  EXPECT_TRUE(indexOf({}).empty());
  Bytes flipped = file;
  flipped[indexOf(file).back().offset + indexOf(file).back().length + 70] ^= 1;
  EXPECT_TRUE(indexOf(flipped).empty());
  const Input piped = openTets(std::make_unique<PipeSource>(file, 0), {});
  EXPECT_TRUE(piped.stream->againInStretches(Part::kAll, 2, 0).empty());
}

// Sections in each other, of which each claims the bytes of all: no more is read than the file has.
TEST(TetsStretches, AreNoneOfAnIndexThatLies) {
  Stream s = manyChunks();
  const Bytes file = write(s);
  const std::vector<Section> sections = sectionsOf(file);
  const auto index = std::find_if(sections.begin(), sections.end(),
                                  [](const Section& x) { return x.head.is(tets::kIndex); });
  ASSERT_NE(index, sections.end());
  const auto sealed = [](tets::SectionHead head, size_t body_bytes, uint64_t rank) {
    Bytes section(sizeof head + body_bytes, 1);
    tets::seal(head, rank, section);
    return section;
  };
  for (const uint64_t last : {uint64_t{1} << 63, uint64_t{64} << 20, ~uint64_t{0}}) {
    Bytes other(file.begin(), file.end() - 64);
    tets::SectionHead head = sections.back().head;
    head.set(tets::EndOwn{0, last, file.size()});
    const Bytes end = sealed(head, 0, head.rank);
    other.insert(other.end(), end.begin(), end.end());
    EXPECT_TRUE(indexOf(other).empty());
  }
  for (const uint32_t claimed : {0u, tets::kIndexEntries + 1, 1000000u}) {
    Bytes other;
    tets::SectionHead head = index->head;
    head.value = claimed;
    const Bytes section = sealed(head, size_t{96} * (tets::kIndexEntries + 1), 3);
    other.resize(64);
    other.insert(other.end(), section.begin(), section.end());
    head = sections.back().head;
    head.set(tets::EndOwn{0, 64, other.size() + 64});
    const Bytes end = sealed(head, 0, 4);
    other.insert(other.end(), end.begin(), end.end());
    EXPECT_TRUE(indexOf(other).empty()) << claimed;
  }
}

TEST(TetsStretches, NameTheChunkThatIsDamaged) {
  Stream s = manyChunks();
  Bytes file = write(s);
  const std::vector<tets::IndexEntry> index = indexOf(file);
  const tets::IndexEntry& last = index.back();
  file[last.offset + last.length - 100] ^= 1;
  const Input input = opened(file);
  const std::vector<Stretch> stretches = input.stream->againInStretches(Part::kAll, 2, 0);
  ASSERT_EQ(stretches.size(), 2u);
  BatchView batch;
  while (stretches[0].source->next(batch)) {
  }
  try {
    while (stretches[1].source->next(batch)) {
    }
    FAIL() << "nothing was found";
  } catch (const Error& error) {
    const std::string place =
        "chunk " + std::to_string(index.size() - 1) + " at byte " + std::to_string(last.offset);
    EXPECT_NE(error.text().find(place), std::string::npos) << error.text();
  }
}

}  // namespace
}  // namespace tetstream::test
