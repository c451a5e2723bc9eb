// .tets: what is whole of a file that is damaged, or was cut off, is read, and only that.
#include <set>

#include "slow_run.h"
#include "tets_format.h"
#include "tets_streams.h"

namespace tetstream::test {
namespace {

const SmallMesh& original() {
  static const SmallMesh mesh = gridMesh(6, 6, 30);
  return mesh;
}

// Ranks of vertices and cells stand in a field and a cell array, as fillRow writes them; the others
// make rows so wide that chunks are short.
Stream wideStream(bool faces, size_t explicit_every = 0) {
  Wanted wanted;
  wanted.fields = {{"rank", 1, ScalarType::kInt64}, {"wide", 9, ScalarType::kFloat64}};
  wanted.cell_data = {{"rank", 1, ScalarType::kInt64}};
  for (int i = 0; i < 6; ++i)
    wanted.cell_data.push_back({"wide" + std::to_string(i), 9, ScalarType::kFloat64});
  wanted.locked = true;
  wanted.faces = faces;
  wanted.explicit_every = explicit_every;
  return streamOf(original(), wanted);
}

int64_t rankIn(const void* rows, size_t row, int64_t offset) {
  int64_t label;
  std::memcpy(&label, static_cast<const unsigned char*>(rows) + row * sizeof label, sizeof label);
  EXPECT_EQ((label - offset) % 31, 0);
  return (label - offset) / 31;
}

struct Recovered {
  std::vector<int64_t> vertices, cells;  // ranks in the original
  std::vector<int64_t> faces;            // labels
  std::vector<std::string> notes;
  std::string failure;
};

// Reads what is left, and checks that it is a valid stream of parts of the original.
class Recovery {
 public:
  explicit Recovery(const SmallMesh& original) : original_(original) {}

  Recovered read(const Bytes& bytes) {
    Recovered out;
    try {
      ReadOptions options;
      options.recover = true;
      options.note = [&out](const std::string& note) { out.notes.push_back(note); };
      const Input input = openTets(openMemory(bytes.data(), bytes.size(), "memory"), options);
      BatchView batch;
      while (input.stream->next(batch)) take(batch, out);
      EXPECT_FALSE(input.stream->next(batch));
    } catch (const Error& error) {
      out.failure = error.text();
    }
    return out;
  }

 private:
  void take(const BatchView& b, Recovered& out) {
    ASSERT_EQ(b.first_vertex, out.vertices.size());
    for (size_t i = 0; i < b.vertex_count; ++i) out.vertices.push_back(rankIn(b.fields[0], i, 0));
    active_.resize(out.vertices.size(), true);
    for (size_t c = 0; c < b.cell_count; ++c) takeCell(b, c, out);
    for (size_t i = 0; i < b.finalized_count; ++i)
      active_.at(static_cast<size_t>(b.finalized[i])) = false;
    for (size_t i = 0; i < b.face_count; ++i) {
      const size_t cell = static_cast<size_t>(b.face_labels[i] + 10);
      for (size_t k = 0; k < 3; ++k)
        ASSERT_EQ(out.vertices.at(static_cast<size_t>(b.faces[3 * i + k])),
                  original_.cells[4 * cell + k]);
      out.faces.push_back(b.face_labels[i]);
    }
  }

  void takeCell(const BatchView& b, size_t c, Recovered& out) {
    const int64_t rank = rankIn(b.cell_data[0], c, 350);
    for (size_t j = 0; j < 4; ++j) {
      const size_t corner = static_cast<size_t>(b.cells[4 * c + j]);
      ASSERT_LT(corner, out.vertices.size());
      ASSERT_TRUE(active_[corner]) << "cell " << rank << " uses what was finalized";
      ASSERT_EQ(out.vertices[corner], original_.cells[4 * static_cast<size_t>(rank) + j]);
    }
    for (size_t j = 0; j < 4; ++j)
      if (b.last_uses && b.last_uses[c] >> j & 1)
        active_[static_cast<size_t>(b.cells[4 * c + j])] = false;
    out.cells.push_back(rank);
  }

