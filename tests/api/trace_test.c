/* The vertex map and the collapse log through the C interface: what comes, in which order, and what
 * happens when a callback or a table is not what it should be. */
#define _DEFAULT_SOURCE
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "rig.h"

#define MOST 20000

static hostile_mesh* mesh;

typedef struct traces {
  int fail_call; /* this call of all, from 1, fails; 0: none */
  int calls, map_opens, map_finishes, map_closes, log_opens, log_finishes, log_closes;
  int after_close, width;
  int64_t count, collapses;
  int64_t vertices[MOST], cells[MOST], kept[MOST], removed[MOST];
  double weights[4 * MOST], positions[3 * MOST];
} traces;

static int32_t called(traces* t) {
  t->after_close += t->map_closes > 0 || t->log_closes > 0;
  return ++t->calls == t->fail_call ? 42 : 0;
}

static int32_t map_open(void* user) {
  ++((traces*)user)->map_opens;
  return called(user);
}
static int32_t map_put(void* user, const tetstream_map_rows* rows) {
  traces* t = user;
  CHECK_EQUAL(rows->struct_size, sizeof *rows);
  CHECK(rows->count > 0 && rows->count <= 4096 && t->count + rows->count <= MOST);
  for (int64_t i = 0; i < rows->count; ++i, ++t->count) {
    t->vertices[t->count] = rows->vertices[i];
    t->cells[t->count] = rows->cells[i];
    for (int k = 0; k < 4; ++k) t->weights[4 * t->count + k] = rows->weights[4 * i + k];
  }
  return called(t);
}
static int32_t map_finish(void* user) {
  ++((traces*)user)->map_finishes;
  return called(user);
}
static void map_close(void* user) {
  ++((traces*)user)->map_closes;
}

static int32_t log_open(void* user, const tetstream_stream_info* info) {
  traces* t = user;
  ++t->log_opens;
  CHECK_EQUAL(info->field_count, 2);
  CHECK_SAYS(info->fields[0].name, "density");
  for (int i = 0; i < info->field_count; ++i) t->width += info->fields[i].components;
  return called(t);
}
static int32_t log_put(void* user, const tetstream_log_rows* rows) {
  traces* t = user;
  CHECK_EQUAL(rows->struct_size, sizeof *rows);
  CHECK(rows->count > 0 && rows->count <= 4096 && t->collapses + rows->count <= MOST);
  for (int64_t i = 0; i < rows->count; ++i, ++t->collapses) {
    t->kept[t->collapses] = rows->kept[i];
    t->removed[t->collapses] = rows->removed[i];
    for (int k = 0; k < 3; ++k) t->positions[3 * t->collapses + k] = rows->positions[3 * i + k];
    CHECK(isfinite(rows->values[4 * i]) && rows->errors[i] >= 0);
  }
  return called(t);
}
static int32_t log_finish(void* user) {
  ++((traces*)user)->log_finishes;
  return called(user);
}
static void log_close(void* user) {
  ++((traces*)user)->log_closes;
}

static tetstream_map_callbacks map_callbacks(traces* t) {
  const tetstream_map_callbacks map = {sizeof map, t, map_open, map_put, map_finish, map_close};
  return map;
}
static tetstream_log_callbacks log_callbacks(traces* t) {
  const tetstream_log_callbacks log = {sizeof log, t, log_open, log_put, log_finish, log_close};
  return log;
}

static traces* new_traces(void) {
  traces* t = calloc(1, sizeof *t);
  CHECK(t != NULL);
  return t;
}

static void set_both(rig r, traces* t) {
  const tetstream_map_callbacks map = map_callbacks(t);
  const tetstream_log_callbacks log = log_callbacks(t);
  CHECK_EQUAL(tetstream_simplifier_set_map(r.simplifier, &map), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_set_log(r.simplifier, &log), TETSTREAM_OK);
}

/* The bytes of a memory writer in .svb would round: .tets is looked at through its size only. */
static tetstream_status run_traced(traces* t, tetstream_report* report) {
  rig r = rig_create("tets");
  tetstream_reader* reader = arrays_of(mesh);
  set_both(r, t);
  const tetstream_status status = tetstream_simplifier_run(r.simplifier, reader);
  if (status < 0) CHECK_SAYS(tetstream_simplifier_message(r.simplifier), "42");
  report->struct_size = sizeof *report;
  CHECK_EQUAL(tetstream_simplifier_get_report(r.simplifier, report), TETSTREAM_OK);
  CHECK_EQUAL(t->map_closes, t->map_opens); /* closed when the run was over, not at the end */
  CHECK_EQUAL(t->log_closes, t->log_opens);
  tetstream_reader_destroy(reader);
  rig_destroy(r);
  CHECK_EQUAL(t->map_closes, t->map_opens);
  CHECK_EQUAL(t->log_closes, t->log_opens);
  CHECK_EQUAL(t->after_close, 0);
  return status;
}

