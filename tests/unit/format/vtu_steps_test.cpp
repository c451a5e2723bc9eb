// .vtu files with time steps of their own: all in one piece, as VTK writes them if they are
// appended and others write them inline, too; or, as VTK writes them inline, a piece for each step,
// in which every array claims step 0.
#include <gtest/gtest.h>

#include "status.h"
#include "vtu_encode.h"
#include "vtu_mesh_testing.h"

namespace tetstream {
namespace {

using namespace test;

const char kTimes[] = "<UnstructuredGrid TimeValues='\n0    \n0.5    \n1e-05\n'>";

std::string timed(const std::vector<VtuTestPiece>& pieces, const VtuStyle& style) {
  return replaced(makeVtu(pieces, style), "<UnstructuredGrid>", kTimes);
}

void addTo(std::vector<VtuTestArray>& all, std::vector<VtuTestArray> arrays, int claimed) {
  for (VtuTestArray& array : arrays) {
    array.attributes = "TimeStep='" + std::to_string(claimed) + "'";
    all.push_back(array);
  }
}

// In each step other values, and the first point elsewhere.
VtuTestPiece pieceOf(int step, int claimed) {
  const VtuTestPiece plain = twoCellPiece();
  VtuTestPiece piece;
  piece.points = plain.points;
  piece.cells = plain.cells;
  addTo(piece.point_data, plain.point_data, claimed);
  addTo(piece.cell_data, plain.cell_data, claimed);
  addTo(piece.points_element, plain.points_element, claimed);
  addTo(piece.cells_element, plain.cells_element, claimed);
  piece.point_data[0].reals[0] = 10 * step;
  piece.cell_data[0].integers[0] = 100 + step;
  piece.points_element[0].reals[0] = -step;
  return piece;
}

VtuTestPiece allSteps() {
  VtuTestPiece all = pieceOf(0, 0);
  for (int step : {1, 2}) {
    const VtuTestPiece more = pieceOf(step, step);
    const auto append = [](std::vector<VtuTestArray>& to, const std::vector<VtuTestArray>& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    append(all.point_data, more.point_data);
    append(all.cell_data, more.cell_data);
    append(all.points_element, more.points_element);
    append(all.cells_element, more.cells_element);
  }
  return all;
}

VtuMesh readStep(const std::string& file, int64_t step) {
  ReadOptions options;
  options.step = step;
  return readVtu(file, 1000, options);
}

void expectStep(const std::string& file, int64_t asked, int step) {
  const VtuMesh mesh = readStep(file, asked);
  EXPECT_EQ(mesh.cells, kTwoCells);
  ASSERT_EQ(mesh.fields.size(), 1u);
  EXPECT_EQ(valuesAs<float>(mesh.fields[0])[0], 10 * step);
  EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[0])[0], 100 + step);
  EXPECT_EQ(valuesAs<double>(mesh.positions)[0], -step);
  ASSERT_EQ(mesh.notes.size(), 1u);
  EXPECT_TRUE(has(mesh.notes[0], "of 3 time steps, 0 to 2, step " + std::to_string(step)))
      << mesh.notes[0];
}

TEST(VtuSteps, ReadsTheOneThatIsAskedForOrTheLast) {
  const std::string files[] = {
      timed({allSteps()}, {VtuCoding::kAppendedRaw}),
      timed({allSteps()}, {VtuCoding::kAppendedBase64, true}),
      timed({allSteps()}, {}),
      timed({allSteps()}, {VtuCoding::kInline, true}),
      timed({pieceOf(0, 0), pieceOf(1, 0), pieceOf(2, 0)}, {}),
      timed({pieceOf(0, 0), pieceOf(1, 0), pieceOf(2, 0)}, {VtuCoding::kInline, true})};
  for (const std::string& file : files) {
    expectStep(file, 0, 0);
    expectStep(file, 1, 1);
    expectStep(file, kLastStep, 2);
    EXPECT_TRUE(has(readStep(file, 2).notes[0], "at time 1e-05"));
    EXPECT_EQ(readStep(file, 2).schema.time, 1e-05);
    try {
      readStep(file, 3);
      ADD_FAILURE() << "step 3 was read";
    } catch (const Error& error) {
      EXPECT_TRUE(has(error.text(), "test.vtu: there is no time step 3")) << error.text();
    }
  }
}

TEST(VtuSteps, ReadsArraysOfSeveralStepsAndOfAll) {
  VtuTestPiece piece = allSteps();
  piece.cells_element = twoCellPiece().cells_element;
  piece.cell_data.resize(2);
  piece.cell_data[1].attributes = "TimeStep='1  2'";
  for (const VtuCoding coding : {VtuCoding::kAppendedRaw, VtuCoding::kInline}) {
    const std::string file = timed({piece}, {coding});
    EXPECT_EQ(valuesAs<int32_t>(readStep(file, 0).cell_data[0])[0], 100);
    for (const int64_t step : {1, 2}) {
      const VtuMesh mesh = readStep(file, step);
      EXPECT_EQ(mesh.cells, kTwoCells);
      EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[0])[0], 101);
      EXPECT_EQ(valuesAs<float>(mesh.fields[0])[0], 10 * static_cast<float>(step));
      EXPECT_EQ(mesh.notes.size(), 1u);
    }
  }
}

// Nor an array that the step lacks.
TEST(VtuSteps, ReadsNothingOfOthersThatAreNotAppended) {
  VtuTestPiece piece = allSteps();
  piece.points_element = twoCellPiece().points_element;
  piece.cells_element = twoCellPiece().cells_element;
  piece.cell_data.resize(1);
  for (const VtuStyle style : {VtuStyle{}, VtuStyle{VtuCoding::kAppendedRaw}}) {
    const std::string file = timed({piece}, style);
    EXPECT_EQ(readStep(file, 0).cell_data.size(), 1u);
    EXPECT_EQ(readStep(file, 2).cell_data.size(), 0u);
    EXPECT_EQ(valuesAs<float>(readStep(file, 2).fields[0])[0], 20);
  }
}

TEST(VtuSteps, RefusesPiecesOfWhichNobodyKnowsTheStep) {
  const std::string text = vtuFailure(timed({pieceOf(0, 0), pieceOf(1, 0)}, {}));
  EXPECT_TRUE(has(text, "2 pieces are of 3 time steps")) << text;
  const std::string word = vtuFailure(replaced(makeVtu({twoCellPiece()}, {}), "<UnstructuredGrid>",
                                               "<UnstructuredGrid TimeValues='0 soon'>"));
  EXPECT_TRUE(has(word, "TimeValues has a word that is no number")) << word;
}

}  // namespace
}  // namespace tetstream
