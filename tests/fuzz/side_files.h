// Formats of several files: the input of a fuzz target is then the files one after another, with a
// line "@@@@" between them.
#pragma once

#include <string_view>

namespace fuzz {

// Writes what the input holds under the names that the format wants, into a folder that is gone
// with the process, and gives the path of the first file. Null for the formats of one file.
const char* writeSideFiles(std::string_view input, std::string_view format);

}  // namespace fuzz
