/* A field that was solved for on the small mesh, carried back to the vertices of the large one.
 *
 *   cc 11_map.c $(pkg-config --cflags --libs tetstream) -lm -o 11_map
 *   ./11_map CELLS
 *
 * Introduces the map: each vertex of the input lies in a cell of the output, with the weights of
 * its corners. It is the prolongation of a multigrid. A field that is linear in space comes back
 * without error; here it is x + 2 y + 3 z, on a ball of about CELLS cells. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <tetstream/tetstream.h>

/* A mesh as it comes; positions of the ball are float32. */
struct mesh {
  int64_t vertex_count, cell_count;
  float (*points)[3];
  int64_t (*cells)[4];
};

/* The map, by vertex of the input. */
struct map {
  int64_t count, room;
  struct row {
    int64_t cell;
    double weights[4];
  } * rows;
};

static void* grown(void* old, int64_t count, size_t size) {
  void* memory = realloc(old, (size_t)(count + 1) * size);
  if (!memory) exit(1);
  return memory;
}

static int32_t put_mesh(void* user, const tetstream_batch* batch) {
  struct mesh* m = user;
  m->points = grown(m->points, m->vertex_count + batch->vertex_count, sizeof *m->points);
  m->cells = grown(m->cells, m->cell_count + batch->cell_count, sizeof *m->cells);
  if (batch->vertex_count > 0)
    memcpy(m->points + m->vertex_count, batch->positions,
           (size_t)batch->vertex_count * sizeof *m->points);
  if (batch->cell_count > 0)
    memcpy(m->cells + m->cell_count, batch->cells, (size_t)batch->cell_count * sizeof *m->cells);
  m->vertex_count += batch->vertex_count;
  m->cell_count += batch->cell_count;
  return 0;
}

/* Rows come in the order of the output's cells. */
static int32_t put_map(void* user, const tetstream_map_rows* rows) {
  struct map* map = user;
  for (int64_t i = 0; i < rows->count; ++i) {
    if (rows->vertices[i] >= map->room) {
      map->room = 2 * rows->vertices[i] + 1;
      map->rows = grown(map->rows, map->room, sizeof *map->rows);
    }
    struct row* row = &map->rows[rows->vertices[i]];
    row->cell = rows->cells[i];
    memcpy(row->weights, rows->weights + 4 * i, sizeof row->weights);
    ++map->count;
  }
  return 0;
}

static tetstream_writer* writer_to(struct mesh* mesh) {
  tetstream_writer* writer = NULL;
  const tetstream_writer_callbacks callbacks = {
      .struct_size = sizeof callbacks, .user = mesh, .put = put_mesh};
  tetstream_writer_create(&callbacks, &writer);
  return writer;
}

static double linear(const float* p) {
  return p[0] + 2.0 * p[1] + 3.0 * p[2];
}

static double largest_error(const struct mesh* large, const struct mesh* small,
                            const struct map* map) {
  double largest = 0;
  for (int64_t i = 0; i < large->vertex_count; ++i) {
    const struct row* row = &map->rows[i];
    double value = 0;
    for (int j = 0; j < 4; ++j)
      value += row->weights[j] * linear(small->points[small->cells[row->cell][j]]);
    largest = fmax(largest, fabs(value - linear(large->points[i])));
  }
  return largest;
}

int main(int argc, char** argv) {
  struct mesh large = {0, 0, NULL, NULL}, small = {0, 0, NULL, NULL};
  struct map map = {0, 0, NULL};
  const tetstream_map_callbacks callbacks = {
      .struct_size = sizeof callbacks, .user = &map, .put = put_map};
  tetstream_reader *once = NULL, *again = NULL;
  tetstream_simplifier* simplifier = NULL;
  const int64_t cells = argc == 2 ? atoll(argv[1]) : 0;
  if (cells < 1) return fprintf(stderr, "usage: 11_map CELLS\n"), 1;
  tetstream_writer *to_large = writer_to(&large), *to_small = writer_to(&small);

  const char* problem = NULL;
  if (tetstream_reader_generate("ball", cells, 1, &once) < 0 ||
      tetstream_reader_generate("ball", cells, 1, &again) < 0)
    problem = tetstream_reader_message(once);
  else if (tetstream_convert(once, to_large, NULL, NULL, NULL) < 0)
    problem = tetstream_writer_message(to_large);
  else if (tetstream_simplifier_create(NULL, to_small, &simplifier) < 0 ||
           tetstream_simplifier_set_map(simplifier, &callbacks) < 0 ||
           tetstream_simplifier_run(simplifier, again) < 0)
    problem = tetstream_simplifier_message(simplifier);
  if (problem)
    fprintf(stderr, "11_map: %s\n", problem);
  else
    printf("%lld of %lld vertices have a place among %lld; error below 1e-5: %s\n",
           (long long)map.count, (long long)large.vertex_count, (long long)small.vertex_count,
           largest_error(&large, &small, &map) < 1e-5 ? "yes" : "no");
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(to_large);
  tetstream_writer_destroy(to_small);
  tetstream_reader_destroy(once);
  tetstream_reader_destroy(again);
  free(large.points);
  free(large.cells);
  free(small.points);
  free(small.cells);
  free(map.rows);
  return problem != NULL;
}
