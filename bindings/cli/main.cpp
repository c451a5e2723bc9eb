// cli: the tetstream command. It reads its words, runs one command and says what went wrong.
// Everything it does to a mesh is done by the library, through the public header.
#include <algorithm>
#include <exception>
#include <iterator>
#include <new>

#include "commands.h"
#include "process.h"
#include "text.h"

namespace tetstream::cli {

ProgressBar::Show progressOf(const Arguments& arguments) {
  if (arguments.always_progress) return ProgressBar::Show::kAlways;
  // At the other end of a pipe another command may draw on the same terminal.
  const bool quiet =
      arguments.quiet || isPipe(arguments.out) || isPipe(arguments.map) || isPipe(arguments.log);
  return quiet ? ProgressBar::Show::kNever : ProgressBar::Show::kOnTerminal;
}

std::vector<std::string> printNotes(const Arguments& arguments, const tetstream_reader* reader,
                                    const tetstream_writer* writer) {
  std::vector<std::string> notes = notesOf(reader, writer);
  if (!arguments.quiet)
    for (const std::string& note : notes) printNote(note);
  return notes;
}

void printReport(const Arguments& arguments, const std::string& text) {
  const Place* const places[] = {&arguments.out, &arguments.map, &arguments.log};
  if (std::any_of(std::begin(places), std::end(places),
                  [](const Place* place) { return isStandardOutput(*place); }))
    printError(text);
  else
    printOut(text);
}

static ExitCode run(const Arguments& arguments) {
  switch (arguments.command) {
    case Arguments::Command::kText:
      printOut(arguments.text);
      return kOk;
    case Arguments::Command::kSimplify:
      return simplify(arguments);
    case Arguments::Command::kInfo:
      return info(arguments);
    case Arguments::Command::kConvert:
      return convert(arguments);
    case Arguments::Command::kLayout:
      return layout(arguments);
    case Arguments::Command::kGenerate:
      return generate(arguments);
    case Arguments::Command::kDiagram:
      return diagram(arguments);
    case Arguments::Command::kCompare:
      return compare(arguments);
  }
  return kInternal;
}

static ExitCode runAndExplain(int argc, char** argv) {
  Failure failure{kInternal, ""};
  try {
    return run(parseArguments(argc, argv));
  } catch (const Failure& thrown) {
    failure = thrown;
  } catch (const std::bad_alloc&) {
    failure = {kNoMemory, "out of memory"};
  } catch (const std::exception& thrown) {
    failure.text = textOf("internal error: %s", thrown.what());
  }
  // A transfer that a signal made fail is no error of its own.
  if (interrupted()) failure = {kCancelled, "cancelled"};
  printError("tetstream: " + oneLine(failure.text) + "\n");
  return failure.code;
}

}  // namespace tetstream::cli

int main(int argc, char** argv) {
  tetstream::cli::prepareProcess();
  try {
    return tetstream::cli::runAndExplain(argc, argv);
  } catch (const std::bad_alloc&) {  // not even for the sentence
    tetstream::cli::printError("tetstream: out of memory\n");
    return tetstream::cli::kNoMemory;
  }
}
