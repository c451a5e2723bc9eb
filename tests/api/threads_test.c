/* Different handles may be used at once: many runs on many threads give the bytes of one. */
#include <pthread.h>
#include <stdlib.h>

#include "check.h"
#include "tetstream/tetstream.h"

typedef struct job {
  int32_t seed;
  tetstream_status status;
  char message[256];
  unsigned char* bytes;
  size_t size;
} job;

static int64_t cell_count(void) {
  return getenv("TETSTREAM_SLOW") ? 3000 : 6000;
}

static tetstream_status simplify(job* j) {
  tetstream_options* options = NULL;
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  const void* data = NULL;
  tetstream_status status = tetstream_options_create(&options);
  if (status >= 0) status = tetstream_options_set_double(options, TETSTREAM_OPTION_RATIO, 0.3);
  if (status >= 0) status = tetstream_reader_generate("fluid", cell_count(), j->seed, &reader);
  if (status >= 0) status = tetstream_writer_create_memory("tets", &writer);
  if (status >= 0) status = tetstream_simplifier_create(options, writer, &simplifier);
  if (status >= 0) status = tetstream_simplifier_run(simplifier, reader);
  snprintf(j->message, sizeof j->message, "%s", tetstream_simplifier_message(simplifier));
  if (status >= 0) status = tetstream_writer_get_memory(writer, &data, &j->size);
  if (status >= 0) {
    j->bytes = malloc(j->size);
    if (j->bytes) memcpy(j->bytes, data, j->size);
  }
  tetstream_simplifier_destroy(simplifier);
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);
  tetstream_options_destroy(options);
  return status;
}

static void* work(void* argument) {
  job* j = argument;
  j->status = simplify(j);
  return NULL;
}

#define THREADS 6

static void runs_at_once_give_the_bytes_of_runs_alone(void) {
  job alone[2] = {{0}}, at_once[THREADS] = {{0}};
  pthread_t threads[THREADS];
  for (int i = 0; i < 2; ++i) {
    alone[i].seed = i + 1;
    work(&alone[i]);
    CHECK(alone[i].status >= 0);
    CHECK(alone[i].bytes && alone[i].size > 0);
  }
  CHECK(alone[0].size != alone[1].size ||
        memcmp(alone[0].bytes, alone[1].bytes, alone[0].size) != 0);
  for (int i = 0; i < THREADS; ++i) {
    at_once[i].seed = i % 2 + 1;
    CHECK_EQUAL(pthread_create(&threads[i], NULL, work, &at_once[i]), 0);
  }
  for (int i = 0; i < THREADS; ++i) {
    const job* same = &alone[i % 2];
    CHECK_EQUAL(pthread_join(threads[i], NULL), 0);
    CHECK_EQUAL(at_once[i].status, same->status);
    CHECK_SAYS(at_once[i].message, "");
    CHECK_EQUAL(at_once[i].size, same->size);
    CHECK(at_once[i].bytes && at_once[i].size == same->size &&
          memcmp(at_once[i].bytes, same->bytes, same->size) == 0);
    free(at_once[i].bytes);
  }
  free(alone[0].bytes);
  free(alone[1].bytes);
}

/* A stream that is handed on, batch by batch, to a simplifier that has threads. */
typedef struct relay {
  tetstream_simplifier* simplifier;
  int batches_left; /* then no more is handed on */
} relay;

static int32_t begin_there(void* user, const tetstream_stream_info* info) {
  relay* r = user;
  CHECK_EQUAL(tetstream_simplifier_begin(r->simplifier, info), TETSTREAM_OK);
  return 0;
}

static int32_t push_there(void* user, const tetstream_batch* batch) {
  relay* r = user;
  CHECK_EQUAL(tetstream_simplifier_push(r->simplifier, batch), TETSTREAM_OK);
  return --r->batches_left > 0 ? 0 : 1;
}

/* What is put into the file meanwhile, by another thread, is not pulled away from under it. */
static void a_writer_may_go_while_its_stream_is_written_behind(void) {
  const int step = getenv("TETSTREAM_SLOW") ? 12 : 1;
  for (int round = 0; round < 24; round += step) {
    tetstream_options* options = NULL;
    tetstream_writer *writer = NULL, *handing_on = NULL;
    tetstream_reader* reader = NULL;
    tetstream_report report = {0};
    relay r = {NULL, 8 + round};
    tetstream_writer_callbacks hands_on = {0};
    hands_on.struct_size = sizeof hands_on;
    hands_on.user = &r;
    hands_on.open = begin_there;
    hands_on.put = push_there;
    report.struct_size = sizeof report;
    CHECK_EQUAL(tetstream_options_create(&options), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_options_set_double(options, TETSTREAM_OPTION_RATIO, 0.9), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_options_set_int64(options, TETSTREAM_OPTION_THREADS, 4), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_options_set_int64(options, TETSTREAM_OPTION_WINDOW, 1), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_writer_create_memory("vtu", &writer), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_simplifier_create(options, writer, &r.simplifier), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_reader_generate("fluid", 200000, 1, &reader), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_writer_create(&hands_on, &handing_on), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_convert(reader, handing_on, NULL, NULL, NULL), TETSTREAM_CALLBACK);
    tetstream_writer_destroy(writer);
    CHECK_EQUAL(tetstream_simplifier_get_report(r.simplifier, &report), TETSTREAM_OK);
    CHECK(report.cells_in > 0);
    tetstream_simplifier_destroy(r.simplifier);
    tetstream_reader_destroy(reader);
    tetstream_writer_destroy(handing_on);
    tetstream_options_destroy(options);
  }
}

int main(void) {
  RUN_CASE(runs_at_once_give_the_bytes_of_runs_alone);
  RUN_CASE(a_writer_may_go_while_its_stream_is_written_behind);
  return check_end();
}
