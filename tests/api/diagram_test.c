/* Layout diagrams: the numbers against those of inspect and of their own sum, the pages as files,
 * and every way in which a diagram can be asked for too early, too late or for nothing. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include "rig.h"

static hostile_mesh* mesh;

static tetstream_reader* callbacks(hostile_reader* hostile, int cut, uint32_t flags) {
  tetstream_reader* reader = NULL;
  memset(hostile, 0, sizeof *hostile);
  hostile->mesh = mesh;
  hostile->cut = cut;
  hostile->flags = flags;
  const tetstream_reader_callbacks reads = hostile_reader_callbacks(hostile);
  CHECK_EQUAL(tetstream_reader_create(&reads, &reader), TETSTREAM_OK);
  return reader;
}

static tetstream_diagram* diagram_of(int32_t columns, int32_t rows) {
  tetstream_diagram* diagram = NULL;
  CHECK_EQUAL(tetstream_diagram_create(NULL, columns, rows, &diagram), TETSTREAM_OK);
  return diagram;
}

static tetstream_diagram_info info_of(const tetstream_diagram* diagram) {
  tetstream_diagram_info info = {0};
  info.struct_size = sizeof info;
  CHECK_EQUAL(tetstream_diagram_get_info(diagram, &info), TETSTREAM_OK);
  return info;
}

/* 0 where this build draws nothing. */
static int draws(void) {
  return strstr(tetstream_version_text(), "no cairo") == NULL;
}

static void check_numbers(tetstream_reader* reader, const tetstream_stream_info* wanted) {
  tetstream_diagram* diagram = diagram_of(16, 9);
  CHECK_EQUAL(tetstream_diagram_read(diagram, reader, 0, NULL, NULL), TETSTREAM_OK);
  CHECK_SAYS(tetstream_diagram_message(diagram), "");
  const tetstream_diagram_info info = info_of(diagram);
  CHECK_EQUAL(info.struct_size, sizeof info);
  CHECK_EQUAL(info.cell_count, wanted->cell_count);
  CHECK_EQUAL(info.vertex_count, wanted->vertex_count);
  CHECK_EQUAL(info.front_width, wanted->front_width);
  CHECK_EQUAL(info.front_span, wanted->front_span);
  CHECK_EQUAL(info.front_cells, wanted->front_cells);
  CHECK(info.columns >= 8 && info.columns <= 16 && info.rows >= 4 && info.rows <= 9);
  CHECK(info.columns * info.cells_per_column >= info.cell_count);
  CHECK(info.rows * info.vertices_per_row >= info.vertex_count);
  CHECK(info.widest_cell >= 0 && info.longest_cell >= 0 && info.longest_life > 0);

  double covered = 0;
  for (int32_t r = 0; r < info.rows; ++r)
    for (int32_t c = 0; c < info.columns; ++c) {
      const float share = info.coverage[r * info.columns + c];
      const int64_t cells = info.cell_count - c * info.cells_per_column;
      const int64_t vertices = info.vertex_count - r * info.vertices_per_row;
      CHECK(share >= 0 && share <= 1);
      covered += (double)share *
                 (double)(cells < info.cells_per_column ? cells : info.cells_per_column) *
                 (double)(vertices < info.vertices_per_row ? vertices : info.vertices_per_row);
    }
  CHECK(fabs(covered - info.mean_life * (double)info.vertex_count) < 1e-3 * covered);
  CHECK(fabs(covered - info.mean_width * (double)info.cell_count) < 1e-3 * covered);
  int64_t widest = 0;
  for (int32_t c = 0; c < info.columns; ++c) {
    CHECK(info.lowest[c] >= 0 && info.lowest[c] <= info.newest[c]);
    if (info.widths[c] > widest) widest = info.widths[c];
  }
  CHECK_EQUAL(widest, info.front_width);
  CHECK_EQUAL(info.newest[info.columns - 1], info.vertex_count - 1);
  tetstream_diagram_destroy(diagram);
  tetstream_reader_destroy(reader);
}

