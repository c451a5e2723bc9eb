#include "hostile.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---------------------------------------------------------------------------------- the mesh */

/* Kuhn's split: the six monotone paths from corner 0 to corner 7 of a cube (bits: x, y, z). */
static const int paths[6][4] = {{0, 1, 3, 7}, {0, 1, 7, 5}, {0, 2, 7, 3},
                                {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 7, 6}};

static void fill_cells(hostile_mesh* mesh, int64_t* rank, int nx, int ny, int nz) {
  int64_t cell = 0;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        for (int path = 0; path < 6; ++path, ++cell) {
          mesh->region[cell] = 2 * z < nz ? 1 : 2;
          for (int j = 0; j < 4; ++j) {
            const int corner = paths[path][j];
            const int at[3] = {x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2)};
            const int64_t grid = at[0] + (nx + 1) * (at[1] + (int64_t)(ny + 1) * at[2]);
            if (rank[grid] < 0) {
              const int64_t v = rank[grid] = mesh->vertex_count++;
              for (int i = 0; i < 3; ++i) mesh->positions[3 * v + i] = at[i];
              mesh->density[v] = at[0] + 0.5 * at[1] * at[1] + 0.1 * at[2];
              for (int i = 0; i < 3; ++i) mesh->velocity[3 * v + i] = (float)(at[i] * at[2]);
            }
            mesh->cells[4 * cell + j] = rank[grid];
          }
        }
  mesh->cell_count = cell;
}

static void fill_box(hostile_mesh* mesh) {
  for (int64_t v = 0; v < mesh->vertex_count; ++v) {
    const double* x = mesh->positions + 3 * v;
    const float* u = mesh->velocity + 3 * v;
    const double row[7] = {x[0], x[1], x[2], mesh->density[v], u[0], u[1], u[2]};
    for (int i = 0; i < 7; ++i) {
      if (v == 0 || row[i] < mesh->box_min[i]) mesh->box_min[i] = row[i];
      if (v == 0 || row[i] > mesh->box_max[i]) mesh->box_max[i] = row[i];
    }
  }
}

/* rank[v] becomes 1 once a later cell uses v. */
static void fill_last_uses(hostile_mesh* mesh, int64_t* rank) {
  for (int64_t v = 0; v < mesh->vertex_count; ++v) rank[v] = 0;
  for (int64_t cell = mesh->cell_count; cell-- > 0;) {
    mesh->last_uses[cell] = 0;
    for (int j = 0; j < 4; ++j) {
      const int64_t v = mesh->cells[4 * cell + j];
      if (!rank[v]) mesh->last_uses[cell] |= (uint8_t)(1 << j);
      rank[v] = 1;
    }
  }
}

hostile_mesh* hostile_mesh_create(int nx, int ny, int nz) {
  const size_t vertices = (size_t)(nx + 1) * (size_t)(ny + 1) * (size_t)(nz + 1);
  const size_t cells = 6 * (size_t)nx * (size_t)ny * (size_t)nz;
  int64_t* rank = malloc(vertices * sizeof *rank);
  hostile_mesh* mesh = calloc(1, sizeof *mesh);
  if (mesh) {
    mesh->positions = malloc(vertices * 3 * sizeof(double));
    mesh->density = malloc(vertices * sizeof(double));
    mesh->velocity = malloc(vertices * 3 * sizeof(float));
    mesh->cells = malloc(cells * 4 * sizeof(int64_t));
    mesh->last_uses = malloc(cells);
    mesh->region = malloc(cells * sizeof(int32_t));
  }
  if (!rank || !mesh || !mesh->positions || !mesh->density || !mesh->velocity || !mesh->cells ||
      !mesh->last_uses || !mesh->region) {
    hostile_mesh_destroy(mesh);
    free(rank);
    return NULL;
  }
  for (size_t v = 0; v < vertices; ++v) rank[v] = -1;
  fill_cells(mesh, rank, nx, ny, nz);
  fill_last_uses(mesh, rank);
  fill_box(mesh);
  free(rank);
  return mesh;
}

