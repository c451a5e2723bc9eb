#include "xdmf_fields.h"

#include <algorithm>

#include "schema.h"
#include "status.h"
#include "xdmf_cells.h"
#include "xdmf_whole.h"

namespace tetstream {

namespace {

std::string nameOf(const XdmfAttribute& attribute) {
  return attribute.name.empty() ? "values" : attribute.name;
}

std::string shown(const XdmfAttribute& attribute) {
  return textOf("array \"%s\"", cutName(nameOf(attribute)).c_str());
}

// Of what a function must have; those after them tell which cells the file's are to FEniCS.
constexpr size_t kNumbers = 0, kValues = 1, kBegins = 2, kFunctionItems = 3;
constexpr uint64_t kMostDegree = 9;

bool isFunction(const XdmfAttribute& attribute) {
  return attribute.is_function && sameWord(attribute.center, "Other");
}

bool isOneOf(const std::string& family, std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(),
                     [&](const char* name) { return sameWord(family, name); });
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
    if (isFunction(attribute) && !spread)
      addFunction(attribute);
    else if (!of_points && !sameWord(attribute.center, "Cell"))
      mesh_.addNote(shown(attribute) + " is left out: it is of " +
                    (sameWord(attribute.center, "Other") ? "neither nodes nor cells"
                                                         : cutName(attribute.center)));
    else if (isNew(attribute, list) && rows > 0)
      add(attribute, rows, of_points ? Spread() : spread, list);
  }
}

bool XdmfFields::isNew(const XdmfAttribute& attribute, const std::vector<MeshArray>& list) {
  const std::string name = cutName(nameOf(attribute));
  const bool is_new = std::none_of(list.begin(), list.end(),
                                   [&](const MeshArray& other) { return other.name == name; });
  if (!is_new) mesh_.addNote(shown(attribute) + " is left out: there is another one of its name");
  return is_new;
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
  const std::optional<int> width = componentsOf(attribute, item.count(), rows);
  if (!width) return {};
  const std::string name = nameOf(attribute);
  std::optional<MeshArray> whole;
  if (may_be_whole) whole = wholeOf(item, name, *width);
  return whole ? std::move(whole) : arrays_.arrayOf(item, name, *width);
}

std::optional<int> XdmfFields::componentsOf(const XdmfAttribute& attribute, uint64_t count,
                                            uint64_t rows) {
  const uint64_t components = count / rows;
  if (count % rows != 0)
    fail(Status::kBadData, "%s: %s has %llu values for %llu rows", mesh_.name.c_str(),
         shown(attribute).c_str(), static_cast<unsigned long long>(count),
         static_cast<unsigned long long>(rows));
  if (components < 1 || components > 9) {
    mesh_.addNote(shown(attribute) + " is left out: it has " + std::to_string(components) +
                  " components, 1 to 9 are possible");
    return {};
  }
  return static_cast<int>(components);
}

// ------------------------------------------------------------------------------------- functions

void XdmfFields::addFunction(const XdmfAttribute& attribute) {
  const std::string& family = attribute.family;
  const uint64_t degree = attribute.degree.value_or(kMostDegree + 1);
  const std::string word = attribute.degree ? " degree " + std::to_string(degree) : " no degree";
  const bool is_read = attribute.items.size() >= kFunctionItems && degree <= kMostDegree &&
                       sameWord(attribute.cell, "tetrahedron") && areTetrahedra(piece_);
  if (is_read && degree > 0 && isOneOf(family, {"CG", "Lagrange"})) {
    if (degree > 1)
      mesh_.addNote(shown(attribute) + " is of" + word +
                    ": its values at the corners of cells are read");
    return addFunction(attribute, (degree + 1) * (degree + 2) * (degree + 3) / 6, true);
  }
  if (is_read && degree == 0 && isOneOf(family, {"DG", "Discontinuous Lagrange"}))
    return addFunction(attribute, 1, false);
  mesh_.addNote(shown(attribute) + " is left out: it is a function of the family \"" +
                cutName(family) + "\" and of" + word +
                "; read are those of \"CG\", and of \"DG\" and degree 0, in tetrahedra "
                "(FEniCS: write gives values at nodes)");
}

void XdmfFields::addFunction(const XdmfAttribute& attribute, uint64_t numbers_each,
                             bool is_of_points) {
  std::vector<MeshArray>& list = is_of_points ? piece_.point_data : piece_.cell_data;
  const uint64_t cells = piece_.cell_count, count = attribute.items[kNumbers].count();
  if (!isNew(attribute, list) || cells == 0) return;
  const std::optional<int> width = componentsOf(attribute, count, cells * numbers_each);
  if (!width) return;
  // note: throws if there are not as many points as are told, for each of which memory is taken.
  if (is_of_points && piece_.point_count > 0) piece_.points->open(3 * piece_.point_count);
  XdmfFunction function = functionOf(attribute, *width);
  function.numbers_each = numbers_each * static_cast<uint64_t>(*width);
  function.is_of_points = is_of_points;
  const XdmfCellList tetrahedra{nullptr, cells, 4, 4, piece_.point_count, function.place};
  list.push_back(
      valuesOfFunction(std::move(function), *piece_.connectivity, tetrahedra, temp_dir_));
}

XdmfFunction XdmfFields::functionOf(const XdmfAttribute& attribute, int components) {
  const XdmfItem &numbers = attribute.items[kNumbers], &values = attribute.items[kValues];
  XdmfFunction function;
  function.numbers = arrays_.arrayOf(numbers, "numbers of values", 1);
  function.values = arrays_.arrayOf(values, nameOf(attribute), 1);
  function.begins = arrays_.arrayOf(attribute.items[kBegins], "numbers of values", 1);
  function.value_count = values.count();
  function.components = components;
  function.is_symmetric = components == 6 && sameWord(attribute.type, "Tensor");
  function.place = arrays_.describe(numbers);
  for (const MeshArray* array : {&function.numbers, &function.begins})
    if (isFloat(array->type)) fail(Status::kBadData, "%s are no integers", function.place.c_str());
  if (function.value_count == 0)
    fail(Status::kBadData, "%s: %s has no values", mesh_.name.c_str(), shown(attribute).c_str());
  return function;
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
