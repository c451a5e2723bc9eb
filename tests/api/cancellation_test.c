/* A thread that is cancelled inside a call ends when the call has returned, whatever the call does
 * meanwhile: it reads, writes, calls back, waits for its threads, destroys what has them. A call
 * that waits for its input can be stopped. */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "check.h"
#include "tetstream/tetstream.h"

typedef struct job {
  pthread_t thread;
  int32_t threads;
  char path[64];
  int is_cancelled, has_run, has_ended;
  tetstream_status status;
} job;

/* Nothing is asked for sooner than the first batch is out, so that files and threads are there. */
static int32_t cancel_myself(void* user, const tetstream_progress* progress) {
  job* j = user;
  if (progress->cells_read == 0 || j->is_cancelled) return 0;
  j->is_cancelled = 1;
  CHECK_EQUAL(pthread_cancel(j->thread), 0);
  pthread_testcancel();
  return 0;
}

static void* work(void* argument) {
  job* j = argument;
  tetstream_options* options = NULL;
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  j->thread = pthread_self();
  CHECK_EQUAL(tetstream_options_create(&options), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_options_set_int64(options, TETSTREAM_OPTION_THREADS, j->threads),
              TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_generate("fluid", 20000, 1, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_file(j->path, NULL, &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_create(options, writer, &simplifier), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_set_progress(simplifier, cancel_myself, j), TETSTREAM_OK);
  j->status = tetstream_simplifier_run(simplifier, reader);
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
  tetstream_options_destroy(options);
  j->has_run = 1;
  pthread_testcancel();
  j->has_ended = 1;
  return NULL;
}

static void a_cancelled_thread_ends_after_its_call(void) {
  for (int32_t threads = 1; threads <= 4; threads += 3) {
    job j = {0};
    pthread_t thread;
    void* result = NULL;
    j.threads = threads;
    snprintf(j.path, sizeof j.path, "/tmp/tetstream_cancel_%ld_%d.vtu", (long)getpid(), threads);
    CHECK_EQUAL(pthread_create(&thread, NULL, work, &j), 0);
    CHECK_EQUAL(pthread_join(thread, &result), 0);
    CHECK_EQUAL(j.is_cancelled, 1);
    CHECK(j.status >= 0);
    CHECK_EQUAL(j.has_run, 1);
    CHECK_EQUAL(j.has_ended, 0);
    CHECK(result == PTHREAD_CANCELED);
    CHECK_EQUAL(unlink(j.path), 0);
  }
}

static void* work_that_may_be_cancelled(void* argument) {
  const int* may = argument;
  int before = -1;
  tetstream_reader* reader = NULL;
  if (!*may) pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, NULL);
  CHECK_EQUAL(tetstream_reader_open_file("nowhere.vtu", NULL, &reader), TETSTREAM_IO);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &before), 0);
  CHECK_EQUAL(before == PTHREAD_CANCEL_ENABLE, *may);
  return NULL;
}

static void a_call_leaves_the_thread_as_it_was(void) {
  for (int may = 0; may < 2; ++may) {
    pthread_t thread;
    CHECK_EQUAL(pthread_create(&thread, NULL, work_that_may_be_cancelled, &may), 0);
    CHECK_EQUAL(pthread_join(thread, NULL), 0);
  }
}

/* Nothing was told since the last batch, and yet it is called. */
static int32_t stop_after_some(void* user, const tetstream_progress* progress) {
  CHECK(progress->phase != NULL && progress->phase[0] != 0);
  return ++*(int*)user > 20;
}

/* The first `bytes` of a file, by a pipe that stays open; returns its other end. */
static int begin_of(const char* path, size_t bytes, int* in) {
  int ends[2];
  char* begin = malloc(bytes);
  FILE* file = fopen(path, "rb");
  CHECK_EQUAL(pipe(ends), 0);
  CHECK(file && begin && fread(begin, 1, bytes, file) == bytes);
  CHECK_EQUAL(write(ends[1], begin, bytes), (int64_t)bytes);
  if (file) fclose(file);
  free(begin);
  *in = ends[0];
  return ends[1];
}

/* Also where other threads read, and the caller's waits for them. */
static void a_run_can_be_stopped_while_its_input_stalls(void) {
  char path[64], in_path[32];
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  snprintf(path, sizeof path, "/tmp/tetstream_stall_%ld.tets", (long)getpid());
  CHECK_EQUAL(tetstream_reader_generate("fluid", 20000, 1, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_file(path, NULL, &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(reader, writer, NULL, NULL, NULL), TETSTREAM_OK);
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
  for (int32_t threads = 1; threads <= 3; threads += 2) {
    tetstream_options* options = NULL;
    tetstream_simplifier* simplifier = NULL;
    int in = -1, called = 0, out = begin_of(path, 5000, &in);
    snprintf(in_path, sizeof in_path, "/dev/fd/%d", in);
    CHECK_EQUAL(tetstream_options_create(&options), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_options_set_int64(options, TETSTREAM_OPTION_THREADS, threads),
                TETSTREAM_OK);
    CHECK_EQUAL(tetstream_reader_open_file(in_path, "tets", &reader), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_writer_create_memory("tets", &writer), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_simplifier_create(options, writer, &simplifier), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_simplifier_set_progress(simplifier, stop_after_some, &called),
                TETSTREAM_OK);
    CHECK_EQUAL(tetstream_simplifier_run(simplifier, reader), TETSTREAM_CANCELLED);
    tetstream_simplifier_destroy(simplifier);
    tetstream_writer_destroy(writer);
    tetstream_reader_destroy(reader);
    tetstream_options_destroy(options);
    close(in);
    close(out);
  }
  CHECK_EQUAL(unlink(path), 0);
}

/* Of a header, and of a file that is put aside first, as it is not read in its order. */
static void opening_can_be_stopped_while_its_input_stalls(void) {
  const char* const formats[2] = {"tets", "vtu"};
  for (size_t i = 0; i < 2; ++i) {
    int ends[2], called = 0;
    tetstream_options* options = NULL;
    tetstream_reader* reader = NULL;
    CHECK_EQUAL(pipe(ends), 0);
    CHECK_EQUAL(write(ends[1], "<VTK", i * 4), (int64_t)i * 4);
    CHECK_EQUAL(tetstream_options_create(&options), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_options_set_progress(options, stop_after_some, &called), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_reader_open_fd_with(ends[0], formats[i], options, &reader),
                TETSTREAM_CANCELLED);
    CHECK(called > 20);
    tetstream_reader_destroy(reader);
    tetstream_options_destroy(options);
    close(ends[0]);
    close(ends[1]);
  }
}

int main(void) {
  RUN_CASE(a_cancelled_thread_ends_after_its_call);
  RUN_CASE(a_call_leaves_the_thread_as_it_was);
  RUN_CASE(a_run_can_be_stopped_while_its_input_stalls);
  RUN_CASE(opening_can_be_stopped_while_its_input_stalls);
  return check_end();
}
