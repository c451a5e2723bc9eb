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

static void check_time_in(const char* format, const whole* w, int pushed, int is_told) {
  tetstream_writer* writer = NULL;
  tetstream_stream_info info = {0};
  CHECK_EQUAL(tetstream_writer_create_memory(format, &writer), TETSTREAM_OK);
  simplify_whole(writer, w, pushed);
  tetstream_reader* reader = read_back(writer, format, &info);
  CHECK_EQUAL((info.flags & TETSTREAM_STREAM_TIMED) != 0, is_told);
  CHECK(info.time == (is_told ? w->info.time : 0));
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);
}

static void it_goes_with_the_mesh(void) {
  static const char* const formats[] = {"tets", "vtu", "vtk", "msh", "exodus"};
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
  CHECK_EQUAL(info.flags & TETSTREAM_STREAM_TIMED, 0);
  CHECK(info.time == 0);
  tetstream_reader_destroy(reader);
  w.info.struct_size = sizeof w.info;
  CHECK_EQUAL(tetstream_reader_open_mesh(&w.info, &w.batch, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_get_info(reader, &info), TETSTREAM_OK);
  CHECK(info.flags & TETSTREAM_STREAM_TIMED);
  info.struct_size = offsetof(tetstream_stream_info, time);
  CHECK_EQUAL(tetstream_reader_get_info(reader, &info), TETSTREAM_OK);
  CHECK_EQUAL(info.flags & TETSTREAM_STREAM_TIMED, 0);
  tetstream_reader_destroy(reader);
  hostile_mesh_destroy(mesh);
}

static int32_t take_time(void* user, const tetstream_stream_info* info) {
  if (info->flags & TETSTREAM_STREAM_TIMED) *(double*)user = info->time;
  return 0;
}

static int32_t take_nothing(void* user, const tetstream_batch* batch) {
  (void)user;
  (void)batch;
  return 0;
}

static void writers_of_callers_get_it(void) {
  hostile_mesh* mesh = hostile_mesh_create(4, 4, 4);
  const whole w = timed(mesh, 1e-3);
  tetstream_writer* writer = NULL;
  double time = 0;
  const tetstream_writer_callbacks callbacks = {sizeof callbacks, &time, take_time,
                                                take_nothing,     NULL,  NULL};
  CHECK_EQUAL(tetstream_writer_create(&callbacks, &writer), TETSTREAM_OK);
  simplify_whole(writer, &w, 0);
  CHECK(time == 1e-3);
  tetstream_writer_destroy(writer);
  hostile_mesh_destroy(mesh);
}

static void notes_tell_one_that_is_left_out(void) {
  hostile_mesh* mesh = hostile_mesh_create(4, 4, 4);
  const whole w = timed(mesh, 1e-3);
  tetstream_writer* writer = NULL;
  CHECK_EQUAL(tetstream_writer_create_memory("sva", &writer), TETSTREAM_OK);
  simplify_whole(writer, &w, 0);
  const char* note = tetstream_writer_note(writer, 0);
  CHECK(note && strcmp(note, ".sva has no time of its values; it is left out: 0.001") == 0);
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
  RUN_CASE(writers_of_callers_get_it);
  RUN_CASE(notes_tell_one_that_is_left_out);
  RUN_CASE(one_that_is_not_finite_is_refused);
  return check_end();
}
