/* A tenth of a file's cells, in another file.
 *
 *   cc 01_files.c $(pkg-config --cflags --libs tetstream) -o 01_files
 *   ./01_files bracket.vtu small.vtu
 *
 * The formats follow from the names. A handle is there after a failure, too, and knows what
 * happened. */
#include <stdio.h>
#include <tetstream/tetstream.h>

int main(int argc, char** argv) {
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  const char* problem = NULL;
  if (argc != 3) return fprintf(stderr, "usage: 01_files IN OUT\n"), 1;

  if (tetstream_reader_open_file(argv[1], NULL, &reader) < 0)
    problem = tetstream_reader_message(reader);
  else if (tetstream_writer_create_file(argv[2], NULL, &writer) < 0)
    problem = tetstream_writer_message(writer);
  else if (tetstream_simplifier_create(NULL, writer, &simplifier) < 0 ||
           tetstream_simplifier_run(simplifier, reader) < 0)
    problem = tetstream_simplifier_message(simplifier);
  if (problem) fprintf(stderr, "01_files: %s\n", problem);

  /* In any order; NULL is allowed. */
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
  return problem != NULL;
}
