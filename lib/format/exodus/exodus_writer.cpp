// Writes Exodus II: labels of cells are element blocks, those of faces side sets, with their names;
// fields and other cell arrays are variables of one time step. After the same sources as the
// reader.
#include <algorithm>
#include <cstring>
#include <set>

#include "exodus_blocks.h"
#include "exodus_format.h"
#include "exodus_sides.h"
#include "label_column.h"
#include "label_names.h"
#include "mesh_collector.h"
#include "netcdf_writer.h"
#include "ordered_rows.h"
#include "rows_at_once.h"
#include "status.h"

namespace tetstream {

namespace {

constexpr size_t kLeastNameBytes = 33;  // of names in the file, as of old

// A component of a column, with the name that it has by itself.
struct ExodusVariable {
  size_t column;
  int component;
  std::string name;
};

// As readers have names: without blanks at their end.
std::string withoutEndBlanks(std::string name) {
  name.resize(name.find_last_not_of(' ') + 1);
  return name.empty() ? "values" : name;
}

// The base, cut where that is needed, and the end.
std::string endingWith(const std::string& base, const std::string& end) {
  return cutName(base, kMostNameBytes - end.size()) + end;
}

std::string nameOfComponent(const Column& column, int component) {
  static constexpr const char* kAxes[] = {"_x", "_y", "_z"};
  std::string base = withoutEndBlanks(column.name);
  if (column.components == 1) return base;
  return endingWith(base, column.components == 3 ? kAxes[component] : textOf("_%d", component + 1));
}

// All but one column, each component under a name of its own; `taken` are other names.
std::vector<ExodusVariable> variablesOf(const std::vector<Column>& columns, size_t without,
                                        std::set<std::string> taken) {
  std::vector<ExodusVariable> variables;
  for (size_t i = 0; i < columns.size(); ++i)
    for (int k = 0; i != without && k < columns[i].components; ++k) {
      const std::string wanted = nameOfComponent(columns[i], k);
      std::string name = wanted;
      for (int n = 2; !taken.insert(name).second; ++n) name = endingWith(wanted, textOf("_%d", n));
      variables.push_back({i, k, name});
    }
  return variables;
}

class ExodusWriter final : public MeshCollector {
 public:
  using MeshCollector::MeshCollector;

 protected:
  void write(MeshSpool& mesh) override {
    mesh_ = &mesh;
    checkSizes();
    groupCells();
    ExodusSides sides(mesh, *elements_, options().temp_dir);
    sides_ = &sides;
    const size_t no_column = SIZE_MAX;
    fields_ = variablesOf(mesh.schema().fields, no_column, {});
    arrays_ = variablesOf(mesh.schema().cell_data, block_column_.value_or(no_column), {kBlockId});
    real_ = realType();
    noteLosses();
    NetcdfWriter file(bytes());
    file_ = &file;
    addHead();
    addNodes();
    addBlocks();
    addSideSets();
    addNodal();
    addElemental();
    file.write();
    for (const std::string& name : rounded_) noteRounded(name);
  }

 private:
  const Schema& schema() const { return mesh_->schema(); }
  uint64_t points() const { return mesh_->pointCount(); }
  uint64_t cells() const { return mesh_->cellCount(); }

  void checkSizes() {
    if (points() == 0)
      fail(Status::kUnsupported, "%s: Exodus has no mesh without points", bytes().name().c_str());
    if (points() > INT32_MAX || cells() > INT32_MAX)
      fail(Status::kUnsupported, "%s: %llu points and %llu cells: Exodus holds 2147483647 of each",
           bytes().name().c_str(), static_cast<unsigned long long>(points()),
           static_cast<unsigned long long>(cells()));
  }

  // ------------------------------------------------------------------------ the order of elements

