#include "msh_kinds.h"

namespace tetstream {

namespace {

struct Row {
  int number;
  CellKind kind;
};

constexpr Row kRows[] = {
    {1, {CellShape::kLine, 2}},
    {2, {CellShape::kTriangle, 3}},
    {3, {CellShape::kQuadrilateral, 4}},
    {4, {CellShape::kTetra, 4}},
    {5, {CellShape::kHexa, 8}},
    {6, {CellShape::kPrism, 6}},
    {7, {CellShape::kPyramid, 5}},
    {8, {CellShape::kLine, 3}},
    {9, {CellShape::kTriangle, 6}},
    {10, {CellShape::kQuadrilateral, 9}},
    {11, {CellShape::kTetra, 10}},
    {12, {CellShape::kHexa, 27}},
    {13, {CellShape::kPrism, 18}},
    {14, {CellShape::kPyramid, 14}},
    {15, {CellShape::kPoint, 1}},
    {16, {CellShape::kQuadrilateral, 8}},
    {17, {CellShape::kHexa, 20}},
    {18, {CellShape::kPrism, 15}},
    {19, {CellShape::kPyramid, 13}},
    {20, {CellShape::kTriangle, 9}},
    {21, {CellShape::kTriangle, 10}},
    {22, {CellShape::kTriangle, 12}},
    {23, {CellShape::kTriangle, 15}},
    {24, {CellShape::kTriangle, 15}},
    {25, {CellShape::kTriangle, 21}},
    {26, {CellShape::kLine, 4}},
    {27, {CellShape::kLine, 5}},
    {28, {CellShape::kLine, 6}},
    {29, {CellShape::kTetra, 20}},
    {30, {CellShape::kTetra, 35}},
    {31, {CellShape::kTetra, 56}},
    {36, {CellShape::kQuadrilateral, 16}},
    {37, {CellShape::kQuadrilateral, 25}},
    {38, {CellShape::kQuadrilateral, 36}},
    {92, {CellShape::kHexa, 64}},
    {93, {CellShape::kHexa, 125}},
};

}  // namespace

const CellKind* mshKind(int64_t number) {
  for (const Row& row : kRows)
    if (row.number == number) return &row.kind;
  return nullptr;
}

}  // namespace tetstream
