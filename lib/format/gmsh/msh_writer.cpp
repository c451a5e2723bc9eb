// Writes Gmsh's files, format 4.1 or 2.2, binary or text. Labels of cells and faces are physical
// groups, other columns $NodeData and $ElementData; what the format cannot say is in $Comments.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "gmsh_format.h"
#include "grouped_rows.h"
#include "held_names.h"
#include "label_names.h"
#include "mesh_collector.h"
#include "msh_elements.h"
#include "msh_kinds.h"
#include "msh_labels.h"
#include "number_sink.h"
#include "rows_at_once.h"
#include "status.h"
#include "text_number.h"

namespace tetstream {

namespace {

struct Box {
  double low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
};

class MshWriter final : public MeshCollector {
 public:
  using MeshCollector::MeshCollector;

 protected:
  void write(MeshSpool& mesh) override {
    mesh_ = &mesh;
    MshLabels labels(mesh, options());
    labels_ = &labels;
    NumberSink out(bytes(), options().binary);
    out_ = &out;
    checkSizes();
    groupFaces();
    MshElements elements(mesh, labels, options());
    elements_ = &elements;
    nameArrays();
    noteLosses();
    writeHead();
    writeNames();
    if (options().newest) {
      writeEntities();
      writeNodes4();
      writeElements4();
    } else {
      writeNodes2();
      writeElements2();
    }
    writeColumns();
    out.flush();
  }

 private:
  uint64_t points() const { return mesh_->pointCount(); }
  uint64_t cells() const { return mesh_->cellCount(); }
  uint64_t elements() const { return labels_->faces() + cells(); }
  void section(const char* name) { out_->text(std::string("$") + name + "\n"); }
  // After numbers, of which the last one ended its line if they are text.
  void end(const char* name) {
    out_->text(std::string(out_->binary() ? "\n" : "") + "$End" + name + "\n");
  }
  void sizeRow(std::initializer_list<uint64_t> values) {
    for (uint64_t value : values) out_->integer<uint64_t>(static_cast<int64_t>(value));
    out_->endRow();
  }

  // Data have 32-bit tags in both formats, nodes and elements in the older one.
  void checkSizes() {
    const bool any_data = !mesh_->schema().fields.empty() || elementData() > 0;
    const auto most = static_cast<uint64_t>(std::numeric_limits<int32_t>::max());
    if ((!options().newest || any_data) && (points() > most || elements() > most))
      fail(Status::kUnsupported,
           "%s: %llu points and %llu elements: Gmsh's format %s holds 2147483647 at most",
           bytes().name().c_str(), static_cast<unsigned long long>(points()),
           static_cast<unsigned long long>(elements()), options().newest ? "4.1 with data" : "2.2");
  }

  size_t elementData() const {
    size_t count = 0;
    for (size_t i = 0; i < mesh_->schema().cell_data.size(); ++i) count += !labels_->isLabel(i);
    return count;
  }

  void noteLosses() {
    if (labels_->facesLeftOut() > 0)
      note(std::to_string(labels_->facesLeftOut()) +
           " labelled faces are left out: physical groups have numbers from 1 to 2147483647");
    if (const auto& others = labels_->groupsOfOthers(); !others.empty()) {
      const auto& [label, group] = *others.begin();
      note("cells whose label is " + std::to_string(label) + " are the physical group " +
           std::to_string(group) + ": groups have numbers from 1 to 2147483647" +
           (others.size() > 1 ? "; " + std::to_string(others.size() - 1) +
                                    " other labels are no such numbers, either"
                              : ""));
    }
    if (labels_->renumbered() > 0)
      note("an entity has one group: " + std::to_string(labels_->renumbered()) +
           " have other numbers than \"" + mesh_->schema().cell_data[*labels_->entities()].name +
           "\" says");
    if (elements_->areReordered() && options().is_mapped)
      note("cells stand in blocks: cell N of the map is the element with the tag N + " +
           std::to_string(labels_->faces() + 1));
    for (const auto* columns : {&mesh_->schema().fields, &mesh_->schema().cell_data})
      for (const Column& c : *columns)
        if (c.components != 1 && c.components != 3 && c.components != 9)
          note("Gmsh itself shows data of 1, 3 or 9 components; \"" + c.name + "\" has " +
               std::to_string(c.components));
    noteTime();
    for (const LabelName& name : mesh_->schema().label_names)
      tellOfName(name.name, plain(name.name), [this](const std::string& text) { note(text); });
  }

