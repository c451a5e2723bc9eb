#include <filesystem>

#include "commands.h"
#include "report.h"
#include "text.h"

namespace tetstream::cli {

// Somebody who forgot the target, or gave 0 for it, should not get the default one.
static void needTarget(const Arguments& arguments, const tetstream_options* options) {
  const auto zero = [&](const char* name, bool is_zero) {
    const bool given = arguments.options.has(name);
    if (given && is_zero)
      throw Failure{kUsage, textOf("--%s 0 is no target: give more than 0", name)};
    return given;
  };
  const bool ratio = zero("ratio", getDouble(options, TETSTREAM_OPTION_RATIO) == 0);
  const bool cells = zero("cells", getInt64(options, TETSTREAM_OPTION_CELLS) == 0);
  const bool error = zero("error", getDouble(options, TETSTREAM_OPTION_ERROR) == 0);
  if (!ratio && !cells && !error)
    throw Failure{kUsage,
                  "simplify needs a target: --ratio R (cells out / cells in), --cells N or "
                  "--error E (percent of the fields' range)"};
}

// Whatever the words, as long as the file's name is not that of another one.
static bool isSame(const Place& a, const Place& b) {
  if (a.isStandard() || b.isStandard()) return a.path == b.path;
  std::error_code ignored;
  return std::filesystem::weakly_canonical(a.path, ignored) ==
         std::filesystem::weakly_canonical(b.path, ignored);
}

// Mesh, map and log go to three places.
static void needPlaces(const Arguments& arguments) {
  const Place* const places[] = {&arguments.out, &arguments.map, &arguments.log};
  for (const Place* const& a : places)
    for (const Place* const* b = places; *b != a; ++b)
      if (!a->path.empty() && isSame(*a, **b))
        throw Failure{kUsage, a->isStandard() ? "only one of OUT, --map and --collapse-log can be -"
                                              : textOf("%s: two things cannot be written there",
                                                       a->path.c_str())};
}

static void printClosing(const Arguments& arguments, double asked_error,
                         const tetstream_report& report, tetstream_status status,
                         const std::vector<std::string>& notes) {
  if (arguments.quiet && arguments.report.empty()) return;
  printReport(arguments, arguments.report == "json" ? reportJson(report, status, notes)
                                                    : reportText(report, asked_error));
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
  needPlaces(arguments);
  const Writer writer = createWriter(arguments.out, arguments.properties);
  ProgressBar bar(progressOf(arguments));
  const Reader reader = openReader(arguments.in, options, bar);

  tetstream_simplifier* handle = nullptr;
  tetstream_status status = tetstream_simplifier_create(options.get(), writer.get(), &handle);
  const Simplifier simplifier(handle);
  check(status, handle);
  setMap(handle, arguments.map);
  setLog(handle, arguments.log);
  check(tetstream_simplifier_set_progress(handle, ProgressBar::callback, &bar), handle);
  status = tetstream_simplifier_run(handle, reader.get());
  bar.clear();
  const auto notes = printNotes(arguments, reader.get(), writer.get());
  check(status, handle);

  tetstream_report report = {};
  report.struct_size = sizeof report;
  check(tetstream_simplifier_get_report(handle, &report), handle);
  printClosing(arguments, getDouble(options.get(), TETSTREAM_OPTION_ERROR), report, status, notes);
  if (status == TETSTREAM_TARGET_MISSED) printMissed(report);
  return exitCodeOf(status);
}

}  // namespace tetstream::cli
