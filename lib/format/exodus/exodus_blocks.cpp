#include "exodus_blocks.h"

#include <algorithm>

#include "mesh_pieces.h"
#include "status.h"
#include "vtk_cells.h"

namespace tetstream {

namespace {

constexpr int kVtkLower = 7, kVtkPolyhedron = 42;  // what has no kind here

// By how the names of elements begin; the number of nodes tells the rest. The corners have the
// order of VTK's, but wedges of six nodes that of VTK's larger ones: their first triangle is turned
// inwards, as sides tell (exodusSide).
struct Element {
  const char* begin;
  uint64_t corners;
  int linear, any;  // VTK's types: of as many nodes as corners, of more
};

constexpr Element kElements[] = {
    {"TET", 4, 10, 71},       {"HEX", 8, 12, 72},       {"WED", 6, 73, 73},
    {"PYR", 5, 14, 74},       {"TRI", 3, 5, 69},        {"SHELL", 4, 9, 70},
    {"SHELL", 3, 5, 69},      {"QUA", 4, 9, 70},        {"BAR", 2, 3, 68},
    {"BEA", 2, 3, 68},        {"TRU", 2, 3, 68},        {"EDG", 2, 3, 68},
    {"SPH", 1, 1, kVtkLower}, {"CIR", 1, 1, kVtkLower}, {"NUL", 0, kVtkLower, kVtkLower}};

int vtkTypeOf(std::string element, uint64_t nodes) {
  for (char& c : element)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  for (const Element& row : kElements)
    if (element.starts_with(row.begin) && nodes >= row.corners)
      return nodes == row.corners ? row.linear : row.any;
  return kVtkPolyhedron;
}

void readShape(NetcdfFile& file, ExodusBlock& block) {
  const NetcdfVariable* nodes = file.find(block.connectivity);
  if (!nodes) return;  // a block without elements
  if (nodes->text || isFloat(nodes->type) || nodes->sizes.empty())
    fail(Status::kBadData, "%s: \"%s\" is no list of nodes", file.name().c_str(),
         block.connectivity.c_str());
  block.element = file.textAttribute(block.connectivity, "elem_type");
  block.elements = nodes->size(0);
  block.nodes = nodes->size(1);
  block.vtk_type =
      nodes->sizes.size() == 2 ? vtkTypeOf(block.element, block.nodes) : kVtkPolyhedron;
}

// Blocks of other dimensions than those that stay become cells that are left out.
void checkShape(NetcdfFile& file, ExodusBlock& block, bool split, bool faces) {
  const VtkCell& cell = vtkCell(block.vtk_type);
  const bool known = cell.fate == VtkCell::kKnown;
  const char* why = nullptr;
  if (cell.fate == VtkCell::kOther) why = "which are not read";
  if (known && dimensionOf(cell.kind.shape) == 3 && cell.kind.shape != CellShape::kTetra && !split)
    why = kOnlyTetrahedra;
  if (why)
    fail(Status::kUnsupported, "%s: %s has elements \"%s\" of %llu nodes; %s", file.name().c_str(),
         nameOf(block).c_str(), cutName(block.element).c_str(),
         static_cast<unsigned long long>(block.nodes), why);
  if (known && dimensionOf(cell.kind.shape) == 2 && !faces) block.vtk_type = kVtkLower;
}

}  // namespace

CellKind ExodusBlock::kind() const {
  return vtkCell(vtk_type).kind;
}

std::string nameOf(const ExodusBlock& block) {
  std::string text = textOf("element block %lld", static_cast<long long>(block.id));
  if (!block.name.empty()) text += " (\"" + cutName(block.name) + "\")";
  return text;
}

std::vector<ExodusBlock> readExodusBlocks(NetcdfFile& file, bool split, bool faces) {
  const std::vector<int64_t> ids = file.integers("eb_prop1", kMaxMeshPieces);
  const std::vector<std::string> names = file.texts("eb_names", kMaxMeshPieces);
  std::vector<ExodusBlock> blocks;
  uint64_t first = 0;
  for (size_t i = 0;; ++i) {
    ExodusBlock block;
    block.connectivity = "connect" + std::to_string(i + 1);
    if (i >= ids.size() && (!ids.empty() || !file.find(block.connectivity))) return blocks;
    if (i == kMaxMeshPieces)
      fail(Status::kUnsupported, "%s: there are too many element blocks", file.name().c_str());
    block.id = i < ids.size() ? ids[i] : static_cast<int64_t>(i + 1);
    if (i < names.size()) block.name = names[i];
    readShape(file, block);
    block.first = first;
    first += block.elements;
    if (block.elements > 0) checkShape(file, block, split, faces);
    blocks.push_back(std::move(block));
  }
}

size_t exodusSide(CellShape shape, int64_t side, int* corners) {
  struct Sides {
    CellShape shape;
    int64_t count;
    int8_t corners[6][4];  // the last of a triangle is -1
  };
  static constexpr Sides kSides[] = {
      {CellShape::kTetra, 4, {{0, 1, 3, -1}, {1, 2, 3, -1}, {0, 3, 2, -1}, {0, 2, 1, -1}}},
      {CellShape::kHexa,
       6,
       {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {0, 4, 7, 3}, {0, 3, 2, 1}, {4, 5, 6, 7}}},
      {CellShape::kPrism,
       5,
       {{0, 1, 4, 3}, {1, 2, 5, 4}, {0, 3, 5, 2}, {0, 2, 1, -1}, {3, 4, 5, -1}}},
      {CellShape::kPyramid,
       5,
       {{0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {0, 4, 3, -1}, {0, 3, 2, 1}}}};
  for (const Sides& row : kSides) {
    if (row.shape != shape || side < 1 || side > row.count) continue;
    const int8_t* places = row.corners[side - 1];
    std::copy_n(places, 4, corners);
    return places[3] < 0 ? 3 : 4;
  }
  return 0;
}

}  // namespace tetstream
