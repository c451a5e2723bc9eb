// cli: how a command ends: the exit codes and what is thrown on the way to one. Depends on the
// public header.
#pragma once

#include <tetstream/tetstream.h>

#include <string>
#include <utility>

namespace tetstream::cli {

// Documented in tetstream(1); numbers are never changed.
enum ExitCode : int {
  kOk = 0,
  kUsage = 1,         // bad argument
  kBadData = 2,       // a file breaks its format's rules
  kIo = 3,            // the system refused a read, a write or an open
  kNoMemory = 4,      // memory, or the budget set for it, is used up
  kTargetMissed = 5,  // the output is complete, but larger than asked for
  kUnsupported = 6,   // a format that is not known or cannot hold it
  kCancelled = 7,     // a signal asked to stop
  kInternal = 8,      // a defect of the library or of the command
};

ExitCode exitCodeOf(tetstream_status status);

struct Failure {
  ExitCode code;
  std::string text;  // without "tetstream: "
};

// Throws Failure if the status is one, with the handle's sentence, which is asked for only then.
void check(tetstream_status status);
void check(tetstream_status status, const tetstream_options* options);
void check(tetstream_status status, const tetstream_reader* reader);
void check(tetstream_status status, const tetstream_writer* writer);
void check(tetstream_status status, const tetstream_simplifier* simplifier);
void check(tetstream_status status, const tetstream_diagram* diagram);
void check(tetstream_status status, const tetstream_comparison* comparison);

}  // namespace tetstream::cli
