// cli: the library's table of options, and options set from words. Depends on handles.h.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "handles.h"

namespace tetstream::cli {

std::vector<tetstream_option_info> optionTable();
// The column of values in a help text: "N", "R", or the option's name in capitals for texts.
std::string metavariable(const tetstream_option_info& info);
// The option's line, its range and its default.
std::string helpText(const tetstream_option_info& info);

// All options that were given, as name and word, and fields as NAME or, where they are weighed,
// NAME:WEIGHT.
struct OptionWords {
  std::vector<std::pair<std::string, std::string>> values;
  std::vector<std::string> fields;
  bool weighs_fields = true;
  bool has(const char* name) const;
};

// Throws Failure with the library's sentence for the first that it refuses.
Options makeOptions(const OptionWords& words);
int64_t getInt64(const tetstream_options* options, int32_t id);
double getDouble(const tetstream_options* options, int32_t id);
std::string getText(const tetstream_options* options, int32_t id);

}  // namespace tetstream::cli
