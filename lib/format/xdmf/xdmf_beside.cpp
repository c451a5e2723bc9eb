#include "xdmf_beside.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "schema.h"
#include "side_faces.h"
#include "status.h"
#include "vtk_cells.h"
#include "xdmf_cells.h"
#include "xdmf_whole.h"

namespace tetstream {

namespace {

constexpr size_t kFacesAtOnce = 256;
constexpr size_t kMostNodes = 9;  // of a face

const VtkCell& cellOf(const XdmfTopology& topology) {
  return vtkCell(vtkTypeOfXdmf(topology.type));
}

bool isOfCells(const XdmfAttribute& attribute) {
  return sameWord(attribute.center, "Cell");
}

std::string shown(const XdmfGrid& grid) {
  return "grid \"" + cutName(grid.name) + "\"";
}

}  // namespace

void XdmfBeside::leaveOut(const XdmfGrid& grid, const std::string& why) {
  mesh_.addNote(shown(grid) + " is left out: " + why);
}

void XdmfBeside::add(const XdmfGrid& grid, const XdmfTopology& topology) {
  const VtkCell& cell = cellOf(topology);
  const int dimension = cell.fate == VtkCell::kKnown ? dimensionOf(cell.kind.shape) : 0;
  if (dimension < 2)
    return leaveOut(grid, "its topology of the type \"" + cutName(topology.type) +
                              "\" is none of cells or of faces of one type");
  if (std::none_of(grid.attributes.begin(), grid.attributes.end(), isOfCells))
    return leaveOut(grid, "it has other cells than the mesh, and no array of them");
  if (dimension == 2)
    addFaces(grid, topology);
  else
    addCells(grid, topology);
}

XdmfCellList XdmfBeside::listOf(const XdmfTopology& topology, MeshPiece& part) {
  addXdmfCells(topology, arrays_, options_.temp_dir, part);
  const CellKind kind = cellOf(topology).kind;
  XdmfCellList list;
  list.nodes = &*part.connectivity;
  list.cells = part.cell_count;
  list.nodes_each = static_cast<uint64_t>(kind.nodes);
  list.corners = static_cast<size_t>(cornersOf(kind.shape));
  list.points = piece_.point_count;
  list.place = arrays_.describe(topology.items.front());
  return list;
}

// ---------------------------------------------------------------------------------------- cells

void XdmfBeside::addCells(const XdmfGrid& grid, const XdmfTopology& topology) {
  const VtkCell& own = cellOf(topology_);
  if (own.fate != VtkCell::kKnown || own.kind.shape != cellOf(topology).kind.shape)
    return leaveOut(grid, "its cells are of another type than those of the mesh");
  MeshPiece part, whole;
  const XdmfCellList named = listOf(topology, part), all = listOf(topology_, whole);
  if (named.cells == 0) return leaveOut(grid, "it has no cells");
  const auto subset = std::make_shared<XdmfSubset>(options_.temp_dir);
  if (const std::optional<uint64_t> missing = subset->find(named, all))
    return leaveOut(grid, "its cell " + std::to_string(*missing) +
                              " is none of the mesh, or its cells are not in the mesh's order");
  const bool is_all = subset->named() == all.cells;
  fields_.add(grid.attributes, named.cells, [&](MeshArray values) {
    return is_all ? std::move(values) : XdmfSubset::spread(subset, std::move(values));
  });
  if (!is_all)
    mesh_.addNote(shown(grid) + " names " + std::to_string(subset->named()) + " of " +
                  std::to_string(all.cells) + " cells: at the others its arrays are 0");
}

// ---------------------------------------------------------------------------------------- faces

void XdmfBeside::addFaces(const XdmfGrid& grid, const XdmfTopology& topology) {
  std::vector<XdmfAttribute> of_cells, others;
  for (const XdmfAttribute& attribute : grid.attributes)
    (isOfCells(attribute) ? of_cells : others).push_back(attribute);
  fields_.add(others);
  MeshPiece part;
  const XdmfCellList faces = listOf(topology, part);
  if (faces.cells == 0) return leaveOut(grid, "it has no faces");
  const std::optional<MeshArray> values = fields_.valuesOf(of_cells[0], faces.cells, true);
  if (!values) return;
  const uint64_t count = faces.cells * static_cast<uint64_t>(values->components);
  std::optional<ValueType> type = wholeType(*values, count);
  // What was not whole as float64 may be as float32.
  if (isFloat(values->type) && of_cells[0].items[0].isUntyped()) type.reset();
  if (!type || values->components != 1)
    return leaveOut(grid, "its array \"" + cutName(of_cells[0].name) +
                              "\" is no label of faces: it has not one integer to each");
  for (size_t i = 1; i < of_cells.size(); ++i)
    mesh_.addNote("array \"" + cutName(of_cells[i].name) + "\" is left out: the faces of " +
                  shown(grid) + " are labelled by another one");
  labelFaces(faces, asWhole(*values, *type));
  mesh_.addNote(shown(grid) + " labels faces");
}

void XdmfBeside::labelFaces(const XdmfCellList& faces, const MeshArray& labels) {
  if (!mesh_.faces) mesh_.faces = std::make_shared<SideFaces>(options_.temp_dir);
  const auto width = static_cast<size_t>(faces.nodes_each);
  const auto nodes = faces.nodes->open(faces.cells * faces.nodes_each),
             label_values = labels.open(faces.cells);
  const CellShape shape = faces.corners == 3 ? CellShape::kTriangle : CellShape::kQuadrilateral;
  int64_t held[kFacesAtOnce * kMostNodes], held_labels[kFacesAtOnce], parts[2][3];
  for (uint64_t at = 0; at < faces.cells; at += kFacesAtOnce) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(kFacesAtOnce, faces.cells - at));
    nodes->read(at * width, n * width, held, ScalarType::kInt64);
    label_values->read(at, n, held_labels, ScalarType::kInt64);
    for (size_t i = 0; i < n; ++i) {
      checkCorners(faces, at + i, held + i * width);
      const size_t made = splitFace(shape, held + i * width, parts);
      for (size_t k = 0; k < made; ++k) mesh_.faces->add(parts[k], held_labels[i]);
    }
  }
}

void XdmfBeside::finish() {
  const uint64_t again = mesh_.faces ? mesh_.faces->finish() : 0;
  if (again > 0)
    mesh_.addNote(std::to_string(again) +
                  " faces are in grids of labels more than once: the first one labels them");
}

}  // namespace tetstream
