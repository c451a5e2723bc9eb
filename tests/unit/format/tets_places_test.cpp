// .tets: a reading of the vertices' places alone.
#include "tets_places.h"
#include "slow_run.h"
#include "source.h"
#include "tets_format.h"
#include "tets_streams.h"

namespace tetstream::test {
namespace {

Bytes placesOf(Source& source) {
  Bytes places;
  uint64_t vertices = 0;
  BatchView batch;
  while (source.next(batch)) {
    EXPECT_EQ(batch.first_vertex, vertices);
    EXPECT_EQ(batch.cell_count + batch.finalized_count + batch.face_count, 0U);
    vertices += batch.vertex_count;
    const auto* from = static_cast<const unsigned char*>(batch.positions);
    places.insert(places.end(), from,
                  from + 3 * sizeOf(source.schema().position_type) * batch.vertex_count);
  }
  EXPECT_FALSE(source.next(batch));
  return places;
}

std::unique_ptr<Source> placesIn(const Bytes& file) {
  return tets::openPlaces(openMemory(file.data(), file.size(), "memory"));
}

Wanted withEverything(ScalarType type) {
  Wanted wanted;
  wanted.position_type = type;
  wanted.fields = {{"pressure", 1, ScalarType::kFloat32}, {"id", 2, ScalarType::kInt64}};
  wanted.cell_data = {{"region", 1, ScalarType::kInt32}};
  wanted.locked = wanted.faces = true;
  wanted.explicit_every = 7;
  return wanted;
}

// Of one chunk and, unless that takes too long, of two with columns larger than what is
// decompressed at once.
TEST(TetsPlaces, AreThoseOfTheStream) {
  for (const int n : {4, slowRun() ? 6 : 24})
    for (const ScalarType type : {ScalarType::kFloat32, ScalarType::kFloat64})
      for (const bool compress : {false, true}) {
        Stream s = streamOf(gridMesh(n, n, n), withEverything(type));
        const Bytes file = write(s, compress);
        const Input input = openTets(openMemory(file.data(), file.size(), "memory"), {});
        const std::unique_ptr<Source> places = input.stream->again(Part::kPositions);
        ASSERT_NE(places, nullptr);
        EXPECT_TRUE(places->schema().fields.empty() && places->schema().cell_data.empty());
        EXPECT_EQ(places->schema().cell_count, input.schema().cell_count);
        EXPECT_EQ(places->schema().vertex_count, input.schema().vertex_count);
        EXPECT_TRUE(places->schema().hasBox());
        EXPECT_TRUE(placesOf(*places) == s.events().positions);
      }
}

TEST(TetsPlaces, AreNoneOfAnEmptyMesh) {
  Stream s;
  EXPECT_TRUE(placesOf(*placesIn(write(s))).empty());
}

TEST(TetsPlaces, AreNoneOfPipes) {
  Stream s = oneCellStream();
  const Input piped = openTets(std::make_unique<PipeSource>(write(s), 0), {});
  EXPECT_EQ(piped.stream->again(Part::kPositions), nullptr);
}

std::string failureOfPlaces(const Bytes& file, Status* status) {
  *status = Status::kOk;
  try {
    placesOf(*placesIn(file));
  } catch (const Error& error) {
    *status = error.status();
    return error.text();
  }
  return "";
}

TEST(TetsPlaces, OfFilesWithAFlippedBitAreRefused) {
  for (const bool compress : {false, true}) {
    Stream s = streamOf(gridMesh(3, 3, 3), withEverything(ScalarType::kFloat32));
    const Bytes file = write(s, compress);
    Bytes bad = file;
    for (size_t bit = 0; bit < 8 * file.size(); bit += 5 * oneIn(25)) {
      bad[bit / 8] ^= static_cast<unsigned char>(1u << bit % 8);
      Status status;
      const std::string text = failureOfPlaces(bad, &status);
      ASSERT_EQ(status, Status::kBadData) << "byte " << bit / 8 << " bit " << bit % 8 << text;
      bad[bit / 8] = file[bit / 8];
    }
  }
}

// Where checksums are right, all the same.
TEST(TetsPlaces, OfChunksThatLieAreRefused) {
  Stream s = streamOf(gridMesh(8, 8, 8), withEverything(ScalarType::kFloat64));
  std::vector<Section> sections = sectionsOf(write(s, true));
  const auto chunk = std::find_if(sections.begin(), sections.end(),
                                  [](const Section& each) { return each.head.is(tets::kChunk); });
  ASSERT_NE(chunk, sections.end());
  const Section whole = *chunk;
  Status status;
  tets::ChunkOwn counts = whole.head.get<tets::ChunkOwn>();
  counts.vertices = tets::kMaxRows + 1;
  chunk->head.set(counts);
  EXPECT_NE(failureOfPlaces(joined(sections), &status).find("it claims 65537 vertices"),
            std::string::npos);
  EXPECT_EQ(status, Status::kBadData);
  counts.vertices = 100;
  chunk->head.set(counts);
  EXPECT_NE(failureOfPlaces(joined(sections), &status), "");
  EXPECT_EQ(status, Status::kBadData);

  *chunk = whole;
  const bool is_compressed = (whole.head.flags & tets::kCodecMask) != 0;
  if (!is_compressed) return;  // this build does not compress
  const size_t columns = tets::chunkStartBytes(s.schema);
  size_t refused = 0;
  for (size_t at = columns; at < std::min(whole.body.size(), columns + 600); at += oneIn(7)) {
    chunk->body[at] ^= 0x55;
    const std::string text = failureOfPlaces(joined(sections), &status);
    EXPECT_TRUE(text.empty() || text.find("cannot be decompressed") != std::string::npos) << text;
    refused += !text.empty();
    chunk->body[at] = whole.body[at];
  }
  EXPECT_GT(refused, 0U);
}

}  // namespace
}  // namespace tetstream::test
