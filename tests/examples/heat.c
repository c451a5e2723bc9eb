/* In situ: a solver of the heat equation that hands its time steps to the simplifier while it runs.
 *
 *   heat MESH OUT [STEPS [EVERY [DT]]]
 *   cc heat.c $(pkg-config --cflags --libs tetstream) -lm -o heat
 *
 * Solves u_t = div(grad u) on the tetrahedra of MESH, a file in any format that tetstream reads:
 * linear finite elements, no flux through the boundary, lumped mass, backward Euler, conjugate
 * gradients. At first u = 1 + cos(pi s), s = (x - xmin) / L, where L = xmax - xmin. STEPS (50)
 * steps of DT (0.001) times L * L are done; the first state and that after every EVERY-th step (10)
 * are simplified to a tenth and written to OUT-000.tets, OUT-010.tets and so on.
 *
 * Of each of them a line tells the step, t / L^2, the heat content (sum of mass times u), the
 * amplitude of the cosine (on a box it decays like exp(-pi^2 t / L^2)), and the cells that were
 * written. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <tetstream/tetstream.h>

enum { BATCH = 8192 }; /* cells that are handed over at a time */

/* The mesh in the order of a stream, and the equations on it. */
struct heat {
  int position_type;
  int64_t vertex_count, vertex_room, cell_count, cell_room;
  int64_t front_cells; /* of the stream, or -1: what the simplifier's window follows from */
  double* points;      /* [vertex_count][3] */
  int64_t* cells;      /* [cell_count][4] */
  uint8_t* last_uses;  /* [cell_count], bit j: no later cell uses corner j */
  double* stiffness;   /* [cell_count][6], of the pairs of corners below */
  double dt;
  /* [vertex_count]: lumped mass, solution, the cosine, and four that the solver works with. */
  double *mass, *u, *cosine, *diagonal, *r, *p, *q;
};

