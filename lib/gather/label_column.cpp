#include "label_column.h"

#include <algorithm>
#include <vector>

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
  const ScalarType type = mesh.schema().cell_data[column].type;
  const uint64_t step = mesh.cellCount() / kRowsThatTell + 1;
  std::vector<int64_t> labels;
  for (uint64_t cell = 0; cell < mesh.cellCount(); cell += step) {
    int64_t stored = 0, label = 0;
    mesh.readCellData(column, cell, 1, &stored);
    convertScalars(&stored, type, &label, ScalarType::kInt64, 1);
    labels.push_back(label);
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

}  // namespace tetstream