void hostile_mesh_destroy(hostile_mesh* mesh) {
  if (!mesh) return;
  free(mesh->positions);
  free(mesh->density);
  free(mesh->velocity);
  free(mesh->cells);
  free(mesh->last_uses);
  free(mesh->region);
  free(mesh);
}

void hostile_mesh_info(const hostile_mesh* mesh, tetstream_stream_info* info) {
  static const tetstream_column fields[2] = {{"density", 1, TETSTREAM_TYPE_FLOAT64},
                                             {"velocity", 3, TETSTREAM_TYPE_FLOAT32}};
  static const tetstream_column cell_data[1] = {{"region", 1, TETSTREAM_TYPE_INT32}};
  memset(info, 0, sizeof *info);
  info->struct_size = sizeof *info;
  info->position_type = TETSTREAM_TYPE_FLOAT64;
  info->field_count = 2;
  info->fields = fields;
  info->cell_data_count = 1;
  info->cell_data = cell_data;
  info->vertex_count = mesh->vertex_count;
  info->cell_count = mesh->cell_count;
  info->front_width = info->front_span = info->front_cells = -1;
  info->box_min = mesh->box_min;
  info->box_max = mesh->box_max;
}

void hostile_mesh_batch(const hostile_mesh* mesh, tetstream_batch* batch, const void* columns[3]) {
  columns[0] = mesh->density;
  columns[1] = mesh->velocity;
  columns[2] = mesh->region;
  memset(batch, 0, sizeof *batch);
  batch->struct_size = sizeof *batch;
  batch->vertex_count = mesh->vertex_count;
  batch->positions = mesh->positions;
  batch->fields = columns;
  batch->cell_count = mesh->cell_count;
  batch->cells = mesh->cells;
  batch->last_uses = mesh->last_uses;
  batch->cell_data = columns + 2;
}

/* -------------------------------------------------------------------------------- the reader */

/* The arrays of a batch lie in one block, which is overwritten and freed at the next call. */
static void drop_buffer(hostile_reader* r) {
  if (r->buffer) memset(r->buffer, 0xa5, r->buffer_size);
  free(r->buffer);
  r->buffer = NULL;
}

/* What the next batch holds: vertices and cells from where the reader is, finalizations apart. */
typedef struct span {
  int64_t vertices, cells, finalized;
} span;

static int64_t vertices_needed(const hostile_reader* r, int64_t cells) {
  int64_t end = r->vertex;
  for (int64_t i = 4 * r->cell; i < 4 * (r->cell + cells); ++i)
    if (r->mesh->cells[i] >= end) end = r->mesh->cells[i] + 1;
  return end - r->vertex;
}

static int64_t at_most(int64_t count, int64_t limit) {
  return count < limit ? count : limit;
}

static span next_span(hostile_reader* r) {
  static const int odd[] = {1, 2, 3, 5, 7, 11, 13, 1, 1, 29};
  const int64_t left = r->mesh->cell_count - r->cell;
  span s = {0, 0, 0};
  if (r->cut == HOSTILE_WHOLE) {
    s.cells = left;
    s.vertices = r->mesh->vertex_count - r->vertex;
  } else if (r->cut == HOSTILE_ODD || r->cut == HOSTILE_LISTS) {
    s.cells = at_most(odd[r->step++ % 10], left);
    s.vertices = vertices_needed(r, s.cells);
  } else if (r->cut == HOSTILE_VERTICES) {
    s.vertices = r->mesh->vertex_count - r->vertex;
    s.cells = s.vertices ? 0 : at_most(10, left);
  } else if (r->explicit_at < 4 && r->cell > 0) {
    s.finalized = 1;
  } else {
    s.vertices = left && vertices_needed(r, 1) > 0;
    s.cells = left && !s.vertices;
  }
  return s;
}

/* The finalizations of the batch: as bits of its cells, or as a list. */
static int64_t list_finalized(const hostile_reader* r, int64_t first, int64_t cells, int64_t* out) {
  int64_t count = 0;
  for (int64_t c = first; c < first + cells; ++c)
    for (int j = 0; j < 4; ++j)
      if (r->mesh->last_uses[c] >> j & 1) out[count++] = r->mesh->cells[4 * c + j];
  return count;
}

