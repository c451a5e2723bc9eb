/* Simplifiers: their states, progress, reports, wrong calls. */
#include <stdlib.h>

#include "rig.h"

static hostile_mesh* mesh;

/* -------------------------------------------------------------------------------- the report */

static void the_report_agrees_with_what_came_out(void) {
  hostile_writer hostile = {0};
  const tetstream_writer_callbacks writes = hostile_writer_callbacks(&hostile);
  tetstream_options* options = options_of(0.5);
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  tetstream_reader* reader = arrays_of(mesh);
  tetstream_report report = {0};
  report.struct_size = sizeof report;
  CHECK_EQUAL(tetstream_writer_create(&writes, &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_create(options, writer, &simplifier), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_get_report(simplifier, &report), TETSTREAM_OK);
  CHECK_EQUAL(report.cells_in, 0);
  CHECK(report.regions && report.limited_by);
  const tetstream_status status = tetstream_simplifier_run(simplifier, reader);
  CHECK(status >= 0);
  CHECK_EQUAL(tetstream_simplifier_get_report(simplifier, &report), TETSTREAM_OK);
  CHECK_EQUAL(report.struct_size, sizeof report);
  CHECK_EQUAL(report.cells_in, mesh->cell_count);
  CHECK_EQUAL(report.vertices_in, mesh->vertex_count);
  CHECK_EQUAL(report.cells_out, hostile.cells);
  CHECK_EQUAL(report.vertices_out, hostile.vertices);
  CHECK(report.seconds > 0);
  CHECK_EQUAL(status == TETSTREAM_TARGET_MISSED, report.limited_by[0] != 0);
  CHECK_EQUAL(status == TETSTREAM_TARGET_MISSED, report.cells_out > report.target_cells);
  tetstream_reader_destroy(reader);
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
  tetstream_options_destroy(options);
  hostile_writer_free(&hostile);
}

/* A caller who locks everything keeps everything, whichever way it comes. */
static void locked_vertices_stay(void) {
  uint8_t* locked = malloc((size_t)mesh->vertex_count);
  memset(locked, 1, (size_t)mesh->vertex_count);
  for (uint32_t flags = 0; flags <= TETSTREAM_STREAM_INDEXED; ++flags) {
    rig r = rig_create("tets");
    tetstream_stream_info info;
    tetstream_batch batch;
    const void* pointers[3];
    tetstream_report report = {0};
    report.struct_size = sizeof report;
    hostile_mesh_info(mesh, &info);
    hostile_mesh_batch(mesh, &batch, pointers);
    info.flags = flags;
    batch.locked = locked;
    CHECK_EQUAL(tetstream_simplifier_begin(r.simplifier, &info), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_simplifier_push(r.simplifier, &batch), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_simplifier_finish(r.simplifier), TETSTREAM_TARGET_MISSED);
    CHECK_EQUAL(tetstream_simplifier_get_report(r.simplifier, &report), TETSTREAM_OK);
    CHECK_EQUAL(report.cells_out, mesh->cell_count);
    CHECK_EQUAL(report.vertices_out, mesh->vertex_count);
    CHECK_SAYS(report.limited_by, "locked");
    rig_destroy(r);
  }
  free(locked);
}

static void report_structs_of_other_sizes_are_respected(void) {
  struct {
    tetstream_report report;
    unsigned char more[24];
  } later;
  rig r = rig_create("tets");
  memset(&later, 0x5a, sizeof later);
  later.report.struct_size = sizeof later;
  CHECK_EQUAL(tetstream_simplifier_get_report(r.simplifier, &later.report), TETSTREAM_OK);
  CHECK_EQUAL(later.report.cells_in, 0);
  CHECK_EQUAL(later.report.struct_size, sizeof later);
  for (size_t i = 0; i < sizeof later.more; ++i) CHECK_EQUAL(later.more[i], 0x5a);
  memset(&later, 0x5a, sizeof later);
  later.report.struct_size = offsetof(tetstream_report, limited_by);
  CHECK_EQUAL(tetstream_simplifier_get_report(r.simplifier, &later.report), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(later.report.cells_out, 0x5a5a5a5a5a5a5a5a);
  rig_destroy(r);
}

/* The texts of the first are still there. */
static void a_stream_that_stands_has_one_report(void) {
  rig r = rig_create("tets");
  whole w = whole_of(mesh);
  tetstream_report first = {0}, second = {0};
  first.struct_size = second.struct_size = sizeof first;
  CHECK_EQUAL(tetstream_simplifier_begin(r.simplifier, &w.info), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_get_report(r.simplifier, &first), TETSTREAM_OK);
  CHECK_EQUAL(first.cells_in, 0);
  CHECK_EQUAL(tetstream_simplifier_push(r.simplifier, &w.batch), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_get_report(r.simplifier, &first), TETSTREAM_OK);
  CHECK_EQUAL(first.cells_in, mesh->cell_count);
  CHECK_EQUAL(tetstream_simplifier_get_report(r.simplifier, &second), TETSTREAM_OK);
  CHECK(first.order == second.order && first.balance == second.balance);
  tetstream_writer_destroy(r.writer);
  r.writer = NULL;
  CHECK_EQUAL(strcmp(first.order, second.order), 0);
  rig_destroy(r);
}

/* ------------------------------------------------------------------------------ the progress */

typedef struct watcher {
  int calls, cancel_at;
  double fraction;
  int64_t cells_read;
  tetstream_simplifier* simplifier;
} watcher;

static int32_t watch(void* user, const tetstream_progress* progress) {
  watcher* w = user;
  ++w->calls;
  CHECK(progress->struct_size >= sizeof *progress);
  CHECK(progress->phase && progress->phase[0]);
  CHECK(progress->fraction == -1 || (progress->fraction >= 0 && progress->fraction <= 1.000001));
  CHECK(progress->cells_read >= w->cells_read);
  w->cells_read = progress->cells_read;
  if (w->simplifier) {
    tetstream_report report = {0};
    report.struct_size = sizeof report;
    CHECK_EQUAL(tetstream_simplifier_get_report(w->simplifier, &report), TETSTREAM_BAD_STATE);
    CHECK_EQUAL(tetstream_simplifier_finish(w->simplifier), TETSTREAM_BAD_STATE);
  }
  return w->calls == w->cancel_at ? 17 : 0;
}

static tetstream_status watched(watcher* w, hostile_writer* out, int reenter) {
  const tetstream_writer_callbacks writes = hostile_writer_callbacks(out);
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  tetstream_reader* reader = NULL;
  CHECK_EQUAL(tetstream_reader_generate("fluid", 20000, 3, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create(&writes, &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_create(NULL, writer, &simplifier), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_set_progress(simplifier, watch, w), TETSTREAM_OK);
  w->simplifier = reenter ? simplifier : NULL;
  const tetstream_status status = tetstream_simplifier_run(simplifier, reader);
  if (status < 0) CHECK_SAYS(tetstream_simplifier_message(simplifier), "17");
  tetstream_reader_destroy(reader);
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
  CHECK_EQUAL(out->stream_errors + out->order_errors, 0);
  hostile_writer_free(out);
  return status;
}

static void progress_cancels_at_any_call(void) {
  watcher all = {0};
  hostile_writer quiet = {0};
  CHECK(watched(&all, &quiet, 0) >= 0);
  CHECK(all.calls > 1);
  CHECK_EQUAL(quiet.finishes, 1);
  const int step = all.calls > 12 ? all.calls / 12 : 1;
  for (int call = 1; call <= all.calls; call += step) {
    watcher w = {0};
    hostile_writer out = {0};
    w.cancel_at = call;
    CHECK_EQUAL(watched(&w, &out, 0), TETSTREAM_CANCELLED);
    CHECK_EQUAL(w.calls, call);
    CHECK_EQUAL(out.closes, out.opens);
    CHECK_EQUAL(out.finishes, 0);
  }
}

static void calls_from_inside_a_callback_are_refused(void) {
  watcher w = {0};
  hostile_writer out = {0};
  CHECK(watched(&w, &out, 1) >= 0);
  CHECK_EQUAL(out.finishes, 1);
}

/* -------------------------------------------------------------------------------- the states */

static void wrong_states_are_named(void) {
  rig r = rig_create("tets");
  whole w = whole_of(mesh);
  CHECK_EQUAL(tetstream_simplifier_push(r.simplifier, &w.batch), TETSTREAM_BAD_STATE);
  CHECK_SAYS(tetstream_simplifier_message(r.simplifier), "tetstream_simplifier_push");
  CHECK_SAYS(tetstream_simplifier_message(r.simplifier), "has not begun");
  CHECK_EQUAL(tetstream_simplifier_finish(r.simplifier), TETSTREAM_BAD_STATE);

  CHECK_EQUAL(tetstream_simplifier_begin(r.simplifier, &w.info), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_begin(r.simplifier, &w.info), TETSTREAM_BAD_STATE);
  CHECK_SAYS(tetstream_simplifier_message(r.simplifier), "has begun");
  CHECK_EQUAL(tetstream_simplifier_set_progress(r.simplifier, NULL, NULL), TETSTREAM_BAD_STATE);
  tetstream_reader* reader = arrays_of(mesh);
  CHECK_EQUAL(tetstream_simplifier_run(r.simplifier, reader), TETSTREAM_BAD_STATE);
  CHECK_EQUAL(tetstream_simplifier_push(r.simplifier, NULL), TETSTREAM_BAD_ARGUMENT);

  /* None of that did harm. */
  CHECK_EQUAL(tetstream_simplifier_push(r.simplifier, &w.batch), TETSTREAM_OK);
  CHECK(tetstream_simplifier_finish(r.simplifier) >= 0);
  CHECK_EQUAL(tetstream_simplifier_push(r.simplifier, &w.batch), TETSTREAM_BAD_STATE);
  CHECK_SAYS(tetstream_simplifier_message(r.simplifier), "has finished");
  CHECK_EQUAL(tetstream_simplifier_finish(r.simplifier), TETSTREAM_BAD_STATE);

  /* The writer is used up, the reader is not. */
  tetstream_simplifier* second = NULL;
  CHECK_EQUAL(tetstream_simplifier_create(r.options, r.writer, &second), TETSTREAM_BAD_STATE);
  CHECK_SAYS(tetstream_simplifier_message(second), "writer");
  CHECK_EQUAL(tetstream_simplifier_run(second, reader), TETSTREAM_BAD_STATE);
  tetstream_simplifier_destroy(second);
  rig_destroy(r);
  r = rig_create("tets");
  CHECK(tetstream_simplifier_run(r.simplifier, reader) >= 0);
  rig_destroy(r);

  /* Now it is. */
  r = rig_create("tets");
  CHECK_EQUAL(tetstream_simplifier_run(r.simplifier, reader), TETSTREAM_BAD_STATE);
  CHECK_SAYS(tetstream_simplifier_message(r.simplifier), "reader");
  tetstream_reader_destroy(reader);
  reader = arrays_of(mesh);
  CHECK(tetstream_simplifier_run(r.simplifier, reader) >= 0);
  tetstream_reader_destroy(reader);
  rig_destroy(r);
}

static void check_counts(const tetstream_simplifier* simplifier, const char* order) {
  tetstream_report report = {0};
  report.struct_size = sizeof report;
  CHECK_EQUAL(tetstream_simplifier_get_report(simplifier, &report), TETSTREAM_OK);
  CHECK_EQUAL(report.cells_in, mesh->cell_count);
  CHECK_EQUAL(report.vertices_in, mesh->vertex_count);
  CHECK_SAYS(report.order, order);
  CHECK(report.peak_window_bytes > 0);
}

static void a_report_says_what_was_done_so_far(void) {
  rig r = rig_create("tets");
  whole w = whole_of(mesh);
  w.info.flags = 0;
  CHECK_EQUAL(tetstream_simplifier_begin(r.simplifier, &w.info), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_push(r.simplifier, &w.batch), TETSTREAM_OK);
  check_counts(r.simplifier, "none: the stream is as it was");
  w.batch.cell_count = -2;
  CHECK_EQUAL(tetstream_simplifier_push(r.simplifier, &w.batch), TETSTREAM_BAD_DATA);
  check_counts(r.simplifier, "none: the stream is as it was");
  rig_destroy(r);
}

static void a_failed_push_breaks_the_simplifier_alone(void) {
  rig r = rig_create("tets");
  whole w = whole_of(mesh);
  tetstream_report report = {0};
  report.struct_size = sizeof report;
  w.batch.cell_count = -2;
  CHECK_EQUAL(tetstream_simplifier_begin(r.simplifier, &w.info), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_push(r.simplifier, &w.batch), TETSTREAM_BAD_DATA);
  CHECK_SAYS(tetstream_simplifier_message(r.simplifier), "-2");
  CHECK_EQUAL(tetstream_simplifier_push(r.simplifier, &w.batch), TETSTREAM_BAD_STATE);
  CHECK_SAYS(tetstream_simplifier_message(r.simplifier), "failed before");
  CHECK_EQUAL(tetstream_simplifier_get_report(r.simplifier, &report), TETSTREAM_OK);
  const void* data = NULL;
  size_t length = 0;
  CHECK_EQUAL(tetstream_writer_get_memory(r.writer, &data, &length), TETSTREAM_BAD_STATE);
  rig_destroy(r);
}

static void fields_that_do_not_exist_are_told_when_the_stream_begins(void) {
  rig r = rig_create("tets");
  tetstream_simplifier* simplifier = NULL;
  tetstream_stream_info info;
  hostile_mesh_info(mesh, &info);
  CHECK_EQUAL(tetstream_options_add_field(r.options, "no-such-field", 1), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_create(r.options, r.writer, &simplifier), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_begin(simplifier, &info), TETSTREAM_BAD_ARGUMENT);
  CHECK_SAYS(tetstream_simplifier_message(simplifier), "no-such-field");
  tetstream_simplifier_destroy(simplifier);
  rig_destroy(r);
}

/* Every order of destroying three handles in the middle of a stream. */
static void handles_are_destroyed_in_any_order(void) {
  static const int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                   {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (int i = 0; i < 12; ++i) {
    hostile_writer hostile = {0};
    const tetstream_writer_callbacks writes = hostile_writer_callbacks(&hostile);
    tetstream_options* options = options_of(0.5);
    tetstream_writer* writer = NULL;
    tetstream_simplifier* simplifier = NULL;
    tetstream_stream_info info;
    tetstream_batch batch;
    const void* pointers[3];
    hostile_mesh_info(mesh, &info);
    hostile_mesh_batch(mesh, &batch, pointers);
    CHECK_EQUAL(tetstream_writer_create(&writes, &writer), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_simplifier_create(options, writer, &simplifier), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_simplifier_begin(simplifier, &info), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_simplifier_push(simplifier, &batch), TETSTREAM_OK);
    if (i >= 6) CHECK(tetstream_simplifier_finish(simplifier) >= 0);
    for (int j = 0; j < 3; ++j) {
      if (orders[i % 6][j] == 0) tetstream_options_destroy(options);
      if (orders[i % 6][j] == 1) tetstream_writer_destroy(writer);
      if (orders[i % 6][j] == 2) tetstream_simplifier_destroy(simplifier);
    }
    CHECK_EQUAL(hostile.closes, hostile.opens);
    CHECK_EQUAL(hostile.finishes, i >= 6);
    CHECK_EQUAL(hostile.order_errors, 0);
    hostile_writer_free(&hostile);
  }
}

static void a_simplifier_without_its_writer_can_only_be_destroyed(void) {
  rig r = rig_create("tets");
  whole w = whole_of(mesh);
  CHECK_EQUAL(tetstream_simplifier_begin(r.simplifier, &w.info), TETSTREAM_OK);
  tetstream_writer_destroy(r.writer);
  r.writer = NULL;
  CHECK_EQUAL(tetstream_simplifier_push(r.simplifier, &w.batch), TETSTREAM_BAD_STATE);
  CHECK_SAYS(tetstream_simplifier_message(r.simplifier), "writer was destroyed");
  CHECK_EQUAL(tetstream_simplifier_finish(r.simplifier), TETSTREAM_BAD_STATE);
  rig_destroy(r);
}

static void null_is_refused_everywhere(void) {
  rig r = rig_create("tets");
  tetstream_simplifier* simplifier = NULL;
  tetstream_stream_info info;
  tetstream_batch batch = {0};
  tetstream_report report = {0};
  hostile_mesh_info(mesh, &info);
  report.struct_size = sizeof report;
  batch.struct_size = sizeof batch;
  CHECK_EQUAL(tetstream_simplifier_create(r.options, NULL, &simplifier), TETSTREAM_BAD_ARGUMENT);
  CHECK_SAYS(tetstream_simplifier_message(simplifier), "writer is NULL");
  CHECK_EQUAL(tetstream_simplifier_begin(simplifier, &info), TETSTREAM_BAD_STATE);
  CHECK_EQUAL(tetstream_simplifier_get_report(simplifier, &report), TETSTREAM_BAD_STATE);
  CHECK_EQUAL(tetstream_simplifier_set_progress(simplifier, NULL, NULL), TETSTREAM_BAD_STATE);
  tetstream_simplifier_destroy(simplifier);
  CHECK_EQUAL(tetstream_simplifier_create(r.options, r.writer, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_simplifier_set_progress(NULL, watch, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_simplifier_run(NULL, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_simplifier_run(r.simplifier, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_simplifier_begin(NULL, &info), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_simplifier_begin(r.simplifier, NULL), TETSTREAM_BAD_ARGUMENT);
  info.struct_size = offsetof(tetstream_stream_info, box_max);
  CHECK_EQUAL(tetstream_simplifier_begin(r.simplifier, &info), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_simplifier_push(NULL, &batch), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_simplifier_finish(NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_simplifier_get_report(NULL, &report), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_simplifier_get_report(r.simplifier, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK(tetstream_simplifier_message(NULL) != NULL);
  tetstream_simplifier_destroy(NULL);

  /* One member short of a batch. */
  info.struct_size = sizeof info;
  CHECK_EQUAL(tetstream_simplifier_begin(r.simplifier, &info), TETSTREAM_OK);
  batch.struct_size = offsetof(tetstream_batch, finalized);
  CHECK_EQUAL(tetstream_simplifier_push(r.simplifier, &batch), TETSTREAM_BAD_ARGUMENT);
  batch.struct_size = sizeof batch;
  CHECK_EQUAL(tetstream_simplifier_push(r.simplifier, &batch), TETSTREAM_OK);
  rig_destroy(r);
}

int main(void) {
  mesh = hostile_mesh_create(5, 5, 7);
  CHECK(mesh != NULL);
  RUN_CASE(the_report_agrees_with_what_came_out);
  RUN_CASE(locked_vertices_stay);
  RUN_CASE(report_structs_of_other_sizes_are_respected);
  RUN_CASE(progress_cancels_at_any_call);
  RUN_CASE(calls_from_inside_a_callback_are_refused);
  RUN_CASE(wrong_states_are_named);
  RUN_CASE(a_report_says_what_was_done_so_far);
  RUN_CASE(a_failed_push_breaks_the_simplifier_alone);
  RUN_CASE(fields_that_do_not_exist_are_told_when_the_stream_begins);
  RUN_CASE(a_stream_that_stands_has_one_report);
  RUN_CASE(handles_are_destroyed_in_any_order);
  RUN_CASE(a_simplifier_without_its_writer_can_only_be_destroyed);
  RUN_CASE(null_is_refused_everywhere);
  hostile_mesh_destroy(mesh);
  return check_end();
}
