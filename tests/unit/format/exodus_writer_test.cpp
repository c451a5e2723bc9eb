// Exodus files of ours: blocks, side sets, names and variables come back; the layout with wide
// numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "exodus_format.h"
#include "indexed_testing.h"
#include "meshes.h"
#include "netcdf_file.h"
#include "netcdf_writer.h"
#include "status.h"
#include "vtu_mesh_testing.h"

namespace tetstream {
namespace {

using namespace test;

template <class T>
std::string packedValues(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// A grid whose cells are in three blocks in turn, labelled faces on two of its sides and one
// inside.
VtuMesh labelledGrid() {
  const SmallMesh grid = gridMesh(2, 3, 2);
  VtuMesh mesh;
  mesh.schema.position_type = ScalarType::kFloat64;
  mesh.schema.fields = {{"f", 1, ScalarType::kFloat64}, {"v", 3, ScalarType::kFloat32}};
  mesh.schema.cell_data = {{"heat", 2, ScalarType::kFloat64}, {"part", 1, ScalarType::kInt32}};
  mesh.schema.label_names = {{"", 7, "bottom"}, {"part", 20, "middle"}};
  mesh.positions = packedValues(grid.positions);
  mesh.cells = grid.cells;
  mesh.schema.vertex_count = static_cast<int64_t>(grid.vertexCount());
  mesh.schema.cell_count = static_cast<int64_t>(grid.cellCount());
  std::vector<float> v;
  for (size_t i = 0; i < 3 * grid.vertexCount(); ++i) v.push_back(0.25f * static_cast<float>(i));
  mesh.fields = {packedValues(grid.field), packedValues(v)};
  std::vector<double> heat;
  std::vector<int32_t> part;
  for (size_t c = 0; c < grid.cellCount(); ++c) {
    heat.insert(heat.end(), {static_cast<double>(c), -0.5 * static_cast<double>(c)});
    part.push_back(30 - 10 * static_cast<int32_t>(c % 3));
  }
  mesh.cell_data = {packedValues(heat), packedValues(part)};
  const auto addFace = [&](size_t cell, size_t without, int64_t label) {
    for (size_t j = 0; j < 4; ++j)
      if (j != without) mesh.faces.push_back(grid.cells[4 * cell + j]);
    mesh.face_labels.push_back(label);
  };
  for (size_t c = 0; c < grid.cellCount(); ++c)
    for (size_t j = 0; j < 4; ++j) {
      int low = 0;
      for (size_t k = 0; k < 4; ++k)
        low += k != j && grid.positions[3 * static_cast<size_t>(grid.cells[4 * c + k]) + 2] == 0;
      if (low == 3) addFace(c, j, 7);
    }
  addFace(17, 0, 8);
  mesh.schema.face_count = static_cast<int64_t>(mesh.face_labels.size());
  return mesh;
}

std::string asExodus(const VtuMesh& mesh, std::vector<std::string>* notes = nullptr,
                     bool is_mapped = false) {
  std::vector<unsigned char> out;
  WriteOptions options;
  options.is_mapped = is_mapped;
  if (notes) options.note = [notes](const std::string& note) { notes->push_back(note); };
  return writtenBy(*createExodus(createMemory(out), options), out, mesh);
}

TEST(ExodusWriter, BlocksSetsNamesAndVariablesComeBack) {
  const VtuMesh mesh = labelledGrid();
  std::vector<std::string> notes;
  const std::string file = asExodus(mesh, &notes);
  EXPECT_EQ(file.substr(0, 4), std::string("CDF\x02"));
  EXPECT_TRUE(anyNote(notes, "component of \"v\" is a variable of its own, \"v_x\" and so on"));
  EXPECT_TRUE(anyNote(notes, "component of \"heat\" is a variable of its own, \"heat_1\" and"));
  ASSERT_EQ(notes.size(), 2u);
  for (const size_t step : {1, 1000}) {
    const VtuMesh back = readAs("exodus", file, step);
    EXPECT_EQ(back.positions, mesh.positions);
    EXPECT_EQ(back.schema.label_names,
              (std::vector<LabelName>{{"", 7, "bottom"}, {"block_id", 20, "middle"}}));
    EXPECT_EQ(labelsOfFaces(back), labelsOfFaces(mesh));
    ASSERT_EQ(back.schema.fields.size(), 4u);
    EXPECT_EQ(back.schema.fields[0].name, "f");
    EXPECT_EQ(back.fields[0], mesh.fields[0]);
    EXPECT_EQ(back.schema.fields[3].name, "v_z");
    EXPECT_EQ(valuesAs<double>(back.fields[3])[5], 0.25 * 17);
    ASSERT_EQ(back.schema.cell_data.size(), 3u);
    EXPECT_EQ(back.schema.cell_data[0].name, "block_id");
    EXPECT_EQ(back.schema.cell_data[2].name, "heat_2");
    // Cells by block, in each in their order.
    const std::vector<int32_t> blocks = valuesAs<int32_t>(back.cell_data[0]);
    const std::vector<double> second = valuesAs<double>(back.cell_data[2]);
    const size_t cells = mesh.cells.size() / 4;
    for (size_t i = 0; i < cells; ++i) {
      const size_t block = i / (cells / 3), old = 3 * (i % (cells / 3)) + 2 - block;
      EXPECT_EQ(blocks[i], 10 + 10 * static_cast<int32_t>(block));
      EXPECT_EQ(second[i], -0.5 * static_cast<double>(old));
      EXPECT_TRUE(std::equal(&mesh.cells[4 * old], &mesh.cells[4 * old] + 4, &back.cells[4 * i]));
    }
  }
}

std::vector<int64_t> numbersOfElements(const std::string& file) {
  return openNetcdf(openMemory(file.data(), file.size(), "file"))->integers("elem_num_map", 1000);
}

// Where blocks take cells out of their order, each has the number that a map has, plus one.
TEST(ExodusWriter, NumbersElementsAsTheCellsCame) {
  VtuMesh mesh = labelledGrid();
  std::vector<std::string> notes;
  const std::string file = asExodus(mesh, &notes, true);
  EXPECT_TRUE(anyNote(notes, "cell N of the map is the element that elem_num_map numbers N + 1"));
  const VtuMesh back = readAs("exodus", file);
  const std::vector<int64_t> numbers = numbersOfElements(file);
  ASSERT_EQ(numbers.size(), mesh.cells.size() / 4);
  EXPECT_FALSE(std::is_sorted(numbers.begin(), numbers.end()));
  for (size_t i = 0; i < numbers.size(); ++i) {
    const int64_t* cell = &mesh.cells[4 * static_cast<size_t>(numbers[i] - 1)];
    EXPECT_TRUE(std::equal(cell, cell + 4, &back.cells[4 * i])) << i;
  }

  std::vector<int32_t> part = valuesAs<int32_t>(mesh.cell_data[1]);
  std::sort(part.begin(), part.end());
  mesh.cell_data[1] = packedValues(part);
  notes.clear();
  EXPECT_TRUE(numbersOfElements(asExodus(mesh, &notes, true)).empty());
  EXPECT_FALSE(anyNote(notes, "elem_num_map"));
}

TEST(ExodusWriter, CellsWithoutLabelsAreBlock1AndFloatsStayNarrow) {
  VtuMesh mesh = labelledGrid();
  mesh.schema.position_type = ScalarType::kFloat32;
  std::vector<float> narrow;
  for (const double x : valuesAs<double>(mesh.positions)) narrow.push_back(static_cast<float>(x));
  mesh.positions = packedValues(narrow);
  mesh.schema.fields = {mesh.schema.fields[1]};
  mesh.fields = {mesh.fields[1]};
  mesh.schema.cell_data.clear();
  mesh.cell_data.clear();
  for (int64_t& label : mesh.face_labels) label = 1;
  mesh.schema.label_names = {{"", 1, "inlet"}};  // which the block 1 is not
  const VtuMesh back = readAs("exodus", asExodus(mesh));
  EXPECT_EQ(back.schema.label_names, mesh.schema.label_names);
  EXPECT_EQ(back.schema.position_type, ScalarType::kFloat32);
  EXPECT_EQ(back.schema.fields[0].type, ScalarType::kFloat32);
  EXPECT_EQ(back.positions, mesh.positions);
  EXPECT_EQ(back.cells, mesh.cells);
  const std::vector<int32_t> blocks = valuesAs<int32_t>(back.cell_data[0]);
  EXPECT_EQ(std::count(blocks.begin(), blocks.end(), 1),
            static_cast<std::ptrdiff_t>(blocks.size()));
}

TEST(ExodusWriter, TellsWhatIsLeftOutOrRounded) {
  VtuMesh mesh = labelledGrid();
  mesh.faces.insert(mesh.faces.end(), {0, 1, 2, mesh.cells[0], mesh.cells[1], mesh.cells[2]});
  mesh.face_labels.insert(mesh.face_labels.end(), {0, int64_t{1} << 40});
  mesh.faces.insert(mesh.faces.end(), {0, 5, 35});  // of no cell
  mesh.face_labels.push_back(4);
  mesh.schema.cell_data.push_back({"number", 1, ScalarType::kInt64});
  std::vector<int64_t> numbers(mesh.cells.size() / 4, 3);
  numbers[5] = (int64_t{1} << 53) + 1;
  mesh.cell_data.push_back(packedValues(numbers));
  mesh.schema.label_names = {{"", 99, "nowhere"}, {"number", 3, "three"}, {"part", 20, "middle"}};
  mesh.schema.cell_data.push_back({"block_id", 1, ScalarType::kInt32});
  mesh.cell_data.push_back(mesh.cell_data[1]);
  std::vector<std::string> notes;
  const VtuMesh back = readAs("exodus", asExodus(mesh, &notes));
  EXPECT_TRUE(anyNote(notes, "3 labelled faces are left out"));
  EXPECT_TRUE(anyNote(notes, "\"number\" has integers that a float64 does not hold"));
  EXPECT_TRUE(anyNote(notes,
                      "no side sets are left out: faces 99 \"nowhere\", \"number\" 3 \"three\", "
                      "\"part\" 20 \"middle\""));
  EXPECT_EQ(back.face_labels.size(), labelledGrid().face_labels.size());
  EXPECT_TRUE(back.schema.label_names.empty());
  EXPECT_EQ(back.schema.cell_data.size(), 5u);
  EXPECT_EQ(valuesAs<int32_t>(back.cell_data[0])[0], 10);  // block_id, though others have names
}

// Names that would be read as one, or not at all.
TEST(ExodusWriter, VariablesHaveNamesOfTheirOwn) {
  VtuMesh mesh = labelledGrid();
  const std::string longest = std::string(254, 'n') + "\xc3\xa4";
  mesh.schema.fields = {{"v_x", 1, ScalarType::kFloat64},
                        {"v", 3, ScalarType::kFloat32},
                        {longest.substr(0, 254), 3, ScalarType::kFloat32},
                        {"f", 1, ScalarType::kFloat64},
                        {"f ", 1, ScalarType::kFloat64}};
  mesh.fields = {mesh.fields[0], mesh.fields[1], mesh.fields[1], mesh.fields[0], mesh.fields[0]};
  mesh.schema.cell_data = {{"block_id", 1, ScalarType::kInt32}};
  mesh.cell_data = {mesh.cell_data[1]};
  std::vector<int32_t> negative(mesh.cells.size() / 4, -3);
  mesh.cell_data[0] = packedValues(negative);
  mesh.schema.label_names.clear();
  std::vector<std::string> notes;
  const VtuMesh back = readAs("exodus", asExodus(mesh, &notes));
  std::vector<std::string> names;
  for (const Column& field : back.schema.fields) names.push_back(field.name);
  const std::string cut(253, 'n');
  EXPECT_EQ(names, (std::vector<std::string>{"v_x", "v_x_2", "v_y", "v_z", cut + "_x", cut + "_y",
                                             cut + "_z", "f", "f_2"}));
  EXPECT_TRUE(anyNote(notes, "\"f \" is written as \"f_2\""));
  EXPECT_TRUE(anyNote(notes, "the labels of \"block_id\" are no ids of blocks"));
  ASSERT_EQ(back.schema.cell_data.size(), 2u);
  EXPECT_EQ(back.schema.cell_data[1].name, "block_id_2");
  EXPECT_EQ(valuesAs<double>(back.cell_data[1])[7], -3);
}

// Whatever the array is called that would be the blocks.
TEST(ExodusWriter, TellsOfLabelsThatAreNoBlocks) {
  VtuMesh mesh = labelledGrid();
  mesh.schema.label_names.clear();
  std::vector<int32_t> labels(mesh.cells.size() / 4, 9);
  labels[3] = -1;
  mesh.schema.cell_data = {{"region", 1, ScalarType::kInt32}};
  mesh.cell_data = {packedValues(labels)};
  std::vector<std::string> notes;
  const VtuMesh back = readAs("exodus", asExodus(mesh, &notes));
  EXPECT_TRUE(anyNote(notes, "the labels of \"region\" are no ids of blocks"));
  ASSERT_EQ(back.schema.cell_data.size(), 2u);
  EXPECT_EQ(valuesAs<double>(back.cell_data[1])[3], -1);
}

// A side is of the cell out of which its face looks as it is wound, and is read so.
TEST(ExodusWriter, FacesInsideLookWhereTheyDid) {
  VtuMesh mesh = labelledGrid();
  const auto faceInside = [](const VtuMesh& of) {
    const auto label = std::find(of.face_labels.begin(), of.face_labels.end(), 8);
    const auto face = static_cast<size_t>(label - of.face_labels.begin());
    int64_t corners[3];
    std::copy_n(&of.faces[3 * face], 3, corners);
    std::rotate(corners, std::min_element(corners, corners + 3), corners + 3);
    return std::vector<int64_t>(corners, corners + 3);
  };
  for (int way = 0; way < 2; ++way) {
    std::swap(mesh.faces[mesh.faces.size() - 1], mesh.faces[mesh.faces.size() - 2]);
    const VtuMesh back = readAs("exodus", asExodus(mesh));
    ASSERT_EQ(back.face_labels.size(), mesh.face_labels.size());
    EXPECT_EQ(faceInside(back), faceInside(mesh)) << way;
  }
}

TEST(ExodusWriter, OfEqualFacesTheFirstIsKept) {
  VtuMesh mesh = labelledGrid();
  const std::vector<int64_t> first(mesh.faces.end() - 3, mesh.faces.end());
  mesh.faces.insert(mesh.faces.end(), {first[2], first[0], first[1]});
  mesh.face_labels.push_back(3);
  const VtuMesh back = readAs("exodus", asExodus(mesh));
  EXPECT_EQ(labelsOfFaces(back), labelsOfFaces(labelledGrid()));
}

TEST(ExodusWriter, RefusesAMeshWithoutPoints) {
  VtuMesh mesh;
  mesh.schema.vertex_count = mesh.schema.cell_count = 0;
  EXPECT_THROW(asExodus(mesh), Error);
}

// Where an array is too large for 32-bit sizes.
TEST(NetcdfWriter, WideNumbersAreReadAsTheOthers) {
  for (const uint64_t most : {uint64_t{40}, uint64_t{1} << 30}) {
    std::vector<unsigned char> out;
    const auto bytes = createMemory(out);
    NetcdfWriter writer(*bytes, most);
    const size_t time = writer.addDimension("time", 0), rows = writer.addDimension("rows", 7),
                 width = writer.addDimension("width", 5);
    writer.addAttribute("title", "some");
    writer.addAttribute("number", NetcdfType::kDouble, 2.5);
    writer.addAttribute("word", NetcdfType::kInt, -3);
    std::vector<double> reals = {1, -2.5, 3e300, 4, 5, 6, 7};
    writer.addVariable("late", NetcdfType::kDouble, {time, rows}, {}, [&](NetcdfValues& values) {
      values.put(reals.data(), ScalarType::kFloat64, 7);
    });
    writer.addVariable("words", NetcdfType::kChar, {rows, width}, {"kind", "text"},
                       [](NetcdfValues& values) {
                         for (int i = 0; i < 7; ++i) values.text(textOf("w%d", i * 11), 5);
                       });
    writer.addVariable("numbers", NetcdfType::kInt, {rows}, {}, [](NetcdfValues& values) {
      for (int64_t i = 0; i < 7; ++i) values.put(-100000 * i);
    });
    writer.write();
    bytes->commit();
    EXPECT_EQ(out[3], most == 40 ? 5 : 2);
    const auto file = openNetcdf(openMemory(out.data(), out.size(), "memory"));
    EXPECT_EQ(file->reals("late", 100), reals);
    EXPECT_EQ(file->texts("words", 100),
              (std::vector<std::string>{"w0", "w11", "w22", "w33", "w44", "w55", "w66"}));
    EXPECT_EQ(file->textAttribute("words", "kind"), "text");
    EXPECT_EQ(file->integers("numbers", 100),
              (std::vector<int64_t>{0, -100000, -200000, -300000, -400000, -500000, -600000}));
  }
}

}  // namespace
}  // namespace tetstream
