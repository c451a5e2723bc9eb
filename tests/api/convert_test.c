/* Converting and inspecting, without simplifying. */
#include <stdlib.h>

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

static void every_format_takes_and_gives_all_cells(void) {
  const char* format = NULL;
  int32_t can_read = 0, can_write = 0;
  for (int32_t i = 0; tetstream_format_at(i, &format, NULL, NULL, &can_read, &can_write) == 0;
       ++i) {
    if (!can_read || !can_write) continue;
    tetstream_writer* writer = NULL;
    tetstream_reader* reader = arrays_of(mesh);
    const void* data = NULL;
    size_t size = 0;
    hostile_writer out = {0};
    CHECK_EQUAL(tetstream_writer_create_memory(format, &writer), TETSTREAM_OK);
    if (!CHECK_EQUAL(tetstream_convert(reader, writer, NULL, NULL, NULL), TETSTREAM_OK))
      printf("    %s: %s\n", format, tetstream_writer_message(writer));
    tetstream_reader_destroy(reader);
    CHECK_EQUAL(tetstream_writer_get_memory(writer, &data, &size), TETSTREAM_OK);

    const tetstream_writer_callbacks writes = hostile_writer_callbacks(&out);
    tetstream_writer* back = NULL;
    CHECK_EQUAL(tetstream_writer_create(&writes, &back), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_reader_open_memory(data, size, format, &reader), TETSTREAM_OK);
    if (!CHECK_EQUAL(tetstream_convert(reader, back, NULL, NULL, NULL), TETSTREAM_OK))
      printf("    %s: %s\n", format, tetstream_writer_message(back));
    CHECK_EQUAL(out.cells, mesh->cell_count);
    CHECK_EQUAL(out.vertices, mesh->vertex_count);
    CHECK_EQUAL(out.finalized, out.vertices);
    CHECK_EQUAL(out.stream_errors + out.order_errors, 0);
    CHECK_EQUAL(out.finishes, 1);
    tetstream_reader_destroy(reader);
    tetstream_writer_destroy(back);
    tetstream_writer_destroy(writer);
    hostile_writer_free(&out);
  }
}

static void check_facts(tetstream_reader* reader) {
  tetstream_stream_info info = {0};
  info.struct_size = sizeof info;
  tetstream_front_info front = {0};
  front.struct_size = sizeof front;
  CHECK_EQUAL(tetstream_reader_get_front(reader, &front), TETSTREAM_BAD_STATE);
  CHECK_EQUAL(tetstream_inspect(reader, NULL, NULL, NULL, &info), TETSTREAM_OK);
  CHECK_SAYS(tetstream_reader_message(reader), "");
  CHECK_EQUAL(tetstream_reader_get_front(reader, &front), TETSTREAM_OK);
  CHECK_EQUAL(front.width, info.front_width);
  CHECK_EQUAL(front.span, info.front_span);
  CHECK_EQUAL(front.cells, info.front_cells);
  CHECK(front.mean_width > 3 && front.mean_width <= (double)front.width);
  CHECK(front.mean_span >= front.mean_width && front.mean_span <= (double)front.span);
  CHECK(front.mean_life > 1 && front.mean_life <= (double)front.longest_life);
  CHECK(front.longest_life <= info.cell_count && front.window_cells >= 64);
  CHECK_EQUAL(info.cell_count, mesh->cell_count);
  CHECK_EQUAL(info.vertex_count, mesh->vertex_count);
  CHECK(info.front_width > 0 && info.front_width <= mesh->vertex_count);
  CHECK(info.front_span >= info.front_width && info.front_span <= mesh->vertex_count);
  CHECK(info.front_cells > 0 && info.front_cells <= mesh->cell_count);
  if (CHECK(info.box_min && info.box_max)) {
    CHECK(info.box_min[0] == 0 && info.box_min[1] == 0 && info.box_min[2] == 0);
    CHECK(info.box_max[0] == 3 && info.box_max[1] == 4 && info.box_max[2] == 5);
    CHECK(info.box_min[3] == 0 && info.box_max[3] == 3 + 0.5 * 16 + 0.1 * 5);
    CHECK(info.box_max[6] == 25); /* the third component of velocity: z squared */
  }
  tetstream_stream_info again = {0};
  again.struct_size = sizeof again;
  CHECK_EQUAL(tetstream_reader_get_info(reader, &again), TETSTREAM_OK);
  CHECK_EQUAL(again.front_cells, info.front_cells);
  CHECK_EQUAL(tetstream_inspect(reader, NULL, NULL, NULL, &info), TETSTREAM_BAD_STATE);
  tetstream_reader_destroy(reader);
}

/* What inspect tells of the window is what a simplification takes by itself: the option counts
 * where one is done. */
