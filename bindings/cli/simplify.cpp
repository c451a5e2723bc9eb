#include "commands.h"
#include "report.h"
#include "text.h"

namespace tetstream::cli {

// Somebody who forgot the target should not get the default one.
static void needTarget(const Arguments& arguments, const tetstream_options* options) {
  const bool ratio = arguments.options.has("ratio"), cells = arguments.options.has("cells");
  if (!ratio && !cells)
    throw Failure{kUsage, "simplify needs a target: --ratio R (cells out / cells in) or --cells N"};
  if (ratio && cells) throw Failure{kUsage, "--ratio and --cells are two targets: give one"};
  if (cells && getInt64(options, TETSTREAM_OPTION_CELLS) == 0)
    throw Failure{kUsage, "--cells 0 is no target: at least one cell has to stay"};
}

static void printReport(const Arguments& arguments, const tetstream_report& report,
                        tetstream_status status) {
  if (arguments.quiet && arguments.report.empty()) return;
  const std::string text =
      arguments.report == "json" ? reportJson(report, status) : reportText(report);
  if (isStandardOutput(arguments.out))
    printError(text);
  else
    printOut(text);
}

static void printMissed(const tetstream_report& report) {
  const std::string why = report.limited_by && *report.limited_by ? report.limited_by : "unknown";
  printError(oneLine("tetstream: the target of " + countText(report.target_cells) +
                     " cells was missed, " + countText(report.cells_out) +
                     " are left; limited by: " + why) +
             "\n");
}

ExitCode simplify(const Arguments& arguments) {
  const Options options = makeOptions(arguments.options);
  needTarget(arguments, options.get());
  checkOutput(arguments.out);
  const Writer writer = createWriter(arguments.out, arguments.properties);
  const Reader reader = openReader(arguments.in, options.get());

  tetstream_simplifier* handle = nullptr;
  tetstream_status status = tetstream_simplifier_create(options.get(), writer.get(), &handle);
  const Simplifier simplifier(handle);
  check(status, handle);
  ProgressBar bar(progressOf(arguments));
  check(tetstream_simplifier_set_progress(handle, ProgressBar::callback, &bar), handle);
  status = tetstream_simplifier_run(handle, reader.get());
  bar.clear();
  printNotes(arguments, reader.get(), writer.get());
  check(status, handle);

  tetstream_report report = {};
  report.struct_size = sizeof report;
  check(tetstream_simplifier_get_report(handle, &report), handle);
  printReport(arguments, report, status);
  if (status == TETSTREAM_TARGET_MISSED) printMissed(report);
  return exitCodeOf(status);
}

}  // namespace tetstream::cli