/* The mesh of arrays is put into another order: vertices are named as the arrays have them. */
static void every_vertex_comes_once_and_every_collapse(void) {
  traces* t = new_traces();
  tetstream_report report;
  CHECK_EQUAL(run_traced(t, &report), TETSTREAM_OK);
  CHECK_EQUAL(t->count, mesh->vertex_count);
  CHECK_EQUAL(t->collapses, report.collapses);
  CHECK_EQUAL(t->width, 4);
  char* came = calloc((size_t)mesh->vertex_count, 1);
  for (int64_t i = 0; i < t->count; ++i) {
    CHECK(t->vertices[i] >= 0 && t->vertices[i] < mesh->vertex_count && !came[t->vertices[i]]);
    came[t->vertices[i]] = 1;
    CHECK(i == 0 || t->cells[i] >= t->cells[i - 1]);
    CHECK(t->cells[i] < report.cells_out);
    const double* w = t->weights + 4 * i;
    CHECK(fabs(w[0] + w[1] + w[2] + w[3] - 1) < 1e-14);
  }
  /* What was kept last stands where the log says, near where it was. */
  for (int64_t i = 0; i < t->collapses; ++i) {
    const double* was = mesh->positions + 3 * t->kept[i];
    const double* is = t->positions + 3 * i;
    CHECK(fabs(was[0] - is[0]) + fabs(was[1] - is[1]) + fabs(was[2] - is[2]) < 10);
  }
  CHECK_EQUAL(t->map_opens + t->log_opens, 2);
  CHECK_EQUAL(t->map_finishes + t->log_finishes, 2);
  free(came);
  free(t);
}

static void a_callback_that_fails_stops_the_run(void) {
  int call = 1;
  for (;; ++call) {
    traces* t = new_traces();
    tetstream_report report;
    t->fail_call = call;
    const tetstream_status status = run_traced(t, &report);
    const int made = t->calls;
    if (made >= call) {
      CHECK_EQUAL(status, TETSTREAM_CALLBACK);
      CHECK_EQUAL(made, call);
    } else {
      CHECK_EQUAL(status, TETSTREAM_OK);
    }
    free(t);
    if (made < call) break;
  }
  CHECK(call > 6);
}

static void tables_may_be_minimal_and_must_not_be_less(void) {
  traces* t = new_traces();
  rig r = rig_create("tets");
  tetstream_map_callbacks map = {sizeof map, t, NULL, map_put, NULL, NULL};
  tetstream_log_callbacks log = {sizeof log, t, NULL, NULL, NULL, NULL};
  CHECK_EQUAL(tetstream_simplifier_set_map(r.simplifier, &map), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_set_log(r.simplifier, &log), TETSTREAM_BAD_ARGUMENT);
  CHECK_SAYS(tetstream_simplifier_message(r.simplifier), "put");
  log.put = log_put;
  log.struct_size -= 1;
  CHECK_EQUAL(tetstream_simplifier_set_log(r.simplifier, &log), TETSTREAM_BAD_ARGUMENT);
  map.struct_size = 8;
  CHECK_EQUAL(tetstream_simplifier_set_map(r.simplifier, &map), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_simplifier_set_map(NULL, &map), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_simplifier_set_map_fd(r.simplifier, -1, "csv"), TETSTREAM_IO);
  tetstream_reader* reader = arrays_of(mesh);
  CHECK_EQUAL(tetstream_simplifier_run(r.simplifier, reader), TETSTREAM_OK);
  CHECK_EQUAL(t->count, mesh->vertex_count); /* the first table still held */
  CHECK_EQUAL(tetstream_simplifier_set_map(r.simplifier, NULL), TETSTREAM_BAD_STATE);
  CHECK_EQUAL(tetstream_simplifier_set_log_fd(r.simplifier, 1, "csv"), TETSTREAM_BAD_STATE);
  tetstream_reader_destroy(reader);
  rig_destroy(r);
  free(t);
}

static void null_takes_a_map_back(void) {
  traces* t = new_traces();
  rig r = rig_create("tets");
  set_both(r, t);
  CHECK_EQUAL(tetstream_simplifier_set_map(r.simplifier, NULL), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_set_log(r.simplifier, NULL), TETSTREAM_OK);
  tetstream_reader* reader = arrays_of(mesh);
  CHECK_EQUAL(tetstream_simplifier_run(r.simplifier, reader), TETSTREAM_OK);
  CHECK_EQUAL(t->calls + t->map_closes + t->log_closes, 0);
  tetstream_reader_destroy(reader);
  rig_destroy(r);
  free(t);
}

