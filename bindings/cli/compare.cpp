// compare: how well a simplified mesh follows its original.
#include "commands.h"
#include "comparison_report.h"
#include "text.h"

namespace tetstream::cli {

static Comparison createComparison(const Arguments& arguments) {
  OptionWords words = arguments.options;
  const bool draws = !arguments.out.path.empty();
  if (words.has("cut") && !draws)
    throw Failure{kUsage, "--cut is where a picture cuts, and needs --picture FILE"};
  if (!arguments.title.empty() && !draws)
    throw Failure{kUsage, "--title is what stands above a picture, and needs --picture FILE"};
  if (draws && !words.has("cut")) words.values.emplace_back("cut", "auto");
  const Options options = makeOptions(words);
  if (draws && getText(options.get(), TETSTREAM_OPTION_CUT) == "none")
    throw Failure{kUsage, "--cut none leaves a picture nothing to show: leave out one of them"};
  tetstream_comparison* handle = nullptr;
  const tetstream_status status = tetstream_comparison_create(options.get(), &handle);
  Comparison comparison(handle);
  check(status, handle);
  if (draws) check(tetstream_comparison_check_path(handle, arguments.out.path.c_str()), handle);
  return comparison;
}

ExitCode compare(const Arguments& arguments) {
  if (arguments.in.isStandard() && arguments.second.isStandard())
    throw Failure{kUsage, "only one of the meshes can come from standard input"};
  const Comparison comparison = createComparison(arguments);
  if (!arguments.out.path.empty()) checkOutput(arguments.out);
  const Options options = makeOptions(arguments.options);
  ProgressBar bar(progressOf(arguments));
  const Reader original = openReader(arguments.in, options, bar);
  const Reader simplified = openResult(arguments.second, arguments.options, bar);
  const tetstream_status status = tetstream_comparison_read(
      comparison.get(), original.get(), simplified.get(), ProgressBar::callback, &bar);
  bar.clear();
  std::vector<std::string> notes = printNotes(arguments, original.get(), nullptr);
  for (const std::string& note : printNotes(arguments, simplified.get(), nullptr))
    notes.push_back(note);
  check(status, comparison.get());
  if (!arguments.out.path.empty())
    check(tetstream_comparison_write(
              comparison.get(), arguments.out.path.c_str(),
              arguments.titleOr(arguments.in.name() + " and " + arguments.second.name()).c_str()),
          comparison.get());
  if (!arguments.quiet || !arguments.report.empty()) {
    const ComparisonFigures figures = figuresOf(comparison.get());
    printOut(arguments.report == "json" ? comparisonJson(figures, notes) : comparisonText(figures));
  }
  return kOk;
}

}  // namespace tetstream::cli
