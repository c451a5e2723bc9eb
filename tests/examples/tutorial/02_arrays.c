/* Arrays in, arrays out: a box with a linear field, in the solver's own memory.
 *
 *   cc 02_arrays.c $(pkg-config --cflags --libs tetstream) -lm -o 02_arrays
 *
 * Introduces what describes a stream (tetstream_stream_info) and what carries it (tetstream_batch),
 * a mesh that lies in arrays in any order, and the one callback that a writer must have. A linear
 * field and flat sides cost nothing: the result has the same volume and, at its vertices, no error.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <tetstream/tetstream.h>

enum { SIDE = 17, POINTS = SIDE * SIDE * SIDE, CELLS = 6 * (SIDE - 1) * (SIDE - 1) * (SIDE - 1) };

struct mesh {
  int64_t point_count, cell_count;
  double points[POINTS][3], field[POINTS];
  int64_t cells[CELLS][4];
};

static double linear(const double* p) {
  return 1 + p[0] - 2 * p[1] + 3 * p[2];
}

/* Boxes of six cells, each from the lowest corner to the highest along three edges. */
static void make(struct mesh* m) {
  static const int along[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  static const int64_t step[3] = {1, SIDE, SIDE * SIDE};
  for (int64_t i = 0; i < POINTS; ++i) {
    int inside = 1;
    for (int k = 0; k < 3; ++k) {
      const int64_t rank = i / step[k] % SIDE;
      m->points[i][k] = (double)rank / (SIDE - 1);
      inside &= rank < SIDE - 1;
    }
    m->field[i] = linear(m->points[i]);
    for (int c = 0; inside && c < 6; ++c) {
      int64_t* cell = m->cells[m->cell_count++];
      cell[0] = i;
      for (int k = 0; k < 3; ++k) cell[k + 1] = cell[k] + step[along[c][k]];
    }
  }
  m->point_count = POINTS;
}

/* What comes is never more than what went in. */
static int32_t put(void* user, const tetstream_batch* batch) {
  struct mesh* m = user;
  if (batch->vertex_count > 0) {
    const size_t count = (size_t)batch->vertex_count;
    memcpy(m->points[m->point_count], batch->positions, count * sizeof m->points[0]);
    memcpy(m->field + m->point_count, batch->fields[0], count * sizeof m->field[0]);
  }
  if (batch->cell_count > 0)
    memcpy(m->cells[m->cell_count], batch->cells, (size_t)batch->cell_count * sizeof m->cells[0]);
  m->point_count += batch->vertex_count;
  m->cell_count += batch->cell_count;
  return 0;
}

static double volume_of(const struct mesh* m) {
  double sum = 0;
  for (int64_t i = 0; i < m->cell_count; ++i) {
    double e[3][3];
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        e[j][k] = m->points[m->cells[i][j + 1]][k] - m->points[m->cells[i][0]][k];
    sum += fabs(e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
                e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
                e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]));
  }
  return sum / 6;
}

int main(void) {
  static struct mesh in, out;
  make(&in);

  const tetstream_column field = {"temperature", 1, TETSTREAM_TYPE_FLOAT64};
  const void* const fields[] = {in.field};
  const tetstream_stream_info info = {.struct_size = sizeof info,
                                      .position_type = TETSTREAM_TYPE_FLOAT64,
                                      .field_count = 1,
                                      .fields = &field};
  const tetstream_batch batch = {.struct_size = sizeof batch,
                                 .vertex_count = in.point_count,
                                 .positions = in.points,
                                 .fields = fields,
                                 .cell_count = in.cell_count,
                                 .cells = in.cells[0]};
  const tetstream_writer_callbacks callbacks = {
      .struct_size = sizeof callbacks, .user = &out, .put = put};
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  const char* problem = NULL;
  if (tetstream_reader_open_mesh(&info, &batch, &reader) < 0)
    problem = tetstream_reader_message(reader);
  else if (tetstream_writer_create(&callbacks, &writer) < 0 ||
           tetstream_simplifier_create(NULL, writer, &simplifier) < 0 ||
           tetstream_simplifier_run(simplifier, reader) < 0)
    problem = tetstream_simplifier_message(simplifier);
  if (problem) fprintf(stderr, "02_arrays: %s\n", problem);
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);

  double largest = 0;
  for (int64_t i = 0; i < out.point_count; ++i)
    largest = fmax(largest, fabs(out.field[i] - linear(out.points[i])));
  printf("cells %lld -> %lld\nvolume %.9f\nerror below 1e-9: %s\n", (long long)in.cell_count,
         (long long)out.cell_count, volume_of(&out), largest < 1e-9 ? "yes" : "no");
  return problem != NULL;
}