static const int pairs[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

static int failed(const char* message) {
  fprintf(stderr, "heat: %s\n", message);
  return 1;
}

static void* allocate(void* old, int64_t count, size_t size) {
  void* memory = realloc(old, (size_t)(count > 0 ? count : 1) * size);
  if (!memory) exit(failed("out of memory"));
  return memory;
}

/* -------------------------------------------------------------------------------- reading */

static int32_t begin_mesh(void* user, const tetstream_stream_info* info) {
  struct heat* h = user;
  h->position_type = info->position_type;
  h->front_cells = info->front_cells;
  return 0;
}

static int32_t take_batch(void* user, const tetstream_batch* batch) {
  struct heat* h = user;
  if (h->vertex_count + batch->vertex_count > h->vertex_room) {
    h->vertex_room = 2 * (h->vertex_count + batch->vertex_count);
    h->points = allocate(h->points, h->vertex_room, sizeof(double[3]));
  }
  for (int64_t i = 0; i < 3 * batch->vertex_count; ++i)
    h->points[3 * h->vertex_count + i] = h->position_type == TETSTREAM_TYPE_FLOAT32
                                             ? ((const float*)batch->positions)[i]
                                             : ((const double*)batch->positions)[i];
  h->vertex_count += batch->vertex_count;
  if (h->cell_count + batch->cell_count > h->cell_room) {
    h->cell_room = 2 * (h->cell_count + batch->cell_count);
    h->cells = allocate(h->cells, h->cell_room, sizeof(int64_t[4]));
  }
  if (batch->cell_count > 0)
    memcpy(h->cells + 4 * h->cell_count, batch->cells,
           (size_t)batch->cell_count * sizeof(int64_t[4]));
  h->cell_count += batch->cell_count;
  return 0;
}

/* Reads the mesh in an order that streams well: a file that is no stream is ordered on the way. */
static int read_mesh(struct heat* h, const char* path) {
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  const tetstream_writer_callbacks callbacks = {
      .struct_size = sizeof callbacks, .user = h, .open = begin_mesh, .put = take_batch};
  int bad = 0;
  if (tetstream_reader_open_file(path, NULL, &reader) < 0)
    bad = failed(tetstream_reader_message(reader));
  else if (tetstream_writer_create(&callbacks, &writer) < 0 ||
           tetstream_convert(reader, writer, NULL, NULL, NULL) < 0)
    bad = failed(tetstream_writer_message(writer));
  else if (h->cell_count == 0)
    bad = failed("the mesh has no cells");
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
  return bad;
}

/* The stream ends a vertex with the last cell that uses it: seen from the end, the first. */
static void find_last_uses(struct heat* h) {
  uint8_t* seen = allocate(NULL, h->vertex_count, 1);
  memset(seen, 0, (size_t)h->vertex_count);
  h->last_uses = allocate(NULL, h->cell_count, 1);
  for (int64_t c = h->cell_count - 1; c >= 0; --c) {
    h->last_uses[c] = 0;
    for (int j = 0; j < 4; ++j) {
      uint8_t* vertex = &seen[h->cells[4 * c + j]];
      if (!*vertex) h->last_uses[c] |= (uint8_t)(1 << j);
      *vertex = 1;
    }
  }
  free(seen);
}

/* -------------------------------------------------------------------------------- solving */

/* Volume and stiffness of a cell: with the normal n_i, as long as twice the area, of the face
 * across from corner i, integral grad_i . grad_j = n_i . n_j / (36 volume). */
static int add_cell(struct heat* h, int64_t c) {
  const int64_t* corner = h->cells + 4 * c;
  double edge[4][3], normal[4][3];
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k)
      edge[i][k] = h->points[3 * corner[i] + k] - h->points[3 * corner[0] + k];
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3, m = (k + 2) % 3;
    normal[1][k] = edge[2][l] * edge[3][m] - edge[2][m] * edge[3][l];
    normal[2][k] = edge[3][l] * edge[1][m] - edge[3][m] * edge[1][l];
    normal[3][k] = edge[1][l] * edge[2][m] - edge[1][m] * edge[2][l];
    normal[0][k] = -(normal[1][k] + normal[2][k] + normal[3][k]);
  }
  const double volume =
      fabs(edge[1][0] * normal[1][0] + edge[1][1] * normal[1][1] + edge[1][2] * normal[1][2]) / 6;
  if (!(volume > 0)) {
    const double* at = h->points + 3 * corner[0];
    fprintf(stderr, "heat: the cell at (%g, %g, %g) is flat\n", at[0], at[1], at[2]);
    return 1;
  }
  for (int j = 0; j < 4; ++j) h->mass[corner[j]] += volume / 4;
  for (int e = 0; e < 6; ++e) {
    const double *a = normal[pairs[e][0]], *b = normal[pairs[e][1]];
    h->stiffness[6 * c + e] = (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / (36 * volume);
  }
  return 0;
}

static int assemble(struct heat* h, double dt_over_square) {
  const int64_t n = h->vertex_count;
  double** const arrays[] = {&h->mass, &h->u, &h->cosine, &h->diagonal, &h->r, &h->p, &h->q};
  for (int i = 0; i < 7; ++i) {
    *arrays[i] = allocate(NULL, n, sizeof(double));
    memset(*arrays[i], 0, (size_t)n * sizeof(double));
  }
  h->stiffness = allocate(NULL, h->cell_count, sizeof(double[6]));
  double low = h->points[0], high = low;
  for (int64_t i = 0; i < n; ++i) {
    low = fmin(low, h->points[3 * i]);
    high = fmax(high, h->points[3 * i]);
  }
  h->dt = dt_over_square * (high - low) * (high - low);
  for (int64_t c = 0; c < h->cell_count; ++c)
    if (add_cell(h, c)) return 1;
  /* The rows of the stiffness sum to 0: what is on the diagonal is minus the rest. */
  memcpy(h->diagonal, h->mass, (size_t)n * sizeof(double));
  for (int64_t c = 0; c < h->cell_count; ++c)
    for (int e = 0; e < 6; ++e)
      for (int k = 0; k < 2; ++k)
        h->diagonal[h->cells[4 * c + pairs[e][k]]] -= h->dt * h->stiffness[6 * c + e];
  for (int64_t i = 0; i < n; ++i) {
    h->cosine[i] = cos(3.14159265358979323846 * (h->points[3 * i] - low) / (high - low));
    h->u[i] = 1 + h->cosine[i];
    if (h->diagonal[i] == 0) h->diagonal[i] = 1; /* a vertex in no cell stays as it is */
  }
  return 0;
}

