/* How much stack a thread needs that calls, as tetstream(3) says it. */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include <stdlib.h>
#include <unistd.h>

#include "check.h"
#include "tetstream/tetstream.h"

#define STACK_BYTES (128 << 10)

static char path[64];

static tetstream_status simplify(tetstream_reader* reader, tetstream_writer* writer) {
  tetstream_options* options = NULL;
  tetstream_simplifier* simplifier = NULL;
  tetstream_options_create(&options);
  tetstream_options_set_double(options, TETSTREAM_OPTION_RATIO, 0.3);
  tetstream_simplifier_create(options, writer, &simplifier);
  const tetstream_status status = tetstream_simplifier_run(simplifier, reader);
  tetstream_options_destroy(options);
  tetstream_simplifier_destroy(simplifier);
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);
  return status;
}

/* Cells of .vtk come by many arrays in turn. */
static void* write_and_simplify(void* unused) {
  (void)unused;
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  CHECK_EQUAL(tetstream_reader_generate("ball", 3000, 1, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_file(path, NULL, &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(reader, writer, NULL, NULL, NULL), TETSTREAM_OK);
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);
  CHECK_EQUAL(tetstream_reader_open_file(path, NULL, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_memory("vtk", &writer), TETSTREAM_OK);
  CHECK(simplify(reader, writer) >= 0);
  return NULL;
}

static void a_thread_of_a_small_stack_can_call(void) {
  pthread_attr_t attributes;
  pthread_t thread;
  CHECK_EQUAL(pthread_attr_init(&attributes), 0);
  CHECK_EQUAL(pthread_attr_setstacksize(&attributes, STACK_BYTES), 0);
  if (CHECK(pthread_create(&thread, &attributes, write_and_simplify, NULL) == 0))
    CHECK_EQUAL(pthread_join(thread, NULL), 0);
  CHECK_EQUAL(pthread_attr_destroy(&attributes), 0);
}

int main(void) {
#ifndef SMALL_FRAMES
  printf("not run: without optimisation, or with sanitizers, functions take more\n");
  return 77;
#endif
  const char* folder = getenv("TMPDIR");
  snprintf(path, sizeof path, "%s/tetstream-stack-%ld.vtk",
           folder && strlen(folder) < 24 ? folder : "/tmp", (long)getpid());
  RUN_CASE(a_thread_of_a_small_stack_can_call);
  unlink(path);
  return check_end();
}
