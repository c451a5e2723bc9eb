// .tets: what is written comes back, whatever carries it.
#include <unistd.h>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <thread>

#include "slow_run.h"
#include "tets_chunk.h"
#include "tets_format.h"
#include "tets_streams.h"

namespace tetstream::test {
namespace {

// Memory, a pipe, plain and compressed: the events must be the same.
void expectKept(Stream s) {
  const Events events = s.events();
  EXPECT_TRUE(read(write(s, false)) == events);
  EXPECT_TRUE(read(write(s, true)) == events);
  EXPECT_TRUE(readPiped(write(s, true)) == events);
  EXPECT_TRUE(readPiped(writePiped(s)) == events);
  EXPECT_TRUE(read(writePiped(s)) == events);
}

const std::vector<Column> kManyFields = {{"pressure", 1, ScalarType::kFloat32},
                                         {"velocity", 3, ScalarType::kFloat64},
                                         {"stress", 9, ScalarType::kFloat32},
                                         {"marker", 1, ScalarType::kInt32},
                                         {"id", 2, ScalarType::kInt64}};

TEST(Tets, KeepsFloat32PositionsWithoutFields) {
  Wanted wanted;
  expectKept(streamOf(gridMesh(4, 3, 5), wanted));
}

TEST(Tets, KeepsFloat64PositionsWithManyFieldsAndCellArrays) {
  Wanted wanted;
  wanted.position_type = ScalarType::kFloat64;
  wanted.fields = kManyFields;
  wanted.cell_data = {{"region", 1, ScalarType::kInt32},
                      {"stress", 6, ScalarType::kFloat64},
                      {"origin", 1, ScalarType::kInt64},
                      {"quality", 1, ScalarType::kFloat32}};
  expectKept(streamOf(gridMesh(4, 3, 5), wanted));
}

TEST(Tets, KeepsNotANumberAndInfinityToTheLastBit) {
  Stream s = oneCellStream();
  const uint32_t odd[4] = {0x7fc12345u, 0xffc00001u, 0x7f800000u, 0x80000000u};
  for (size_t i = 0; i < 4; ++i) std::memcpy(s.batches[0].field(0, i), &odd[i], 4);
  expectKept(std::move(s));
}

TEST(Tets, KeepsLockedVerticesAndLabelledFacesWithTheirBatch) {
  Wanted wanted;
  wanted.locked = wanted.faces = true;
  wanted.explicit_every = 4;
  expectKept(streamOf(gridMesh(4, 4, 5), wanted));
}

TEST(Tets, KeepsExplicitFinalizationsBetweenTheCellsWhereTheyStand) {
  for (const size_t every : {1, 2, 7}) {
    Wanted wanted;
    wanted.explicit_every = every;
    wanted.batch_cells = 13;
    Stream s = streamOf(gridMesh(4, 3, 5), wanted);
    EXPECT_FALSE(s.events().finalized.empty());
    expectKept(std::move(s));
  }
}

TEST(Tets, KeepsAStreamThatFinalizesNothing) {
  Wanted wanted;
  wanted.last_uses = false;
  expectKept(streamOf(gridMesh(3, 3, 3), wanted));
}

TEST(Tets, KeepsTheTimeOfTheValues) {
  for (const std::optional<double> time : {std::optional<double>(), {0.0}, {-0.1}}) {
    Stream s = streamOf(gridMesh(2, 2, 1), {});
    s.schema.time = time;
    for (const Bytes& file : {write(s, true), write(s, false), writePiped(s)})
      EXPECT_EQ(openTets(openMemory(file.data(), file.size(), "memory"), {}).stream->schema().time,
                time);
  }
}

TEST(Tets, KeepsAnEmptyMesh) {
  Stream s;
  s.schema.fields = kManyFields;
  expectKept(s);
  Schema schema;
  read(write(s), &schema);
  EXPECT_EQ(schema.cell_count, 0);
  EXPECT_EQ(schema.vertex_count, 0);
  EXPECT_FALSE(schema.hasBox());
}

TEST(Tets, KeepsOneCell) {
  expectKept(oneCellStream());
}

TEST(Tets, KeepsVerticesWithoutCells) {
  Stream s;
  Batch b(s.schema);
  b.clear(0);
  b.addVertices(7);
  for (size_t i = 0; i < 7; ++i) {
    const float p[3] = {float(i), 2, 3};
    std::memcpy(b.position(i), p, sizeof p);
  }
  s.batches.push_back(std::move(b));
  expectKept(std::move(s));
}

// 86,400 cells, in batches far larger and far smaller than a chunk.
TEST(Tets, KeepsManyChunksWhateverTheBatches) {
  const SmallMesh mesh = gridMesh(12, 12, slowRun() ? 30 : 100);
  Wanted wanted;
  wanted.fields = {{"f", 1, ScalarType::kFloat32}};
  wanted.explicit_every = 50;
  for (const size_t cells : {1u, 4096u, 1u << 30}) {
    wanted.batch_cells = cells;
    Stream s = streamOf(mesh, wanted);
    const Events events = s.events();
    EXPECT_TRUE(readPiped(write(s, true)) == events);
    EXPECT_TRUE(readPiped(writePiped(s)) == events);
  }
}

TEST(Tets, WritesTheSameBytesWhateverTheBatches) {
  const SmallMesh mesh = gridMesh(12, 12, slowRun() ? 24 : 60);
  Wanted wanted;
  wanted.fields = {{"f", 1, ScalarType::kFloat32}};
  Bytes first;
  for (const size_t cells : {1u, 777u, 4096u, 20000u, 1u << 30}) {
    wanted.batch_cells = cells;
    Stream s = streamOf(mesh, wanted);
    const Bytes bytes = write(s, false);
    if (first.empty()) first = bytes;
    EXPECT_TRUE(bytes == first) << cells;
  }
}

TEST(Tets, SpreadsVerticesThatComeLongBeforeTheirCells) {
  const SmallMesh mesh = gridMesh(40, 40, 40);  // 68,921 vertices
  Stream s;
  Batch vertices(s.schema), cells(s.schema);
  vertices.clear(0);
  vertices.addVertices(mesh.vertexCount());
  convertScalars(mesh.positions.data(), ScalarType::kFloat64, vertices.position(0),
                 ScalarType::kFloat32, mesh.positions.size());
  cells.clear(mesh.vertexCount());
  cells.addCells(100);
  std::memcpy(cells.cell(0), mesh.cells.data(), 400 * sizeof(int64_t));
  const int64_t last = static_cast<int64_t>(mesh.vertexCount()) - 1;
  cells.cell(50)[2] = last;  // one cell that needs them all
  s.batches.push_back(std::move(vertices));
  s.batches.push_back(std::move(cells));
  EXPECT_TRUE(readPiped(write(s, true)) == s.events());
}

TEST(Tets, CompressesOnlyWhereItPaysAndNeverOnPipes) {
  Wanted wanted;
  wanted.batch_cells = 1000;
  Stream s = streamOf(gridMesh(10, 10, 10), wanted);
  const size_t plain = write(s, false).size(), packed = write(s, true).size();
  EXPECT_LE(packed, plain);
  EXPECT_EQ(writePiped(s).size(), plain);

  Stream noise;  // that nothing can make smaller
  noise.schema.fields = {{"noise", 9, ScalarType::kFloat64}};
  Batch batch(noise.schema);
  batch.clear(0);
  batch.addVertices(1000);
  uint64_t state = 1;
  for (size_t i = 0; i < 9000; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    const uint64_t mixed = (state ^ state >> 29) * 0xbf58476d1ce4e5b9u;
    std::memcpy(static_cast<char*>(batch.field(0, 0)) + 8 * i, &mixed, 8);
  }
  std::memcpy(batch.position(0), batch.field(0, 0), 12000);
  noise.batches.push_back(std::move(batch));
  EXPECT_TRUE(write(noise, true) == write(noise, false));
}

TEST(Tets, FilesCarryWhatTheStreamDidNotKnowBeforehand) {
  Wanted wanted;
  wanted.fields = {{"v", 2, ScalarType::kFloat32}};
  Stream s = streamOf(gridMesh(2, 2, 9), wanted);
  const auto expectKnown = [&](const Schema& known) {
    EXPECT_EQ(known.vertex_count, 90);
    EXPECT_EQ(known.cell_count, 216);
    EXPECT_GE(known.front_width, 9);
    EXPECT_LT(known.front_width, 30);
    EXPECT_GE(known.front_span, known.front_width);
    EXPECT_GT(known.front_cells, 0);
    ASSERT_TRUE(known.hasBox());
    EXPECT_EQ(known.box_min, (std::vector<double>{0, 0, 0, -3, float(0.1 - 3)}));
    EXPECT_EQ(known.box_max[2], 9);
  };
  Schema schema;
  readPiped(write(s), &schema);  // from the header
  expectKnown(schema);
  read(writePiped(s), &schema);  // from the end
  expectKnown(schema);
  readPiped(writePiped(s), &schema);  // what nobody could know
  EXPECT_EQ(schema.cell_count, -1);
  EXPECT_FALSE(schema.hasBox());
}

TEST(Tets, PipesCarryWhatTheStreamKnewBeforehand) {
  Stream s = oneCellStream();
  s.schema.cell_count = 1;
  s.schema.front_width = 4;
  s.schema.box_min = {0, 0, 0, -9};
  s.schema.box_max = {1, 1, 1, 9};
  Schema schema;
  readPiped(writePiped(s), &schema);
  EXPECT_EQ(schema.vertex_count, -1);
  EXPECT_EQ(schema.cell_count, 1);
  EXPECT_EQ(schema.front_width, 4);
  EXPECT_EQ(schema.box_max, s.schema.box_max);
}

TEST(Tets, RefusesToFinishWithOtherCountsThanAnnounced) {
  Stream s = oneCellStream();
  s.schema.cell_count = 2;
  EXPECT_THROW(write(s), Error);
  EXPECT_THROW(writePiped(s), Error);
}

TEST(Tets, RefusesSchemasThatItCannotHold) {
  Stream s;
  s.schema.fields = {{std::string("a\0b", 3), 1, ScalarType::kFloat32}};
  EXPECT_THROW(write(s), Error);
  s.schema.fields.clear();
  for (int i = 0; i < 1025; ++i)
    s.schema.fields.push_back({textOf("f%d", i), 1, ScalarType::kFloat32});
  EXPECT_THROW(write(s), Error);
  s.schema.fields.pop_back();
  EXPECT_TRUE(read(write(s)) == s.events());
}

TEST(Tets, RefusesStreamsThatNameUnknownVertices) {
  Stream s = oneCellStream();
  s.batches[0].cell(0)[1] = 4;
  EXPECT_THROW(write(s), Error);
  s = oneCellStream();
  const int64_t face[3] = {0, 1, 4};
  s.batches[0].addFace(face, 1);
  EXPECT_THROW(write(s), Error);
  s = oneCellStream();
  s.batches[0].addFinalized(-1);
  EXPECT_THROW(write(s), Error);
}

TEST(Tets, GoesThroughARealPipeAndARealFile) {
  Wanted wanted;
  wanted.fields = kManyFields;
  Stream s = streamOf(gridMesh(8, 8, 12), wanted);
  const Events events = s.events();
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  std::thread writer([&] {
    writeTo(s, createDescriptor(ends[1], "pipe"), true);
    ::close(ends[1]);
  });
  EXPECT_TRUE(readFrom(openDescriptor(ends[0], "pipe")) == events);
  writer.join();
  ::close(ends[0]);

  const char* dir = std::getenv("TMPDIR");
  std::string path = std::string(dir && *dir ? dir : "/tmp") + "/tets_test.XXXXXX";
  ::close(::mkstemp(path.data()));
  writeTo(s, createFile(path), true);
  Schema schema;
  EXPECT_TRUE(readFrom(openFile(path), &schema) == events);
  EXPECT_EQ(schema.cell_count, 8 * 8 * 12 * 6);
  std::remove(path.c_str());
}

TEST(Tets, ColumnsOfAPlainChunkStandOnMultiplesOf64InTheFile) {
  Wanted wanted;
  wanted.fields = kManyFields;
  wanted.locked = true;
  Stream s = streamOf(gridMesh(3, 3, 3), wanted);
  const Bytes file = write(s, false);
  const std::vector<Section> sections = sectionsOf(file);
  ASSERT_TRUE(sections[1].head.is(tets::kChunk));
  tets::ChunkShape shape(s.schema);
  shape.set(sections[1].head.get<tets::ChunkOwn>(), sections[1].head.flags);
  const size_t payload = sections[0].head.length + 64 + tets::chunkStartBytes(s.schema);
  EXPECT_EQ(payload % 64, 0u);
  const Events events = s.events();
  for (size_t i = 0; i < s.schema.fields.size(); ++i) {
    const tets::ColumnPlace& c = shape[shape.field(i)];
    EXPECT_EQ(c.offset % 64, 0u);
    ASSERT_EQ(c.bytes, events.fields[i].size());
    EXPECT_EQ(std::memcmp(file.data() + payload + c.offset, events.fields[i].data(), c.bytes), 0);
  }
}

TEST(Tets, ReadsIdsOf64Bits) {
  Stream s = oneCellStream();
  std::vector<Section> sections = sectionsOf(write(s));
  Section& chunk = sections[1];
  ASSERT_EQ(chunk.head.flags & tets::kChunkWideCells, 0u);
  chunk.head.flags |= tets::kChunkWideCells;
  // The int32 ids 0 1 2 3 stand after the start, 48 bytes of positions and 16 of the field, each
  // on a multiple of 64; as int64 they fill half a line of the same 64 bytes.
  const int64_t ids[4] = {0, 1, 2, 3};
  std::memcpy(chunk.body.data() + tets::chunkStartBytes(s.schema) + 128, ids, sizeof ids);
  EXPECT_TRUE(read(joined(sections)) == s.events());
}

// Vertex 0 in a cell of the chunk that begins with vertex 2^40.
TEST(Tets, WritesIdsOf64BitsWhereADifferenceDoesNotFit) {
  Stream s = oneCellStream();
  tets::ChunkBuilder chunk(s.schema);
  tets::IndexEntry entry;
  for (const int64_t near : {(int64_t{1} << 40) - (int64_t{1} << 31), int64_t{0}}) {
    BatchView view = s.batches[0].view();
    const int64_t base = int64_t{1} << 40, ids[4] = {near, base + 1, base + 2, base + 3};
    view.cells = ids;
    chunk.start(static_cast<uint64_t>(base), 5);
    chunk.addVertices(view, 0, 4);
    chunk.addCells(view, 0, 1);
    const Bytes section = chunk.encode(0, false, &entry);
    tets::SectionHead head;
    std::memcpy(&head, section.data(), sizeof head);
    tets::ChunkShape shape(s.schema);
    shape.set(head.get<tets::ChunkOwn>(), head.flags);
    const unsigned char* cells = section.data() + sizeof head + tets::chunkStartBytes(s.schema) +
                                 shape[shape.cells()].offset;
    if (near > 0) {
      EXPECT_EQ(head.flags & tets::kChunkWideCells, 0u);
      const int32_t narrow[4] = {INT32_MIN, 1, 2, 3};
      EXPECT_EQ(std::memcmp(cells, narrow, sizeof narrow), 0);
    } else {
      EXPECT_NE(head.flags & tets::kChunkWideCells, 0u);
      EXPECT_EQ(std::memcmp(cells, ids, sizeof ids), 0);
    }
    EXPECT_EQ(entry.first_cell, 5u);
  }
}

TEST(Tets, SkipsSectionsThatItDoesNotKnow) {
  Stream s = oneCellStream();
  const std::vector<Section> sections = sectionsOf(write(s));
  ASSERT_EQ(sections.size(), 5u);
  for (size_t place = 1; place < sections.size(); ++place) {
    std::vector<Section> more = sections;
    Section note;
    note.head = tets::makeHead("NOTE", 0);
    note.body.assign(200, 'n');
    more.insert(more.begin() + static_cast<ptrdiff_t>(place), note);
    EXPECT_TRUE(read(joined(more)) == s.events()) << place;
    EXPECT_TRUE(readPiped(joined(more)) == s.events()) << place;

    more[place].head.flags = tets::kMustUnderstand;
    Status status;
    failureOf(joined(more), true, &status);
    EXPECT_EQ(status, Status::kUnsupported);
  }
}

TEST(Tets, ReadsWhatLaterVersionsAppendToIndexAndTotals) {
  Stream s = oneCellStream();
  std::vector<Section> sections = sectionsOf(write(s));
  tets::IndexOwn own = sections[2].head.get<tets::IndexOwn>();
  own.entry_bytes += 64;
  sections[2].head.set(own);
  sections[2].body.resize(sizeof(tets::IndexEntry) + 64, 1);
  sections[3].body.resize(sections[3].body.size() + 64, 1);
  const Bytes file = joined(sections);
  Schema schema;
  EXPECT_TRUE(read(file, &schema) == s.events());
  EXPECT_EQ(schema.cell_count, 1);
  EXPECT_TRUE(readPiped(file) == s.events());
}

TEST(Tets, WritesAnIndexAfterEvery1024Chunks) {
  // Batches with faces are not cut, and two of these do not go into one chunk.
  Stream s;
  const size_t rows = 9000, batches = 1030;
  Bytes out;
  const std::unique_ptr<Sink> sink = createTets(createMemory(out), {});
  sink->begin(s.schema);
  Batch batch(s.schema);
  batch.clear(0);
  batch.addVertices(rows);
  const int64_t face[3] = {0, 1, 2};
  batch.addFace(face, 1);
  for (size_t i = 0; i < batches; ++i) {
    BatchView view = batch.view();
    view.first_vertex = i * rows;
    sink->put(view);
  }
  sink->finish();
  int indices = 0;
  for (const Section& section : sectionsOf(out)) indices += section.head.is(tets::kIndex);
  EXPECT_EQ(indices, 2);
  const Input input = openTets(openMemory(out.data(), out.size(), "memory"), {});
  EXPECT_EQ(input.schema().vertex_count, static_cast<int64_t>(rows * batches));
  BatchView view;
  uint64_t seen = 0;
  while (input.stream->next(view)) seen += view.vertex_count;
  EXPECT_EQ(seen, rows * batches);
}

// ----------------------------------------------------------------------------- read again

// Read to the end, or half, or not at all: the first reading does not notice.
void expectReadAgain(std::unique_ptr<ByteSource> bytes, const Events& events) {
  const Input input = openTets(std::move(bytes), {});
  for (const int batches : {0, 1, 1 << 20}) {
    const std::unique_ptr<Source> second = input.stream->again(Part::kAll);
    ASSERT_NE(second, nullptr);
    EXPECT_EQ(second->schema().cell_count, input.schema().cell_count);
    Events again;
    BatchView batch;
    for (int k = 0; k < batches && second->next(batch); ++k) again.add(second->schema(), batch);
    if (batches > 1) {
      EXPECT_TRUE(again == events);
      EXPECT_FALSE(second->next(batch));
    }
  }
  Events first;
  BatchView batch;
  while (input.stream->next(batch)) first.add(input.schema(), batch);
  EXPECT_TRUE(first == events);
}

TEST(Tets, CanBeReadAgainWhereBytesCan) {
  Wanted wanted;
  wanted.fields = kManyFields;
  wanted.cell_data = {{"region", 1, ScalarType::kInt32}};
  wanted.locked = true;
  Stream s = streamOf(gridMesh(4, 4, 5), wanted);
  const Events events = s.events();
  for (const bool compress : {false, true}) {
    const Bytes bytes = write(s, compress);
    expectReadAgain(openMemory(bytes.data(), bytes.size(), "memory"), events);
    std::FILE* file = std::tmpfile();
    ASSERT_NE(file, nullptr);
    ASSERT_EQ(std::fwrite(bytes.data(), 1, bytes.size(), file), bytes.size());
    std::fflush(file);
    ASSERT_EQ(::lseek(::fileno(file), 0, SEEK_SET), 0);
    expectReadAgain(openDescriptor(::fileno(file), "file"), events);
    std::fclose(file);
    const Input piped = openTets(std::make_unique<PipeSource>(bytes, 0), {});
    EXPECT_EQ(piped.stream->again(Part::kAll), nullptr);
  }
}

}  // namespace
}  // namespace tetstream::test
