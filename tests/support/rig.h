/* tests/support: a simplifier with a writer into memory, for programs in C. */
#ifndef TETSTREAM_TEST_RIG_H
#define TETSTREAM_TEST_RIG_H

#include "check.h"
#include "hostile.h"

typedef struct rig {
  tetstream_options* options;
  tetstream_writer* writer;
  tetstream_simplifier* simplifier;
} rig;

static inline tetstream_options* options_of(double ratio) {
  tetstream_options* options = NULL;
  CHECK_EQUAL(tetstream_options_create(&options), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_options_set_double(options, TETSTREAM_OPTION_RATIO, ratio), TETSTREAM_OK);
  return options;
}

static inline rig rig_create_with_pilot(const char* format, const char* pilot) {
  rig r = {options_of(0.4), NULL, NULL};
  CHECK_EQUAL(tetstream_options_set_text(r.options, TETSTREAM_OPTION_PILOT, pilot), TETSTREAM_OK);
  /* So that a small mesh fills the window several times. */
  CHECK_EQUAL(tetstream_options_set_int64(r.options, TETSTREAM_OPTION_WINDOW, 400), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_memory(format, &r.writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_create(r.options, r.writer, &r.simplifier), TETSTREAM_OK);
  return r;
}

/* The same bytes wherever the input comes from. */
static inline rig rig_create(const char* format) {
  return rig_create_with_pilot(format, "none");
}

static inline void rig_destroy(rig r) {
  tetstream_simplifier_destroy(r.simplifier);
  tetstream_writer_destroy(r.writer);
  tetstream_options_destroy(r.options);
}

/* All of a mesh in one batch. One at a time: the pointers to its columns are shared. */
typedef struct whole {
  tetstream_stream_info info;
  tetstream_batch batch;
} whole;

static inline whole whole_of(const hostile_mesh* mesh) {
  static const void* pointers[3];
  whole w;
  hostile_mesh_info(mesh, &w.info);
  hostile_mesh_batch(mesh, &w.batch, pointers);
  return w;
}

/* To half of it, pushed into a simplifier or as the mesh in memory that it is. */
static inline void simplify_whole(tetstream_writer* writer, const whole* w, int pushed) {
  tetstream_options* options = options_of(0.5);
  tetstream_simplifier* simplifier = NULL;
  tetstream_reader* reader = NULL;
  CHECK_EQUAL(tetstream_simplifier_create(options, writer, &simplifier), TETSTREAM_OK);
  if (pushed) {
    tetstream_stream_info info = w->info;
    info.flags |= TETSTREAM_STREAM_INDEXED;
    CHECK_EQUAL(tetstream_simplifier_begin(simplifier, &info), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_simplifier_push(simplifier, &w->batch), TETSTREAM_OK);
    CHECK(tetstream_simplifier_finish(simplifier) >= 0);
  } else {
    CHECK_EQUAL(tetstream_reader_open_mesh(&w->info, &w->batch, &reader), TETSTREAM_OK);
    CHECK(tetstream_simplifier_run(simplifier, reader) >= 0);
  }
  tetstream_reader_destroy(reader);
  tetstream_simplifier_destroy(simplifier);
  tetstream_options_destroy(options);
}

/* The reader of what a writer in memory has, and what it carries. */
static inline tetstream_reader* read_back(tetstream_writer* writer, const char* format,
                                          tetstream_stream_info* info) {
  const void* data;
  size_t size;
  tetstream_reader* reader = NULL;
  info->struct_size = sizeof *info;
  CHECK_EQUAL(tetstream_writer_get_memory(writer, &data, &size), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_open_memory(data, size, format, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_get_info(reader, info), TETSTREAM_OK);
  return reader;
}

/* A reader of the mesh's own arrays, likewise. */
static inline tetstream_reader* arrays_of(const hostile_mesh* mesh) {
  const whole w = whole_of(mesh);
  tetstream_reader* reader = NULL;
  CHECK_EQUAL(tetstream_reader_open_mesh(&w.info, &w.batch, &reader), TETSTREAM_OK);
  return reader;
}

#endif
