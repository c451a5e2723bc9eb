/* Whatever is done with a stream: a number that no vertex has is an error, not another vertex. */
#include <tetstream/tetstream.h>

#include "check.h"

/* One cell, of which the last vertex has a number that nobody gave. */
typedef struct stranger {
  int64_t cell[4];
  int at_end;
} stranger;

static int32_t stranger_open(void* user, tetstream_stream_info* info) {
  ((stranger*)user)->at_end = 0;
  static const tetstream_column field = {"f", 1, TETSTREAM_TYPE_FLOAT64};
  info->position_type = TETSTREAM_TYPE_FLOAT64;
  info->vertex_count = 4;
  info->cell_count = 1;
  info->field_count = 1;
  info->fields = &field;
  return 0;
}
static int32_t stranger_next(void* user, tetstream_batch* batch) {
  static const double positions[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  static const void* const fields[1] = {positions};
  stranger* s = user;
  if (s->at_end) return 0;
  s->at_end = 1;
  batch->vertex_count = 4;
  batch->positions = positions;
  batch->fields = fields;
  batch->cell_count = 1;
  batch->cells = s->cell;
  return 0;
}

static tetstream_reader* reader_of(stranger* s) {
  tetstream_reader* reader = NULL;
  tetstream_reader_callbacks reads = {0};
  reads.struct_size = sizeof reads;
  reads.user = s;
  reads.open = stranger_open;
  reads.next = stranger_next;
  CHECK_EQUAL(tetstream_reader_create(&reads, &reader), TETSTREAM_OK);
  return reader;
}

static tetstream_status converted(stranger* s) {
  tetstream_writer* writer = NULL;
  tetstream_reader* reader = reader_of(s);
  CHECK_EQUAL(tetstream_writer_create_memory("tets", &writer), TETSTREAM_OK);
  const tetstream_status status = tetstream_convert(reader, writer, NULL, NULL, NULL);
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
  return status;
}

static tetstream_status simplified(stranger* s) {
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  tetstream_reader* reader = reader_of(s);
  CHECK_EQUAL(tetstream_writer_create_memory("tets", &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_create(NULL, writer, &simplifier), TETSTREAM_OK);
  const tetstream_status status = tetstream_simplifier_run(simplifier, reader);
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
  return status;
}

static tetstream_status compared(stranger* s) {
  tetstream_comparison* comparison = NULL;
  stranger sound = {{0, 1, 2, 3}, 0};
  tetstream_reader *first = reader_of(&sound), *second = reader_of(s);
  CHECK_EQUAL(tetstream_comparison_create(NULL, &comparison), TETSTREAM_OK);
  const tetstream_status status = tetstream_comparison_read(comparison, first, second, NULL, NULL);
  tetstream_comparison_destroy(comparison);
  tetstream_reader_destroy(first);
  tetstream_reader_destroy(second);
  return status;
}

static tetstream_status drawn(stranger* s) {
  tetstream_diagram* diagram = NULL;
  tetstream_reader* reader = reader_of(s);
  CHECK_EQUAL(tetstream_diagram_create(NULL, 9, 9, &diagram), TETSTREAM_OK);
  const tetstream_status status =
      tetstream_diagram_read(diagram, reader, TETSTREAM_PAGE_LAYOUT, NULL, NULL);
  tetstream_diagram_destroy(diagram);
  tetstream_reader_destroy(reader);
  return status;
}

static tetstream_status inspected(stranger* s) {
  tetstream_stream_info info = {0};
  tetstream_reader* reader = reader_of(s);
  info.struct_size = sizeof info;
  const tetstream_status status = tetstream_inspect(reader, NULL, NULL, NULL, &info);
  tetstream_reader_destroy(reader);
  return status;
}

/* Whatever its low bits are, also those of a vertex that is there. */
static void numbers_that_nobody_gave_are_no_vertices(void) {
  tetstream_status (*const uses[])(stranger*) = {converted, simplified, compared, drawn, inspected};
  for (size_t i = 0; i < sizeof uses / sizeof uses[0]; ++i) {
    stranger s = {{0, 1, 2, 3}, 0};
    CHECK(uses[i](&s) >= 0);
    for (int bit = 2; bit < 64; ++bit) {
      s.cell[3] = (int64_t)((UINT64_C(1) << bit) + 3);
      CHECK_EQUAL(uses[i](&s), TETSTREAM_BAD_DATA);
    }
  }
}

int main(void) {
  RUN_CASE(numbers_that_nobody_gave_are_no_vertices);
  return check_end();
}