static void the_window_that_is_told_is_not_the_option(void) {
  tetstream_options* options = NULL;
  tetstream_front_info front[2] = {{0}, {0}};
  CHECK_EQUAL(tetstream_options_create(&options), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_options_set_int64(options, TETSTREAM_OPTION_WINDOW, 5000), TETSTREAM_OK);
  for (int i = 0; i < 2; ++i) {
    tetstream_reader* reader = NULL;
    tetstream_stream_info info = {0};
    CHECK_EQUAL(tetstream_reader_generate("fluid", 20000, 1, &reader), TETSTREAM_OK);
    info.struct_size = sizeof info;
    front[i].struct_size = sizeof front[i];
    CHECK_EQUAL(tetstream_inspect(reader, i ? options : NULL, NULL, NULL, &info), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_reader_get_front(reader, &front[i]), TETSTREAM_OK);
    tetstream_reader_destroy(reader);
  }
  CHECK_EQUAL(front[1].window_cells, front[0].window_cells);
  tetstream_options_destroy(options);
}

/* In every order all cells come, and the report tells the front that comes with them. */
static void a_layout_tells_its_order_and_its_front(void) {
  static const char* const orders[] = {"auto",    "none",    "spatial",       "brick",
                                       "z-order", "hilbert", "breadth-first", "spectral"};
  for (size_t i = 0; i < sizeof orders / sizeof orders[0]; ++i) {
    tetstream_options* options = NULL;
    tetstream_writer* writer = NULL;
    tetstream_layout_report report = {0};
    report.struct_size = sizeof report;
    CHECK_EQUAL(tetstream_options_create(&options), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_options_set_text(options, TETSTREAM_OPTION_ORDER, orders[i]),
                TETSTREAM_OK);
    hostile_writer out = {0};
    const tetstream_writer_callbacks writes = hostile_writer_callbacks(&out);
    CHECK_EQUAL(tetstream_writer_create(&writes, &writer), TETSTREAM_OK);
    tetstream_reader* reader = arrays_of(mesh);
    CHECK_EQUAL(tetstream_layout(reader, writer, options, NULL, NULL, &report), TETSTREAM_OK);
    CHECK_EQUAL(out.cells, mesh->cell_count);
    CHECK_EQUAL(out.finalized, mesh->vertex_count);
    CHECK_EQUAL(out.stream_errors + out.order_errors, 0);
    CHECK_EQUAL(report.cells, out.cells);
    CHECK_EQUAL(report.vertices, out.vertices);
    CHECK_EQUAL(report.unused_vertices, 0);
    CHECK(report.front_width >= 4 && report.front_span >= report.front_width);
    CHECK(i == 0 || strstr(report.order, orders[i]) == report.order);
    tetstream_reader_destroy(reader);
    tetstream_options_destroy(options);
    tetstream_writer_destroy(writer);
    hostile_writer_free(&out);
  }
}

