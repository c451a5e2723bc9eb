#include "schema.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "label_names.h"
#include "status.h"

namespace tetstream {

size_t Schema::fieldComponents() const {
  size_t sum = 0;
  for (const Column& c : fields) sum += static_cast<size_t>(c.components);
  return sum;
}

std::string cutName(const std::string& text, size_t most) {
  if (text.size() <= most) return text;
  size_t size = most;
  while (size > 0 && (static_cast<unsigned char>(text[size]) & 0xC0) == 0x80) --size;
  return text.substr(0, size);
}

static void checkColumns(const std::vector<Column>& columns, const char* kind) {
  for (size_t i = 0; i < columns.size(); ++i) {
    const Column& c = columns[i];
    if (c.name.empty() || c.name.size() > kMostNameBytes)
      fail(Status::kBadArgument, "%s %zu: a name has 1 to %zu bytes, this one has %s", kind, i,
           kMostNameBytes, c.name.empty() ? "none" : "more");
    if (c.components < 1 || c.components > kMaxComponents)
      fail(Status::kBadArgument, "%s \"%s\": %d components, 1 to %d are possible", kind,
           c.name.c_str(), c.components, kMaxComponents);
    if (!isKnown(c.type))
      fail(Status::kBadArgument, "%s \"%s\": unknown number type %d", kind, c.name.c_str(),
           static_cast<int>(c.type));
    if (findColumn(columns, c.name) != static_cast<int>(i))
      fail(Status::kBadArgument, "%s \"%s\" is there twice", kind, c.name.c_str());
  }
}

void checkSchema(const Schema& schema) {
  if (!isFloat(schema.position_type))
    fail(Status::kBadArgument, "positions must be float32 or float64");
  checkColumns(schema.fields, "field");
  checkColumns(schema.cell_data, "cell array");
  checkLabelNames(schema);
  if (schema.time && !std::isfinite(*schema.time))
    fail(Status::kBadArgument, "the time is not finite");
}

void failNotFinite(const std::string& row, const Column& field) {
  fail(Status::kBadData,
       "%s: its %s is not finite: name the fields that are to be measured, others may have such "
       "values",
       row.c_str(), field.name.c_str());
}

int findColumn(const std::vector<Column>& columns, const std::string& name) {
  for (size_t i = 0; i < columns.size(); ++i)
    if (columns[i].name == name) return static_cast<int>(i);
  return -1;
}

bool namesPartition(const std::string& name) {
  static constexpr const char* kNames[] = {
      "decomposition", "ghosttype",      "gmshpartition", "metis",       "metispartition",
      "mpirank",       "ownerrank",      "partition",     "partitionid", "proc",
      "processid",     "processor",      "processorid",   "procid",      "procs",
      "rank",          "vtkghostlevels", "vtkghosttype",  "vtkprocessid"};
  std::string plain;  // letters alone, in lower case
  for (char c : name)
    if (std::isalpha(static_cast<unsigned char>(c)))
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::any_of(kNames, kNames + sizeof kNames / sizeof *kNames,
                     [&](const char* known) { return plain == known; });
}

}  // namespace tetstream
