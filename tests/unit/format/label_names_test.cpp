// Names of labels in files: .tets and .msh give back what they got, damaged ones are refused, and
// which array labels the cells of formats that have one label to a cell.
#include <algorithm>

#include "gmsh_format.h"
#include "indexed_testing.h"
#include "medit_format.h"
#include "tets_format.h"
#include "tets_streams.h"

namespace tetstream::test {
namespace {

const std::vector<LabelName> kNames = {
    {"", 0, "inner"}, {"", 1, "outer wall"}, {"region", 5, "st\xc3\xa4hl"}, {"region", 7, "lead"}};

Stream namedStream(std::vector<LabelName> names) {
  Wanted wanted;
  wanted.fields = {{"f", 2, ScalarType::kFloat64}};
  wanted.cell_data = {{"p", 1, ScalarType::kFloat32}, {"region", 1, ScalarType::kInt32}};
  wanted.faces = true;
  Stream s = streamOf(gridMesh(2, 2, 1), wanted);
  s.schema.label_names = std::move(names);
  return s;
}

Schema schemaOf(const Bytes& tets) {
  return openTets(openMemory(tets.data(), tets.size(), "memory"), {}).stream->schema();
}

TEST(LabelNamesOfFiles, ComeBackFromTets) {
  Stream s = namedStream(kNames);
  const std::vector<Bytes> files = {write(s, true), write(s, false), writePiped(s)};
  for (const Bytes& file : files) {
    EXPECT_EQ(schemaOf(file).label_names, kNames);
    EXPECT_TRUE(read(file) == s.events());
  }
  EXPECT_TRUE(schemaOf(files[0]).hasBox());  // filled in before them
}

// A mebibyte is all that a header may have.
TEST(LabelNamesOfFiles, AreLeftOutOfTetsWhereThereIsNoRoom) {
  std::vector<LabelName> names;
  for (int64_t i = 0; i < 5000; ++i) names.push_back({"region", i, std::string(255, 'n')});
  Stream s = namedStream(names);
  Bytes file;
  WriteOptions options;
  std::vector<std::string> notes;
  options.note = [&](const std::string& note) { notes.push_back(note); };
  const auto sink = createTets(createMemory(file), options);
  sink->begin(s.schema);
  for (Batch& b : s.batches) sink->put(b.view());
  sink->finish();
  const std::vector<LabelName> kept = schemaOf(file).label_names;
  EXPECT_GT(kept.size(), 3000u);
  EXPECT_TRUE(std::equal(kept.begin(), kept.end(), names.begin()));
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find(std::to_string(kept.size()) + " of the 5000 names"), std::string::npos);
  EXPECT_TRUE(read(file) == s.events());
}

// What a header may not say, by what is changed in the record of its last name.
TEST(LabelNamesOfFiles, ThatLieAreRefused) {
  Stream s = namedStream({{"region", 7, "lead"}});
  const std::vector<Section> sections = sectionsOf(write(s));
  const Bytes& body = sections[0].body;
  const std::string name = "lead";
  const auto text = std::search(body.begin(), body.end(), name.begin(), name.end());
  ASSERT_NE(text, body.end());
  const auto record = static_cast<size_t>(text - body.begin()) - sizeof(tets::LabelNameRecord);
  const struct {
    size_t at;
    uint32_t value;
    const char* problem;
  } cases[] = {{0, 20, "impossible sizes"},  {0, 1u << 20, "too short"},
               {4, 900, "impossible sizes"}, {4, 0, "has no bytes"},
               {8, 2, "impossible sizes"},   {8, 0xfffffff0u, "impossible"},
               {8, 0, "has no labels"},      {24, 0x64610065u, "a zero byte"}};
  for (const auto& c : cases) {
    std::vector<Section> changed = sections;
    std::memcpy(changed[0].body.data() + record + c.at, &c.value, sizeof c.value);
    for (const bool piped : {false, true}) {
      Status status;
      const std::string problem = failureOf(joined(changed), piped, &status);
      EXPECT_EQ(status, Status::kBadData) << problem;
      EXPECT_NE(problem.find(c.problem), std::string::npos) << problem << "\nwanted: " << c.problem;
    }
  }
  std::vector<Section> more = sections;
  tets::HeaderOwn own = more[0].head.get<tets::HeaderOwn>();
  own.label_names = 1u << 30;
  more[0].head.set(own);
  Status status;
  EXPECT_NE(failureOf(joined(more), false, &status).find("too short"), std::string::npos);
}

// The mesh as a .msh file, and what is told.
std::string asMsh(Stream& s, bool binary, bool newest, std::vector<std::string>* notes) {
  Bytes out;
  WriteOptions options;
  options.binary = binary;
  options.newest = newest;
  options.note = [notes](const std::string& note) { notes->push_back(note); };
  const auto sink = createMsh(createMemory(out), options);
  sink->begin(s.schema);
  for (Batch& b : s.batches) sink->put(b.view());
  sink->finish();
  return {out.begin(), out.end()};
}

TEST(LabelNamesOfFiles, ArePhysicalNamesOfMsh) {
  Stream s = namedStream(kNames);
  for (const bool binary : {false, true})
    for (const bool newest : {false, true}) {
      std::vector<std::string> notes;
      const std::string file = asMsh(s, binary, newest, &notes);
      EXPECT_NE(file.find("$PhysicalNames\n3\n2 1 \"outer wall\"\n3 5 \"st\xc3\xa4hl\"\n"),
                std::string::npos);
      EXPECT_TRUE(anyNote(notes, "no physical groups are left out: faces 0 \"inner\""));
      const Input input = openText(openMsh, file);
      EXPECT_EQ(input.schema().label_names,
                std::vector<LabelName>(kNames.begin() + 1, kNames.end()));
    }
}

TEST(LabelNamesOfFiles, OfOneGroupTheFirstCountsAndQuotesAreTold) {
  Stream s = namedStream({{"region", 5, "a \"b\""}});
  std::vector<std::string> notes;
  std::string file = asMsh(s, false, true, &notes);
  EXPECT_TRUE(anyNote(notes, "the name of \"a \"b\"\" has characters that the format cannot hold"));
  EXPECT_NE(file.find("3 5 \"a _b_\"\n"), std::string::npos);
  file.replace(file.find("$PhysicalNames\n1\n3 5 \"a _b_\""), 28,
               "$PhysicalNames\n2\n3 5 \"one\"\n3 5 \"two\"");
  EXPECT_EQ(openText(openMsh, file).schema().label_names,
            (std::vector<LabelName>{{"region", 5, "one"}}));
}

// Of a mesh of 20 cells: ids, ranks, the label of each.
Stream labelledStream(std::vector<Column> arrays) {
  Wanted wanted;
  wanted.cell_data = std::move(arrays);
  Stream s = streamOf(gridMesh(2, 2, 1), wanted);
  int64_t cell = 0;
  for (Batch& b : s.batches)
    for (size_t row = 0; row < b.view().cell_count; ++row, ++cell)
      for (size_t i = 0; i < s.schema.cell_data.size(); ++i) {
        const auto value = static_cast<int32_t>(i == 0 ? 100 + cell : i == 1 ? cell % 2 : cell % 3);
        std::memcpy(b.cellData(i, row), &value, sizeof value);
      }
  return s;
}

TEST(LabelNamesOfFiles, IdsAndRanksAreNoGroups) {
  const Column ids = {"cell_id", 1, ScalarType::kInt32}, rank = {"rank", 1, ScalarType::kInt32},
               label = {"material", 1, ScalarType::kInt32};
  std::vector<std::string> notes;
  Stream s = labelledStream({ids, rank, label});
  std::string file = asMsh(s, false, true, &notes);
  EXPECT_NE(file.find("tetstream physical material\n"), std::string::npos);
  EXPECT_NE(file.find("\"cell_id\""), std::string::npos);
  s = labelledStream({ids, rank});
  file = asMsh(s, false, true, &notes);
  EXPECT_NE(file.find("tetstream physical\n"), std::string::npos);
  Bytes mesh;
  const auto sink = createMesh(createMemory(mesh), {});
  s = labelledStream({ids, rank, label});
  sink->begin(s.schema);
  for (Batch& b : s.batches) sink->put(b.view());
  sink->finish();
  Input input = openMedit(openMemory(mesh.data(), mesh.size(), "memory"), {});
  const SvMesh back = readAll(input);
  ASSERT_EQ(back.schema.cell_data.size(), 1u);
  EXPECT_EQ(*std::max_element(back.cell_data[0].begin(), back.cell_data[0].end()), 2);
  // The one that is called as the format's own is, whatever it holds; and one with names.
  s = labelledStream({{"gmsh:physical", 1, ScalarType::kInt32}, rank, label});
  EXPECT_NE(asMsh(s, false, true, &notes).find("tetstream physical gmsh:physical\n"),
            std::string::npos);
  s = labelledStream({ids, rank, label});
  s.schema.label_names = {{"rank", 1, "first"}};
  EXPECT_NE(asMsh(s, false, true, &notes).find("tetstream physical rank\n"), std::string::npos);
}

}  // namespace
}  // namespace tetstream::test
