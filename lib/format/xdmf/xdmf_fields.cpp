#include "xdmf_fields.h"

#include <algorithm>

#include "schema.h"
#include "status.h"
#include "xdmf_whole.h"

namespace tetstream {

namespace {

std::string nameOf(const XdmfAttribute& attribute) {
  return attribute.name.empty() ? "values" : attribute.name;
}

std::string shown(const XdmfAttribute& attribute) {
  return textOf("array \"%s\"", cutName(nameOf(attribute)).c_str());
}

// What has values neither at nodes nor in cells.
std::string whatOf(const XdmfAttribute& attribute) {
  if (!sameWord(attribute.center, "Other")) return cutName(attribute.center);
  return "neither nodes nor cells, as finite elements are "
         "(FEniCS: write_checkpoint; write gives values at nodes)";
}

bool hasName(const std::vector<MeshArray>& list, const std::string& name) {
  return std::any_of(list.begin(), list.end(),
                     [&](const MeshArray& other) { return other.name == cutName(name); });
}

}  // namespace

void XdmfFields::add(const std::vector<XdmfAttribute>& attributes) {
  add(attributes, piece_.cell_count, {});
}

void XdmfFields::add(const std::vector<XdmfAttribute>& attributes, uint64_t cells,
                     const Spread& spread) {
  for (const XdmfAttribute& attribute : attributes) {
    const bool of_points = sameWord(attribute.center, "Node");
    const uint64_t rows = of_points ? piece_.point_count : cells;
    auto& list = of_points ? piece_.point_data : piece_.cell_data;
    if (!of_points && !sameWord(attribute.center, "Cell"))
      mesh_.addNote(shown(attribute) + " is left out: it is of " + whatOf(attribute));
    else if (hasName(list, nameOf(attribute)))
      mesh_.addNote(shown(attribute) + " is left out: there is another one of its name");
    else if (rows > 0)
      add(attribute, rows, of_points ? Spread() : spread, list);
  }
}

void XdmfFields::add(const XdmfAttribute& attribute, uint64_t rows, const Spread& spread,
                     std::vector<MeshArray>& list) {
  std::optional<MeshArray> values = valuesOf(attribute, rows, spread != nullptr);
  if (values) list.push_back(spread ? spread(std::move(*values)) : std::move(*values));
}

std::optional<MeshArray> XdmfFields::valuesOf(const XdmfAttribute& attribute, uint64_t rows,
                                              bool may_be_whole) {
  if (attribute.is_function || attribute.items.size() != 1) {
    mesh_.addNote(shown(attribute) + " is left out: it is no list of values, but a function");
    return {};
  }
  const XdmfItem& item = attribute.items[0];
  const uint64_t count = item.count(), components = count / rows;
  if (count % rows != 0)
    fail(Status::kBadData, "%s: %s has %llu values for %llu rows", mesh_.name.c_str(),
         shown(attribute).c_str(), static_cast<unsigned long long>(count),
         static_cast<unsigned long long>(rows));
  if (components < 1 || components > 9) {
    mesh_.addNote(shown(attribute) + " is left out: it has " + std::to_string(components) +
                  " components, 1 to 9 are possible");
    return {};
  }
  const std::string name = nameOf(attribute);
  const auto width = static_cast<int>(components);
  std::optional<MeshArray> whole;
  if (may_be_whole) whole = wholeOf(item, name, width);
  return whole ? std::move(whole) : arrays_.arrayOf(item, name, width);
}

// note: as float64, of which float32, what such text is otherwise, has not all integers.
std::optional<MeshArray> XdmfFields::wholeOf(XdmfItem item, const std::string& name,
                                             int components) {
  if (!item.isUntyped()) return {};
  item.precision = sizeof(double);
  MeshArray values = arrays_.arrayOf(item, name, components);
  const std::optional<ValueType> type = wholeType(values, item.count());
  if (!type) return {};
  return asWhole(std::move(values), *type);
}

}  // namespace tetstream