/* Pushed in pieces and without its end: closed once. */
static void a_run_that_is_dropped_closes_its_traces(void) {
  traces* t = new_traces();
  rig r = rig_create("tets");
  whole w = whole_of(mesh);
  set_both(r, t);
  CHECK_EQUAL(tetstream_simplifier_begin(r.simplifier, &w.info), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_push(r.simplifier, &w.batch), TETSTREAM_OK);
  rig_destroy(r);
  CHECK_EQUAL(t->map_closes, 1);
  CHECK_EQUAL(t->log_closes, 1);
  CHECK_EQUAL(t->map_finishes + t->log_finishes, 0);
  free(t);
}

static void swap_regions(void) {
  for (int64_t i = 0; i < mesh->cell_count; ++i) mesh->region[i] = 3 - mesh->region[i];
}

/* Where the format puts cells of a label together, and there is a map that names them. */
static void a_note_tells_of_cells_in_blocks(void) {
  swap_regions(); /* so that the first comes last */
  for (int with_map = 0; with_map < 2; ++with_map) {
    traces* t = new_traces();
    rig r = rig_create("exodus");
    if (with_map) set_both(r, t);
    tetstream_reader* reader = arrays_of(mesh);
    CHECK(tetstream_simplifier_run(r.simplifier, reader) >= 0);
    int told = 0;
    const char* note;
    for (int32_t i = 0; (note = tetstream_writer_note(r.writer, i)) != NULL; ++i)
      told += strstr(note, "elem_num_map") != NULL;
    CHECK_EQUAL(told, with_map);
    tetstream_reader_destroy(reader);
    rig_destroy(r);
    free(t);
  }
  swap_regions();
}

static void files_are_refused_in_formats_that_are_none(void) {
  rig r = rig_create("tets");
  CHECK_EQUAL(tetstream_simplifier_set_map_file(r.simplifier, "a.txt", NULL),
              TETSTREAM_UNSUPPORTED);
  CHECK_SAYS(tetstream_simplifier_message(r.simplifier), ".tetmap");
  CHECK_EQUAL(tetstream_simplifier_set_log_file(r.simplifier, "a.csv", "tetmap"),
              TETSTREAM_UNSUPPORTED);
  CHECK_SAYS(tetstream_simplifier_message(r.simplifier), "tetlog");
  CHECK_EQUAL(tetstream_simplifier_set_map_file(r.simplifier, "/no/such/folder/a.csv", NULL),
              TETSTREAM_IO);
  CHECK_EQUAL(tetstream_simplifier_set_map_file(r.simplifier, NULL, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_simplifier_set_map_fd(r.simplifier, 1, NULL), TETSTREAM_BAD_ARGUMENT);
  rig_destroy(r);
}

/* Before anything is read; then with another name. */
static void two_files_of_one_name_are_refused(void) {
  char folder[] = "/tmp/tetstream_traces.XXXXXX", map[64], log[64];
  CHECK(mkdtemp(folder) != NULL);
  snprintf(map, sizeof map, "%s/map.csv", folder);
  snprintf(log, sizeof log, "%s/./map.csv", folder);
  rig r = rig_create("tets");
  whole w = whole_of(mesh);
  CHECK_EQUAL(tetstream_simplifier_set_map_file(r.simplifier, map, NULL), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_set_log_file(r.simplifier, log, NULL), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_begin(r.simplifier, &w.info), TETSTREAM_BAD_ARGUMENT);
  CHECK_SAYS(tetstream_simplifier_message(r.simplifier), "map.csv: two things");
  snprintf(log, sizeof log, "%s/log.csv", folder);
  CHECK_EQUAL(tetstream_simplifier_set_log_file(r.simplifier, log, NULL), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_begin(r.simplifier, &w.info), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_push(r.simplifier, &w.batch), TETSTREAM_OK);
  CHECK(tetstream_simplifier_finish(r.simplifier) >= 0);
  rig_destroy(r);
  CHECK_EQUAL(unlink(map), 0);
  CHECK_EQUAL(unlink(log), 0);
  CHECK_EQUAL(rmdir(folder), 0);
}

int main(void) {
  mesh = hostile_mesh_create(5, 5, 9);
  RUN_CASE(every_vertex_comes_once_and_every_collapse);
  RUN_CASE(a_callback_that_fails_stops_the_run);
  RUN_CASE(tables_may_be_minimal_and_must_not_be_less);
  RUN_CASE(null_takes_a_map_back);
  RUN_CASE(a_run_that_is_dropped_closes_its_traces);
  RUN_CASE(a_note_tells_of_cells_in_blocks);
  RUN_CASE(files_are_refused_in_formats_that_are_none);
  RUN_CASE(two_files_of_one_name_are_refused);
  hostile_mesh_destroy(mesh);
  return check_end();
}