static char* take(char** at, const void* from, size_t bytes) {
  char* out = *at;
  if (from && bytes) memcpy(out, from, bytes);
  *at += (bytes + 15) / 16 * 16;
  return out;
}

static int make_buffer(hostile_reader* r, span s) {
  r->buffer_size =
      (size_t)s.vertices * (24 + 8 + 12) + (size_t)s.cells * (32 + 1 + 4 + 32) + 16 * 16 + 64;
  r->buffer = malloc(r->buffer_size);
  return r->buffer != NULL;
}

/* Spoils what was filled in; the arrays are the reader's own. */
static void spoil(const hostile_reader* r, tetstream_batch* b, int64_t* cells, double* positions,
                  uint8_t* last_uses, const void** columns) {
  switch (r->spoil) {
    case HOSTILE_GARBAGE_ID:
      cells[0] = INT64_MAX - 3;
      break;
    case HOSTILE_NEGATIVE_ID:
      cells[1] = -7;
      break;
    case HOSTILE_NEGATIVE_COUNT:
      b->cell_count = -5;
      break;
    case HOSTILE_NULL_POSITIONS:
      b->positions = NULL;
      break;
    case HOSTILE_NULL_FIELD:
      columns[1] = NULL;
      break;
    case HOSTILE_LAST_USES:
      last_uses[0] = 16;
      break;
    case HOSTILE_NAN:
      positions[1] = NAN;
      break;
    case HOSTILE_TWICE:
      cells[0] = r->mesh->cells[0];
      last_uses[0] = 15;
      break;
    default:
      break;
  }
}

static int fill(hostile_reader* r, tetstream_batch* b, span s) {
  const hostile_mesh* m = r->mesh;
  if (!make_buffer(r, s)) return -1;
  char* at = r->buffer;
  const void** columns = (const void**)(void*)take(&at, NULL, 3 * sizeof(void*));
  double* positions =
      (double*)(void*)take(&at, m->positions + 3 * r->vertex, (size_t)s.vertices * 24);
  columns[0] = take(&at, m->density + r->vertex, (size_t)s.vertices * 8);
  columns[1] = take(&at, m->velocity + 3 * r->vertex, (size_t)s.vertices * 12);
  int64_t* cells = (int64_t*)(void*)take(&at, m->cells + 4 * r->cell, (size_t)s.cells * 32);
  columns[2] = take(&at, m->region + r->cell, (size_t)s.cells * 4);
  uint8_t* last_uses = (uint8_t*)take(&at, m->last_uses + r->cell, (size_t)s.cells);
  int64_t* finalized = (int64_t*)(void*)take(&at, NULL, (size_t)s.cells * 32 + 8);
  b->vertex_count = s.vertices;
  b->positions = positions;
  b->fields = columns;
  b->cell_count = s.cells;
  b->cells = cells;
  b->cell_data = columns + 2;
  b->finalized = finalized;
  if (r->flags & TETSTREAM_STREAM_INDEXED) {
    b->finalized_count = 0;
  } else if (r->cut == HOSTILE_LISTS) {
    b->finalized_count = list_finalized(r, r->cell, s.cells, finalized);
  } else if (s.finalized) {
    finalized[0] = m->cells[4 * (r->cell - 1) + r->explicit_at];
    b->finalized_count = 1;
  } else if (r->cut != HOSTILE_ITEMS) {
    b->last_uses = last_uses;
  }
  if (r->spoil && r->nexts == r->spoil_batch) {
    b->last_uses = last_uses;
    spoil(r, b, cells, positions, last_uses, columns);
  }
  return 0;
}

/* Item by item, the finalizations of the last cell come one by one after it. */
static void skip_to_finalization(hostile_reader* r) {
  if (r->cut != HOSTILE_ITEMS || r->cell == 0 || (r->flags & TETSTREAM_STREAM_INDEXED)) {
    r->explicit_at = 4;
    return;
  }
  while (r->explicit_at < 4 && !(r->mesh->last_uses[r->cell - 1] >> r->explicit_at & 1))
    ++r->explicit_at;
}

