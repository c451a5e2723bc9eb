// Reads Exodus II files: nodes, element blocks, variables of one time step and side sets, which
// label faces. All of it is read where it lies. The format: L. A. Schoof, V. R. Yarberry, EXODUS
// II: A Finite Element Data Model, SAND92-2137, and the netCDF names in its appendix.
#include <algorithm>

#include "exodus_blocks.h"
#include "exodus_format.h"
#include "made_values.h"
#include "pieced_mesh.h"
#include "rows_at_once.h"
#include "side_faces.h"
#include "status.h"
#include "time_steps.h"
#include "vtk_cells.h"

namespace tetstream {

namespace {

constexpr size_t kMaxVariables = 1 << 12;

std::string numbered(const char* name, size_t number) {
  return name + std::to_string(number);
}

class Exodus {
 public:
  Exodus(std::unique_ptr<ByteSource> bytes, const ReadOptions& options, MeshPieces& mesh)
      : options_(options), mesh_(mesh) {
    mesh_.name = bytes->name();
    file_ = openNetcdf(std::move(bytes));
  }

  void read() {
    const std::vector<int64_t> side_sets = file_->integers("ss_prop1", kMaxMeshPieces);
    takePoints();
    blocks_ = readExodusBlocks(*file_, options_.split, side_sets.empty());
    if (blocks_.empty()) failFile(Status::kBadData, "there are no element blocks");
    takeCells();
    takeVariables();
    if (!side_sets.empty()) takeSideSets(side_sets);
    tellOfTheRest();
    mesh_.add(std::move(piece_));
  }

 private:
  [[noreturn]] void failFile(Status status, const std::string& text) const {
    fail(status, "%s: %s", mesh_.name.c_str(), text.c_str());
  }

  // ------------------------------------------------------------------------------------- points

  void takePoints() {
    const bool apart = file_->find("coordx") != nullptr;
    const NetcdfVariable& x = file_->need(apart ? "coordx" : "coord");
    const bool solid = apart ? file_->find("coordz") != nullptr : x.size(0) == 3;
    if (!solid) failFile(Status::kUnsupported, "the mesh has not three dimensions");
    const uint64_t count = apart ? x.size(0) : x.size(1);
    if (count > kMaxMeshCount) failFile(Status::kBadData, "there are more nodes than any file has");
    piece_.point_count = count;
    MeshArray points{"points", x.type, 3, {}};
    if (!apart && x.count() < 3 * count) failFile(Status::kBadData, "coordinates are missing");
    if (apart)
      for (const char* name : {"coordx", "coordy", "coordz"})
        if (file_->need(name).count() != count || file_->need(name).type != x.type)
          failFile(Status::kBadData, "the coordinates are not as many in each direction");
    points.open = [file = file_, count, apart](uint64_t) {
      std::vector<std::unique_ptr<Values>> columns;
      for (const char* name : {"coordx", "coordy", "coordz"})
        columns.push_back(apart ? file->open(name, 0, count)
                                : file->open("coord", columns.size() * count, count));
      return openColumns(std::move(columns));
    };
    if (!isFloat(x.type)) failFile(Status::kBadData, "the coordinates are no floats");
    piece_.points = std::move(points);
  }

  [[noreturn]] void failShort(const std::string& variable, uint64_t needed) const {
    failFile(Status::kBadData, "\"" + cutName(variable) + "\" has not the " +
                                   std::to_string(needed) + " values that are needed");
  }

  // `count` values of a variable from `first` on; throws now if they are not there.
  std::function<std::unique_ptr<Values>(uint64_t)> opener(const std::string& variable,
                                                          uint64_t first, uint64_t count) {
    if (file_->need(variable).count() < first + count) failShort(variable, count);
    return [file = file_, variable, first, count](uint64_t) {
      return file->open(variable, first, count);
    };
  }

  // -------------------------------------------------------------------------------------- cells

  // One value for all elements of a block, in turn.
  template <class Open>
  std::function<std::unique_ptr<Values>(uint64_t)> perBlock(Open open_block) const {
    std::vector<ValuesPart> parts;
    for (const ExodusBlock& block : blocks_) {
      ValuesPart part = open_block(block);
      if (part.count > 0) parts.push_back(std::move(part));
    }
    return [parts](uint64_t) { return openParts(parts); };
  }