/* out = (mass + dt stiffness) in */
static void apply(const struct heat* h, const double* in, double* out) {
  for (int64_t i = 0; i < h->vertex_count; ++i) out[i] = h->mass[i] * in[i];
  for (int64_t c = 0; c < h->cell_count; ++c)
    for (int e = 0; e < 6; ++e) {
      const int64_t a = h->cells[4 * c + pairs[e][0]], b = h->cells[4 * c + pairs[e][1]];
      const double flow = h->dt * h->stiffness[6 * c + e] * (in[b] - in[a]);
      out[a] += flow;
      out[b] -= flow;
    }
}

static double dot(const struct heat* h, const double* a, const double* b) {
  double sum = 0;
  for (int64_t i = 0; i < h->vertex_count; ++i) sum += a[i] * b[i];
  return sum;
}

/* One step: (mass + dt stiffness) u_new = mass u, down to 1e-10 of the right-hand side, by
 * conjugate gradients that begin at u and divide by the diagonal. */
static int step(struct heat* h) {
  const int64_t n = h->vertex_count;
  double right = 0, before = 0;
  apply(h, h->u, h->q);
  for (int64_t i = 0; i < n; ++i) {
    const double known = h->mass[i] * h->u[i];
    right += known * known;
    h->r[i] = known - h->q[i];
    h->p[i] = h->r[i] / h->diagonal[i];
    before += h->r[i] * h->p[i];
  }
  for (int iteration = 0; dot(h, h->r, h->r) > 1e-20 * right; ++iteration) {
    if (iteration == 10000) return failed("no convergence in 10000 iterations");
    apply(h, h->p, h->q);
    const double length = before / dot(h, h->p, h->q);
    double after = 0;
    for (int64_t i = 0; i < n; ++i) {
      h->u[i] += length * h->p[i];
      h->r[i] -= length * h->q[i];
      after += h->r[i] * h->r[i] / h->diagonal[i];
    }
    for (int64_t i = 0; i < n; ++i) h->p[i] = h->r[i] / h->diagonal[i] + after / before * h->p[i];
    before = after;
  }
  return 0;
}

/* --------------------------------------------------------------------- handing over a step */

/* The mesh and its box once more, with the field as it is now, in pieces: each has the vertices
 * that its cells are the first to use. */
