// cli: what a simplification tells at its end. Depends on the public header.
#pragma once

#include <tetstream/tetstream.h>

#include <string>
#include <vector>

namespace tetstream::cli {

// `asked_error`: the limit on it, in percent; 0: none.
std::string reportText(const tetstream_report& report, double asked_error);
std::string layoutText(const tetstream_layout_report& report);
// One object with every member of the struct by its name, and the notes.
std::string layoutJson(const tetstream_layout_report& report,
                       const std::vector<std::string>& notes);
// The same, and the status.
std::string reportJson(const tetstream_report& report, tetstream_status status,
                       const std::vector<std::string>& notes);

}  // namespace tetstream::cli