  // Blocks by label, in each the cells in their order.
  void groupCells() {
    block_column_ = labelColumn(*mesh_, kBlockId, [this](size_t column) {
      const bool can = canBeGroups(*mesh_, column, 0, INT32_MAX);
      if (!can && !no_blocks_) no_blocks_ = column;
      return can;
    });
    if (block_column_)
      forLabels([this](int64_t label) { ++blocks_[label]; });
    else if (cells() > 0)
      blocks_[1] = cells();
    cells_ = std::make_unique<GroupedRows<uint64_t>>(blocks_, options().temp_dir);
    elements_ = std::make_unique<RowSpool>(sizeof(int64_t), options().temp_dir);
    uint64_t cell = 0;
    forLabels([&](int64_t label) {
      const uint64_t place = cells_->add(label, cell);
      is_reordered_ = is_reordered_ || place != cell;
      ++cell;
      const auto element = static_cast<int64_t>(place);
      elements_->append(&element, 1);
    });
    cells_->finish();
    elements_->finish();
  }

  // visit(label) for all cells in their order.
  template <class Visit>
  void forLabels(Visit visit) {
    for (uint64_t at = 0; at < cells(); at += kRowsAtOnce) {
      const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, cells() - at));
      int64_t labels[kRowsAtOnce];
      options().tellOfWriting();
      std::fill_n(labels, n, int64_t{1});
      if (block_column_) readLabels(*mesh_, *block_column_, at, n, labels);
      for (size_t i = 0; i < n; ++i) visit(labels[i]);
    }
  }

  uint64_t cellAt(uint64_t element) {
    return *static_cast<const uint64_t*>(cells_->rows().row(element));
  }

  // Rows of cells, in the order of the elements: read(first, count, out) reads them in the cells'.
  template <class Read>
  std::unique_ptr<OrderedRows> inElements(size_t row_bytes, Read read) {
    auto rows = std::make_unique<OrderedRows>(cells(), row_bytes, options().temp_dir);
    const auto read_and_told = [&](uint64_t first, size_t n, void* out) {
      options().tellOfWriting();
      read(first, n, out);
    };
    forEachRow(cells(), row_bytes, read_and_told, [&](uint64_t cell, const unsigned char* row) {
      rows->put(static_cast<uint64_t>(*static_cast<const int64_t*>(elements_->row(cell))), row);
    });
    rows->finish();
    return rows;
  }

  // visit(row of the element) for `count` elements from `first` on, of what inElements makes.
  template <class Read, class Visit>
  void forElements(std::unique_ptr<OrderedRows>& rows, size_t row_bytes, Read read, uint64_t first,
                   uint64_t count, Visit visit) {
    if (!is_reordered_) {
      const auto from = [&](uint64_t at, size_t n, void* out) { read(first + at, n, out); };
      return forEachRow(count, row_bytes, from,
                        [&](uint64_t, const unsigned char* row) { visit(row); });
    }
    if (!rows) rows = inElements(row_bytes, read);
    for (uint64_t element = first; element < first + count; ++element) visit(rows->row(element));
  }

  // ------------------------------------------------------------------------------------- the head

  // Float32 if all values are.
  NetcdfType realType() const {
    bool narrow = schema().position_type == ScalarType::kFloat32;
    for (const ExodusVariable& v : fields_)
      narrow = narrow && schema().fields[v.column].type == ScalarType::kFloat32;
    for (const ExodusVariable& v : arrays_)
      narrow = narrow && schema().cell_data[v.column].type == ScalarType::kFloat32;
    return narrow ? NetcdfType::kFloat : NetcdfType::kDouble;
  }

  void noteLosses() {
    if (sides_->leftOut() > 0)
      note(std::to_string(sides_->leftOut()) +
           " labelled faces are left out: side sets have ids from 1 to 2147483647, and sides of "
           "cells");
    if (no_blocks_ && !block_column_)
      note("the labels of \"" + schema().cell_data[*no_blocks_].name +
           "\" are no ids of blocks, which are 0 to 2147483647, or more than 65536: all cells are "
           "block 1");
    if (is_reordered_ && options().is_mapped)
      note(
          "cells stand in blocks: "
          "cell N of the map is the element that elem_num_map numbers N + 1");
    noteNames(schema().fields, fields_);
    noteNames(schema().cell_data, arrays_);
    std::vector<LabelName> left_out;
    for (const LabelName& name : schema().label_names)
      if (!isKept(name)) left_out.push_back(name);
    if (!left_out.empty())
      note("names of labels that are no blocks and no side sets are left out: " +
           shownLabelNames(left_out));
  }

