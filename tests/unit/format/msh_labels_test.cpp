// Labels of cells as Gmsh's physical groups and entities.
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "msh_testing.h"

namespace tetstream {
namespace {

using namespace test;

// Forty cells of three materials, in turns, with the column asked for beside them.
SvMesh materials(const std::vector<Column>& beside = {}) {
  Schema schema;
  schema.cell_data = {{"material", 1, ScalarType::kInt64}};
  schema.cell_data.insert(schema.cell_data.end(), beside.begin(), beside.end());
  SvMesh m = indexedMesh(schema, 40);
  for (size_t i = 0; i < 40; ++i) m.cell_data[0][i] = static_cast<double>(i / 7 % 3);
  return m;
}

// Rows of its cells by material, in each in their order: as blocks of version 4.1 are.
template <class Row>
std::vector<Row> grouped(const SvMesh& m, const std::vector<Row>& rows) {
  std::vector<Row> all;
  for (double material : {0.0, 1.0, 2.0})
    for (size_t i = 0; i < rows.size(); ++i)
      if (m.cell_data[0][i] == material) all.push_back(rows[i]);
  return all;
}

TEST(MshLabels, WritesRegionsAsGroupsAndKeepsTheirColumn) {
  const SvMesh m = materials();
  for (bool binary : {false, true})
    for (bool newest : {false, true}) {
      const Bytes file = write(m, binary, newest);
      const SvMesh r = readBytes(openMsh, file);
      ASSERT_EQ(r.schema.cell_data.size(), 1u);
      EXPECT_EQ(r.schema.cell_data[0].name, "material");
      EXPECT_EQ(r.schema.cell_data[0].type, ScalarType::kInt64);
      EXPECT_EQ(r.cells, (newest ? grouped(m, m.cells) : m.cells));
      EXPECT_EQ(r.cell_data[0], (newest ? grouped(m, m.cell_data[0]) : m.cell_data[0]));
      EXPECT_EQ(std::string(file.begin(), file.end()).find("ElementData"), std::string::npos);
    }
}

// The first and the last element of the second block, with what stands before its corners.
std::string tagsOfSecondBlock(const Bytes& file) {
  const std::string text(file.begin(), file.end());
  const size_t block = text.find("\n3 1 4 14 \n");
  if (block == std::string::npos) return text;
  std::istringstream rows(text.substr(block));
  std::string row, first, last;
  std::getline(rows, row);
  std::getline(rows, row);
  for (int i = 0; i < 14; ++i) {
    std::getline(rows, row);
    (i == 0 ? first : last) = row.substr(0, row.find(' '));
  }
  return first + " " + last;
}

// Data stand in the order of the elements, since there are programs that go by it. Tags are those
// of the order in which cells came.
TEST(MshLabels, GroupsDataOfCellsAndNumbersThemForMaps) {
  const SvMesh m = materials({{"half", 1, ScalarType::kFloat64}});
  for (bool is_mapped : {false, true}) {
    Bytes file;
    std::vector<std::string> notes;
    WriteOptions options;
    options.binary = false;
    options.is_mapped = is_mapped;
    options.note = [&notes](const std::string& note) { notes.push_back(note); };
    putStream(m, *createMsh(createMemory(file), options), 7);
    EXPECT_EQ(tagsOfSecondBlock(file), "8 35");
    EXPECT_EQ(anyNote(notes, "cell N of the map is the element with the tag N + 1"), is_mapped);
    const SvMesh r = readBytes(openMsh, file);
    EXPECT_EQ(r.cells, grouped(m, m.cells));
    EXPECT_EQ(r.cell_data[1], grouped(m, m.cell_data[1]));
  }
}

// Groups have numbers from 1, and of a file with groups other programs take no cells without one.
TEST(MshLabels, GivesCellsOfLabel0AGroupBesideOthers) {
  SvMesh m = materials();
  // The last one names a label that no cell has.
  m.schema.label_names = {{"material", 0, "air"}, {"material", 2, "steel"}, {"material", 3, "oil"}};
  for (bool binary : {false, true}) {
    std::vector<std::string> notes;
    const Bytes file = write(m, binary, true, &notes);
    EXPECT_TRUE(anyNote(notes, "cells whose label is 0 are the physical group 4"));
    const std::string text(file.begin(), file.end());
    EXPECT_NE(text.find("tetstream group 4 0\n"), std::string::npos);
    EXPECT_NE(text.find("3 4 \"air\"\n3 2 \"steel\"\n3 3 \"oil\"\n"), std::string::npos);
    Input again = openMsh(openMemory(file.data(), file.size(), "mesh"), {});
    EXPECT_EQ(again.indexed->schema().label_names, m.schema.label_names);
    EXPECT_EQ(readAll(again).cell_data[0], grouped(m, m.cell_data[0]));
  }
  EXPECT_EQ(readBytes(openMsh, write(m, true, false)).cell_data[0], m.cell_data[0]);
}

// Groups have no negative numbers and none of more than 31 bits, in either version.
TEST(MshLabels, AreGroupsOfTheirOwnWhereTheirNumbersAreNone) {
  SvMesh m = materials();
  m.schema.label_names = {{"material", -1, "outside"}, {"material", 9, "steel"}};
  const double labels[] = {-1, 9, 5e9};
  for (size_t i = 0; i < 40; ++i) m.cell_data[0][i] = labels[i / 7 % 3];
  for (const bool binary : {false, true})
    for (const bool newest : {false, true}) {
      std::vector<std::string> notes;
      const Bytes file = write(m, binary, newest, &notes);
      EXPECT_TRUE(
          anyNote(notes,
                  "cells whose label is -1 are the physical group 10: groups have "
                  "numbers from 1 to 2147483647; 1 other labels are no such numbers, either"));
      const std::string text(file.begin(), file.end());
      EXPECT_NE(text.find("tetstream group 10 -1\ntetstream group 11 5000000000\n"),
                std::string::npos);
      EXPECT_NE(text.find("3 10 \"outside\"\n3 9 \"steel\"\n"), std::string::npos);
      EXPECT_EQ(text.find("ElementData"), std::string::npos);
      Input again = openMsh(openMemory(file.data(), file.size(), "mesh"), {});
      EXPECT_EQ(again.indexed->schema().label_names, m.schema.label_names);
      std::map<double, size_t> cells;
      const SvMesh r = readAll(again);
      for (const double label : r.cell_data[0]) ++cells[label];
      EXPECT_EQ(cells, (std::map<double, size_t>{{-1, 14}, {9, 14}, {5e9, 12}}));
    }
}

// Labels up to the largest that a group can have leave numbers below them only.
TEST(MshLabels, GivesLabel0AFreeNumberBelowTheLargest) {
  SvMesh m = materials();
  for (size_t i = 0; i < 40; ++i) m.cell_data[0][i] = i % 3 == 0 ? 0 : i % 3 == 1 ? 1 : 2147483647;
  for (bool newest : {false, true}) {
    const SvMesh r = readBytes(openMsh, write(m, true, newest));
    ASSERT_EQ(r.schema.cell_data.size(), 1u);
    std::map<double, int> cells, wanted;
    for (size_t i = 0; i < 40; ++i) {
      ++cells[r.cell_data[0][i]];
      ++wanted[m.cell_data[0][i]];
    }
    EXPECT_EQ(cells, wanted);
  }
  const Bytes old = write(m, false, false);
  const std::string text(old.begin(), old.end());
  EXPECT_NE(text.find("1 4 2 0 2 "), std::string::npos) << "an entity that another group has";
}

// An entity of version 4.1 has one group, an element of version 2.2 both numbers.
TEST(MshLabels, NotesEntitiesThatGetOtherNumbers) {
  SvMesh m = materials({{"gmsh:geometrical", 1, ScalarType::kInt32}});
  for (size_t i = 0; i < 40; ++i) {
    m.cell_data[0][i] = 1 + static_cast<double>(i % 2);
    m.cell_data[1][i] = 1 + static_cast<double>(i % 3);
  }
  std::vector<std::string> notes;
  write(m, true, true, &notes);
  EXPECT_TRUE(anyNote(notes, "3 have other numbers than \"gmsh:geometrical\" says"));
  notes.clear();
  EXPECT_EQ(readBytes(openMsh, write(m, true, false, &notes)).cell_data, m.cell_data);
  EXPECT_TRUE(notes.empty());
}

TEST(MshLabels, LeavesCellsThatAreTogetherInTheirOrder) {
  SvMesh m = materials();
  for (size_t i = 0; i < 40; ++i) m.cell_data[0][i] = i < 20 ? 5 : 2;
  EXPECT_EQ(readBytes(openMsh, write(m, true, true)).cells, m.cells);
}

TEST(MshLabels, KeepsRegionsOfWhichAllAreZero) {
  Schema schema;
  schema.cell_data = {{"material", 1, ScalarType::kInt32}};
  SvMesh m = indexedMesh(schema, 10);
  m.cell_data[0].assign(10, 0);
  for (bool binary : {false, true})
    for (bool newest : {false, true}) {
      const SvMesh r = readBytes(openMsh, write(m, binary, newest));
      ASSERT_EQ(r.schema.cell_data.size(), 1u);
      EXPECT_EQ(r.schema.cell_data[0].name, "material");
      EXPECT_EQ(r.cell_data, m.cell_data);
    }
}

}  // namespace
}  // namespace tetstream
