/* Options of the reading: other cells that are split, points that are joined, cell arrays as
 * fields, damaged files, time steps, folders of temporary files; properties of the format msh. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <tetstream/tetstream.h>
#include <unistd.h>

#include "check.h"

static const char kPyramid[] =
    "MeshVersionFormatted 2\nDimension 3\nVertices 5\n0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n"
    "0 0 1 0\nPyramids 1\n1 2 3 4 5 7\nEnd\n";

static tetstream_options* with(int32_t id, const char* value) {
  tetstream_options* options = NULL;
  CHECK_EQUAL(tetstream_options_create(&options), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_options_set_text(options, id, value), TETSTREAM_OK);
  return options;
}

static int64_t cells_of(tetstream_reader* reader) {
  tetstream_stream_info info = {0};
  info.struct_size = sizeof info;
  CHECK_EQUAL(tetstream_reader_get_info(reader, &info), TETSTREAM_OK);
  return info.cell_count;
}

static void other_cells_are_split_only_if_asked_for(void) {
  tetstream_options* split = with(TETSTREAM_OPTION_SPLIT, "yes");
  tetstream_reader* reader = NULL;
  const size_t size = sizeof kPyramid - 1;
  CHECK_EQUAL(tetstream_reader_open_memory(kPyramid, size, "mesh", &reader), TETSTREAM_UNSUPPORTED);
  CHECK_SAYS(tetstream_reader_message(reader), "cell 1 is a pyramid");
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_reader_open_memory_with(kPyramid, size, "mesh", split, &reader),
              TETSTREAM_OK);
  CHECK_EQUAL(cells_of(reader), 2);
  CHECK_SAYS(tetstream_reader_note(reader, 0), "are split into them");
  tetstream_reader_destroy(reader);
  tetstream_options_destroy(split);
}

/* Two cells with a point each at the same place. */
static const char kSlit[] =
    "MeshVersionFormatted 2\nDimension 3\nVertices 7\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
    "0 0 0 0\n-1 0 0 0\n0 -1 0 0\nTetrahedra 2\n1 2 3 4 0\n5 6 7 4 0\nEnd\n";

static void points_are_joined_if_asked_for(void) {
  const char* values[] = {"auto", "no", "yes"};
  const void* stream;
  size_t size;
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  tetstream_options* options = NULL;
  for (int i = 0; i < 3; ++i) {
    tetstream_stream_info info = {0};
    info.struct_size = sizeof info;
    options = with(TETSTREAM_OPTION_JOIN_POINTS, values[i]);
    CHECK_EQUAL(
        tetstream_reader_open_memory_with(kSlit, sizeof kSlit - 1, "mesh", options, &reader),
        TETSTREAM_OK);
    CHECK_EQUAL(tetstream_reader_get_info(reader, &info), TETSTREAM_OK);
    CHECK_EQUAL(info.vertex_count, i == 2 ? 6 : 7);
    if (i == 2) CHECK_SAYS(tetstream_reader_note(reader, 0), "1 of 7 points were joined");
    if (i < 2) tetstream_reader_destroy(reader);
    if (i < 2) tetstream_options_destroy(options);
  }
  CHECK_EQUAL(tetstream_writer_create_memory("tets", &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(reader, writer, NULL, NULL, NULL), TETSTREAM_OK);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_writer_get_memory(writer, &stream, &size), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_open_memory_with(stream, size, "tets", options, &reader),
              TETSTREAM_UNSUPPORTED);
  CHECK_SAYS(tetstream_reader_message(reader), "points of streams are not joined");
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_options_set_text(options, TETSTREAM_OPTION_JOIN_POINTS, "no"),
              TETSTREAM_OK);
  CHECK_EQUAL(tetstream_options_set_text(options, TETSTREAM_OPTION_CELLS_TO_POINTS, "yes"),
              TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_open_memory_with(stream, size, "tets", options, &reader),
              TETSTREAM_UNSUPPORTED);
  CHECK_SAYS(tetstream_reader_message(reader), "cell arrays do not become fields");
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);
  tetstream_options_destroy(options);
}

