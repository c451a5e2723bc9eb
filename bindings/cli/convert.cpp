// convert and generate: a stream copied to a writer.
#include "commands.h"

namespace tetstream::cli {

static ExitCode copy(const Arguments& arguments, tetstream_reader* reader, tetstream_writer* writer,
                     const tetstream_options* options, ProgressBar& bar) {
  const tetstream_status status =
      tetstream_convert(reader, writer, options, ProgressBar::callback, &bar);
  bar.clear();
  printNotes(arguments, reader, writer);
  check(status, writer);
  return exitCodeOf(status);
}

ExitCode convert(const Arguments& arguments) {
  const Options options = makeOptions(arguments.options);
  checkOutput(arguments.out);
  const Writer writer = createWriter(arguments.out, arguments.properties);
  ProgressBar bar(progressOf(arguments));
  const Reader reader = openReader(arguments.in, options, bar);
  return copy(arguments, reader.get(), writer.get(), options.get(), bar);
}

ExitCode generate(const Arguments& arguments) {
  // The words for cells and seed are those of simplify, so the library reads them.
  const Options options = makeOptions(arguments.options);
  checkOutput(arguments.out);
  const Reader reader =
      generateReader(arguments.kind, getInt64(options.get(), TETSTREAM_OPTION_CELLS),
                     getInt64(options.get(), TETSTREAM_OPTION_SEED));
  const Writer writer = createWriter(arguments.out, arguments.properties);
  ProgressBar bar(progressOf(arguments));
  return copy(arguments, reader.get(), writer.get(), nullptr, bar);
}

}  // namespace tetstream::cli