static void a_layout_refuses_what_it_cannot_fill(void) {
  tetstream_writer* writer = NULL;
  tetstream_reader* reader = arrays_of(mesh);
  tetstream_layout_report report = {0};
  CHECK_EQUAL(tetstream_writer_create_memory("tets", &writer), TETSTREAM_OK);
  report.struct_size = sizeof report - 1;
  CHECK_EQUAL(tetstream_layout(reader, writer, NULL, NULL, NULL, &report), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_layout(NULL, writer, NULL, NULL, NULL, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_layout(reader, NULL, NULL, NULL, NULL, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_layout(reader, writer, NULL, NULL, NULL, NULL), TETSTREAM_OK);
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);
}

static void inspection_finds_the_same_however_the_mesh_comes(void) {
  hostile_reader hostile;
  check_facts(callbacks(&hostile, HOSTILE_WHOLE, 0));
  check_facts(callbacks(&hostile, HOSTILE_ITEMS, 0));
  CHECK_EQUAL(hostile.closes, 1);
  check_facts(callbacks(&hostile, HOSTILE_ODD, TETSTREAM_STREAM_INDEXED));
  CHECK_EQUAL(hostile.closes, 1);
  check_facts(arrays_of(mesh));
}

static void failures_of_the_reader_are_told_by_the_writer(void) {
  hostile_reader hostile;
  hostile_writer out = {0};
  const tetstream_writer_callbacks writes = hostile_writer_callbacks(&out);
  tetstream_writer* writer = NULL;
  tetstream_reader* reader = callbacks(&hostile, HOSTILE_ODD, 0);
  hostile.fail_call = 4;
  hostile.fail_value = 99;
  CHECK_EQUAL(tetstream_writer_create(&writes, &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(reader, writer, NULL, NULL, NULL), TETSTREAM_CALLBACK);
  CHECK_SAYS(tetstream_writer_message(writer), "99");
  CHECK_EQUAL(hostile.closes, 1);
  CHECK_EQUAL(out.closes, out.opens);
  CHECK_EQUAL(out.finishes, 0);
  CHECK_EQUAL(tetstream_convert(reader, writer, NULL, NULL, NULL), TETSTREAM_BAD_STATE);
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);
  CHECK_EQUAL(hostile.closes, 1);
  hostile_writer_free(&out);
}

static void values_too_large_for_float32_are_refused_where_nothing_else_is_held(void) {
  tetstream_writer* writer = NULL;
  const double before = mesh->density[7];
  mesh->density[7] = 1e39;
  tetstream_reader* reader = arrays_of(mesh);
  CHECK_EQUAL(tetstream_writer_create_memory("svb", &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(reader, writer, NULL, NULL, NULL), TETSTREAM_UNSUPPORTED);
  CHECK_SAYS(tetstream_writer_message(writer), "vertex 7");
  CHECK_SAYS(tetstream_writer_message(writer), "density");
  mesh->density[7] = before;
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);
}

/* Both tell of the points that no cell has. */
static void what_is_in_no_cell_is_told(void) {
  static const char text[] =
      "MeshVersionFormatted 2 Dimension 3 Vertices 6 0 0 0 0  9 9 9 0  1 0 0 0  0 1 0 0  0 0 1 0  "
      "8 8 8 0 Tetrahedra 1 1 3 4 5 0 End";
  static const char told[] = "vertices that are in no cell, left out: 2";
  for (int inspects = 0; inspects < 2; ++inspects) {
    tetstream_stream_info info = {0};
    tetstream_writer* writer = NULL;
    tetstream_reader* reader = NULL;
    info.struct_size = sizeof info;
    CHECK_EQUAL(tetstream_writer_create_memory("tets", &writer), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_reader_open_memory(text, sizeof text - 1, "mesh", &reader), TETSTREAM_OK);
    CHECK_EQUAL(inspects ? tetstream_inspect(reader, NULL, NULL, NULL, &info)
                         : tetstream_convert(reader, writer, NULL, NULL, NULL),
                TETSTREAM_OK);
    CHECK_SAYS(tetstream_reader_note(reader, 0), told);
    CHECK(tetstream_reader_note(reader, 1) == NULL);
    tetstream_reader_destroy(reader);
    tetstream_writer_destroy(writer);
  }
}

static int32_t cancel(void* user, const tetstream_progress* progress) {
  CHECK(progress->phase && progress->phase[0]);
  return *(int32_t*)user;
}

static void progress_cancels(void) {
  int32_t value = 5;
  tetstream_stream_info info = {0};
  tetstream_writer* writer = NULL;
  tetstream_reader* reader = arrays_of(mesh);
  info.struct_size = sizeof info;
  CHECK_EQUAL(tetstream_inspect(reader, NULL, cancel, &value, &info), TETSTREAM_CANCELLED);
  CHECK_SAYS(tetstream_reader_message(reader), "5");
  tetstream_reader_destroy(reader);
  reader = arrays_of(mesh);
  CHECK_EQUAL(tetstream_writer_create_memory("tets", &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(reader, writer, NULL, cancel, &value), TETSTREAM_CANCELLED);
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);
}

static void null_is_refused_everywhere(void) {
  tetstream_stream_info info = {0};
  tetstream_writer* writer = NULL;
  tetstream_reader* reader = arrays_of(mesh);
  info.struct_size = sizeof info;
  CHECK_EQUAL(tetstream_writer_create_memory("tets", &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(NULL, writer, NULL, NULL, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_SAYS(tetstream_writer_message(writer), "reader is NULL");
  CHECK_EQUAL(tetstream_convert(reader, NULL, NULL, NULL, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_inspect(NULL, NULL, NULL, NULL, &info), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_inspect(reader, NULL, NULL, NULL, NULL), TETSTREAM_BAD_ARGUMENT);
  info.struct_size = 8;
  CHECK_EQUAL(tetstream_inspect(reader, NULL, NULL, NULL, &info), TETSTREAM_BAD_ARGUMENT);
  /* None of that used anything up. */
  CHECK_EQUAL(tetstream_convert(reader, writer, NULL, NULL, NULL), TETSTREAM_OK);
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);
}

int main(void) {
  mesh = hostile_mesh_create(3, 4, 5);
  CHECK(mesh != NULL);
  RUN_CASE(every_format_takes_and_gives_all_cells);
  RUN_CASE(the_window_that_is_told_is_not_the_option);
  RUN_CASE(a_layout_tells_its_order_and_its_front);
  RUN_CASE(a_layout_refuses_what_it_cannot_fill);
  RUN_CASE(inspection_finds_the_same_however_the_mesh_comes);
  RUN_CASE(failures_of_the_reader_are_told_by_the_writer);
  RUN_CASE(values_too_large_for_float32_are_refused_where_nothing_else_is_held);
  RUN_CASE(what_is_in_no_cell_is_told);
  RUN_CASE(progress_cancels);
  RUN_CASE(null_is_refused_everywhere);
  hostile_mesh_destroy(mesh);
  return check_end();
}