  void noteNames(const std::vector<Column>& columns, const std::vector<ExodusVariable>& variables) {
    for (const ExodusVariable& v : variables) {
      const Column& column = columns[v.column];
      if (v.component == 0 && column.components > 1)
        note("each component of \"" + column.name + "\" is a variable of its own, \"" + v.name +
             "\" and so on");
      else if (column.components == 1 && v.name != column.name)
        note("\"" + column.name + "\" is written as \"" + v.name + "\"");
    }
  }

  bool isKept(const LabelName& name) const {
    if (name.array.empty()) return sides_->counts().count(name.label) > 0;
    return block_column_ && schema().cell_data[*block_column_].name == name.array &&
           blocks_.count(name.label) > 0;
  }

  std::string nameOf(const std::string& array, int64_t label) const {
    const LabelName* found = findLabelName(schema().label_names, array, label);
    return found ? found->name : "";
  }

  size_t longestName() const {
    size_t longest = kLeastNameBytes - 1;
    for (const LabelName& name : schema().label_names)
      longest = std::max(longest, name.name.size());
    for (const auto* variables : {&fields_, &arrays_})
      for (const ExodusVariable& v : *variables) longest = std::max(longest, v.name.size());
    return longest;
  }

  void addHead() {
    name_bytes_ = longestName() + 1;
    file_->addAttribute("api_version", NetcdfType::kFloat, 6.02);
    file_->addAttribute("version", NetcdfType::kFloat, 6.02);
    file_->addAttribute("floating_point_word_size", NetcdfType::kInt,
                        real_ == NetcdfType::kFloat ? 4 : 8);
    file_->addAttribute("file_size", NetcdfType::kInt, 1);
    file_->addAttribute("maximum_name_length", NetcdfType::kInt,
                        static_cast<double>(name_bytes_ - 1));
    file_->addAttribute("int64_status", NetcdfType::kInt, 0);
    file_->addAttribute("title", "tetstream");
    time_ = file_->addDimension("time_step", 0);
    names_ = file_->addDimension("len_name", name_bytes_);
    file_->addDimension("len_string", kLeastNameBytes);
    file_->addDimension("num_dim", 3);
    file_->addVariable("time_whole", NetcdfType::kDouble, {time_}, {},
                       [time = schema().time.value_or(0)](NetcdfValues& values) {
                         values.put(&time, ScalarType::kFloat64, 1);
                       });
  }

  // ------------------------------------------------------------------------------- nodes, elements

  void addNodes() {
    nodes_ = file_->addDimension("num_nodes", points());
    static constexpr const char* kCoordinates[] = {"coordx", "coordy", "coordz"};
    for (size_t k = 0; k < 3; ++k)
      file_->addVariable(kCoordinates[k], real_, {nodes_}, {},
                         [this, k](NetcdfValues& values) { putPositions(values, k); });
  }

  void putPositions(NetcdfValues& values, size_t k) {
    const ScalarType type = schema().position_type;
    forEachRow(
        points(), 3 * sizeOf(type),
        [&](uint64_t first, size_t n, void* out) { mesh_->readPositions(first, n, out); },
        [&](uint64_t, const unsigned char* row) { values.put(row + k * sizeOf(type), type, 1); });
  }