  const SmallMesh& original_;
  std::vector<bool> active_;
};

Recovered recovered(const Bytes& bytes) {
  return Recovery(original()).read(bytes);
}

// Where a section begins, and which rows a chunk holds.
struct Place {
  size_t begin, end;
  bool chunk;
  int64_t first_vertex, vertices, first_cell, cells;
};

std::vector<Place> placesOf(const Bytes& file) {
  std::vector<Place> places;
  size_t at = 0;
  int64_t cells = 0;
  for (const Section& s : sectionsOf(file)) {
    Place p = {at, at + static_cast<size_t>(s.head.length), s.head.is(tets::kChunk), 0, 0, 0, 0};
    if (p.chunk) {
      const auto own = s.head.get<tets::ChunkOwn>();
      p.first_vertex = static_cast<int64_t>(own.first_vertex);
      p.vertices = own.vertices;
      p.first_cell = cells;
      p.cells = own.cells;
      cells += own.cells;
    }
    places.push_back(p);
    at = p.end;
  }
  return places;
}

// The cells that are to be recovered where these sections are whole.
std::vector<int64_t> wantedCells(const std::vector<Place>& places, const std::set<size_t>& broken) {
  const SmallMesh& mesh = original();
  std::vector<bool> there(mesh.positions.size() / 3, false);
  std::vector<int64_t> cells;
  for (size_t i = 0; i < places.size(); ++i) {
    const Place& p = places[i];
    if (!p.chunk || broken.count(i)) continue;
    for (int64_t v = 0; v < p.vertices; ++v) there[static_cast<size_t>(p.first_vertex + v)] = true;
    for (int64_t c = p.first_cell; c < p.first_cell + p.cells; ++c) {
      const auto corner = mesh.cells.begin() + static_cast<ptrdiff_t>(4 * c);
      if (std::all_of(corner, corner + 4, [&](int64_t v) { return there[static_cast<size_t>(v)]; }))
        cells.push_back(c);
    }
  }
  return cells;
}

bool isTold(const Recovered& r, const std::string& words) {
  return std::any_of(r.notes.begin(), r.notes.end(), [&](const std::string& note) {
    return note.find(words) != std::string::npos;
  });
}

class TetsRecovery : public ::testing::TestWithParam<bool> {};

TEST_P(TetsRecovery, AWholeFileIsReadAsItIs) {
  Stream s = wideStream(true, 3);
  const Bytes file = write(s, GetParam());
  const Recovered r = recovered(file);
  EXPECT_EQ(r.failure, "");
  EXPECT_EQ(r.cells, wantedCells(placesOf(file), {}));
  EXPECT_TRUE(isTold(r, "nothing is missing"));
}

// Chunks are told by their numbers in the file, those that are missing counted.
TEST_P(TetsRecovery, EveryChunkIsToldByItsNumber) {
  Stream s = wideStream(true, 3);
  Bytes file = write(s, GetParam());
  const std::vector<Place> places = placesOf(file);
  ASSERT_GT(places.size(), 6u);
  for (size_t chunk : {0, 1, 2}) file[places[1 + chunk].end - 1] ^= 1;
  const Recovered r = recovered(file);
  for (size_t chunk : {0, 1, 2})
    EXPECT_TRUE(isTold(r, textOf("chunk %zu at byte %zu", chunk, places[1 + chunk].begin)))
        << chunk;
}

TEST_P(TetsRecovery, WhateverIsCutOffTheChunksBeforeAreThere) {
  Stream s = wideStream(true, 3);
  const Bytes file = write(s, GetParam());
  const std::vector<Place> places = placesOf(file);
  ASSERT_GT(places.size(), 6u);
  std::set<size_t> broken;
  for (size_t i = places.size(); i-- > 1;) {
    broken.insert(i);
    const std::vector<int64_t> wanted = wantedCells(places, broken);
    const Place& p = places[i];
    for (const size_t size :
         {p.begin, p.begin + 1, p.begin + 63, p.begin + 64, (p.begin + p.end) / 2, p.end - 1}) {
      if (size == file.size()) continue;  // the end marker has a head alone
      const Recovered r =
          recovered(Bytes(file.begin(), file.begin() + static_cast<ptrdiff_t>(size)));
      ASSERT_EQ(r.failure, "") << size;
      ASSERT_EQ(r.cells, wanted) << size;
      ASSERT_TRUE(isTold(r, textOf("ends at byte %zu", size))) << size;
      ASSERT_TRUE(isTold(r, "the end is missing")) << size;
    }
  }
}

TEST_P(TetsRecovery, AChunkThatIsDamagedIsGonePast) {
  for (const bool faces : {false, true}) {
    Stream s = wideStream(faces, 3);
    const Bytes file = write(s, GetParam());
    const std::vector<Place> places = placesOf(file);
    for (size_t i = 1; i < places.size(); i += oneIn(3))
      for (const size_t byte : {places[i].begin + 2, places[i].begin + 20, places[i].begin + 40,
                                (places[i].begin + places[i].end) / 2, places[i].end - 1}) {
        Bytes bad = file;
        bad[byte] ^= 16;
        const Recovered r = recovered(bad);
        ASSERT_EQ(r.failure, "") << byte;
        ASSERT_EQ(r.cells, wantedCells(places, {i})) << byte;
        ASSERT_FALSE(isTold(r, "nothing is missing")) << byte;
        // Every label whose cell is there and whose vertices came before the damage or after it.
        ASSERT_EQ(r.faces.empty(), !faces) << byte;
      }
  }
}

TEST_P(TetsRecovery, BytesThatAreMissingOrTooManyAreGonePast) {
  Stream s = wideStream(false);
  const Bytes file = write(s, GetParam());
  const std::vector<Place> places = placesOf(file);
  const auto at = [&](size_t place) { return static_cast<ptrdiff_t>(place); };
  for (size_t i = 2; i + 1 < places.size(); ++i) {
    Bytes without = file;  // a whole section
    without.erase(without.begin() + at(places[i].begin), without.begin() + at(places[i].end));
    EXPECT_EQ(recovered(without).cells, wantedCells(places, {i}));
    Bytes shorter = file;  // what follows stands on no multiple of 64
    shorter.erase(shorter.begin() + at(places[i].begin + 70),
                  shorter.begin() + at(places[i].begin + 113));
    EXPECT_EQ(recovered(shorter).cells, wantedCells(places, {i}));
    Bytes longer = file;
    longer.insert(longer.begin() + at(places[i].begin), 1000, static_cast<unsigned char>(0x89));
    EXPECT_EQ(recovered(longer).cells, wantedCells(places, {}));
    Bytes twice = file;  // one that came before
    twice.insert(twice.begin() + at(places[i].begin), file.begin() + at(places[i - 1].begin),
                 file.begin() + at(places[i - 1].end));
    EXPECT_EQ(recovered(twice).cells, wantedCells(places, {}));
  }
}

INSTANTIATE_TEST_SUITE_P(PlainAndCompressed, TetsRecovery, ::testing::Bool());

TEST(TetsRecoveryEnds, WithoutAHeaderThereIsNothing) {
  Stream s = oneCellStream();
  Bytes file = write(s);
  for (const size_t byte : {0, 30, 70}) {
    Bytes bad = file;
    bad[byte] ^= 1;
    EXPECT_NE(recovered(bad).failure.find("without a header nothing can be recovered"),
              std::string::npos);
  }
  EXPECT_NE(recovered({}).failure, "");
}

TEST(TetsRecoveryEnds, APipeIsRecoveredToo) {
  Stream s = wideStream(false);
  Bytes file = writePiped(s);
  file.resize(file.size() * 2 / 3);
  ReadOptions options;
  options.recover = true;
  const Input input = openTets(std::make_unique<PipeSource>(file, 0), options);
  size_t cells = 0;
  for (BatchView batch; input.stream->next(batch);) cells += batch.cell_count;
  EXPECT_GT(cells, 1000u);
}

}  // namespace
}  // namespace tetstream::test
