// Labelled faces of .tets: they come in time, and the header says how many.
#include <array>
#include <set>

#include "slow_run.h"
#include "tets_format.h"
#include "tets_streams.h"

namespace tetstream::test {
namespace {

// Faces without the place where their batch ended, in order.
std::vector<std::array<int64_t, 4>> facesOf(const Events& events) {
  std::vector<std::array<int64_t, 4>> faces;
  for (size_t i = 0; i < events.faces.size(); i += 5)
    faces.push_back(
        {events.faces[i], events.faces[i + 1], events.faces[i + 2], events.faces[i + 3]});
  std::sort(faces.begin(), faces.end());
  return faces;
}

// Takes no face of which a vertex was final in a batch before.
class FacesInTime final : public Sink {
 public:
  void begin(const Schema&) override {}
  void put(const BatchView& batch) override {
    for (size_t i = 0; i < 3 * batch.face_count; ++i) late += final_.count(batch.faces[i]) > 0;
    for (size_t i = 0; i < 4 * batch.cell_count; ++i)
      if (batch.last_uses[i / 4] >> (i % 4) & 1) final_.insert(batch.cells[i]);
  }
  void finish() override {}
  int late = 0;

 private:
  std::set<int64_t> final_;
};

// It comes back in parts: each face with the part of its last vertex.
TEST(TetsFaces, OfABatchTooLargeForAChunkComeInTime) {
  const SmallMesh mesh = gridMesh(12, 12, 100);
  Wanted wanted;
  wanted.faces = true;
  for (const size_t cells : {20000u, 60000u, 1u << 30}) {
    if (slowRun() && cells == 20000u) continue;
    wanted.batch_cells = cells;
    Stream s = streamOf(mesh, wanted);
    const Bytes bytes = write(s, true);
    Events back = readPiped(bytes), before = s.events();
    EXPECT_TRUE(facesOf(back) == facesOf(before));
    const Input input = openTets(openMemory(bytes.data(), bytes.size(), "memory"), {});
    FacesInTime in_time;
    copyStream(*input.stream, in_time);
    EXPECT_EQ(in_time.late, 0);
    if (cells > 65536) back.faces = before.faces;
    EXPECT_TRUE(back == before);
  }
}

// The number of faces stands in the header; what is announced has to come.
TEST(TetsFaces, AreAsManyAsTheHeaderSays) {
  Wanted wanted;
  for (const bool faces : {false, true}) {
    wanted.faces = faces;
    Stream s = streamOf(gridMesh(3, 3, 3), wanted);
    const int64_t count = static_cast<int64_t>(s.events().faces.size() / 5);
    EXPECT_EQ(count > 0, faces);
    Schema read_back;
    read(write(s), &read_back);
    EXPECT_EQ(read_back.face_count, faces ? count : -1);
    s.schema.face_count = count;
    readPiped(writePiped(s), &read_back);
    EXPECT_EQ(read_back.face_count, faces ? count : -1);
    s.schema.face_count = count + 1;
    EXPECT_THROW(write(s), Error);
  }
}

}  // namespace
}  // namespace tetstream::test