  void takeCells() {
    piece_.cell_count = blocks_.back().first + blocks_.back().elements;
    if (piece_.cell_count > kMaxMeshCount)
      failFile(Status::kBadData, "there are more elements than any file has");
    piece_.connectivity = MeshArray{"connectivity", ValueType::kInt64, 1, nodesOfCells()};
    const bool linear = std::all_of(blocks_.begin(), blocks_.end(), [](const ExodusBlock& b) {
      return b.elements == 0 || b.vtk_type == kVtkTetra;
    });
    mesh_.form = linear ? CellForm::kTetrahedra : CellForm::kOffsets;
    if (linear)
      piece_.connectivity->components = 4;
    else
      takeTypes();
    MeshArray ids{
        kBlockId, ValueType::kInt32, 1, perBlock([](const ExodusBlock& block) {
          return ValuesPart{block.elements, [id = block.id] { return openSequence(id, 0); }};
        })};
    for (const ExodusBlock& block : blocks_)
      if (block.id != static_cast<int32_t>(block.id)) ids.type = ValueType::kInt64;
    piece_.cell_data.push_back(std::move(ids));
    for (const ExodusBlock& block : blocks_)
      mesh_.label_names.push_back({kBlockId, block.id, block.name});
  }

  std::function<std::unique_ptr<Values>(uint64_t)> nodesOfCells() const {
    return perBlock([this](const ExodusBlock& block) {
      const uint64_t count = block.elements * block.nodes;
      return ValuesPart{count, [file = file_, name = block.connectivity, count] {
                          return openShifted(file->open(name, 0, count), -1);
                        }};
    });
  }

  void takeTypes() {
    piece_.types = MeshArray{"types", ValueType::kInt32, 1, perBlock([](const ExodusBlock& block) {
                               return ValuesPart{block.elements, [type = block.vtk_type] {
                                                   return openSequence(type, 0);
                                                 }};
                             })};
    uint64_t nodes = 0;
    piece_.offsets = MeshArray{
        "offsets", ValueType::kInt64, 1, perBlock([&](const ExodusBlock& block) {
          const auto each = static_cast<int64_t>(block.nodes);
          const auto first = static_cast<int64_t>(nodes) + each;
          nodes += block.elements * block.nodes;
          return ValuesPart{block.elements, [first, each] { return openSequence(first, each); }};
        })};
  }

  // ---------------------------------------------------------------------------------- variables

  void takeVariables() {
    const std::vector<std::string> of_nodes = file_->texts("name_nod_var", kMaxVariables);
    const std::vector<std::string> of_elements = file_->texts("name_elem_var", kMaxVariables);
    const NetcdfVariable* times = file_->find("time_whole");
    const uint64_t steps = times ? times->count() : 0;
    if (steps == 0) {
      if (!of_nodes.empty() || !of_elements.empty())
        mesh_.addNote("the variables are left out: there is no time step");
      return;
    }
    step_ = chooseStep(mesh_, steps, options_,
                       [&](uint64_t step) { return timeIn(*file_->open("time_whole", step, 1)); });
    for (size_t i = 0; i < of_nodes.size(); ++i)
      if (isNew(piece_.point_data, shown(of_nodes[i], i))) addNodal(i, of_nodes);
    for (size_t i = 0; i < of_elements.size(); ++i)
      if (isNew(piece_.cell_data, shown(of_elements[i], i))) addElemental(i, of_elements[i]);
  }

  bool isNew(const std::vector<MeshArray>& arrays, const std::string& name) {
    const bool is_there = std::any_of(arrays.begin(), arrays.end(),
                                      [&](const MeshArray& array) { return array.name == name; });
    if (is_there)
      mesh_.addNote(
          textOf("variable \"%s\" is left out: there is another array of its name", name.c_str()));
    return !is_there;
  }

  // Of a variable of its own: what a step of it has for each of the rows. The format has scalars
  // only; some writers give vectors one dimension more.
  int componentsOf(const std::string& variable, uint64_t rows) {
    const NetcdfVariable& v = file_->need(variable);
    const uint64_t steps = v.size(0), values = steps > 0 ? v.count() / steps : 0;
    if (v.text || rows == 0 || values < rows || values % rows != 0) failShort(variable, rows);
    return static_cast<int>(std::min<uint64_t>(values / rows, kMaxComponents + 1));
  }

  // Where variables may have fewer steps than there are times.
  bool hasStep(const std::string& variable, const std::string& name) {
    const bool has = file_->need(variable).size(0) > step_;
    if (!has)
      mesh_.addNote(
          textOf("variable \"%s\" is left out: it has no values of this time step", name.c_str()));
    return has;
  }

  bool isTooWide(const std::string& name, int components) {
    if (components > kMaxComponents)
      mesh_.addNote(textOf("variable \"%s\" is left out: it has more than %d components",
                           name.c_str(), kMaxComponents));
    return components > kMaxComponents;
  }

