// layout: a mesh brought into an order, and what came of it.
#include "commands.h"
#include "report.h"

namespace tetstream::cli {

ExitCode layout(const Arguments& arguments) {
  const Options options = makeOptions(arguments.options);
  checkOutput(arguments.out);
  const Writer writer = createWriter(arguments.out, arguments.properties);
  ProgressBar bar(progressOf(arguments));
  const Reader reader = openReader(arguments.in, options, bar);
  tetstream_layout_report report = {};
  report.struct_size = sizeof report;
  const tetstream_status status = tetstream_layout(reader.get(), writer.get(), options.get(),
                                                   ProgressBar::callback, &bar, &report);
  bar.clear();
  const auto notes = printNotes(arguments, reader.get(), writer.get());
  check(status, writer.get());
  if (!arguments.quiet || !arguments.report.empty())
    printReport(arguments,
                arguments.report == "json" ? layoutJson(report, notes) : layoutText(report));
  return exitCodeOf(status);
}

}  // namespace tetstream::cli