/* A cell with a value. */
static const char kOneValue[] =
    "# vtk DataFile Version 3.0\none\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0 1 0 "
    "0\n"
    "0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\nCELL_DATA 1\nSCALARS heat double 1\n"
    "LOOKUP_TABLE default\n2.5\n";

static void cell_arrays_are_fields_if_asked_for(void) {
  const size_t size = sizeof kOneValue - 1;
  tetstream_options* options = with(TETSTREAM_OPTION_CELLS_TO_POINTS, "yes");
  tetstream_reader* reader = NULL;
  tetstream_stream_info info = {0};
  info.struct_size = sizeof info;
  CHECK_EQUAL(tetstream_reader_open_memory(kOneValue, size, "vtk", &reader), TETSTREAM_OK);
  CHECK_SAYS(tetstream_reader_note(reader, 0),
             "only cell arrays: \"heat\" (option cells-to-points");
  CHECK_EQUAL(tetstream_reader_get_info(reader, &info), TETSTREAM_OK);
  CHECK_EQUAL(info.field_count, 0);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_reader_open_memory_with(kOneValue, size, "vtk", options, &reader),
              TETSTREAM_OK);
  CHECK(tetstream_reader_note(reader, 0) == NULL);
  CHECK_EQUAL(tetstream_inspect(reader, NULL, NULL, NULL, &info), TETSTREAM_OK);
  CHECK_EQUAL(info.field_count, 1);
  CHECK_EQUAL(info.cell_data_count, 1);
  CHECK_EQUAL(info.box_min[3], 2.5);
  tetstream_reader_destroy(reader);
  tetstream_options_destroy(options);
}

/* Two steps, of one cell and of two. */
#define STEP(cells, corners)                                                   \
  "<Grid><Topology TopologyType=\"Tetrahedron\"><DataItem Dimensions=\"" cells \
  " 4\" NumberType=\"Int\">" corners                                           \
  "</DataItem></Topology><Geometry><DataItem "                                 \
  "Dimensions=\"5 3\">0 0 0 1 0 0 0 1 0 0 0 1 1 1 1</DataItem></Geometry></Grid>"
static const char kSteps[] =
    "<Xdmf><Domain><Grid GridType=\"Collection\" CollectionType=\"Temporal\">" STEP("1", "0 1 2 3")
        STEP("2", "0 1 2 3 1 2 3 4") "</Grid></Domain></Xdmf>";

static void one_time_step_is_read(void) {
  const struct {
    const char* step;
    int64_t cells;
  } cases[] = {{"first", 1}, {"last", 2}, {"0", 1}, {"1", 2}};
  const size_t size = sizeof kSteps - 1;
  tetstream_reader* reader = NULL;
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
    tetstream_options* options = with(TETSTREAM_OPTION_STEP, cases[i].step);
    CHECK_EQUAL(tetstream_reader_open_memory_with(kSteps, size, "xdmf", options, &reader),
                TETSTREAM_OK);
    CHECK_EQUAL(cells_of(reader), cases[i].cells);
    CHECK_SAYS(tetstream_reader_note(reader, 0), "of 2 time steps, 0 to 1, step");
    tetstream_reader_destroy(reader);
    tetstream_options_destroy(options);
  }
  CHECK_EQUAL(tetstream_reader_open_memory(kSteps, size, "xdmf", &reader), TETSTREAM_OK);
  CHECK_EQUAL(cells_of(reader), 2); /* the last */
  tetstream_reader_destroy(reader);
  const char* wrong[] = {"2", "-1", "next", "", "1 "};
  for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
    tetstream_options* options = with(TETSTREAM_OPTION_STEP, wrong[i]);
    CHECK_EQUAL(tetstream_reader_open_memory_with(kSteps, size, "xdmf", options, &reader),
                TETSTREAM_BAD_ARGUMENT);
    tetstream_reader_destroy(reader);
    tetstream_options_destroy(options);
  }
}

