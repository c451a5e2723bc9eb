// Reads XDMF 2 and 3 as FEniCS, meshio and VTK write it: grids in XML, values in its text, in HDF5
// or in raw files. Of a collection over time one step is read; grids of a spatial collection are
// pieces whose shared points are one each; grids beside the mesh give it more arrays and labels.
#include <algorithm>
#include <cstdlib>

#include "made_values.h"
#include "mixed_cells.h"
#include "pieced_mesh.h"
#include "status.h"
#include "time_steps.h"
#include "vtk_cells.h"
#include "xdmf_beside.h"
#include "xdmf_cells.h"
#include "xdmf_format.h"
#include "xdmf_references.h"

namespace tetstream {

namespace {

constexpr int kMostIncludes = 8;      // one of another
constexpr size_t kMostOthers = 1024;  // functions, each of which looks for its mesh

class Xdmf {
 public:
  Xdmf(const std::shared_ptr<ByteSource>& bytes, const ReadOptions& options, MeshPieces& mesh)
      : options_(options),
        mesh_(mesh),
        file_(readXdmfTree(*bytes)),
        text_(bytes, file_.entities),
        arrays_(bytes, text_, {options.threads, std::this_thread::get_id()}, options.temp_dir),
        grids_(file_.grids) {
    mesh_.name = bytes->name();
    followXdmfReferences(file_, text_);
    children_.resize(grids_.size());
    for (int i = 0; i < gridCount(); ++i)
      if (at(i).parent >= 0) children_[static_cast<size_t>(at(i).parent)].push_back(i);
  }

  void read() {
    const std::vector<int> leaves = chooseLeaves();
    if (leaves.empty()) failWithoutCells();
    mesh_.join = leaves.size() > 1;
    std::vector<MeshPiece> pieces;
    pieces.reserve(leaves.size());
    for (const int leaf : leaves) pieces.push_back(readPiece(leaf));
    if (pieces.size() == 1)
      addOthers(leaves[0], pieces[0]);
    else
      noteOthers(leaves);
    takeForm(pieces);
    for (MeshPiece& piece : pieces) mesh_.add(std::move(piece));
  }

 private:
  const XdmfGrid& at(int grid) const { return grids_[static_cast<size_t>(grid)]; }
  int gridCount() const { return static_cast<int>(grids_.size()); }
  [[noreturn]] void failFile(Status status, const std::string& text) const {
    fail(status, "%s: %s", mesh_.name.c_str(), text.c_str());
  }
  std::string nameOf(int grid) const { return "grid \"" + cutName(at(grid).name) + "\""; }

  // ------------------------------------------------------------------------------- which grids

  const std::vector<int>& childrenOf(int grid) const {
    return children_[static_cast<size_t>(grid)];
  }

  // The grids without others in them, of a grid or of a collection in space.
  std::vector<int> leavesOf(int grid) const {
    if (at(grid).kind == XdmfGrid::kUniform) return {grid};
    std::vector<int> leaves;
    for (const int child : childrenOf(grid))
      for (const int leaf : leavesOf(child)) leaves.push_back(leaf);
    return leaves;
  }

  bool hasCells(int grid) const {
    const XdmfTopology* topology = topologyOf(grid);
    if (!topology || topology->items.empty()) return false;
    const int type = vtkTypeOfXdmf(topology->type);
    const VtkCell& cell = vtkCell(type);
    return type == 0 || (cell.fate == VtkCell::kKnown && dimensionOf(cell.kind.shape) == 3);
  }

  std::vector<int> chooseLeaves() {
    for (int i = 0; i < gridCount(); ++i)
      if (at(i).kind == XdmfGrid::kTemporal) return leavesOfStep(i);
    for (int i = 0; i < gridCount(); ++i) {
      if (at(i).parent >= 0) continue;
      std::vector<int> leaves = leavesOf(i);
      std::erase_if(leaves, [this](int leaf) { return !hasCells(leaf); });
      if (leaves.empty()) continue;
      for (const int told : {i, leaves[0]}) takeTime(mesh_, at(told).time);
      return leaves;
    }
    return {};
  }