static tetstream_status push_mesh(const struct heat* h, double time,
                                  tetstream_simplifier* simplifier) {
  const tetstream_column column = {"u", 1, TETSTREAM_TYPE_FLOAT64};
  double low[4], high[4];
  for (int k = 0; k < 4; ++k) {
    low[k] = high[k] = k < 3 ? h->points[k] : h->u[0];
    for (int64_t i = 0; i < h->vertex_count; ++i) {
      const double value = k < 3 ? h->points[3 * i + k] : h->u[i];
      low[k] = fmin(low[k], value);
      high[k] = fmax(high[k], value);
    }
  }
  const tetstream_stream_info info = {.struct_size = sizeof info,
                                      .position_type = TETSTREAM_TYPE_FLOAT64,
                                      .flags = TETSTREAM_STREAM_TIMED,
                                      .field_count = 1,
                                      .fields = &column,
                                      .vertex_count = h->vertex_count,
                                      .cell_count = h->cell_count,
                                      .front_cells = h->front_cells,
                                      .box_min = low,
                                      .box_max = high,
                                      .time = time};
  tetstream_status status = tetstream_simplifier_begin(simplifier, &info);
  int64_t vertex = 0; /* the next one to be handed over */
  for (int64_t cell = 0; status >= 0 && cell < h->cell_count; cell += BATCH) {
    const void* const fields[] = {h->u + vertex};
    tetstream_batch batch = {.struct_size = sizeof batch,
                             .positions = h->points + 3 * vertex,
                             .fields = fields,
                             .cell_count = BATCH,
                             .cells = h->cells + 4 * cell,
                             .last_uses = h->last_uses + cell};
    for (int64_t i = 0; i < 4 * BATCH && i < 4 * (h->cell_count - cell); ++i)
      if (batch.cells[i] >= vertex + batch.vertex_count)
        batch.vertex_count = batch.cells[i] + 1 - vertex;
    if (cell + BATCH >= h->cell_count) { /* the last cells, and the vertices that none uses */
      batch.cell_count = h->cell_count - cell;
      batch.vertex_count = h->vertex_count - vertex;
    }
    vertex += batch.vertex_count;
    status = tetstream_simplifier_push(simplifier, &batch);
  }
  return status >= 0 ? tetstream_simplifier_finish(simplifier) : status;
}

/* How much of u is the cosine without its mean. */
static double amplitude(const struct heat* h) {
  double volume = 0, mean = 0, part = 0, whole = 0;
  for (int64_t i = 0; i < h->vertex_count; ++i) {
    volume += h->mass[i];
    mean += h->mass[i] * h->cosine[i];
  }
  for (int64_t i = 0; i < h->vertex_count; ++i) {
    const double wave = h->cosine[i] - mean / volume;
    part += h->mass[i] * wave * h->u[i];
    whole += h->mass[i] * wave * wave;
  }
  return part / whole;
}

static int write_step(const struct heat* h, const char* out, int number, double time) {
  char path[4096];
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  tetstream_report report = {.struct_size = sizeof report};
  int bad = 0;
  if (snprintf(path, sizeof path, "%s-%03d.tets", out, number) >= (int)sizeof path)
    bad = failed("the name of the output is too long");
  else if (tetstream_writer_create_file(path, NULL, &writer) < 0)
    bad = failed(tetstream_writer_message(writer));
  else if (tetstream_simplifier_create(NULL, writer, &simplifier) < 0 ||
           push_mesh(h, number * h->dt, simplifier) < 0 ||
           tetstream_simplifier_get_report(simplifier, &report) < 0)
    bad = failed(tetstream_simplifier_message(simplifier));
  else
    printf("%d %.6g %.15g %.9g %lld\n", number, time, dot(h, h->mass, h->u), amplitude(h),
           (long long)report.cells_out);
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer); /* what was written before a failure goes with it */
  return bad;
}

static void destroy(struct heat* h) {
  void* const arrays[] = {h->points, h->cells,    h->last_uses, h->stiffness, h->mass, h->u,
                          h->cosine, h->diagonal, h->r,         h->p,         h->q};
  for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; ++i) free(arrays[i]);
}

int main(int argc, char** argv) {
  struct heat h = {.front_cells = -1};
  const int steps = argc > 3 ? atoi(argv[3]) : 50, every = argc > 4 ? atoi(argv[4]) : 10;
  const double dt = argc > 5 ? atof(argv[5]) : 0.001;
  if (argc < 3 || argc > 6 || steps < 0 || every < 1 || !(dt > 0)) {
    fprintf(stderr, "usage: heat MESH OUT [STEPS [EVERY [DT]]]\n");
    return 1;
  }
  int bad = read_mesh(&h, argv[1]) || assemble(&h, dt);
  if (!bad) {
    find_last_uses(&h);
    printf("# step time content amplitude cells\n");
  }
  for (int done = 0; !bad && done <= steps; ++done)
    bad = (done > 0 && step(&h)) || (done % every == 0 && write_step(&h, argv[2], done, done * dt));
  destroy(&h);
  return bad;
}