/* What a reader of those bytes gives when they are converted. */
static tetstream_status convert_with(const void* data, size_t size,
                                     const tetstream_options* options, tetstream_reader** reader,
                                     tetstream_writer** writer) {
  const tetstream_status status =
      tetstream_reader_open_memory_with(data, size, "tets", options, reader);
  if (status < 0) return status;
  CHECK_EQUAL(tetstream_writer_create_memory("tets", writer), TETSTREAM_OK);
  return tetstream_convert(*reader, *writer, NULL, NULL, NULL);
}

static void a_damaged_file_is_read_only_if_asked_for(void) {
  tetstream_options* recover = with(TETSTREAM_OPTION_RECOVER, "yes");
  tetstream_reader *reader = NULL, *whole = NULL;
  tetstream_writer *writer = NULL, *file = NULL;
  const void *data = NULL, *out = NULL;
  size_t size = 0, out_size = 0;
  CHECK_EQUAL(tetstream_reader_generate("ball", 100000, 1, &whole), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_memory("tets", &file), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(whole, file, NULL, NULL, NULL), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_get_memory(file, &data, &size), TETSTREAM_OK);
  CHECK_EQUAL(convert_with(data, size / 2, NULL, &reader, &writer), TETSTREAM_BAD_DATA);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(convert_with(data, size / 2, recover, &reader, &writer), TETSTREAM_OK);
  CHECK_SAYS(tetstream_reader_note(reader, 0), "ends at byte");
  CHECK_SAYS(tetstream_reader_note(reader, 1), "the end is missing");
  CHECK_EQUAL(tetstream_writer_get_memory(writer, &out, &out_size), TETSTREAM_OK);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_reader_open_memory(out, out_size, "tets", &reader), TETSTREAM_OK);
  CHECK(cells_of(reader) > 5000);
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);
  CHECK_EQUAL(
      tetstream_reader_open_memory_with(kPyramid, sizeof kPyramid - 1, "mesh", recover, &reader),
      TETSTREAM_UNSUPPORTED);
  CHECK_SAYS(tetstream_reader_message(reader), "only .tets files can be recovered");
  tetstream_reader_destroy(reader);
  tetstream_reader_destroy(whole);
  tetstream_writer_destroy(file);
  tetstream_options_destroy(recover);
}

/* A temporary file, whose name goes to `path`; nothing in it if `text` is NULL. */
#define TEMPORARY "/tmp/tetstream_reading.XXXXXX"
static int made_file(char* path, const char* text) {
  const int fd = mkstemp(path);
  CHECK(fd >= 0);
  if (text) CHECK_EQUAL(write(fd, text, strlen(text)), (ssize_t)strlen(text));
  return fd;
}

static void drop_file(const char* path, int fd) {
  CHECK_EQUAL(close(fd), 0);
  CHECK_EQUAL(unlink(path), 0);
}

static void every_way_of_opening_takes_options(void) {
  char path[] = TEMPORARY;
  const int fd = made_file(path, kPyramid);
  tetstream_options* split = with(TETSTREAM_OPTION_SPLIT, "yes");
  tetstream_reader* reader = NULL;
  CHECK_EQUAL(tetstream_reader_open_file_with(path, "mesh", split, &reader), TETSTREAM_OK);
  CHECK_EQUAL(cells_of(reader), 2);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(lseek(fd, 0, SEEK_SET), 0);
  CHECK_EQUAL(tetstream_reader_open_fd_with(fd, "mesh", split, &reader), TETSTREAM_OK);
  CHECK_EQUAL(cells_of(reader), 2);
  tetstream_reader_destroy(reader);
  tetstream_options_destroy(split);
  drop_file(path, fd);
}

