#include "msh_hints.h"

#include <utility>

#include "text_number.h"

namespace tetstream {

const char* mshTypeName(ScalarType type) {
  switch (type) {
    case ScalarType::kFloat32:
      return "float32";
    case ScalarType::kFloat64:
      return "float64";
    case ScalarType::kInt32:
      return "int32";
    case ScalarType::kInt64:
      return "int64";
  }
  return "";
}

static bool typeOf(std::string_view word, ScalarType* type) {
  for (ScalarType t :
       {ScalarType::kFloat32, ScalarType::kFloat64, ScalarType::kInt32, ScalarType::kInt64})
    if (word == mshTypeName(t)) {
      *type = t;
      return true;
    }
  return false;
}

void readMshHint(std::string_view line, MshHints* hints) {
  if (takeWord(line) != "tetstream") return;
  const std::string_view what = takeWord(line);
  // One blank, then the name, which may have blanks itself.
  const auto name = [&line] { return std::string(line.empty() ? line : line.substr(1)); };
  if (what == "physical" || what == "geometrical") {
    std::string text = name();
    if (text.size() > 255) return;
    (what == "physical" ? hints->physical : hints->entity) = std::move(text);
    hints->labels_named = true;
    return;
  }
  if (what == "group") {
    int64_t group, label;
    if (parseInteger(takeWord(line), &group) && parseInteger(takeWord(line), &label))
      hints->label_of[group] = label;
    return;
  }
  ScalarType type;
  if (!typeOf(takeWord(line), &type)) return;
  if (what == "position" && isFloat(type)) hints->position_type = type;
  if (what == "field") hints->fields[name()] = type;
  if (what == "cells") hints->cell_data[name()] = type;
}

}  // namespace tetstream