static tetstream_stream_info facts(tetstream_reader* reader) {
  tetstream_stream_info info = {0};
  info.struct_size = sizeof info;
  CHECK_EQUAL(tetstream_inspect(reader, NULL, NULL, NULL, &info), TETSTREAM_OK);
  tetstream_reader_destroy(reader);
  return info; /* its pointers are not looked at */
}

static void the_numbers_are_those_of_the_stream(void) {
  hostile_reader hostile;
  tetstream_stream_info wanted;
  for (int cut = HOSTILE_WHOLE; cut <= HOSTILE_LISTS; ++cut) {
    wanted = facts(callbacks(&hostile, cut, 0));
    check_numbers(callbacks(&hostile, cut, 0), &wanted);
  }
  wanted = facts(arrays_of(mesh));
  check_numbers(arrays_of(mesh), &wanted);
  check_numbers(callbacks(&hostile, HOSTILE_ODD, TETSTREAM_STREAM_INDEXED), &wanted);
  CHECK_EQUAL(hostile.closes, 1);
}

static void a_stream_of_nothing_has_a_diagram(void) {
  hostile_reader hostile;
  tetstream_reader* reader = callbacks(&hostile, HOSTILE_ODD, 0);
  hostile.empty = 1;
  tetstream_diagram* diagram = diagram_of(10, 10);
  CHECK_EQUAL(tetstream_diagram_read(diagram, reader, 0, NULL, NULL), TETSTREAM_OK);
  const tetstream_diagram_info info = info_of(diagram);
  CHECK_EQUAL(info.cell_count, 0);
  CHECK_EQUAL(info.columns, 0);
  CHECK_EQUAL(info.widest_cell, -1);
  CHECK(info.coverage == NULL && info.widths == NULL);
  tetstream_diagram_destroy(diagram);
  tetstream_reader_destroy(reader);
}

/* The first bytes of a file are these. */
static void check_begins(const char* path, const char* bytes) {
  char found[8] = {0};
  FILE* file = fopen(path, "rb");
  if (!CHECK(file != NULL)) return;
  CHECK(fread(found, 1, sizeof found, file) == sizeof found);
  CHECK(memcmp(found, bytes, strlen(bytes)) == 0);
  fclose(file);
  CHECK_EQUAL(remove(path), 0);
}

static void pages_are_drawn_as_often_as_wanted(void) {
  char folder[] = "/tmp/tetstream-diagram-XXXXXX";
  char svg[64], png[64], other[64], absent[64];
  if (!CHECK(mkdtemp(folder) != NULL)) return;
  snprintf(svg, sizeof svg, "%s/a.svg", folder);
  snprintf(png, sizeof png, "%s/a.png", folder);
  snprintf(other, sizeof other, "%s/a.gif", folder);
  snprintf(absent, sizeof absent, "%s/absent/a.svg", folder);
  tetstream_diagram* diagram = diagram_of(20, 20);
  tetstream_reader* reader = arrays_of(mesh);
  CHECK_EQUAL(tetstream_diagram_read(diagram, reader, TETSTREAM_PAGE_SWEEP, NULL, NULL),
              TETSTREAM_OK);
  tetstream_reader_destroy(reader); /* what was read stays */
  if (draws()) {
    CHECK_EQUAL(tetstream_diagram_check_path(diagram, svg), TETSTREAM_OK);
    for (int32_t page = TETSTREAM_PAGE_LAYOUT; page <= TETSTREAM_PAGE_SWEEP; ++page) {
      CHECK_EQUAL(tetstream_diagram_write(diagram, page, svg, "a mesh"), TETSTREAM_OK);
      check_begins(svg, "<?xml");
      CHECK_EQUAL(tetstream_diagram_write(diagram, page, png, NULL), TETSTREAM_OK);
      check_begins(png, "\x89PNG");
    }
    CHECK_EQUAL(tetstream_diagram_write(diagram, 1, absent, NULL), TETSTREAM_IO);
    CHECK_SAYS(tetstream_diagram_message(diagram), "absent/a.svg");
  } else {
    CHECK_EQUAL(tetstream_diagram_write(diagram, 1, svg, NULL), TETSTREAM_UNSUPPORTED);
    CHECK_SAYS(tetstream_diagram_message(diagram), "cairo");
  }
  CHECK_EQUAL(tetstream_diagram_check_path(diagram, other), TETSTREAM_UNSUPPORTED);
  CHECK_EQUAL(tetstream_diagram_write(diagram, 1, other, NULL), TETSTREAM_UNSUPPORTED);
  CHECK_EQUAL(info_of(diagram).cell_count, mesh->cell_count); /* nothing of that did harm */
  tetstream_diagram_destroy(diagram);
  CHECK_EQUAL(rmdir(folder), 0); /* and nothing is left */
}

