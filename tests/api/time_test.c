/* The time of values through the C interface: it goes with a mesh into the files that hold it, and
 * to writers of callers; one that is not told, or not finite, does not. */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "rig.h"

static whole timed(const hostile_mesh* mesh, double time) {
  whole w = whole_of(mesh);
  w.info.flags |= TETSTREAM_STREAM_TIMED;
  w.info.time = time;
  return w;
}

/* Simplified as it is pushed, or as a mesh in memory. */
static void simplify_into(tetstream_writer* writer, const whole* w, int pushed) {
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

static void check_time_in(const char* format, const whole* w, int pushed, int is_told) {
  const void* data;
  size_t size;
  tetstream_writer* writer = NULL;
  tetstream_reader* reader = NULL;
  tetstream_stream_info info = {0};
  info.struct_size = sizeof info;
  CHECK_EQUAL(tetstream_writer_create_memory(format, &writer), TETSTREAM_OK);
  simplify_into(writer, w, pushed);
  CHECK_EQUAL(tetstream_writer_get_memory(writer, &data, &size), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_open_memory(data, size, format, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_get_info(reader, &info), TETSTREAM_OK);
  CHECK_EQUAL((info.flags & TETSTREAM_STREAM_TIMED) != 0, is_told);
  CHECK(info.time == (is_told ? w->info.time : 0));
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);
}

static void it_goes_with_the_mesh(void) {
  static const char* const formats[] = {"tets", "vtu", "msh", "exodus"};
  hostile_mesh* mesh = hostile_mesh_create(4, 4, 4);
  const whole w = timed(mesh, 1e-3);
  for (size_t i = 0; i < sizeof formats / sizeof *formats; ++i)
    for (int pushed = 0; pushed < 2; ++pushed) check_time_in(formats[i], &w, pushed, 1);
  whole untimed = w;
  untimed.info.flags = 0;
  check_time_in("tets", &untimed, 0, 0);
  check_time_in("vtu", &untimed, 1, 0);
  hostile_mesh_destroy(mesh);
}

/* As a structure is that was made before there was a time. */
static void it_needs_its_member(void) {
  hostile_mesh* mesh = hostile_mesh_create(4, 4, 4);
  whole w = timed(mesh, 1e-3);
  w.info.struct_size = offsetof(tetstream_stream_info, time);
  tetstream_reader* reader = NULL;
  CHECK_EQUAL(tetstream_reader_open_mesh(&w.info, &w.batch, &reader), TETSTREAM_OK);
  tetstream_stream_info info = {0};
  info.struct_size = sizeof info;
  CHECK_EQUAL(tetstream_reader_get_info(reader, &info), TETSTREAM_OK);
  CHECK(info.time == 0);
  tetstream_reader_destroy(reader);
  hostile_mesh_destroy(mesh);
}

static void notes_tell_one_that_is_left_out(void) {
  hostile_mesh* mesh = hostile_mesh_create(4, 4, 4);
  const whole w = timed(mesh, 1e-3);
  tetstream_writer* writer = NULL;
  CHECK_EQUAL(tetstream_writer_create_memory("vtk", &writer), TETSTREAM_OK);
  simplify_into(writer, &w, 0);
  const char* note = tetstream_writer_note(writer, 0);
  CHECK(note && strcmp(note, ".vtk has no time of its values; it is left out: 0.001") == 0);
  tetstream_writer_destroy(writer);
  hostile_mesh_destroy(mesh);
}

static void one_that_is_not_finite_is_refused(void) {
  hostile_mesh* mesh = hostile_mesh_create(4, 4, 4);
  const whole w = timed(mesh, (double)NAN);
  tetstream_reader* reader = NULL;
  CHECK_EQUAL(tetstream_reader_open_mesh(&w.info, &w.batch, &reader), TETSTREAM_BAD_ARGUMENT);
  CHECK(strstr(tetstream_reader_message(reader), "the time is not finite") != NULL);
  tetstream_reader_destroy(reader);
  hostile_mesh_destroy(mesh);
}

int main(void) {
  RUN_CASE(it_goes_with_the_mesh);
  RUN_CASE(it_needs_its_member);
  RUN_CASE(notes_tell_one_that_is_left_out);
  RUN_CASE(one_that_is_not_finite_is_refused);
  return check_end();
}