  // It is told with data.
  void noteTime() {
    const double time = mesh_->schema().time.value_or(0);
    if (time != 0 && mesh_->schema().fields.empty() && elementData() == 0)
      note(textOf("without data there is no time, either; it is left out: %.9g", time));
  }

  void nameArrays() {
    for (const auto* columns : {&mesh_->schema().fields, &mesh_->schema().cell_data}) {
      const std::vector<std::string> held =
          heldNames(*columns, plain, [this](const std::string& text) { note(text); });
      for (size_t i = 0; i < held.size(); ++i) names_[&(*columns)[i]] = held[i];
    }
  }

  // --------------------------------------------------------------------------------- the head

  void writeHead() {
    section("MeshFormat");
    out_->text(std::string(options().newest ? "4.1" : "2.2") +
               (out_->binary() ? " 1 8\n" : " 0 8\n"));
    if (out_->binary()) {
      out_->integer<int32_t>(1);
      out_->text("\n");
    }
    out_->text("$EndMeshFormat\n");
    writeHints();
  }

  static std::string plain(std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '"' || c == '\n' || c == '\r'; }, '_');
    return name;
  }

  void writeHints() {
    const Schema& schema = mesh_->schema();
    std::string text = "$Comments\ntetstream position ";
    text += std::string(mshTypeName(schema.position_type)) + "\n";
    const auto hint = [&](const char* what, const Column& c) {
      text += std::string("tetstream ") + what + " " + mshTypeName(c.type) + " " + names_.at(&c);
      text += '\n';
    };
    const auto label = [&](const char* what, const std::optional<size_t>& column) {
      text += std::string("tetstream ") + what;
      if (column) text += " " + names_.at(&schema.cell_data[*column]);
      text += '\n';
    };
    label("physical", labels_->groups());
    label("geometrical", labels_->entities());
    for (const auto& [other, group] : labels_->groupsOfOthers())
      text += "tetstream group " + std::to_string(group) + " " + std::to_string(other) + "\n";
    for (const Column& c : schema.fields) hint("field", c);
    for (const Column& c : schema.cell_data) hint("cells", c);
    out_->text(text + "$EndComments\n");
  }

  // The group that a name is of: its dimension and its tag, 0 for none.
  std::pair<int, int64_t> groupOf(const LabelName& name) const {
    if (name.array.empty()) return {2, MshLabels::isGroup(name.label) ? name.label : 0};
    const auto& column = labels_->groups();
    if (!column || mesh_->schema().cell_data[*column].name != name.array) return {3, 0};
    return {3, labels_->groupOf(name.label)};
  }

  void writeNames() {
    std::string rows;
    size_t count = 0;
    std::vector<LabelName> left_out;
    for (const LabelName& name : mesh_->schema().label_names) {
      const auto [dimension, group] = groupOf(name);
      if (group == 0) {
        left_out.push_back(name);
        continue;
      }
      ++count;
      rows += std::to_string(dimension) + " " + std::to_string(group) + " \"" + plain(name.name) +
              "\"\n";
    }
    if (!left_out.empty())
      note("names of labels that are no physical groups are left out: " +
           shownLabelNames(left_out));
    if (count == 0) return;
    section("PhysicalNames");
    out_->text(std::to_string(count) + "\n" + rows + "$EndPhysicalNames\n");
  }

  // ------------------------------------------------------------------------------------ nodes

  // visit(point, position of the schema's type)
  template <class Visit>
  void forEachPoint(Visit visit) {
    const size_t bytes = 3 * sizeOf(mesh_->schema().position_type);
    forEachRow(
        points(), bytes,
        [&](uint64_t first, size_t n, void* out) { mesh_->readPositions(first, n, out); }, visit);
  }

  void putPosition(const unsigned char* position) {
    const ScalarType type = mesh_->schema().position_type;
    for (size_t k = 0; k < 3; ++k) out_->real(position + k * sizeOf(type), type);
    out_->endRow();
  }

  void writeNodes2() {
    section("Nodes");
    out_->text(std::to_string(points()) + "\n");
    forEachPoint([&](uint64_t point, const unsigned char* position) {
      out_->integer<int32_t>(static_cast<int64_t>(point + 1));
      putPosition(position);
    });
    end("Nodes");
  }