static int32_t reader_open(void* user, tetstream_stream_info* info) {
  hostile_reader* r = user;
  ++r->opens;
  if (r->fail_call == 1) return r->fail_value;
  hostile_mesh_info(r->mesh, info);
  info->flags = r->flags;
  r->explicit_at = 4;
  return 0;
}

static int32_t reader_next(void* user, tetstream_batch* batch) {
  hostile_reader* r = user;
  ++r->nexts;
  if (r->ended) ++r->calls_after_end;
  drop_buffer(r);
  if (r->fail_call == r->nexts + 1) return r->fail_value;
  skip_to_finalization(r);
  const span s = next_span(r);
  if (r->empty || s.vertices + s.cells + s.finalized == 0) {
    r->ended = 1;
    return 0;
  }
  if (fill(r, batch, s) != 0) return -1;
  r->vertex += s.vertices;
  r->cell += s.cells;
  if (s.cells) r->explicit_at = 0;
  if (s.finalized) ++r->explicit_at;
  return 0;
}

static void reader_close(void* user) {
  hostile_reader* r = user;
  ++r->closes;
  drop_buffer(r);
}

tetstream_reader_callbacks hostile_reader_callbacks(hostile_reader* reader) {
  tetstream_reader_callbacks c = {sizeof c, reader, reader_open, reader_next, reader_close};
  return c;
}

void hostile_reader_free(hostile_reader* reader) {
  drop_buffer(reader);
}

/* -------------------------------------------------------------------------------- the writer */

static void called(hostile_writer* w, char call, const char* allowed_before) {
  if (!strchr(allowed_before, w->last_call ? w->last_call : '-')) ++w->order_errors;
  w->last_call = call;
}

static int32_t writer_open(void* user, const tetstream_stream_info* info) {
  hostile_writer* w = user;
  called(w, 'o', "-");
  ++w->opens;
  if (info->struct_size < sizeof *info) ++w->order_errors;
  return w->fail_open ? w->fail_value : 0;
}

static void know(hostile_writer* w, int64_t count) {
  if (w->vertices + count > w->state_size) {
    const int64_t size = 2 * (w->vertices + count);
    unsigned char* state = realloc(w->state, (size_t)size);
    if (!state) abort();
    w->state = state;
    w->state_size = size;
  }
  memset(w->state + w->vertices, 1, (size_t)count);
  w->vertices += count;
}

static void use(hostile_writer* w, int64_t vertex, int last) {
  if (vertex < 0 || vertex >= w->vertices || w->state[vertex] != 1) {
    ++w->stream_errors;
    return;
  }
  if (!last) return;
  w->state[vertex] = 2;
  ++w->finalized;
}

static int32_t writer_put(void* user, const tetstream_batch* b) {
  hostile_writer* w = user;
  called(w, 'p', w->opens ? "op" : "-p");
  ++w->puts;
  if (w->puts == w->fail_put) return w->fail_value;
  if (b->vertex_count) know(w, b->vertex_count);
  for (int64_t c = 0; c < b->cell_count; ++c)
    for (int j = 0; j < 4; ++j)
      use(w, b->cells[4 * c + j], b->last_uses && (b->last_uses[c] >> j & 1));
  for (int64_t i = 0; i < b->finalized_count; ++i) use(w, b->finalized[i], 1);
  w->cells += b->cell_count;
  return 0;
}

static int32_t writer_finish(void* user) {
  hostile_writer* w = user;
  called(w, 'f', "op");
  ++w->finishes;
  return w->fail_finish ? w->fail_value : 0;
}

static void writer_close(void* user) {
  hostile_writer* w = user;
  called(w, 'c', "opf");
  ++w->closes;
}

tetstream_writer_callbacks hostile_writer_callbacks(hostile_writer* writer) {
  tetstream_writer_callbacks c = {sizeof c,   writer,        writer_open,
                                  writer_put, writer_finish, writer_close};
  return c;
}

tetstream_writer_callbacks hostile_writer_minimal(hostile_writer* writer) {
  tetstream_writer_callbacks c = {sizeof c, writer, NULL, writer_put, NULL, NULL};
  return c;
}

void hostile_writer_free(hostile_writer* writer) {
  free(writer->state);
  writer->state = NULL;
}
