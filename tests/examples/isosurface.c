/* A sink of one's own: the isosurface of a mesh, made while the mesh is being simplified.
 *
 *   isosurface MESH FIELD VALUE OUT.obj [RATIO]
 *   cc isosurface.c $(pkg-config --cflags --libs tetstream) -o isosurface
 *
 * Writes the triangles where FIELD of the simplified MESH has VALUE. RATIO is cells out / cells in,
 * 0.1 if not given. The simplified mesh is never stored: a vertex is kept from when it comes until
 * it is finalized, and with it the points of the surface on its edges. Wavefront's OBJ lets points
 * and triangles be written as they are made. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <tetstream/tetstream.h>

enum { BUCKETS = 1 << 16 };

/* A point of the surface on the edge to another vertex, or at the vertex itself. */
struct cut {
  int64_t other, point;
  struct cut* next;
};

struct vertex {
  int64_t id;
  double place[3], value;
  struct cut* cuts;
  struct vertex* next; /* in its bucket */
};

struct surface {
  const char* field_name;
  double value;
  FILE* file;
  int field, field_is_double, position_is_double;
  int64_t vertices, points, faces, active, most_active;
  struct vertex* buckets[BUCKETS]; /* the active vertices, by id */
};

static int failed(const char* message) {
  fprintf(stderr, "isosurface: %s\n", message);
  return 1;
}

static double number(const void* array, int is_double, int64_t i) {
  return is_double ? ((const double*)array)[i] : ((const float*)array)[i];
}

static struct vertex** find(struct surface* s, int64_t id) {
  struct vertex** at = &s->buckets[id % BUCKETS];
  while (*at && (*at)->id != id) at = &(*at)->next;
  return at;
}

static int add_vertex(struct surface* s, const tetstream_batch* batch, int64_t i) {
  struct vertex *v = calloc(1, sizeof *v), **at = find(s, s->vertices);
  if (!v) return 1;
  v->id = s->vertices++;
  for (int k = 0; k < 3; ++k)
    v->place[k] = number(batch->positions, s->position_is_double, 3 * i + k);
  v->value = number(batch->fields[s->field], s->field_is_double, i);
  *at = v;
  if (++s->active > s->most_active) s->most_active = s->active;
  return 0;
}

static void drop_vertex(struct surface* s, int64_t id) {
  struct vertex **at = find(s, id), *v = *at;
  if (!v) return;
  *at = v->next;
  for (struct cut *c = v->cuts, *next; c; c = next) {
    next = c->next;
    free(c);
  }
  free(v);
  --s->active;
}

/* The point between a vertex below the value and one that is not; -1: no memory. Where the latter
 * has just the value it is the point, for all its edges. */
static int64_t point_between(struct surface* s, struct vertex* below, struct vertex* above) {
  const double share = (s->value - below->value) / (above->value - below->value);
  const int at_vertex = above->value == s->value;
  struct vertex* keeper = at_vertex || above->id < below->id ? above : below;
  const int64_t other = at_vertex || keeper == below ? above->id : below->id;
  struct cut* c = keeper->cuts;
  while (c && c->other != other) c = c->next;
  if (c) return c->point;
  if (!(c = malloc(sizeof *c))) return -1;
  c->other = other;
  c->point = ++s->points; /* OBJ counts from 1 */
  c->next = keeper->cuts;
  keeper->cuts = c;
  double p[3];
  for (int k = 0; k < 3; ++k) p[k] = below->place[k] + share * (above->place[k] - below->place[k]);
  fprintf(s->file, "v %.15g %.15g %.15g\n", p[0], p[1], p[2]);
  return c->point;
}

