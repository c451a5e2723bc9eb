#include "label_column.h"

#include <algorithm>
#include <set>

#include "id_census.h"
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

// Calls use(row, rows) with all labels of an array, some rows at a time, until it returns false.
template <class Use>
void forLabels(MeshSpool& mesh, size_t column, const Use& use) {
  int64_t rows[kRowsAtOnce];
  for (uint64_t first = 0; first < mesh.cellCount(); first += kRowsAtOnce) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, mesh.cellCount() - first));
    readLabels(mesh, column, first, n, rows);
    if (!use(rows, n)) return;
  }
}

bool looksLikeIds(MeshSpool& mesh, size_t column) {
  IdCensus census(mesh.cellCount());
  forLabels(mesh, column, [&](const int64_t* rows, size_t n) {
    for (size_t i = 0; i < n; ++i) census.add(&rows[i], 1);
    return true;
  });
  return census.areIds();
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

bool canBeGroups(MeshSpool& mesh, size_t column, int64_t least, int64_t most) {
  std::set<int64_t> found;
  int64_t last = 0;
  bool any = false, can = true;
  forLabels(mesh, column, [&](const int64_t* rows, size_t n) {
    for (size_t i = 0; i < n && can; ++i) {
      if (any && rows[i] == last) continue;
      last = rows[i];
      any = true;
      can = last >= least && last <= most;
      if (can) found.insert(last);
      can = can && found.size() <= kMostGroups;
    }
    return can;
  });
  return can;
}

}  // namespace tetstream
