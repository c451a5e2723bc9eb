/* A reader of one's own: a bar of any length that is never in memory, only two of its layers are.
 *
 *   ./04_reader LENGTH OUT
 *
 * Introduces the callbacks of a reader, and finalization: the layer behind is told to be done with,
 * and so the library can simplify and write it while the bar goes on. */
#include <stdio.h>
#include <stdlib.h>
#include <tetstream/tetstream.h>

enum { SIDE = 9, LAYER = SIDE * SIDE, BOXES = (SIDE - 1) * (SIDE - 1) };

struct bar {
  int64_t length, layer; /* in boxes; the layer of points that comes next */
  float points[LAYER][3], heat[LAYER];
  int64_t cells[6 * BOXES][4], done[LAYER];
  const void* fields[1];
};

static int32_t open_bar(void* user, tetstream_stream_info* info) {
  static const tetstream_column heat = {"heat", 1, TETSTREAM_TYPE_FLOAT32};
  const struct bar* b = user;
  info->position_type = TETSTREAM_TYPE_FLOAT32;
  info->field_count = 1;
  info->fields = &heat;
  /* Not needed, but then a run can tell how far it is. */
  info->vertex_count = (b->length + 1) * LAYER;
  info->cell_count = b->length * 6 * BOXES;
  return 0;
}

/* The boxes between this layer of points and the one before. */
static int64_t fill_cells(struct bar* b) {
  static const int along[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  static const int step[3] = {1, SIDE, LAYER};
  int64_t count = 0;
  for (int64_t i = 0; i < LAYER; ++i)
    for (int c = 0; i % SIDE < SIDE - 1 && i / SIDE < SIDE - 1 && c < 6; ++c, ++count) {
      b->cells[count][0] = (b->layer - 1) * LAYER + i;
      for (int k = 0; k < 3; ++k) b->cells[count][k + 1] = b->cells[count][k] + step[along[c][k]];
    }
  return count;
}

/* One layer, or, past the end, nothing: that ends the stream. */
static int32_t next_layer(void* user, tetstream_batch* batch) {
  struct bar* b = user;
  if (b->layer > b->length) return 0;
  for (int i = 0; i < LAYER; ++i) {
    const int x = i % SIDE, y = i / SIDE;
    b->points[i][0] = (float)x / (SIDE - 1);
    b->points[i][1] = (float)y / (SIDE - 1);
    b->points[i][2] = (float)b->layer / (SIDE - 1);
    b->heat[i] = b->points[i][0] * b->points[i][0];
    b->done[i] = (b->layer - 1) * LAYER + i;
  }
  b->fields[0] = b->heat;
  batch->vertex_count = LAYER;
  batch->positions = b->points;
  batch->fields = b->fields;
  if (b->layer > 0) {
    batch->cell_count = fill_cells(b);
    batch->cells = b->cells[0];
    batch->finalized_count = LAYER; /* those of the layer before */
    batch->finalized = b->done;
  }
  ++b->layer;
  return 0;
}

int main(int argc, char** argv) {
  static struct bar bar;
  const tetstream_reader_callbacks callbacks = {
      .struct_size = sizeof callbacks, .user = &bar, .open = open_bar, .next = next_layer};
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  tetstream_report report = {.struct_size = sizeof report};
  if (argc != 3 || (bar.length = atoll(argv[1])) < 1)
    return fprintf(stderr, "usage: 04_reader LENGTH OUT\n"), 1;
  const char* problem = NULL;
  if (tetstream_writer_create_file(argv[2], NULL, &writer) < 0)
    problem = tetstream_writer_message(writer);
  else if (tetstream_reader_create(&callbacks, &reader) < 0 ||
           tetstream_simplifier_create(NULL, writer, &simplifier) < 0 ||
           tetstream_simplifier_run(simplifier, reader) < 0 ||
           tetstream_simplifier_get_report(simplifier, &report) < 0)
    problem = tetstream_simplifier_message(simplifier);
  if (problem)
    fprintf(stderr, "04_reader: %s\n", problem);
  else
    printf("cells %lld -> %lld, front %lld vertices, window %lld cells\n",
           (long long)report.cells_in, (long long)report.cells_out, (long long)report.front_width,
           (long long)report.window_cells);
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
  return problem != NULL;
}
