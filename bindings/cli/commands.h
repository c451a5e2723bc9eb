// cli: the commands; each returns the exit code or throws Failure. Depends on arguments.h.
#pragma once

#include <string>
#include <vector>

#include "arguments.h"
#include "failure.h"
#include "progress.h"

namespace tetstream::cli {

ExitCode simplify(const Arguments& arguments);
ExitCode info(const Arguments& arguments);
ExitCode convert(const Arguments& arguments);
ExitCode layout(const Arguments& arguments);
ExitCode generate(const Arguments& arguments);
ExitCode diagram(const Arguments& arguments);
ExitCode compare(const Arguments& arguments);

// When a bar is shown, for all of them.
ProgressBar::Show progressOf(const Arguments& arguments);
// To standard output, or to standard error where the mesh goes there.
void printReport(const Arguments& arguments, const std::string& text);
// Says what reader and writer left out, once a run is over, unless that is to be quiet, and returns
// it for a report; a null handle has nothing to say.
std::vector<std::string> printNotes(const Arguments& arguments, const tetstream_reader* reader,
                                    const tetstream_writer* writer);

}  // namespace tetstream::cli