  // One block, of the first volume.
  void writeNodes4() {
    section("Nodes");
    const uint64_t blocks = points() > 0 ? 1 : 0;
    sizeRow({blocks, points(), blocks, points()});
    if (blocks > 0) {
      out_->integer<int32_t>(3);
      out_->integer<int32_t>(labels_->volumes().empty() ? 1
                                                        : labels_->volumes().begin()->second.tag);
      out_->integer<int32_t>(0);
      sizeRow({points()});
      for (uint64_t i = 1; i <= points(); ++i) sizeRow({i});
      forEachPoint([&](uint64_t, const unsigned char* position) { putPosition(position); });
    }
    end("Nodes");
  }

  Box findBox() {
    Box box;
    forEachPoint([&](uint64_t point, const unsigned char* position) {
      double p[3];
      convertScalars(position, mesh_->schema().position_type, p, ScalarType::kFloat64, 3);
      for (size_t k = 0; k < 3; ++k) {
        box.low[k] = point == 0 ? p[k] : std::min(box.low[k], p[k]);
        box.high[k] = point == 0 ? p[k] : std::max(box.high[k], p[k]);
      }
    });
    return box;
  }

  // All have the box of the mesh, and no bounds.
  void writeEntities() {
    const Box box = findBox();
    section("Entities");
    sizeRow({0, 0, labels_->surfaces().size(), labels_->volumes().size()});
    const auto entity = [&](int64_t tag, int64_t group) {
      out_->integer<int32_t>(tag);
      for (double x : box.low) out_->real(x);
      for (double x : box.high) out_->real(x);
      out_->integer<uint64_t>(group != 0 ? 1 : 0);
      if (group != 0) out_->integer<int32_t>(group);
      out_->integer<uint64_t>(0);
      out_->endRow();
    };
    for (const auto& surface : labels_->surfaces()) entity(surface.first, surface.first);
    for (const auto& [key, volume] : labels_->volumes()) entity(volume.tag, volume.group);
    end("Entities");
  }

  // --------------------------------------------------------------------------------- elements

  struct Face {
    int64_t corners[3];
  };

