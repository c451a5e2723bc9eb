// cli: the two ends of a run, by name; "-" is standard input or output. Depends on handles.h,
// option_table.h, progress.h.
#pragma once

#include <string>
#include <vector>

#include "handles.h"
#include "option_table.h"
#include "progress.h"

namespace tetstream::cli {

struct Place {
  std::string path;
  std::string format;  // empty: by the path's extension, or tets for "-"
  bool isStandard() const { return path == "-"; }
  std::string name() const;  // the file's alone, without its folders
};

// A property of the output's format, as for tetstream_writer_set, and the flag that asks for it.
struct Property {
  std::string flag, name, value;
};

// Before any work: throws Failure if nothing can be written there, or a terminal would get it.
void checkOutput(const Place& out);
// True if what is written there comes out of standard output, whatever its name.
bool isStandardOutput(const Place& out);
// True if it is standard output and that is a pipe.
bool isPipe(const Place& out);

// The tmpdir option holds for a pipe that has to be spooled, too. Opening shows in the bar.
Reader openReader(const Place& in, const Options& options, ProgressBar& bar);
// What was made of a mesh that is read with these options.
Reader openResult(const Place& in, const OptionWords& words, ProgressBar& bar);
Writer createWriter(const Place& out, const std::vector<Property>& properties);
// A vertex map and a collapse log, unless the path is empty; "-" gets them as text.
void setMap(tetstream_simplifier* simplifier, const Place& map);
void setLog(tetstream_simplifier* simplifier, const Place& log);
Reader generateReader(const std::string& kind, int64_t cells, int64_t seed);

// What both have noted, once a run is over; a null handle has nothing to say.
std::vector<std::string> notesOf(const tetstream_reader* reader, const tetstream_writer* writer);

}  // namespace tetstream::cli
