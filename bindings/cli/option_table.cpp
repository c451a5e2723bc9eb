#include "option_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "failure.h"
#include "text.h"

namespace tetstream::cli {

std::vector<tetstream_option_info> optionTable() {
  std::vector<tetstream_option_info> table(static_cast<size_t>(tetstream_option_count()));
  for (size_t i = 0; i < table.size(); ++i) {
    table[i].struct_size = sizeof table[i];
    check(tetstream_option_at(static_cast<int32_t>(i), &table[i]));
  }
  return table;
}

std::string metavariable(const tetstream_option_info& info) {
  if (info.type == TETSTREAM_OPTION_IS_INT64) return "N";
  if (info.type == TETSTREAM_OPTION_IS_DOUBLE) return "R";
  return "NAME";
}

// Bounds that only keep arithmetic from overflowing mean nothing to people.
static std::string boundText(double bound) {
  return std::fabs(bound) < 1e-15 ? "0" : exactText(bound);
}

// "auto x y" as "auto, x, y".
static std::string choicesText(const char* choices) {
  std::string text;
  for (const char* at = choices ? choices : ""; *at; ++at) {
    if (*at == ' ') text += ',';
    text += *at;
  }
  return text;
}

// "0 to 1", "at least 1", or nothing where every number of the type will do.
static std::string rangeText(const tetstream_option_info& info) {
  constexpr double kNoBound = 1e15;
  if (info.type == TETSTREAM_OPTION_IS_TEXT) return choicesText(info.choices);
  const bool low = info.minimum > -kNoBound, high = info.maximum < kNoBound;
  if (low && high) return boundText(info.minimum) + " to " + boundText(info.maximum);
  if (low) return "at least " + boundText(info.minimum);
  if (high) return "at most " + boundText(info.maximum);
  return "";
}

// The command takes no target of 0, which elsewhere is none.
static bool isTarget(const tetstream_option_info& info) {
  return info.id == TETSTREAM_OPTION_RATIO || info.id == TETSTREAM_OPTION_CELLS ||
         info.id == TETSTREAM_OPTION_ERROR;
}

std::string helpText(const tetstream_option_info& info) {
  std::string text = info.text, range = rangeText(info);
  if (isTarget(info))
    return text.substr(0, text.find(';')) + " (above 0" +
           (info.maximum < 1000 ? ", at most " + boundText(info.maximum) : "") + ")";
  std::string set = info.default_text ? info.default_text : "";
  if (!set.empty()) set = "default " + set;
  if (!range.empty() && !set.empty()) range += "; ";
  if (range.empty() && set.empty()) return text;
  return text + " (" + range + set + ")";
}

bool OptionWords::has(const char* name) const {
  return std::any_of(values.begin(), values.end(), [=](const auto& v) { return v.first == name; });
}

// What follows the last colon is a weight if it is a number; else all of it is the name, so that
// a field "rho:0" is spelt "rho:0:1".
static std::pair<std::string, double> splitField(const std::string& word) {
  const size_t colon = word.find_last_of(':');
  if (colon == std::string::npos) return {word, 1.0};
  double weight = 0;
  const char* const end = word.data() + word.size();
  const auto parsed = std::from_chars(word.data() + colon + 1, end, weight);
  if (parsed.ec != std::errc() || parsed.ptr != end) return {word, 1.0};
  return {word.substr(0, colon), weight};
}

Options makeOptions(const OptionWords& words) {
  tetstream_options* handle = nullptr;
  const tetstream_status status = tetstream_options_create(&handle);
  Options options(handle);
  check(status, handle);
  for (const auto& [name, value] : words.values)
    check(tetstream_options_parse(handle, name.c_str(), value.c_str()), handle);
  for (const std::string& word : words.fields) {
    const auto [name, weight] = words.weighs_fields ? splitField(word) : std::pair{word, 1.0};
    check(tetstream_options_add_field(handle, name.c_str(), weight), handle);
  }
  return options;
}

int64_t getInt64(const tetstream_options* options, int32_t id) {
  int64_t value = 0;
  check(tetstream_options_get_int64(options, id, &value), options);
  return value;
}

double getDouble(const tetstream_options* options, int32_t id) {
  double value = 0;
  check(tetstream_options_get_double(options, id, &value), options);
  return value;
}

std::string getText(const tetstream_options* options, int32_t id) {
  const char* value = nullptr;
  check(tetstream_options_get_text(options, id, &value), options);
  return value;
}

}  // namespace tetstream::cli
