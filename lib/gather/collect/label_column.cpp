#include "label_column.h"

#include <algorithm>
#include <set>
#include <vector>

#include "rows_at_once.h"

namespace tetstream {

namespace {

bool isOfIntegers(const Column& column) {
  return column.components == 1 && !isFloat(column.type);
}

bool hasNames(const Schema& schema, const std::string& array) {
  return std::any_of(schema.label_names.begin(), schema.label_names.end(),
                     [&](const LabelName& name) { return name.array == array; });
}

bool looksLikeIds(MeshSpool& mesh, size_t column) {
  const uint64_t step = mesh.cellCount() / kRowsThatTell + 1;
  std::vector<int64_t> labels;
  for (uint64_t cell = 0; cell < mesh.cellCount(); cell += step) {
    labels.push_back(0);
    readLabels(mesh, column, cell, 1, &labels.back());
  }
  std::sort(labels.begin(), labels.end());
  const auto end = std::unique(labels.begin(), labels.end());
  return areIds(static_cast<size_t>(end - labels.begin()), labels.size());
}

}  // namespace

std::optional<size_t> labelColumn(MeshSpool& mesh, const char* name,
                                  const std::function<bool(size_t)>& may) {
  const std::vector<Column>& columns = mesh.schema().cell_data;
  const auto first = [&](auto fits) -> std::optional<size_t> {
    for (size_t i = 0; i < columns.size(); ++i)
      if (isOfIntegers(columns[i]) && fits(i) && may(i)) return i;
    return {};
  };
  if (findColumn(columns, name) >= 0)
    return first([&](size_t i) { return columns[i].name == name; });
  const auto named = first([&](size_t i) { return hasNames(mesh.schema(), columns[i].name); });
  if (named) return named;
  return first(
      [&](size_t i) { return !namesPartition(columns[i].name) && !looksLikeIds(mesh, i); });
}

void readLabels(MeshSpool& mesh, size_t column, uint64_t first, size_t count, int64_t* out) {
  int64_t raw[kRowsAtOnce];
  mesh.readCellData(column, first, count, raw);
  convertScalars(raw, mesh.schema().cell_data[column].type, out, ScalarType::kInt64, count);
}

bool canBeGroups(MeshSpool& mesh, size_t column, int64_t least) {
  std::set<int64_t> found;
  int64_t rows[kRowsAtOnce], last = 0;
  bool any = false;
  for (uint64_t first = 0; first < mesh.cellCount(); first += kRowsAtOnce) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, mesh.cellCount() - first));
    readLabels(mesh, column, first, n, rows);
    for (size_t i = 0; i < n; ++i) {
      if (any && rows[i] == last) continue;
      last = rows[i];
      any = true;
      if (last < least || last > INT32_MAX) return false;
      found.insert(last);
      if (found.size() > kMostGroups) return false;
    }
  }
  return true;
}

}  // namespace tetstream
