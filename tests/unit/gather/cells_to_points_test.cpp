// Cell arrays as fields.
#include "cells_to_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "mesh_spool.h"

namespace tetstream {
namespace {

// Three cells in a row, point 7 in none; of the arrays, "region" has labels, and "p" is a field,
// too.
std::unique_ptr<MeshSpool> threeCells() {
  auto mesh = std::make_unique<MeshSpool>(ScalarType::kFloat32, "");
  mesh->addField({"p", 1, ScalarType::kFloat32});
  for (const Column& column : std::vector<Column>{{"p", 1, ScalarType::kFloat64},
                                                  {"u", 2, ScalarType::kFloat32},
                                                  {"region", 1, ScalarType::kInt32},
                                                  {"rho", 1, ScalarType::kFloat64}})
    mesh->addCellData(column);
  const float places[24] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 2, 1, 1, 9, 9, 9, 8, 8, 8};
  const float p[8] = {1, 2, 3, 4, 5, 6, 7, 8};
  const int64_t cells[12] = {0, 1, 2, 3, 1, 2, 3, 4, 2, 3, 4, 5};
  const double cell_p[3] = {0, 0, 0}, rho[3] = {1, std::numeric_limits<double>::quiet_NaN(), 4};
  const float u[6] = {1, 10, 2, 20, 6, 60};
  const int32_t region[3] = {1, 1, 2};
  mesh->appendPositions(places, 8);
  mesh->appendField(0, p, 8);
  mesh->appendCells(cells, 3);
  mesh->appendCellData(0, cell_p, 3);
  mesh->appendCellData(1, u, 3);
  mesh->appendCellData(2, region, 3);
  mesh->appendCellData(3, rho, 3);
  mesh->finish();
  mesh->finishFaces();
  return mesh;
}

TEST(CellsToPoints, FieldsAreTheMeansOfTheCellsRound) {
  const auto mesh = cellsToPoints(threeCells(), "");
  const Schema& schema = mesh->schema();
  ASSERT_EQ(schema.fields.size(), 3u);
  EXPECT_EQ(schema.fields[1].name, "u");
  EXPECT_EQ(schema.fields[1].components, 2);
  EXPECT_EQ(schema.fields[1].type, ScalarType::kFloat32);
  EXPECT_EQ(schema.fields[2].name, "rho");
  EXPECT_EQ(schema.cell_data.size(), 4u);
  const float p[8] = {1, 2, 3, 4, 5, 6, 7, 8};
  const float u[16] = {1, 10, 1.5, 15, 3, 30, 3, 30, 4, 40, 6, 60, 0, 0, 0, 0};
  const double rho[8] = {1, 1, 2.5, 2.5, 4, 4, 0, 0};  // of what is finite
  for (uint64_t first = 0; first < 8; first += 3) {
    const auto count = static_cast<size_t>(std::min<uint64_t>(3, 8 - first));
    float read_p[3], read_u[6];
    double read_rho[3];
    mesh->readField(2, first, count, read_rho);
    mesh->readField(1, first, count, read_u);
    mesh->readField(0, first, count, read_p);
    for (size_t i = 0; i < count; ++i) {
      EXPECT_EQ(read_p[i], p[first + i]);
      EXPECT_EQ(read_u[2 * i], u[2 * (first + i)]);
      EXPECT_EQ(read_u[2 * i + 1], u[2 * (first + i) + 1]);
      EXPECT_EQ(read_rho[i], rho[first + i]);
    }
  }
  int32_t region[3];
  mesh->readCellData(2, 0, 3, region);
  EXPECT_EQ(region[2], 2);
}

}  // namespace
}  // namespace tetstream