static void a_pipe_is_spooled_where_the_options_say(void) {
  tetstream_options* nowhere = with(TETSTREAM_OPTION_TMPDIR, "/nowhere/at/all");
  tetstream_reader* reader = NULL;
  int ends[2];
  CHECK_EQUAL(pipe(ends), 0);
  CHECK_EQUAL(close(ends[1]), 0);
  CHECK_EQUAL(tetstream_reader_open_fd_with(ends[0], "vtu", nowhere, &reader), TETSTREAM_IO);
  CHECK_SAYS(tetstream_reader_message(reader), "/nowhere/at/all");
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(close(ends[0]), 0);
  tetstream_options_destroy(nowhere);
}

/* What options made of the original may be made already in its result. */
static void a_result_takes_what_it_can(void) {
  char path[] = TEMPORARY;
  const int fd = made_file(path, kPyramid);
  tetstream_options* options = with(TETSTREAM_OPTION_SPLIT, "yes");
  tetstream_reader* reader = NULL;
  CHECK_EQUAL(tetstream_options_set_text(options, TETSTREAM_OPTION_STEP, "3"), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_options_set_text(options, TETSTREAM_OPTION_JOIN_POINTS, "yes"),
              TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_open_file_with(path, "mesh", options, &reader),
              TETSTREAM_UNSUPPORTED);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_reader_open_result(path, "mesh", options, &reader), TETSTREAM_OK);
  CHECK_EQUAL(cells_of(reader), 2); /* without the step alone: it is still cut */
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_options_set_text(options, TETSTREAM_OPTION_SPLIT, "no"), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_open_result(path, "mesh", options, &reader), TETSTREAM_UNSUPPORTED);
  CHECK_SAYS(tetstream_reader_message(reader), "split");
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_reader_open_result("/nowhere", "mesh", NULL, &reader), TETSTREAM_IO);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_reader_open_result(path, "mesh", options, NULL), TETSTREAM_BAD_ARGUMENT);
  tetstream_options_destroy(options);
  drop_file(path, fd);
}

/* A stream takes none of them, save those of streams. */
static void a_result_that_is_a_stream_is_read_as_it_is(void) {
  char path[] = TEMPORARY;
  const int fd = made_file(path, NULL);
  static const char* const kNames[] = {"step", "split", "join-points", "cells-to-points"};
  static const char* const kValues[] = {"2", "yes", "yes", "yes"};
  tetstream_options* options = NULL;
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  CHECK_EQUAL(tetstream_options_create(&options), TETSTREAM_OK);
  for (int i = 0; i < 4; ++i)
    CHECK_EQUAL(tetstream_options_parse(options, kNames[i], kValues[i]), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_generate("ball", 100, 1, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_file(path, "tets", &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(reader, writer, NULL, NULL, NULL), TETSTREAM_OK);
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_reader_open_result(path, "tets", options, &reader), TETSTREAM_OK);
  CHECK(cells_of(reader) > 20);
  tetstream_reader_destroy(reader);
  tetstream_options_destroy(options);
  drop_file(path, fd);
}

struct told {
  int calls, stop_at;
  double last;
};

static int32_t tell(void* user, const tetstream_progress* progress) {
  struct told* told = user;
  CHECK(strcmp(progress->phase, "open") == 0);
  CHECK(progress->fraction >= told->last && progress->fraction <= 1);
  CHECK_EQUAL(progress->cells_total, -1);
  told->last = progress->fraction;
  return ++told->calls == told->stop_at;
}

/* A mesh in text, as its format's writer makes it. */
static tetstream_writer* text_of(int64_t cells, const void** data, size_t* size) {
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  CHECK_EQUAL(tetstream_reader_generate("ball", cells, 1, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_memory("mesh", &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(reader, writer, NULL, NULL, NULL), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_get_memory(writer, data, size), TETSTREAM_OK);
  tetstream_reader_destroy(reader);
  return writer;
}

static void opening_tells_how_far_it_is(void) {
  const void* data;
  size_t size;
  struct told told = {0, 0, 0};
  tetstream_options* options = NULL;
  tetstream_reader* reader = NULL;
  tetstream_writer* text = text_of(30000, &data, &size);
  CHECK_EQUAL(tetstream_options_create(&options), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_options_set_progress(options, tell, &told), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_open_memory_with(data, size, "mesh", options, &reader),
              TETSTREAM_OK);
  CHECK(told.calls >= 1);
  CHECK(told.last > 0);
  CHECK(cells_of(reader) > 20000);
  tetstream_reader_destroy(reader);

  told = (struct told){0, 1, 0};
  CHECK_EQUAL(tetstream_reader_open_memory_with(data, size, "mesh", options, &reader),
              TETSTREAM_CANCELLED);
  CHECK_EQUAL(told.calls, 1);
  CHECK_SAYS(tetstream_reader_message(reader), "progress callback returned 1");
  tetstream_reader_destroy(reader);

  CHECK_EQUAL(tetstream_options_set_progress(options, NULL, NULL), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_open_memory_with(data, size, "mesh", options, &reader),
              TETSTREAM_OK);
  CHECK_EQUAL(told.calls, 1);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_options_set_progress(NULL, tell, NULL), TETSTREAM_BAD_ARGUMENT);
  tetstream_options_destroy(options);
  tetstream_writer_destroy(text);
}

static void null_is_refused(void) {
  tetstream_reader* reader = NULL;
  CHECK_EQUAL(tetstream_reader_open_file_with(NULL, "mesh", NULL, &reader), TETSTREAM_BAD_ARGUMENT);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_reader_open_fd_with(0, NULL, NULL, &reader), TETSTREAM_BAD_ARGUMENT);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_reader_open_memory_with(NULL, 5, "mesh", NULL, &reader),
              TETSTREAM_BAD_ARGUMENT);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_reader_open_memory_with("", 0, "mesh", NULL, NULL), TETSTREAM_BAD_ARGUMENT);
}

