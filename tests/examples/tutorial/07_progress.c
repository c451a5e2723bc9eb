/* How far a run is, and how to stop it: at Ctrl-C, or where the caller says.
 *
 *   ./07_progress IN OUT [STOP]
 *
 * Introduces the progress callback. A run that is stopped leaves no file; STOP is a fraction, after
 * which it is as if Ctrl-C had been pressed. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <tetstream/tetstream.h>

static volatile sig_atomic_t interrupted;

static void interrupt(int signal_number) {
  (void)signal_number;
  interrupted = 1;
}

/* Called once a window at least. The fraction is -1 if it is not known. */
static int32_t show(void* user, const tetstream_progress* progress) {
  const double* stop = user;
  if (progress->fraction >= 0)
    fprintf(stderr, "\r%-10s %3.0f %%", progress->phase, 100 * progress->fraction);
  return interrupted || progress->fraction > *stop;
}

int main(int argc, char** argv) {
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  double stop = argc == 4 ? atof(argv[3]) : 1;
  if (argc < 3 || argc > 4) return fprintf(stderr, "usage: 07_progress IN OUT [STOP]\n"), 1;
  signal(SIGINT, interrupt);

  const char* problem = NULL;
  tetstream_status status = TETSTREAM_OK;
  if (tetstream_reader_open_file(argv[1], NULL, &reader) < 0)
    problem = tetstream_reader_message(reader);
  else if (tetstream_writer_create_file(argv[2], NULL, &writer) < 0)
    problem = tetstream_writer_message(writer);
  else if (tetstream_simplifier_create(NULL, writer, &simplifier) < 0 ||
           tetstream_simplifier_set_progress(simplifier, show, &stop) < 0 ||
           (status = tetstream_simplifier_run(simplifier, reader)) < 0)
    problem = tetstream_simplifier_message(simplifier);
  fputc('\n', stderr);
  if (status == TETSTREAM_CANCELLED)
    printf("stopped\n");
  else if (problem)
    fprintf(stderr, "07_progress: %s\n", problem);
  else
    printf("complete\n");
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
  return problem != NULL;
}
