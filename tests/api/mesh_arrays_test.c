/* Indexed meshes in arrays of the caller's: what must be there, and which numbers cells may have.
 */
#include <stdlib.h>

#include "check.h"
#include "hostile.h"

static hostile_mesh* mesh;

static void meshes_in_arrays_are_checked_when_opened(void) {
  tetstream_stream_info info;
  tetstream_batch batch;
  const void* pointers[3];
  tetstream_reader* reader = NULL;
  hostile_mesh_info(mesh, &info);
  hostile_mesh_batch(mesh, &batch, pointers);
  info.vertex_count = info.cell_count = 123456789;
  CHECK_EQUAL(tetstream_reader_open_mesh(&info, &batch, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_get_info(reader, &info), TETSTREAM_OK);
  CHECK_EQUAL(info.vertex_count, mesh->vertex_count);
  CHECK_EQUAL(info.cell_count, mesh->cell_count);
  CHECK_EQUAL(info.flags, TETSTREAM_STREAM_INDEXED);
  tetstream_reader_destroy(reader);

  hostile_mesh_info(mesh, &info);
  batch.cell_count = -1;
  CHECK_EQUAL(tetstream_reader_open_mesh(&info, &batch, &reader), TETSTREAM_BAD_DATA);
  tetstream_reader_destroy(reader);
  batch.cell_count = mesh->cell_count;
  batch.cells = NULL;
  CHECK_EQUAL(tetstream_reader_open_mesh(&info, &batch, &reader), TETSTREAM_BAD_DATA);
  tetstream_reader_destroy(reader);
  batch.cells = mesh->cells;
  batch.fields = NULL;
  CHECK_EQUAL(tetstream_reader_open_mesh(&info, &batch, &reader), TETSTREAM_BAD_DATA);
  tetstream_reader_destroy(reader);
}

/* Neither has rows, so neither needs pointers to its fields and cell arrays. */
static void a_mesh_without_cells_or_points_needs_no_arrays(void) {
  for (int points = 0; points < 2; ++points) {
    tetstream_stream_info info;
    tetstream_batch batch, empty = {0};
    const void* pointers[3];
    tetstream_reader* reader = NULL;
    hostile_mesh_info(mesh, &info);
    hostile_mesh_batch(mesh, &batch, pointers);
    empty.struct_size = sizeof empty;
    empty.vertex_count = points ? mesh->vertex_count : 0;
    empty.positions = points ? batch.positions : NULL;
    empty.fields = points ? batch.fields : NULL;
    CHECK_EQUAL(tetstream_reader_open_mesh(&info, &empty, &reader), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_inspect(reader, NULL, NULL, NULL, &info), TETSTREAM_OK);
    CHECK_EQUAL(info.cell_count, 0);
    tetstream_reader_destroy(reader);
  }
}

/* The bytes of a .tets of the mesh; the caller frees them. */
static void* converted(const tetstream_stream_info* info, const tetstream_batch* batch,
                       size_t* size) {
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  const void* bytes = NULL;
  CHECK_EQUAL(tetstream_reader_open_mesh(info, batch, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_memory("tets", &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(reader, writer, NULL, NULL, NULL), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_get_memory(writer, &bytes, size), TETSTREAM_OK);
  void* copy = malloc(*size);
  CHECK(copy != NULL);
  memcpy(copy, bytes, *size);
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
  return copy;
}

static void cells_in_an_array_may_be_int32(void) {
  tetstream_stream_info info;
  tetstream_batch batch;
  const void* pointers[3];
  hostile_mesh_info(mesh, &info);
  hostile_mesh_batch(mesh, &batch, pointers);
  size_t wide_size = 0, narrow_size = 0;
  void* wide = converted(&info, &batch, &wide_size);
  int32_t* cells = malloc(4 * sizeof(int32_t) * (size_t)mesh->cell_count);
  CHECK(cells != NULL);
  for (int64_t i = 0; i < 4 * mesh->cell_count; ++i) cells[i] = (int32_t)mesh->cells[i];
  batch.cells = NULL;
  batch.cells32 = cells;
  void* narrow = converted(&info, &batch, &narrow_size);
  CHECK_EQUAL(narrow_size, wide_size);
  CHECK(memcmp(narrow, wide, wide_size) == 0);
  free(narrow);
  free(wide);

  /* An id is checked as it is, and no other stream has such cells. */
  tetstream_reader* reader = NULL;
  cells[5] = -1;
  CHECK_EQUAL(tetstream_reader_open_mesh(&info, &batch, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_inspect(reader, NULL, NULL, NULL, &info), TETSTREAM_BAD_DATA);
  CHECK_SAYS(tetstream_reader_message(reader), "cell 1: vertex -1");
  tetstream_reader_destroy(reader);
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  CHECK_EQUAL(tetstream_writer_create_memory("tets", &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_create(NULL, writer, &simplifier), TETSTREAM_OK);
  hostile_mesh_info(mesh, &info);
  CHECK_EQUAL(tetstream_simplifier_begin(simplifier, &info), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_push(simplifier, &batch), TETSTREAM_BAD_DATA);
  CHECK_SAYS(tetstream_simplifier_message(simplifier), "cells32");
  batch.cells = mesh->cells;
  CHECK_EQUAL(tetstream_reader_open_mesh(&info, &batch, &reader), TETSTREAM_BAD_ARGUMENT);
  tetstream_reader_destroy(reader);
  free(cells);
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
}

enum { BOX = 3 + 1 + 3 };

/* Of the error, for a mesh that comes with this box. */
static double estimate(const double* low, const double* high) {
  tetstream_stream_info info;
  tetstream_batch batch;
  const void* pointers[3];
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  tetstream_report report = {.struct_size = sizeof report};
  hostile_mesh_info(mesh, &info);
  hostile_mesh_batch(mesh, &batch, pointers);
  info.box_min = low;
  info.box_max = high;
  CHECK_EQUAL(tetstream_reader_open_mesh(&info, &batch, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_memory("tets", &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_create(NULL, writer, &simplifier), TETSTREAM_OK);
  CHECK(tetstream_simplifier_run(simplifier, reader) >= 0);
  CHECK_EQUAL(tetstream_simplifier_get_report(simplifier, &report), TETSTREAM_OK);
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
  return report.estimated_error;
}

/* Then errors are in percent of its ranges. A box that is too small is widened. */
static void a_part_may_have_the_box_of_the_whole(void) {
  double middle[BOX], low[BOX], high[BOX];
  for (int i = 0; i < BOX; ++i) {
    const double more = i < 3 ? 0 : 50 * (mesh->box_max[i] - mesh->box_min[i]);
    middle[i] = (mesh->box_min[i] + mesh->box_max[i]) / 2;
    low[i] = mesh->box_min[i] - more;
    high[i] = mesh->box_max[i] + more;
  }
  const double alone = estimate(NULL, NULL), as_part = estimate(low, high);
  CHECK(as_part > 0 && as_part < alone / 10);
  CHECK(estimate(middle, middle) == alone);
  CHECK(estimate(mesh->box_min, mesh->box_max) == alone);
}

int main(void) {
  mesh = hostile_mesh_create(3, 4, 5);
  CHECK(mesh != NULL);
  RUN_CASE(meshes_in_arrays_are_checked_when_opened);
  RUN_CASE(a_mesh_without_cells_or_points_needs_no_arrays);
  RUN_CASE(cells_in_an_array_may_be_int32);
  RUN_CASE(a_part_may_have_the_box_of_the_whole);
  hostile_mesh_destroy(mesh);
  return check_end();
}