  void addBlocks() {
    if (blocks_.empty()) return;
    const size_t numbered = file_->addDimension("num_elem", cells());
    const size_t count = file_->addDimension("num_el_blk", blocks_.size());
    std::optional<std::string> array;
    if (block_column_) array = schema().cell_data[*block_column_].name;
    addIds("eb", count, blocks_, array);
    uint64_t first = 0;
    size_t number = 1;
    for (const auto& [label, elements] : blocks_) {
      const std::string which = std::to_string(number++);
      const size_t rows = file_->addDimension("num_el_in_blk" + which, elements);
      const size_t corners = file_->addDimension("num_nod_per_el" + which, 4);
      block_rows_.push_back({rows, first, elements});
      file_->addVariable(
          "connect" + which, NetcdfType::kInt, {rows, corners}, {"elem_type", "TETRA"},
          [this, first, n = elements](NetcdfValues& values) { putCorners(values, first, n); });
      first += elements;
    }
    if (is_reordered_)
      file_->addVariable("elem_num_map", NetcdfType::kInt, {numbered}, {},
                         [this](NetcdfValues& values) { putNumbers(values); });
  }

  // Of each element that of its cell, from 1, as maps of vertices have it.
  void putNumbers(NetcdfValues& values) {
    for (uint64_t element = 0; element < cells(); ++element)
      values.put(static_cast<int64_t>(cellAt(element) + 1));
  }

  // The status, ids and names of blocks or sets; `array`: whose labels the names are of, "" of
  // faces'.
  void addIds(const std::string& kind, size_t count, const std::map<int64_t, uint64_t>& groups,
              const std::optional<std::string>& array) {
    const auto forGroups = [&groups](auto visit) {
      return [&groups, visit](NetcdfValues& values) {
        for (const auto& group : groups) visit(values, group.first);
      };
    };
    file_->addVariable(kind + "_status", NetcdfType::kInt, {count}, {},
                       forGroups([](NetcdfValues& values, int64_t) { values.put(1); }));
    file_->addVariable(kind + "_prop1", NetcdfType::kInt, {count}, {"name", "ID"},
                       forGroups([](NetcdfValues& values, int64_t id) { values.put(id); }));
    file_->addVariable(kind + "_names", NetcdfType::kChar, {count, names_}, {},
                       forGroups([this, array](NetcdfValues& values, int64_t id) {
                         values.text(array ? nameOf(*array, id) : "", name_bytes_);
                       }));
  }

  void putCorners(NetcdfValues& values, uint64_t first, uint64_t elements) {
    const auto read = [this](uint64_t at, size_t n, void* out) {
      mesh_->readCells(at, n, static_cast<int64_t*>(out));
    };
    forElements(corners_, 4 * sizeof(int64_t), read, first, elements,
                [&](const unsigned char* row) {
                  int64_t corners[4];
                  std::memcpy(corners, row, sizeof corners);
                  for (const int64_t corner : corners) values.put(corner + 1);
                });
  }

  // ------------------------------------------------------------------------------------ side sets

  void addSideSets() {
    const std::map<int64_t, uint64_t>& sets = sides_->counts();
    if (sets.empty()) return;
    addIds("ss", file_->addDimension("num_side_sets", sets.size()), sets, "");
    uint64_t first = 0;
    size_t number = 1;
    for (const auto& set : sets) {
      const std::string which = std::to_string(number++);
      const size_t rows = file_->addDimension("num_side_ss" + which, set.second);
      const auto put = [this, first, n = set.second](int32_t ExodusSide::*member) {
        return [this, first, n, member](NetcdfValues& values) {
          for (uint64_t i = first; i < first + n; ++i)
            values.put(static_cast<const ExodusSide*>(sides_->rows().row(i))->*member);
        };
      };
      file_->addVariable("elem_ss" + which, NetcdfType::kInt, {rows}, {},
                         put(&ExodusSide::element));
      file_->addVariable("side_ss" + which, NetcdfType::kInt, {rows}, {}, put(&ExodusSide::side));
      first += set.second;
    }
  }

  // ------------------------------------------------------------------------------------ variables

  void addNames(const char* dimension, const char* variable,
                const std::vector<ExodusVariable>& variables) {
    const size_t count = file_->addDimension(dimension, variables.size());
    file_->addVariable(variable, NetcdfType::kChar, {count, names_}, {},
                       [this, &variables](NetcdfValues& values) {
                         for (const ExodusVariable& v : variables) values.text(v.name, name_bytes_);
                       });
  }