static tetstream_reader_callbacks theirs;

static int32_t open_without_box(void* user, tetstream_stream_info* info) {
  const int32_t value = theirs.open(user, info);
  info->box_min = info->box_max = NULL;
  return value;
}

/* Callbacks are read once. */
static void a_sweep_needs_the_box_beforehand(void) {
  hostile_reader hostile = {0};
  tetstream_diagram* diagram = diagram_of(20, 20);
  tetstream_reader* reader = NULL;
  hostile.mesh = mesh;
  theirs = hostile_reader_callbacks(&hostile);
  tetstream_reader_callbacks ours = theirs;
  ours.open = open_without_box;
  CHECK_EQUAL(tetstream_reader_create(&ours, &reader), TETSTREAM_OK);
  tetstream_status status =
      tetstream_diagram_read(diagram, reader, TETSTREAM_PAGE_SWEEP, NULL, NULL);
  CHECK_EQUAL(status, TETSTREAM_UNSUPPORTED);
  CHECK_SAYS(tetstream_diagram_message(diagram), "box");
  CHECK_EQUAL(tetstream_diagram_read(diagram, reader, 0, NULL, NULL), TETSTREAM_BAD_STATE);
  tetstream_diagram_destroy(diagram);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(hostile.closes, hostile.opens);
}

static void failures_of_the_reader_are_told_by_the_diagram(void) {
  hostile_reader hostile;
  tetstream_diagram_info info = {0};
  info.struct_size = sizeof info;
  for (int spoilt = 0; spoilt < 2; ++spoilt) {
    tetstream_diagram* diagram = diagram_of(20, 20);
    tetstream_reader* reader = callbacks(&hostile, HOSTILE_ODD, 0);
    hostile.fail_call = spoilt ? 0 : 4;
    hostile.fail_value = 99;
    hostile.spoil = HOSTILE_GARBAGE_ID;
    hostile.spoil_batch = spoilt ? 3 : 0;
    CHECK_EQUAL(tetstream_diagram_read(diagram, reader, 0, NULL, NULL),
                spoilt ? TETSTREAM_BAD_DATA : TETSTREAM_CALLBACK);
    CHECK_SAYS(tetstream_diagram_message(diagram), spoilt ? "cell" : "99");
    CHECK_EQUAL(tetstream_diagram_get_info(diagram, &info), TETSTREAM_BAD_STATE);
    CHECK_EQUAL(tetstream_diagram_write(diagram, 1, "a.svg", NULL), TETSTREAM_BAD_STATE);
    tetstream_diagram_destroy(diagram);
    tetstream_reader_destroy(reader);
    CHECK_EQUAL(hostile.closes, 1);
    hostile_reader_free(&hostile);
  }
}

static int32_t cancel(void* user, const tetstream_progress* progress) {
  CHECK(progress->phase && progress->phase[0]);
  return *(int32_t*)user;
}

static void progress_cancels(void) {
  int32_t value = 5;
  tetstream_diagram* diagram = diagram_of(20, 20);
  tetstream_reader* reader = arrays_of(mesh);
  CHECK_EQUAL(tetstream_diagram_read(diagram, reader, 0, cancel, &value), TETSTREAM_CANCELLED);
  CHECK_SAYS(tetstream_diagram_message(diagram), "5");
  tetstream_diagram_destroy(diagram);
  tetstream_reader_destroy(reader);
}