/* The triangles in a cell: none, one or two; their normals point to where the field is lower. */
static int cut_cell(struct surface* s, const int64_t* ids) {
  struct vertex* corner[4]; /* those below the value first */
  int below = 0, above = 4, touched = 0;
  for (int j = 0; j < 4; ++j) {
    struct vertex* v = *find(s, ids[j]);
    corner[v->value < s->value ? below++ : --above] = v;
    touched += v->value == s->value;
  }
  if (below == 0 || below == 4 || (touched == 4 - below && touched < 3)) return 0;
  double e[3][3]; /* edges from the first corner, and the volume that they span */
  for (int i = 0; i < 9; ++i)
    e[i / 3][i % 3] = corner[i / 3 + 1]->place[i % 3] - corner[0]->place[i % 3];
  const double volume = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
                        e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
                        e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
  /* The edges that are cut, around the polygon, by the number of corners below. */
  static const int edges[3][4][2] = {{{0, 1}, {0, 2}, {0, 3}, {0, 3}},
                                     {{0, 2}, {0, 3}, {1, 3}, {1, 2}},
                                     {{0, 3}, {1, 3}, {2, 3}, {2, 3}}};
  int64_t p[4];
  for (int i = 0; i < 4; ++i) {
    const int* edge = edges[below - 1][volume > 0 ? 3 - i : i];
    if ((p[i] = point_between(s, corner[edge[0]], corner[edge[1]])) < 0) return 1;
  }
  for (int i = 1; i < 3; ++i) {
    if (p[0] == p[i] || p[i] == p[i + 1] || p[i + 1] == p[0]) continue;
    fprintf(s->file, "f %lld %lld %lld\n", (long long)p[0], (long long)p[i], (long long)p[i + 1]);
    ++s->faces;
  }
  return 0;
}

static int32_t begin(void* user, const tetstream_stream_info* info) {
  struct surface* s = user;
  for (s->field = 0; s->field < info->field_count; ++s->field)
    if (strcmp(info->fields[s->field].name, s->field_name) == 0) break;
  if (s->field == info->field_count || info->fields[s->field].components != 1 ||
      info->fields[s->field].type > TETSTREAM_TYPE_FLOAT64)
    return failed("there is no such field of one float");
  s->position_is_double = info->position_type == TETSTREAM_TYPE_FLOAT64;
  s->field_is_double = info->fields[s->field].type == TETSTREAM_TYPE_FLOAT64;
  return 0;
}

static int32_t take(void* user, const tetstream_batch* batch) {
  struct surface* s = user;
  for (int64_t i = 0; i < batch->vertex_count; ++i)
    if (add_vertex(s, batch, i)) return 2;
  for (int64_t i = 0; i < batch->cell_count; ++i) {
    if (cut_cell(s, batch->cells + 4 * i)) return 2;
    for (int j = 0; j < 4; ++j)
      if (batch->last_uses && batch->last_uses[i] >> j & 1) drop_vertex(s, batch->cells[4 * i + j]);
  }
  for (int64_t i = 0; i < batch->finalized_count; ++i) drop_vertex(s, batch->finalized[i]);
  return 0;
}

static void end(void* user) {
  struct surface* s = user;
  for (int i = 0; i < BUCKETS; ++i)
    while (s->buckets[i]) drop_vertex(s, s->buckets[i]->id);
}

int main(int argc, char** argv) {
  static struct surface s;
  const tetstream_writer_callbacks sink = {
      .struct_size = sizeof sink, .user = &s, .open = begin, .put = take, .close = end};
  tetstream_options* options = NULL;
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  int bad = 0;
  if (argc < 5 || argc > 6) return failed("usage: isosurface MESH FIELD VALUE OUT.obj [RATIO]");
  s.field_name = argv[2];
  s.value = atof(argv[3]);
  s.file = fopen(argv[4], "wb");
  if (!s.file) return failed("the output cannot be opened");
  if (tetstream_options_create(&options) < 0 ||
      tetstream_options_parse(options, "ratio", argc > 5 ? argv[5] : "0.1") < 0)
    bad = failed(tetstream_options_message(options));
  else if (tetstream_reader_open_file(argv[1], NULL, &reader) < 0)
    bad = failed(tetstream_reader_message(reader));
  else if (tetstream_writer_create(&sink, &writer) < 0 ||
           tetstream_simplifier_create(options, writer, &simplifier) < 0 ||
           tetstream_simplifier_run(simplifier, reader) < 0)
    bad = failed(tetstream_simplifier_message(simplifier));
  else
    printf("%lld triangles, %lld points, at most %lld of %lld vertices in core\n",
           (long long)s.faces, (long long)s.points, (long long)s.most_active,
           (long long)s.vertices);
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
  tetstream_options_destroy(options);
  bad |= ferror(s.file) | fclose(s.file);
  if (bad) remove(argv[4]);
  return bad;
}