  // One variable each, or, in old files, all of them in one.
  void addNodal(size_t i, const std::vector<std::string>& names) {
    const uint64_t nodes = piece_.point_count;
    const std::string own = numbered("vals_nod_var", i + 1);
    const bool apart = file_->find(own) != nullptr;
    const std::string variable = apart ? own : "vals_nod_var";
    const uint64_t row = apart ? step_ : step_ * names.size() + i;
    if (!hasStep(variable, shown(names[i], i))) return;
    const int components = apart && nodes > 0 ? componentsOf(variable, nodes) : 1;
    if (isTooWide(shown(names[i], i), components)) return;
    const uint64_t values = nodes * static_cast<uint64_t>(components);
    piece_.point_data.push_back({shown(names[i], i), file_->need(variable).type, components,
                                 opener(variable, row * values, values)});
  }

  // Of each block a variable, where it has one.
  void addElemental(size_t i, const std::string& name) {
    ValueType type = ValueType::kFloat32;
    int components = 0;  // of the first block that has it
    uint64_t without = 0;
    for (size_t b = 0; b < blocks_.size(); ++b) {
      const uint64_t elements = blocks_[b].elements;
      if (elements == 0) continue;
      const NetcdfVariable* found = file_->find(elemental(i, b));
      without += found ? 0 : elements;
      if (!found) continue;
      if (!hasStep(elemental(i, b), shown(name, i))) return;
      if (found->type != ValueType::kFloat32) type = ValueType::kFloat64;
      const int here = componentsOf(elemental(i, b), elements);
      if (components == 0) components = here;
      if (here != components)
        return mesh_.addNote(textOf("variable \"%s\" is left out: its blocks differ in components",
                                    shown(name, i).c_str()));
    }
    if (isTooWide(shown(name, i), components)) return;
    if (without > 0)
      mesh_.addNote(textOf("\"%s\" has no value at %llu elements, where it is taken as 0",
                           shown(name, i).c_str(), static_cast<unsigned long long>(without)));
    components = std::max(components, 1);
    piece_.cell_data.push_back({shown(name, i), type, components, openElemental(i, components)});
  }

  std::function<std::unique_ptr<Values>(uint64_t)> openElemental(size_t i, int components) {
    std::vector<ValuesPart> parts;
    for (size_t b = 0; b < blocks_.size(); ++b) {
      const uint64_t values = blocks_[b].elements * static_cast<uint64_t>(components);
      if (values == 0) continue;
      if (!file_->find(elemental(i, b))) {
        parts.push_back({values, [] { return openSequence(0, 0); }});
        continue;
      }
      const auto open = opener(elemental(i, b), step_ * values, values);
      parts.push_back({values, [open, values] { return open(values); }});
    }
    return [parts](uint64_t) { return openParts(parts); };
  }

  static std::string elemental(size_t variable, size_t block) {
    return numbered("vals_elem_var", variable + 1) + numbered("eb", block + 1);
  }

  static std::string shown(const std::string& name, size_t i) {
    return name.empty() ? numbered("variable", i + 1) : cutName(name);
  }

  // ---------------------------------------------------------------------------------- side sets

  void takeSideSets(const std::vector<int64_t>& ids) {
    const std::vector<std::string> names = file_->texts("ss_names", kMaxMeshPieces);
    mesh_.faces = std::make_shared<SideFaces>(options_.temp_dir);
    nodes_ = nodesOfCells()(0);
    uint64_t strange = 0;
    for (size_t i = 0; i < ids.size(); ++i) {
      strange += takeSideSet(i, ids[i]);
      if (i < names.size()) mesh_.label_names.push_back({"", ids[i], names[i]});
      mesh_.addNote(textOf("side set %lld labels faces", static_cast<long long>(ids[i])));
    }
    nodes_.reset();
    const uint64_t again = mesh_.faces->finish();
    if (strange > 0)
      mesh_.addNote(textOf("%llu sides of elements that are no cells are left out",
                           static_cast<unsigned long long>(strange)));
    if (again > 0)
      mesh_.addNote(textOf("%llu faces are in side sets more than once: the first one labels them",
                           static_cast<unsigned long long>(again)));
  }