  std::vector<int> leavesOfStep(int collection) {
    const std::vector<int>& steps = childrenOf(collection);
    if (steps.empty()) failFile(Status::kBadData, nameOf(collection) + " has no time steps");
    step_count_ = steps.size();
    step_ = static_cast<size_t>(chooseStep(
        mesh_, step_count_, options_, [&](uint64_t step) { return timeOf(collection, step); }));
    return leavesOf(steps[step_]);
  }

  // A step tells its time, or the collection those of all, or else the first grid in the step.
  std::optional<double> timeOf(int collection, uint64_t step) {
    const std::vector<int>& steps = childrenOf(collection);
    const int grid = steps[static_cast<size_t>(step)];
    if (at(grid).time) return at(grid).time;
    const std::vector<XdmfItem>& lists = at(collection).times;
    const bool are_even = at(collection).has_even_times;
    if (const size_t held = are_even ? 3 : steps.size();
        lists.size() == 1 && lists[0].count() == held) {
      const std::unique_ptr<Values> times = arrays_.arrayOf(lists[0], "times", 1).open(held);
      return are_even ? timeIn(*times, 0) + static_cast<double>(step) * timeIn(*times, 1)
                      : timeIn(*times, step);
    }
    const std::vector<int> leaves = leavesOf(grid);
    return leaves.empty() ? std::nullopt : at(leaves[0]).time;
  }

  // ---------------------------------------------------------------------------------- includes

  // The grid that an xpointer leads to: one of a name, perhaps one in it; without a name, or if
  // there is none of it, the first one that has what is wanted. -1: none.
  template <class Has>
  int includedBy(const std::string& pointer, Has has) const {
    const size_t name_at = pointer.find("@Name=");
    int found = -1;
    if (name_at != std::string::npos && name_at + 6 < pointer.size()) {
      const size_t begin = name_at + 7, end = pointer.find(pointer[name_at + 6], begin);
      const std::string name = pointer.substr(begin, end - begin);
      for (int i = 0; i < gridCount() && found < 0; ++i)
        if (at(i).name == name) found = i;
      const size_t child = end == std::string::npos ? end : pointer.find("/Grid", end);
      if (found >= 0 && child != std::string::npos) found = childOf(found, pointer.substr(child));
    }
    for (int i = 0; i < gridCount() && (found < 0 || !has(at(found))); ++i)
      if (has(at(i))) found = i;
    return found >= 0 && has(at(found)) ? found : -1;
  }

  // "/Grid[2]/..." is the second child.
  int childOf(int grid, const std::string& path) const {
    const std::vector<int>& children = childrenOf(grid);
    const size_t number =
        path.starts_with("/Grid[") ? std::strtoul(path.c_str() + 6, nullptr, 10) : 1;
    return number >= 1 && number <= children.size() ? children[number - 1] : -1;
  }

  template <class Part>
  const Part* partOf(int grid, std::optional<Part> XdmfGrid::*part, const char* word) const {
    for (int i = 0; i < kMostIncludes; ++i) {
      if (at(grid).*part) return &*(at(grid).*part);
      int from = -1;
      for (const std::string& pointer : at(grid).includes)
        if (from < 0 && (pointer.find(word) != std::string::npos ||
                         pointer.find("self::") == std::string::npos))
          from = includedBy(pointer, [&](const XdmfGrid& g) {
            return (g.*part).has_value() || (!g.includes.empty() && &g != &at(grid));
          });
      if (from < 0) return nullptr;
      grid = from;
    }
    return nullptr;
  }
  const XdmfTopology* topologyOf(int grid) const {
    return partOf(grid, &XdmfGrid::topology, "Topology");
  }
  const XdmfGeometry* geometryOf(int grid) const {
    return partOf(grid, &XdmfGrid::geometry, "Geometry");
  }

  // ------------------------------------------------------------------------------------- pieces

