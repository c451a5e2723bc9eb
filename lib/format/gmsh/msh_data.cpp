// Fields and cell data of Gmsh's files: values by the tags of nodes and elements.
#include <algorithm>
#include <cmath>

#include "msh_mesh.h"
#include "status.h"

namespace tetstream {

namespace {

constexpr size_t kMostName = 255, kMostSuffix = 32;
constexpr size_t kMostComponents = 512;  // what a row may have to be passed over

// What stands before the values.
struct DataHead {
  std::string name;
  double time = 0;
  int64_t step = 0, components = 1, rows = 0, partition = 0;
};

DataHead readHead(MshMesh& mesh, bool of_cells) {
  FileScan& file = mesh.file;
  DataHead head;
  const int64_t texts = file.integer("the number of texts", 0, 64);
  for (int64_t i = 0; i < texts; ++i) {
    std::string text = file.text("a text");
    if (i == 0) head.name = std::move(text);
  }
  const int64_t reals = file.integer("the number of real tags", 0, 64);
  for (int64_t i = 0; i < reals; ++i) {
    const double value = file.real("a real tag");
    if (i == 0) head.time = value;
  }
  const int64_t integers = file.integer("the number of integer tags", 3, 64);
  head.step = file.integer("the time step");
  head.components = file.integer("the number of components", 1, kMostComponents);
  head.rows = file.integer("the number of values", 0, INT64_MAX);
  for (int64_t i = 3; i < integers; ++i) {
    const int64_t value = file.integer("an integer tag");
    if (i == 3) head.partition = value;
  }
  if (head.name.empty()) head.name = of_cells ? "cell data" : "data";
  if (head.name.size() > kMostName) head.name.resize(kMostName);
  const auto row_bytes = static_cast<uint64_t>(
      mesh.numbers.binary() ? kMshInt + kMshDouble * static_cast<size_t>(head.components)
                            : 2 + 2 * static_cast<size_t>(head.components));
  file.checkClaim(static_cast<uint64_t>(head.rows), row_bytes, "rows of data");
  if (mesh.numbers.binary()) file.line();
  return head;
}

ScalarType typeOf(const std::map<std::string, ScalarType>& hints, const std::string& name) {
  const auto found = hints.find(name);
  return found == hints.end() ? ScalarType::kFloat64 : found->second;
}

}  // namespace

void MshData::read(MshMesh& mesh, bool of_cells) {
  if (!mesh.intake) mesh.file.failBad("data before the nodes that it belongs to");
  DataHead head = readHead(mesh, of_cells);
  if (of_cells) mesh.finishCells();
  times_.push_back(head.time);
  const bool kept = head.components <= kMaxComponents;
  if (!kept)
    mesh.intake->leaveOut("components of \"" + head.name + "\"",
                          static_cast<uint64_t>(head.components));
  const size_t data =
      kept ? dataFor(mesh, head.name, head.step, of_cells, static_cast<int>(head.components)) : 0;
  std::vector<double> values(static_cast<size_t>(head.components));
  if (kept && mesh.placeData(data, of_cells, static_cast<uint64_t>(head.rows), values.size()))
    return;
  TagTable& tags = of_cells ? mesh.cells : *mesh.points;
  mesh.numbers.expectRows(static_cast<uint64_t>(head.rows), {{{false, 1}, {true, values.size()}}});
  for (int64_t i = 0; i < head.rows; ++i) {
    const int64_t tag = mesh.numbers.integer(kMshInt, of_cells ? "an element" : "a node");
    mesh.numbers.reals(values.data(), values.size(), kMshDouble, "a value");
    int64_t first, count;
    if (!tags.find(tag, &first, &count)) {
      // Faces, lines and points have data, too.
      if (of_cells) continue;
      mesh.file.failBad("\"" + head.name + "\" has a value of node " + std::to_string(tag) +
                        ", which is not there");
    }
    for (int64_t k = 0; kept && k < count; ++k)
      mesh.intake->putData(data, static_cast<uint64_t>(first + k), values.data());
  }
}

std::optional<double> MshData::time() const {
  if (times_.empty() || times_[0] == 0 || !std::isfinite(times_[0])) return {};
  const auto is_first = [this](double time) { return time == times_[0]; };
  if (!std::all_of(times_.begin(), times_.end(), is_first)) return {};
  return times_[0];
}

// The column of that name and step, or a new one.
size_t MshData::dataFor(MshMesh& mesh, const std::string& name, int64_t step, bool of_cells,
                        int components) {
  bool taken = false;
  for (const Block& block : blocks_) {
    if (block.of_cells != of_cells || block.name != name) continue;
    if (block.step == step && block.components == components) return block.data;
    taken = true;
  }
  const auto isUsed = [&](const std::string& candidate) {
    return (of_cells && (candidate == mesh.hints.physical || candidate == mesh.hints.entity)) ||
           std::any_of(blocks_.begin(), blocks_.end(), [&](const Block& b) {
             return b.of_cells == of_cells && b.column == candidate;
           });
  };
  std::string unique = name;
  const std::string stem = name.substr(0, kMostName - kMostSuffix);
  if (taken) unique = stem + ":" + std::to_string(step);
  for (size_t i = 2; isUsed(unique); ++i)
    unique = stem + ":" + std::to_string(step) + "." + std::to_string(i);
  const auto& hints = of_cells ? mesh.hints.cell_data : mesh.hints.fields;
  const size_t data = mesh.intake->addData({unique, components, typeOf(hints, name)}, of_cells);
  blocks_.push_back({name, unique, step, of_cells, components, data});
  return data;
}

}  // namespace tetstream
