// diagram: the order of a stream as a picture.
#include "commands.h"

namespace tetstream::cli {

static Diagram createDiagram(const Arguments& arguments, const tetstream_options* options) {
  tetstream_diagram* handle = nullptr;
  const tetstream_status status =
      tetstream_diagram_create(options, arguments.columns, arguments.rows, &handle);
  Diagram diagram(handle);
  check(status, handle);
  check(tetstream_diagram_check_path(handle, arguments.out.path.c_str()), handle);
  return diagram;
}

ExitCode diagram(const Arguments& arguments) {
  const int32_t page = arguments.sweep ? TETSTREAM_PAGE_SWEEP : TETSTREAM_PAGE_LAYOUT;
  const Options options = makeOptions(arguments.options);
  const Diagram drawn = createDiagram(arguments, options.get());
  checkOutput(arguments.out);
  ProgressBar bar(progressOf(arguments));
  const Reader reader = openReader(arguments.in, options, bar);
  const tetstream_status status =
      tetstream_diagram_read(drawn.get(), reader.get(), page, ProgressBar::callback, &bar);
  bar.clear();
  printNotes(arguments, reader.get(), nullptr);
  check(status, drawn.get());
  check(tetstream_diagram_write(drawn.get(), page, arguments.out.path.c_str(),
                                arguments.titleOr(arguments.in.name()).c_str()),
        drawn.get());
  return kOk;
}

}  // namespace tetstream::cli