/* The head of what a writer of msh gives, with a property. */
static void expect_head(const char* property, const char* value, const char* head) {
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  const void* data = NULL;
  size_t size = 0;
  CHECK_EQUAL(tetstream_reader_generate("ball", 100, 1, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_memory("msh", &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_set(writer, property, value), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(reader, writer, NULL, NULL, NULL), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_get_memory(writer, &data, &size), TETSTREAM_OK);
  CHECK(size > strlen(head) && memcmp(data, head, strlen(head)) == 0);
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
}

static void the_format_msh_has_an_encoding_and_a_version(void) {
  tetstream_writer* writer = NULL;
  expect_head("encoding", "text", "$MeshFormat\n4.1 0 8\n");
  expect_head("encoding", "binary", "$MeshFormat\n4.1 1 8\n");
  expect_head("version", "2.2", "$MeshFormat\n2.2 1 8\n");
  CHECK_EQUAL(tetstream_writer_create_memory("msh", &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_set(writer, "version", "3"), TETSTREAM_BAD_ARGUMENT);
  tetstream_writer_destroy(writer);
  CHECK_EQUAL(tetstream_writer_create_memory("vtu", &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_set(writer, "encoding", "text"), TETSTREAM_BAD_ARGUMENT);
  tetstream_writer_destroy(writer);
}

int main(void) {
  RUN_CASE(other_cells_are_split_only_if_asked_for);
  RUN_CASE(points_are_joined_if_asked_for);
  RUN_CASE(cell_arrays_are_fields_if_asked_for);
  RUN_CASE(one_time_step_is_read);
  RUN_CASE(a_damaged_file_is_read_only_if_asked_for);
  RUN_CASE(every_way_of_opening_takes_options);
  RUN_CASE(a_pipe_is_spooled_where_the_options_say);
  RUN_CASE(a_result_takes_what_it_can);
  RUN_CASE(a_result_that_is_a_stream_is_read_as_it_is);
  RUN_CASE(opening_tells_how_far_it_is);
  RUN_CASE(null_is_refused);
  RUN_CASE(the_format_msh_has_an_encoding_and_a_version);
  return check_end();
}
