#include "label_names.h"

#include <algorithm>
#include <tuple>

#include "status.h"

namespace tetstream {

namespace {

constexpr size_t kShown = 20;

bool comesBefore(const LabelName& a, const LabelName& b) {
  return std::tie(a.array, a.label) < std::tie(b.array, b.label);
}

bool isOfOneLabel(const LabelName& a, const LabelName& b) {
  return a.label == b.label && a.array == b.array;
}

std::string whatItNames(const LabelName& name) {
  const std::string label = std::to_string(name.label);
  return name.array.empty() ? "faces " + label : "\"" + name.array + "\" " + label;
}

void checkArray(const Schema& schema, const LabelName& name) {
  if (name.array.empty()) return;
  const int found = findColumn(schema.cell_data, name.array);
  if (found < 0)
    fail(Status::kBadArgument, "label name \"%s\": there is no cell array \"%s\"",
         name.name.c_str(), name.array.c_str());
  const Column& column = schema.cell_data[static_cast<size_t>(found)];
  if (isFloat(column.type) || column.components != 1)
    fail(
        Status::kBadArgument,
        "label name \"%s\": the cell array \"%s\" has no labels, which are integers, one to a cell",
        name.name.c_str(), name.array.c_str());
}

}  // namespace

void checkLabelNames(const Schema& schema) {
  const std::vector<LabelName>& names = schema.label_names;
  for (size_t i = 0; i < names.size(); ++i) {
    const LabelName& name = names[i];
    if (name.name.empty() || name.name.size() > kMostNameBytes)
      fail(Status::kBadArgument, "the name of %s has %s, of which there are 1 to %zu",
           whatItNames(name).c_str(), name.name.empty() ? "no bytes" : "too many bytes",
           kMostNameBytes);
    if (i > 0 && isOfOneLabel(names[i - 1], name))
      fail(Status::kBadArgument, "%s has two names, \"%s\" and \"%s\"", whatItNames(name).c_str(),
           names[i - 1].name.c_str(), name.name.c_str());
    checkArray(schema, name);
  }
}

void sortLabelNames(std::vector<LabelName>& names) {
  std::stable_sort(names.begin(), names.end(), comesBefore);
}

void settleLabelNames(std::vector<LabelName>& names) {
  for (LabelName& name : names) name.name = cutName(name.name.substr(0, name.name.find('\0')));
  std::erase_if(names, [](const LabelName& name) { return name.name.empty(); });
  sortLabelNames(names);
  names.erase(std::unique(names.begin(), names.end(), isOfOneLabel), names.end());
}

void removeLabelNames(std::vector<LabelName>& names, const std::string& array) {
  std::erase_if(names, [&](const LabelName& name) { return name.array == array; });
}

const LabelName* findLabelName(const std::vector<LabelName>& names, const std::string& array,
                               int64_t label) {
  const LabelName wanted{array, label, {}};
  const auto found = std::lower_bound(names.begin(), names.end(), wanted, comesBefore);
  return found != names.end() && isOfOneLabel(*found, wanted) ? &*found : nullptr;
}

std::string shownLabelNames(const std::vector<LabelName>& names) {
  std::string text;
  for (size_t i = 0; i < std::min(names.size(), kShown); ++i) {
    text += (i > 0 ? ", " : "") + whatItNames(names[i]);
    if (!names[i].name.empty()) text += " \"" + names[i].name + "\"";
  }
  if (names.size() > kShown) text += " and " + std::to_string(names.size() - kShown) + " more";
  return text;
}

}  // namespace tetstream