static void misuse_is_refused_and_does_no_harm(void) {
  tetstream_diagram* diagram = NULL;
  tetstream_diagram_info info = {0};
  tetstream_reader* reader = arrays_of(mesh);
  const int32_t sizes[] = {0, -1, TETSTREAM_DIAGRAM_LARGEST + 1};
  for (int i = 0; i < 3; ++i) {
    CHECK_EQUAL(tetstream_diagram_create(NULL, sizes[i], 5, &diagram), TETSTREAM_BAD_ARGUMENT);
    CHECK_SAYS(tetstream_diagram_message(diagram), "columns");
    CHECK_EQUAL(tetstream_diagram_check_path(diagram, "a.svg"), TETSTREAM_BAD_STATE);
    tetstream_diagram_destroy(diagram);
    CHECK_EQUAL(tetstream_diagram_create(NULL, 5, sizes[i], &diagram), TETSTREAM_BAD_ARGUMENT);
    CHECK_SAYS(tetstream_diagram_message(diagram), "rows");
    tetstream_diagram_destroy(diagram);
  }
  CHECK_EQUAL(tetstream_diagram_create(NULL, 5, 5, NULL), TETSTREAM_BAD_ARGUMENT);
  diagram = diagram_of(5, 5);
  info.struct_size = sizeof info;
  CHECK_EQUAL(tetstream_diagram_get_info(diagram, &info), TETSTREAM_BAD_STATE);
  CHECK_SAYS(tetstream_diagram_message(diagram), "has not begun");
  CHECK_EQUAL(tetstream_diagram_write(diagram, 1, "a.svg", NULL), TETSTREAM_BAD_STATE);
  CHECK_EQUAL(tetstream_diagram_read(NULL, reader, 0, NULL, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_diagram_read(diagram, NULL, 0, NULL, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_diagram_read(diagram, reader, 3, NULL, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_diagram_read(diagram, reader, 0, NULL, NULL), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_diagram_read(diagram, reader, 0, NULL, NULL), TETSTREAM_BAD_STATE);
  CHECK_SAYS(tetstream_diagram_message(diagram), "has finished");
  CHECK_EQUAL(tetstream_diagram_get_info(diagram, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_diagram_get_info(NULL, &info), TETSTREAM_BAD_ARGUMENT);
  info.struct_size = sizeof info - 1;
  CHECK_EQUAL(tetstream_diagram_get_info(diagram, &info), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_diagram_write(diagram, 0, "a.svg", NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_diagram_write(diagram, 1, NULL, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_diagram_check_path(diagram, NULL), TETSTREAM_BAD_ARGUMENT);
  if (draws()) {
    CHECK_EQUAL(tetstream_diagram_write(diagram, 2, "a.svg", NULL), TETSTREAM_BAD_STATE);
    CHECK_SAYS(tetstream_diagram_message(diagram), "without a sweep");
  }
  CHECK_SAYS(tetstream_diagram_message(NULL), "NULL");
  tetstream_diagram_destroy(diagram);
  tetstream_diagram_destroy(NULL);
  tetstream_reader_destroy(reader);
}

int main(void) {
  mesh = hostile_mesh_create(3, 4, 5);
  CHECK(mesh != NULL);
  RUN_CASE(the_numbers_are_those_of_the_stream);
  RUN_CASE(a_stream_of_nothing_has_a_diagram);
  RUN_CASE(pages_are_drawn_as_often_as_wanted);
  RUN_CASE(a_sweep_needs_the_box_beforehand);
  RUN_CASE(failures_of_the_reader_are_told_by_the_diagram);
  RUN_CASE(progress_cancels);
  RUN_CASE(misuse_is_refused_and_does_no_harm);
  hostile_mesh_destroy(mesh);
  return check_end();
}