  [[noreturn]] void failWithoutCells() const {
    for (int i = 0; i < gridCount(); ++i)
      if (!at(i).other_file.empty()) failWithoutParts(i);
    const bool has_others = std::any_of(grids_.begin(), grids_.end(), [](const XdmfGrid& grid) {
      return grid.topology.has_value();
    });
    failFile(Status::kBadData, has_others
                                   ? "there are grids, but none with cells of three dimensions"
                                   : "there is no grid with cells");
  }
  [[noreturn]] void failWithoutParts(int grid) const {
    const std::string& file = at(grid).other_file;
    if (file.empty()) failFile(Status::kBadData, nameOf(grid) + " has no topology or no geometry");
    failFile(Status::kUnsupported, nameOf(grid) + " includes \"" + cutName(file) +
                                       "\": topology, geometry and attributes in other XML files "
                                       "are not read");
  }

  MeshPiece readPiece(int grid) {
    const XdmfTopology* topology = topologyOf(grid);
    const XdmfGeometry* geometry = geometryOf(grid);
    if (!topology || topology->items.empty() || !geometry || geometry->items.empty())
      failWithoutParts(grid);
    if (vtkTypeOfXdmf(topology->type) < 0)
      failFile(Status::kUnsupported, nameOf(grid) + " has a topology of the type \"" +
                                         cutName(topology->type) + "\", which is not read");
    MeshPiece piece;
    addPoints(*geometry, piece);
    addXdmfCells(*topology, arrays_, options_.temp_dir, piece);
    XdmfFields(arrays_, mesh_, piece, options_.temp_dir).add(at(grid).attributes);
    noteLeftOut(grid);
    return piece;
  }

  void noteLeftOut(int grid) {
    if (at(grid).has_sets) mesh_.addNote("sets of nodes, faces or cells are left out");
    if (!at(grid).other_file.empty())
      mesh_.addNote("what a grid includes from other XML files is left out");
    for (const std::string& pointer : at(grid).includes)
      if (pointer.find("Attribute") != std::string::npos || pointer.ends_with("/*)"))
        mesh_.addNote("attributes that a grid includes from another one are left out");
  }

  void addPoints(const XdmfGeometry& geometry, MeshPiece& piece) {
    const bool apart = sameWord(geometry.type, "X_Y_Z") && geometry.items.size() == 3;
    const uint64_t count = geometry.items[0].count();
    if (sameWord(geometry.type, "XY") || sameWord(geometry.type, "X_Y"))
      failFile(Status::kUnsupported, "a geometry of the type \"" + geometry.type +
                                         "\" has no third coordinate, and so no tetrahedra");
    if (!apart && (!sameWord(geometry.type, "XYZ") || count % 3 != 0))
      failFile(Status::kUnsupported, "a geometry of the type \"" + cutName(geometry.type) +
                                         "\" is not read, or it has not three coordinates a point");
    if (!apart) {
      piece.point_count = count / 3;
      piece.points = arrays_.arrayOf(geometry.items[0], "geometry", 3);
      return;
    }
    piece.point_count = count;
    std::vector<MeshArray> columns;
    for (const XdmfItem& item : geometry.items)
      columns.push_back(arrays_.arrayOf(item, "geometry", 1));
    piece.points = MeshArray{"geometry", columns[0].type, 3, [columns, count](uint64_t) {
                               std::vector<std::unique_ptr<Values>> opened;
                               opened.reserve(columns.size());
                               for (const MeshArray& column : columns)
                                 opened.push_back(column.open(count));
                               return openColumns(std::move(opened));
                             }};
  }

  // --------------------------------------------------------------------------------- the others

  // What else is on the same mesh: other functions, each in a collection or a grid of its own, and
  // labels of some of its cells and faces.
  void addOthers(int leaf, MeshPiece& piece) {
    const std::string mesh = placeOf(leaf), points = placeOfPoints(leaf);
    XdmfFields fields(arrays_, mesh_, piece, options_.temp_dir);
    XdmfBeside beside(arrays_, options_, mesh_, piece, *topologyOf(leaf));
    for (const int grid : gridsBeside(leaf)) {
      const XdmfTopology* topology = topologyOf(grid);
      if (placeOf(grid) == mesh)
        fields.add(at(grid).attributes);
      else if (topology && !topology->items.empty() && placeOfPoints(grid) == points)
        beside.add(at(grid), *topology);
      else if (hasSameMesh(grid, leaf))
        fields.add(at(grid).attributes);
      else
        mesh_.addNote(nameOf(grid) + " is left out: it has another mesh");
    }
    beside.finish();
  }

