/* The bar of 04_reader.c, pushed by the program that computes it: the loop is the program's own.
 *
 *   ./06_push LENGTH OUT
 *
 * Introduces begin, push and finish. The result has the same bytes as that of 04_reader.c, though
 * here points, boxes and finalizations come one after the other: how a stream is cut does not
 * count. (Far larger batches than a box are quicker.) */
#include <stdio.h>
#include <stdlib.h>
#include <tetstream/tetstream.h>

enum { SIDE = 9, LAYER = SIDE * SIDE };

/* The points of one layer; no cell yet. */
static tetstream_status push_points(tetstream_simplifier* simplifier, int64_t layer) {
  float points[LAYER][3], heat[LAYER];
  const void* const fields[] = {heat};
  const tetstream_batch batch = {
      .struct_size = sizeof batch, .vertex_count = LAYER, .positions = points, .fields = fields};
  for (int i = 0; i < LAYER; ++i) {
    const int x = i % SIDE, y = i / SIDE;
    points[i][0] = (float)x / (SIDE - 1);
    points[i][1] = (float)y / (SIDE - 1);
    points[i][2] = (float)layer / (SIDE - 1);
    heat[i] = points[i][0] * points[i][0];
  }
  return tetstream_simplifier_push(simplifier, &batch);
}

/* The six cells of a box above point `low`. */
static tetstream_status push_box(tetstream_simplifier* simplifier, int64_t low) {
  static const int along[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  static const int step[3] = {1, SIDE, LAYER};
  int64_t cells[6][4];
  const tetstream_batch batch = {.struct_size = sizeof batch, .cell_count = 6, .cells = cells[0]};
  for (int c = 0; c < 6; ++c) {
    cells[c][0] = low;
    for (int k = 0; k < 3; ++k) cells[c][k + 1] = cells[c][k] + step[along[c][k]];
  }
  return tetstream_simplifier_push(simplifier, &batch);
}

/* No later cell uses the points of this layer. */
static tetstream_status push_end_of(tetstream_simplifier* simplifier, int64_t layer) {
  int64_t done[LAYER];
  const tetstream_batch batch = {
      .struct_size = sizeof batch, .finalized_count = LAYER, .finalized = done};
  for (int i = 0; i < LAYER; ++i) done[i] = layer * LAYER + i;
  return tetstream_simplifier_push(simplifier, &batch);
}

static tetstream_status push_bar(tetstream_simplifier* simplifier, int64_t length) {
  const tetstream_column heat = {"heat", 1, TETSTREAM_TYPE_FLOAT32};
  const tetstream_stream_info info = {.struct_size = sizeof info,
                                      .position_type = TETSTREAM_TYPE_FLOAT32,
                                      .field_count = 1,
                                      .fields = &heat,
                                      .vertex_count = (length + 1) * LAYER,
                                      .cell_count = length * 6 * (SIDE - 1) * (SIDE - 1)};
  tetstream_status status = tetstream_simplifier_begin(simplifier, &info);
  for (int64_t layer = 0; status >= 0 && layer <= length; ++layer) {
    status = push_points(simplifier, layer);
    for (int64_t i = 0; layer > 0 && status >= 0 && i < LAYER - SIDE; ++i)
      if (i % SIDE < SIDE - 1) status = push_box(simplifier, (layer - 1) * LAYER + i);
    if (layer > 0 && status >= 0) status = push_end_of(simplifier, layer - 1);
  }
  return status >= 0 ? tetstream_simplifier_finish(simplifier) : status;
}

int main(int argc, char** argv) {
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  const int64_t length = argc == 3 ? atoll(argv[1]) : 0;
  if (length < 1) return fprintf(stderr, "usage: 06_push LENGTH OUT\n"), 1;
  const char* problem = NULL;
  if (tetstream_writer_create_file(argv[2], NULL, &writer) < 0)
    problem = tetstream_writer_message(writer);
  else if (tetstream_simplifier_create(NULL, writer, &simplifier) < 0 ||
           push_bar(simplifier, length) < 0)
    problem = tetstream_simplifier_message(simplifier);
  if (problem) fprintf(stderr, "06_push: %s\n", problem);
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
  return problem != NULL;
}
