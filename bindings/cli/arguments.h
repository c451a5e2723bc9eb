// cli: what the command line asks for. Depends on files.h, option_table.h.
#pragma once

#include <string>
#include <vector>

#include "files.h"
#include "option_table.h"

namespace tetstream::cli {

struct Arguments {
  enum class Command { kText, kSimplify, kInfo, kConvert, kLayout, kGenerate, kDiagram, kCompare };

  Command command = Command::kText;
  std::string text;  // kText: what to print: help, version
  Place in, out;
  Place second;                      // compare: the simplified mesh
  std::vector<Property> properties;  // of the output's format
  OptionWords options;
  std::string kind;                    // of generate
  std::string report;                  // "text", "json"; empty: not asked for
  Place map, log;                      // simplify; no path: not asked for
  std::string title;                   // diagram, compare
  int32_t columns = 1200, rows = 800;  // diagram: of the raster
  bool sweep = false;                  // diagram: that page
  bool quiet = false;                  // no bar, no notes, no report that was not asked for
  bool always_progress = false;        // a bar, or lines, wherever standard error goes

  std::string titleOr(const std::string& names) const { return title.empty() ? names : title; }
};

// Throws Failure if the words make no command.
Arguments parseArguments(int argc, const char* const* argv);

}  // namespace tetstream::cli
