// cli: what a simplification tells at its end. Depends on the public header.
#pragma once

#include <tetstream/tetstream.h>

#include <string>

namespace tetstream::cli {

std::string reportText(const tetstream_report& report);
std::string layoutText(const tetstream_layout_report& report);
std::string layoutJson(const tetstream_layout_report& report);
// One object with every member of tetstream_report by its name, and the status.
std::string reportJson(const tetstream_report& report, tetstream_status status);

}  // namespace tetstream::cli