  // Whether its points and cells are equal though they are in another place, as those of each
  // function in a checkpoint of FEniCS are.
  bool hasSameMesh(int grid, int leaf) {
    const XdmfTopology *topology = topologyOf(grid), *own_topology = topologyOf(leaf);
    const XdmfGeometry *geometry = geometryOf(grid), *own_geometry = geometryOf(leaf);
    return !at(grid).attributes.empty() && topology && geometry &&
           sameWord(topology->type, own_topology->type.c_str()) &&
           sameWord(geometry->type, own_geometry->type.c_str()) &&
           arrays_.areEqual(topology->items, own_topology->items) &&
           arrays_.areEqual(geometry->items, own_geometry->items);
  }

  void noteOthers(const std::vector<int>& leaves) {
    for (const int grid : gridsBeside(leaves[0]))
      if (std::find(leaves.begin(), leaves.end(), grid) == leaves.end())
        mesh_.addNote(nameOf(grid) + " is left out: the mesh is made of several grids");
  }

  // Of a collection over time the grids of the same step.
  std::vector<int> gridsBeside(int leaf) {
    std::vector<int> all;
    for (int i = 0; i < gridCount(); ++i) {
      std::vector<int> grids;
      if (at(i).kind == XdmfGrid::kTemporal) {
        const std::vector<int>& steps = childrenOf(i);
        if (steps.size() == step_count_) grids = leavesOf(steps[step_]);
        if (steps.size() != step_count_)
          mesh_.addNote(nameOf(i) + " is left out: it has other time steps");
      } else if (at(i).parent < 0) {
        grids = leavesOf(i);
      }
      for (const int grid : grids) {
        if (grid != leaf) all.push_back(grid);
        if (all.size() > kMostOthers)
          failFile(Status::kUnsupported, "there are too many grids beside " + nameOf(leaf));
      }
    }
    return all;
  }

  std::string placeOf(int grid) {
    const XdmfTopology* topology = topologyOf(grid);
    if (!topology || topology->items.empty()) return "";
    return arrays_.placeOf(topology->items[0]) + " " + placeOfPoints(grid);
  }
  std::string placeOfPoints(int grid) {
    const XdmfGeometry* geometry = geometryOf(grid);
    return geometry && !geometry->items.empty() ? arrays_.placeOf(geometry->items[0]) : "";
  }

  // Where all are tetrahedra, they need no types and stay where they are, unless some are ghosts.
  void takeForm(std::vector<MeshPiece>& pieces) {
    const auto isTetrahedra = [](const MeshPiece& piece) {
      return piece.cell_count == 0 || (!ghostMarks(piece) && areTetrahedra(piece));
    };
    mesh_.form = CellForm::kOffsets;
    if (!std::all_of(pieces.begin(), pieces.end(), isTetrahedra)) return;
    mesh_.form = CellForm::kTetrahedra;
    for (MeshPiece& piece : pieces) piece.connectivity->components = 4;
  }

  const ReadOptions& options_;
  MeshPieces& mesh_;
  XdmfFile file_;
  XdmfText text_;
  XdmfArrays arrays_;
  const std::vector<XdmfGrid>& grids_;
  std::vector<std::vector<int>> children_;  // of each
  size_t step_count_ = 0, step_ = 0;
};

}  // namespace

Input openXdmf(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  const std::shared_ptr<ByteSource> shared = makeSeekable(std::move(bytes), options.temp_dir);
  MeshPieces mesh;
  Xdmf(shared, options, mesh).read();
  return openPiecedMesh(std::move(mesh), options);
}

}  // namespace tetstream