  // Returns how many sides are of elements that are no cells.
  uint64_t takeSideSet(size_t set, int64_t id) {
    const std::string elements = numbered("elem_ss", set + 1), sides = numbered("side_ss", set + 1);
    const NetcdfVariable* list = file_->find(elements);
    if (!list) return 0;  // an empty one
    const uint64_t count = list->count();
    if (isFloat(list->type) || list->text || isFloat(file_->need(sides).type) ||
        file_->need(sides).count() != count)
      failFile(Status::kBadData, "\"" + elements + "\" and \"" + sides + "\" do not match");
    if (count == 0) return 0;
    const auto open_elements = file_->open(elements, 0, count),
               open_sides = file_->open(sides, 0, count);
    int64_t element[kRowsAtOnce], side[kRowsAtOnce];
    uint64_t strange = 0;
    for (uint64_t at = 0; at < count; at += kRowsAtOnce) {
      const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, count - at));
      open_elements->read(at, n, element, ScalarType::kInt64);
      open_sides->read(at, n, side, ScalarType::kInt64);
      for (size_t i = 0; i < n; ++i) strange += !takeSide(element[i], side[i], set, id);
    }
    return strange;
  }

  bool takeSide(int64_t element, int64_t side, size_t set, int64_t id) {
    if (element < 1 || static_cast<uint64_t>(element) > piece_.cell_count)
      failFile(Status::kBadData, numbered("side set ", set + 1) + " names element " +
                                     std::to_string(element) + ", there are " +
                                     std::to_string(piece_.cell_count));
    const auto index = static_cast<uint64_t>(element - 1);
    const ExodusBlock& block = blockOf(index);
    const CellKind kind = block.kind();
    if (dimensionOf(kind.shape) < 3) return false;
    int places[4];
    const size_t corners = exodusSide(kind.shape, side, places);
    if (corners == 0)
      failFile(Status::kBadData, numbered("side set ", set + 1) + " names side " +
                                     std::to_string(side) + " of a " + nameOf(kind.shape));
    int64_t cell[kMostCorners], face[4], triangles[2][3];
    nodes_->read(first_node_ + (index - block.first) * block.nodes,
                 static_cast<size_t>(cornersOf(kind.shape)), cell, ScalarType::kInt64);
    for (size_t i = 0; i < corners; ++i) face[i] = cell[places[i]];
    const size_t parts =
        splitFace(corners == 3 ? CellShape::kTriangle : CellShape::kQuadrilateral, face, triangles);
    for (size_t i = 0; i < parts; ++i) {
      checkFace(triangles[i], element);
      mesh_.faces->add(triangles[i], id);
    }
    return true;
  }

  void checkFace(const int64_t* corners, int64_t element) const {
    for (size_t k = 0; k < 3; ++k)
      if (static_cast<uint64_t>(corners[k]) >= piece_.point_count)
        failFile(Status::kBadData, "element " + std::to_string(element) + " uses node " +
                                       std::to_string(corners[k] + 1) + ", there are " +
                                       std::to_string(piece_.point_count));
  }

  // Sides mostly go from block to block; first_node_ is where its nodes begin among all.
  const ExodusBlock& blockOf(uint64_t element) {
    if (element < blocks_[block_].first) block_ = 0, first_node_ = 0;
    while (element - blocks_[block_].first >= blocks_[block_].elements) {
      first_node_ += blocks_[block_].elements * blocks_[block_].nodes;
      ++block_;
    }
    return blocks_[block_];
  }

  // ------------------------------------------------------------------------------------ the rest

  void tellOfTheRest() {
    const struct {
      const char *variable, *things;
    } left_out[] = {{"ns_prop1", "node sets"},
                    {"name_glo_var", "variables of the whole model"},
                    {"name_nset_var", "variables of node sets"},
                    {"name_sset_var", "variables of side sets"},
                    {"node_num_map", "the file's own numbers of nodes"}};
    for (const auto& row : left_out) {
      const NetcdfVariable* found = file_->find(row.variable);
      if (!found) continue;
      const std::string count = found->text || std::string(row.variable) != "ns_prop1"
                                    ? ""
                                    : std::to_string(found->count()) + " ";
      mesh_.addNote(count + row.things + " are left out");
    }
  }

  const ReadOptions& options_;
  MeshPieces& mesh_;
  std::shared_ptr<NetcdfFile> file_;
  MeshPiece piece_;
  std::vector<ExodusBlock> blocks_;
  uint64_t step_ = 0;
  std::unique_ptr<Values> nodes_;  // of all elements, while sides are read
  size_t block_ = 0;
  uint64_t first_node_ = 0;
};

}  // namespace

Input openExodus(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  MeshPieces mesh;
  Exodus(makeSeekable(std::move(bytes), options.temp_dir), options, mesh).read();
  return openPiecedMesh(std::move(mesh), options);
}

}  // namespace tetstream