  void addNodal() {
    if (fields_.empty()) return;
    addNames("num_nod_var", "name_nod_var", fields_);
    for (size_t i = 0; i < fields_.size(); ++i)
      file_->addVariable("vals_nod_var" + std::to_string(i + 1), real_, {time_, nodes_}, {},
                         [this, &v = fields_[i]](NetcdfValues& values) { putField(values, v); });
  }

  void putField(NetcdfValues& values, const ExodusVariable& v) {
    const Column& column = schema().fields[v.column];
    const size_t at = static_cast<size_t>(v.component) * sizeOf(column.type);
    forEachRow(
        points(), column.bytesPerRow(),
        [&](uint64_t first, size_t n, void* out) { mesh_->readField(v.column, first, n, out); },
        [&](uint64_t, const unsigned char* row) { values.put(row + at, column.type, 1); });
    noteRounding(values, column);
  }

  void addElemental() {
    if (arrays_.empty() || blocks_.empty()) return;
    addNames("num_elem_var", "name_elem_var", arrays_);
    for (size_t i = 0; i < arrays_.size(); ++i)
      for (size_t b = 0; b < block_rows_.size(); ++b)
        file_->addVariable("vals_elem_var" + std::to_string(i + 1) + "eb" + std::to_string(b + 1),
                           real_, {time_, block_rows_[b].dimension}, {},
                           [this, &v = arrays_[i], &rows = block_rows_[b]](NetcdfValues& values) {
                             putArray(values, v, rows);
                           });
  }

  struct BlockRows {
    size_t dimension;
    uint64_t first, elements;
  };

  void putArray(NetcdfValues& values, const ExodusVariable& v, const BlockRows& rows) {
    const Column& column = schema().cell_data[v.column];
    const size_t at = static_cast<size_t>(v.component) * sizeOf(column.type);
    if (ordered_column_ != v.column) ordered_.reset();
    ordered_column_ = v.column;
    const auto read = [&](uint64_t first, size_t n, void* out) {
      mesh_->readCellData(v.column, first, n, out);
    };
    forElements(ordered_, column.bytesPerRow(), read, rows.first, rows.elements,
                [&](const unsigned char* row) { values.put(row + at, column.type, 1); });
    noteRounding(values, column);
  }

  void noteRounding(const NetcdfValues& values, const Column& column) {
    const bool known = std::find(rounded_.begin(), rounded_.end(), column.name) != rounded_.end();
    if (!values.exact() && !known) rounded_.push_back(column.name);
  }

  MeshSpool* mesh_ = nullptr;
  ExodusSides* sides_ = nullptr;
  NetcdfWriter* file_ = nullptr;
  std::optional<size_t> block_column_, no_blocks_;  // which would be, but for its labels
  std::map<int64_t, uint64_t> blocks_;              // elements by label
  std::unique_ptr<GroupedRows<uint64_t>> cells_;    // by element
  std::unique_ptr<RowSpool> elements_;              // by cell, from 0
  // By element, where that is not the order of the cells: corners; the last array that was asked
  // for.
  std::unique_ptr<OrderedRows> corners_, ordered_;
  size_t ordered_column_ = SIZE_MAX;
  bool is_reordered_ = false;  // they are not in the order of cells
  std::vector<BlockRows> block_rows_;
  std::vector<ExodusVariable> fields_, arrays_;
  NetcdfType real_ = NetcdfType::kDouble;
  size_t name_bytes_ = 0, time_ = 0, names_ = 0, nodes_ = 0;  // the last three: dimensions
  std::vector<std::string> rounded_;
};

}  // namespace

std::unique_ptr<Sink> createExodus(std::unique_ptr<ByteSink> bytes, const WriteOptions& options) {
  return std::make_unique<ExodusWriter>(std::move(bytes), options, "Exodus II");
}

}  // namespace tetstream
