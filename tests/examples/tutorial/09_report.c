/* What a run came to: as many cells as follow the fields within ERROR percent, but no fewer than
 * CELLS.
 *
 *   ./09_report IN OUT ERROR CELLS
 *
 * Introduces several targets at once, and the report. A target that was missed is no failure: the
 * output is complete and valid. */
#include <stdio.h>
#include <tetstream/tetstream.h>

int main(int argc, char** argv) {
  tetstream_options* options = NULL;
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  if (argc != 5) return fprintf(stderr, "usage: 09_report IN OUT ERROR CELLS\n"), 1;

  const char* problem = NULL;
  tetstream_status status = TETSTREAM_OK;
  /* A newer library fills no more than this program knows. */
  tetstream_report report = {.struct_size = sizeof report};
  if (tetstream_options_create(&options) < 0 ||
      tetstream_options_parse(options, "error", argv[3]) < 0 ||
      tetstream_options_parse(options, "cells", argv[4]) < 0)
    problem = tetstream_options_message(options);
  else if (tetstream_reader_open_file(argv[1], NULL, &reader) < 0)
    problem = tetstream_reader_message(reader);
  else if (tetstream_writer_create_file(argv[2], NULL, &writer) < 0)
    problem = tetstream_writer_message(writer);
  else if (tetstream_simplifier_create(options, writer, &simplifier) < 0 ||
           (status = tetstream_simplifier_run(simplifier, reader)) < 0 ||
           tetstream_simplifier_get_report(simplifier, &report) < 0)
    problem = tetstream_simplifier_message(simplifier);

  if (problem) {
    fprintf(stderr, "09_report: %s\n", problem);
  } else {
    printf("cells      %lld -> %lld\n", (long long)report.cells_in, (long long)report.cells_out);
    printf("reached    %s\n", report.reached);
    printf("error      %.3g %% of the range, estimated\n", report.estimated_error);
    if (status == TETSTREAM_TARGET_MISSED) printf("missed     %s\n", report.limited_by);
    printf("regions    %s\n", report.regions);
    printf("order      %s\n", report.order);
    printf("memory     %llu bytes of the window\n", (unsigned long long)report.peak_window_bytes);
  }
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
  tetstream_options_destroy(options);
  return problem != NULL;
}