  // Those that can be written, by label, so that each surface is one block: their order means
  // nothing, and labels may change from each to the next.
  void groupFaces() {
    faces_ = std::make_unique<GroupedRows<Face>>(labels_->surfaces(), options().temp_dir);
    std::vector<int64_t> corners(3 * kRowsAtOnce), labels(kRowsAtOnce);
    for (uint64_t first = 0; first < mesh_->faceCount(); first += kRowsAtOnce) {
      const auto n =
          static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, mesh_->faceCount() - first));
      mesh_->readFaces(first, n, corners.data(), labels.data());
      for (size_t i = 0; i < n; ++i)
        if (labels_->surfaces().count(labels[i]) > 0)
          faces_->add(labels[i], {{corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]}});
    }
    faces_->finish();
  }

  // visit(label, corners), label by label.
  template <class Visit>
  void forEachFace(Visit visit) {
    uint64_t at = 0;
    for (const auto& [label, count] : labels_->surfaces())
      for (const uint64_t end = at + count; at < end; ++at)
        visit(static_cast<int32_t>(label),
              static_cast<const Face*>(faces_->rows().row(at))->corners);
  }

  template <class Stored>
  void putElement(uint64_t tag, std::initializer_list<int32_t> before, const int64_t* corners,
                  size_t count) {
    out_->integer<Stored>(static_cast<int64_t>(tag));
    for (int32_t value : before) out_->integer<Stored>(value);
    for (size_t k = 0; k < count; ++k) out_->integer<Stored>(corners[k] + 1);
    out_->endRow();
  }

  // In binary, blocks of one kind, of at most so many.
  void blockHead2(int32_t kind, uint64_t* in_block, uint64_t left) {
    if (!out_->binary() || (*in_block)-- > 0) return;
    *in_block = std::min<uint64_t>(left, 1 << 30);
    out_->integer<int32_t>(kind);
    out_->integer<int32_t>(static_cast<int64_t>((*in_block)--));
    out_->integer<int32_t>(2);
  }

  void putElement2(int32_t kind, uint64_t tag, int32_t group, int32_t entity,
                   const int64_t* corners, size_t count) {
    if (out_->binary()) return putElement<int32_t>(tag, {group, entity}, corners, count);
    putElement<int32_t>(tag, {kind, 2, group, entity}, corners, count);
  }

  void writeElements2() {
    section("Elements");
    out_->text(std::to_string(elements()) + "\n");
    uint64_t tag = 0, in_block = 0;
    forEachFace([&](int32_t label, const int64_t* corners) {
      blockHead2(kMshTriangle, &in_block, labels_->faces() - tag);
      putElement2(kMshTriangle, ++tag, label, label, corners, 3);
    });
    in_block = 0;
    elements_->forEachInStream([&](uint64_t, const MshVolume& volume, const int64_t* corners) {
      blockHead2(kMshTetra, &in_block, elements() - tag);
      putElement2(kMshTetra, ++tag, volume.group, volume.tag, corners, 4);
    });
    end("Elements");
  }

  void blockHead4(int32_t dimension, int32_t entity, int32_t kind, uint64_t count) {
    out_->integer<int32_t>(dimension);
    out_->integer<int32_t>(entity);
    out_->integer<int32_t>(kind);
    sizeRow({count});
  }

  // A block for each surface and each volume. Tags tell the order of the stream, by which a map
  // names cells.
  void writeElements4() {
    std::vector<const MshVolume*> volumes(labels_->volumes().size());
    for (const auto& [key, volume] : labels_->volumes())
      volumes[static_cast<size_t>(volume.rank)] = &volume;
    section("Elements");
    sizeRow({labels_->surfaces().size() + volumes.size(), elements(), elements() > 0 ? 1u : 0u,
             elements()});
    uint64_t tag = 0, left = 0;
    forEachFace([&](int32_t label, const int64_t* corners) {
      if (left == 0) {
        left = labels_->surfaces().at(label);
        blockHead4(2, label, kMshTriangle, left);
      }
      putElement<uint64_t>(++tag, {}, corners, 3);
      --left;
    });
    auto volume = volumes.begin();
    elements_->forEachInFile([&](uint64_t number, const int64_t* corners) {
      if (left == 0) {
        left = (*volume)->cells;
        blockHead4(3, (*volume++)->tag, kMshTetra, left);
      }
      putElement<uint64_t>(tag + number + 1, {}, corners, 4);
      --left;
    });
    end("Elements");
  }

  // ------------------------------------------------------------------------------------- data

  // `forEach` visits the rows: visit(tag, values).
  template <class ForEach>
  void writeData(const char* name, const Column& column, uint64_t rows, ForEach forEach) {
    section(name);
    std::string time;
    const double told = mesh_->schema().time.value_or(0);
    printNumber(&told, ScalarType::kFloat64, time);
    out_->text("1\n\"" + names_.at(&column) + "\"\n1\n" + time + "\n3\n0\n" +
               std::to_string(column.components) + "\n" + std::to_string(rows) + "\n");
    bool exact = true;
    forEach([&](uint64_t tag, const unsigned char* values) {
      out_->integer<int32_t>(static_cast<int64_t>(tag));
      for (int k = 0; k < column.components; ++k, values += sizeOf(column.type)) {
        out_->real(values, column.type);
        exact = exact && isExactAsDouble(values, column.type);
      }
      out_->endRow();
    });
    end(name);
    if (!exact && out_->binary()) noteRounded(column.name);
  }

  template <class Visit>
  void forEachPointRow(size_t field, Visit visit) {
    forEachRow(
        points(), mesh_->schema().fields[field].bytesPerRow(),
        [&](uint64_t first, size_t n, void* out) { mesh_->readField(field, first, n, out); },
        [&](uint64_t row, const unsigned char* values) { visit(row + 1, values); });
  }

  void writeColumns() {
    const Schema& schema = mesh_->schema();
    for (size_t c = 0; c < schema.fields.size(); ++c)
      writeData("NodeData", schema.fields[c], points(),
                [&](const auto& visit) { forEachPointRow(c, visit); });
    for (size_t c = 0; c < schema.cell_data.size(); ++c)
      if (!labels_->isLabel(c))
        writeData("ElementData", schema.cell_data[c], cells(), [&](const auto& visit) {
          elements_->forEachRow(c, [&](uint64_t number, const unsigned char* values) {
            visit(labels_->faces() + number + 1, values);
          });
        });
  }

  MeshSpool* mesh_ = nullptr;
  std::map<const Column*, std::string> names_;  // that arrays have in the file
  MshLabels* labels_ = nullptr;
  MshElements* elements_ = nullptr;
  std::unique_ptr<GroupedRows<Face>> faces_;
  NumberSink* out_ = nullptr;
};

}  // namespace

std::unique_ptr<Sink> createMsh(std::unique_ptr<ByteSink> bytes, const WriteOptions& options) {
  return std::make_unique<MshWriter>(std::move(bytes), options, ".msh");
}

}  // namespace tetstream
