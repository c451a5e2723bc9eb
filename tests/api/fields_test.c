/* Several fields through the C interface and through files: measured, carried, picked; bits kept
 * where a vertex stayed; as many components as there may be. */
#include <math.h>
#include <stdlib.h>

#include "rig.h"

#define MOST_FIELDS 15
#define LABEL_BASE 0x3fffffffffffff00 /* no float64 holds it */
#define CELL_BASE (-0x3fffffffffffff00)

static hostile_mesh* grid;
static int side; /* its cubes along each axis */

/* The grid with columns of its own, in and out. */
typedef struct mesh {
  int64_t vertex_count, cell_count;
  double* positions;
  void* fields[MOST_FIELDS];
  uint8_t* locked;
  int64_t* cells;
  int64_t* ids; /* cell data */
  tetstream_column columns[MOST_FIELDS];
  int32_t field_count, is_open;
} mesh;

static size_t bytes_of(const tetstream_column* column) {
  const int is_short =
      column->type == TETSTREAM_TYPE_FLOAT32 || column->type == TETSTREAM_TYPE_INT32;
  return (size_t)column->components * (is_short ? 4 : 8);
}

static const tetstream_column id_column = {"id", 1, TETSTREAM_TYPE_INT64};

static void mesh_free(mesh* m) {
  for (int f = 0; f < m->field_count; ++f) free(m->fields[f]);
  free(m->positions);
  free(m->locked);
  free(m->cells);
  free(m->ids);
  memset(m, 0, sizeof *m);
}

static void* add_field(mesh* m, const char* name, int components, int type) {
  const tetstream_column column = {name, components, type};
  m->columns[m->field_count] = column;
  return m->fields[m->field_count++] = malloc((size_t)m->vertex_count * bytes_of(&column));
}

static double wave(const double* x, int k) {
  return sin(0.4 * x[0] + 0.1 * k) * cos(0.3 * x[1] - 0.2 * k) + 0.01 * k * x[2] * x[2];
}

static double linear(const double* x, int k) {
  return (k + 1) * (3 * x[0] - x[1] + 0.5 * x[2] + 11);
}

/* No field yet; the boundary and every fifth vertex are locked. */
static mesh bare_mesh(void) {
  mesh m = {0};
  m.vertex_count = grid->vertex_count;
  m.cell_count = grid->cell_count;
  m.positions = malloc((size_t)m.vertex_count * 24);
  m.cells = malloc((size_t)m.cell_count * 32);
  m.ids = malloc((size_t)m.cell_count * 8);
  m.locked = malloc((size_t)m.vertex_count);
  memcpy(m.cells, grid->cells, (size_t)m.cell_count * 32);
  for (int64_t c = 0; c < m.cell_count; ++c) m.ids[c] = CELL_BASE + c;
  for (int64_t v = 0; v < m.vertex_count; ++v) {
    int outside = 0;
    for (int i = 0; i < 3; ++i) {
      const double x = grid->positions[3 * v + i];
      outside |= x == 0 || x == side;
      m.positions[3 * v + i] = x + (x == 0 || x == side ? 0 : 0.1 * sin(7.0 * (double)v + i));
    }
    m.locked[v] = (uint8_t)(outside || v % 5 == 0);
  }
  return m;
}

/* "density" (f64), "velocity" (3 x f32), "linear" (2 x f64), "label" (i64), "mark" (2 x i32). */
static mesh mixed_mesh(void) {
  mesh m = bare_mesh();
  double* density = add_field(&m, "density", 1, TETSTREAM_TYPE_FLOAT64);
  float* velocity = add_field(&m, "velocity", 3, TETSTREAM_TYPE_FLOAT32);
  double* lines = add_field(&m, "linear", 2, TETSTREAM_TYPE_FLOAT64);
  int64_t* labels = add_field(&m, "label", 1, TETSTREAM_TYPE_INT64);
  int32_t* marks = add_field(&m, "mark", 2, TETSTREAM_TYPE_INT32);
  for (int64_t v = 0; v < m.vertex_count; ++v) {
    const double* x = m.positions + 3 * v;
    density[v] = wave(x, 0) + 1e-13 * (double)v;
    for (int k = 0; k < 3; ++k) velocity[3 * v + k] = (float)wave(x, k + 1);
    for (int k = 0; k < 2; ++k) lines[2 * v + k] = linear(x, k);
    labels[v] = LABEL_BASE + v;
    for (int k = 0; k < 2; ++k) marks[2 * v + k] = (int32_t)(7 * v + k);
  }
  return m;
}

static tetstream_reader* reader_of(const mesh* m) {
  static const void* cell_data[1];
  tetstream_stream_info info = {0};
  tetstream_batch batch = {0};
  tetstream_reader* reader = NULL;
  info.struct_size = sizeof info;
  info.position_type = TETSTREAM_TYPE_FLOAT64;
  info.flags = TETSTREAM_STREAM_INDEXED;
  info.field_count = m->field_count;
  info.fields = m->columns;
  info.cell_data_count = 1;
  info.cell_data = &id_column;
  batch.struct_size = sizeof batch;
  batch.vertex_count = m->vertex_count;
  batch.positions = m->positions;
  batch.fields = (const void* const*)m->fields;
  batch.locked = m->locked;
  batch.cell_count = m->cell_count;
  batch.cells = m->cells;
  cell_data[0] = m->ids;
  batch.cell_data = cell_data;
  CHECK_EQUAL(tetstream_reader_open_mesh(&info, &batch, &reader), TETSTREAM_OK);
  return reader;
}

/* -------------------------------------------------------------------------------- a writer */

static int32_t take_info(void* user, const tetstream_stream_info* info) {
  mesh* m = user;
  m->is_open = 1;
  m->field_count = info->field_count;
  for (int f = 0; f < info->field_count; ++f) {
    m->columns[f] = info->fields[f];
    m->columns[f].name = NULL; /* lives during the call only */
  }
  CHECK_EQUAL(info->position_type, TETSTREAM_TYPE_FLOAT64);
  CHECK_EQUAL(info->cell_data_count, 1);
  return 0;
}

static void* appended(void* to, size_t at, const void* from, size_t bytes) {
  to = realloc(to, at + bytes + 1);
  if (bytes > 0) memcpy((char*)to + at, from, bytes);
  return to;
}

static int32_t take_batch(void* user, const tetstream_batch* batch) {
  mesh* m = user;
  const size_t had = (size_t)m->vertex_count, came = (size_t)batch->vertex_count;
  m->positions = appended(m->positions, 24 * had, batch->positions, 24 * came);
  for (int f = 0; f < m->field_count; ++f) {
    const size_t width = bytes_of(&m->columns[f]);
    m->fields[f] = appended(m->fields[f], width * had, batch->fields[f], width * came);
  }
  const size_t had_cells = (size_t)m->cell_count, came_cells = (size_t)batch->cell_count;
  if (came_cells > 0) {
    m->cells = appended(m->cells, 32 * had_cells, batch->cells, 32 * came_cells);
    m->ids = appended(m->ids, 8 * had_cells, batch->cell_data[0], 8 * came_cells);
  }
  m->vertex_count += batch->vertex_count;
  m->cell_count += batch->cell_count;
  return 0;
}

static tetstream_writer* writer_into(mesh* m) {
  tetstream_writer_callbacks calls = {0};
  tetstream_writer* writer = NULL;
  calls.struct_size = sizeof calls;
  calls.user = m;
  calls.open = take_info;
  calls.put = take_batch;
  CHECK_EQUAL(tetstream_writer_create(&calls, &writer), TETSTREAM_OK);
  return writer;
}

/* What simplifying gives; the options are destroyed. */
static mesh simplified(tetstream_reader* reader, tetstream_options* options) {
  mesh out = {0};
  tetstream_writer* writer = writer_into(&out);
  tetstream_simplifier* simplifier = NULL;
  CHECK_EQUAL(tetstream_simplifier_create(options, writer, &simplifier), TETSTREAM_OK);
  const tetstream_status status = tetstream_simplifier_run(simplifier, reader);
  if (!CHECK(status >= 0)) printf("    %s\n", tetstream_simplifier_message(simplifier));
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
  tetstream_options_destroy(options);
  return out;
}

/* The same through files of a format: the input is one, and the output is read from one. */
static mesh simplified_files(const mesh* in, const char* format, tetstream_options* options) {
  mesh out = {0};
  tetstream_writer *files[2] = {NULL, NULL}, *writer = writer_into(&out);
  tetstream_reader* reader = reader_of(in);
  tetstream_simplifier* simplifier = NULL;
  const void* bytes = NULL;
  size_t size = 0;
  for (int i = 0; i < 2; ++i)
    CHECK_EQUAL(tetstream_writer_create_memory(format, &files[i]), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(reader, files[0], NULL, NULL, NULL), TETSTREAM_OK);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_writer_get_memory(files[0], &bytes, &size), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_open_memory(bytes, size, format, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_create(options, files[1], &simplifier), TETSTREAM_OK);
  CHECK(tetstream_simplifier_run(simplifier, reader) >= 0);
  tetstream_simplifier_destroy(simplifier);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_writer_get_memory(files[1], &bytes, &size), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_open_memory(bytes, size, format, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(reader, writer, NULL, NULL, NULL), TETSTREAM_OK);
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);
  for (int i = 0; i < 2; ++i) tetstream_writer_destroy(files[i]);
  tetstream_options_destroy(options);
  return out;
}

/* ---------------------------------------------------------------------------------- the cases */

static tetstream_options* measuring(double ratio, const char* name) {
  tetstream_options* options = options_of(ratio);
  if (name) CHECK_EQUAL(tetstream_options_add_field(options, name, 1), TETSTREAM_OK);
  return options;
}

/* Where the boundary is locked every new place lies in an old cell. */
static void check_carried_linear(const mesh* out) {
  const double* lines = out->fields[2];
  int64_t off = 0;
  for (int64_t v = 0; v < out->vertex_count; ++v)
    for (int k = 0; k < 2; ++k)
      off += fabs(lines[2 * v + k] - linear(out->positions + 3 * v, k)) > 1e-10;
  CHECK_EQUAL(off, 0);
}

/* One value of those that came, both columns from the same vertex, no vertex twice. */
static void check_picked(const mesh* in, const mesh* out) {
  const int64_t* labels = out->fields[3];
  const int32_t* marks = out->fields[4];
  char* seen = calloc((size_t)(in->vertex_count + in->cell_count), 1);
  for (int64_t v = 0; v < out->vertex_count; ++v) {
    const int64_t from = labels[v] - LABEL_BASE;
    if (!CHECK(from >= 0 && from < in->vertex_count)) break;
    CHECK_EQUAL(seen[from]++, 0);
    CHECK_EQUAL(marks[2 * v], 7 * from);
    CHECK_EQUAL(marks[2 * v + 1], 7 * from + 1);
  }
  for (int64_t c = 0; c < out->cell_count; ++c) {
    const int64_t from = out->ids[c] - CELL_BASE;
    if (!CHECK(from >= 0 && from < in->cell_count)) break;
    CHECK_EQUAL(seen[in->vertex_count + from]++, 0);
  }
  free(seen);
}

/* Locked vertices are there with every bit of all that they have. Their labels find them. */
static void check_bits(const mesh* in, const mesh* out) {
  int64_t kept = 0, locked = 0;
  for (int64_t v = 0; v < in->vertex_count; ++v) locked += in->locked[v];
  for (int64_t v = 0; v < out->vertex_count; ++v) {
    const int64_t from = ((const int64_t*)out->fields[3])[v] - LABEL_BASE;
    if (from < 0 || from >= in->vertex_count || !in->locked[from]) continue;
    ++kept;
    CHECK(memcmp(out->positions + 3 * v, in->positions + 3 * from, 24) == 0);
    for (int f = 0; f < in->field_count; ++f) {
      const size_t width = bytes_of(&in->columns[f]);
      CHECK(memcmp((char*)out->fields[f] + width * (size_t)v,
                   (char*)in->fields[f] + width * (size_t)from, width) == 0);
    }
  }
  CHECK_EQUAL(kept, locked);
  CHECK(kept < out->vertex_count);
}

static void check_mixed(const mesh* in, const mesh* out) {
  CHECK(out->cell_count > 0 && out->cell_count < in->cell_count * 9 / 10);
  CHECK_EQUAL(out->field_count, in->field_count);
  for (int f = 0; f < in->field_count; ++f) {
    CHECK_EQUAL(out->columns[f].type, in->columns[f].type);
    CHECK_EQUAL(out->columns[f].components, in->columns[f].components);
  }
  check_carried_linear(out);
  check_picked(in, out);
  check_bits(in, out);
}

static void fields_not_named_are_carried_labels_picked_and_bits_kept(void) {
  mesh in = mixed_mesh();
  mesh out = simplified(reader_of(&in), measuring(0.5, "density"));
  check_mixed(&in, &out);
  mesh_free(&out);
  tetstream_options* options = measuring(0.5, "velocity");
  CHECK_EQUAL(tetstream_options_add_field(options, "linear", 0), TETSTREAM_OK);
  out = simplified(reader_of(&in), options);
  check_mixed(&in, &out);
  mesh_free(&out);
  mesh_free(&in);
}

/* A .tets file knows what is locked; in a .vtu file all vertices may move. */
static void files_keep_what_was_carried_and_picked(void) {
  mesh in = mixed_mesh();
  mesh out = simplified_files(&in, "tets", measuring(0.5, "density"));
  check_mixed(&in, &out);
  mesh_free(&out);
  out = simplified_files(&in, "vtu", measuring(0.5, "density"));
  CHECK(out.cell_count > 0 && out.cell_count <= in.cell_count / 2);
  for (int f = 0; f < in.field_count; ++f) CHECK_EQUAL(out.columns[f].type, in.columns[f].type);
  check_picked(&in, &out);
  mesh_free(&out);
  mesh_free(&in);
}

/* A field that is not measured has no say: whatever it holds, the same mesh. */
static void carried_fields_change_nothing(void) {
  mesh in = mixed_mesh();
  mesh one = simplified(reader_of(&in), measuring(0.4, "density"));
  double* lines = in.fields[2];
  for (int64_t v = 0; v < 2 * in.vertex_count; ++v) lines[v] = 1e6 * sin((double)(v * v));
  mesh other = simplified(reader_of(&in), measuring(0.4, "density"));
  CHECK_EQUAL(one.cell_count, other.cell_count);
  CHECK_EQUAL(one.vertex_count, other.vertex_count);
  if (one.vertex_count == other.vertex_count && one.cell_count == other.cell_count) {
    CHECK(memcmp(one.positions, other.positions, 24 * (size_t)one.vertex_count) == 0);
    CHECK(memcmp(one.fields[0], other.fields[0], 8 * (size_t)one.vertex_count) == 0);
    CHECK(memcmp(one.cells, other.cells, 32 * (size_t)one.cell_count) == 0);
  }
  mesh_free(&one);
  mesh_free(&other);
  mesh_free(&in);
}

static char names[MOST_FIELDS][8];

/* `components` of waves, nine to a field. */
static mesh wavy_mesh(int components) {
  mesh m = bare_mesh();
  memset(m.locked, 0, (size_t)m.vertex_count);
  for (int first = 0; first < components; first += 9) {
    const int count = components - first < 9 ? components - first : 9;
    snprintf(names[m.field_count], sizeof names[0], "w%d", m.field_count);
    float* values = add_field(&m, names[m.field_count], count, TETSTREAM_TYPE_FLOAT32);
    for (int64_t v = 0; v < m.vertex_count; ++v)
      for (int k = 0; k < count; ++k)
        values[count * v + k] = (float)wave(m.positions + 3 * v, first + k);
  }
  return m;
}

/* All components stay near the waves: of 7, of 125, the most that can be measured. */
static void up_to_125_components_are_measured(void) {
  for (int components = 1; components <= 125; components += components < 10 ? 6 : 59) {
    mesh in = wavy_mesh(components), out = simplified(reader_of(&in), options_of(0.25));
    CHECK(out.cell_count <= in.cell_count / 4);
    double worst = 0;
    for (int f = 0; f < out.field_count; ++f) {
      const int count = out.columns[f].components;
      const float* values = out.fields[f];
      for (int64_t v = 0; v < out.vertex_count; ++v)
        for (int k = 0; k < count; ++k) {
          const double miss =
              (double)values[count * v + k] - wave(out.positions + 3 * v, 9 * f + k);
          worst = fmax(worst, fabs(miss));
        }
    }
    CHECK(worst < 0.5); /* their range is 2 and more */
    mesh_free(&out);
    mesh_free(&in);
  }
}

static void more_than_125_components_are_refused_with_the_way_out(void) {
  mesh in = wavy_mesh(126), out = {0};
  tetstream_reader* reader = reader_of(&in);
  tetstream_writer* writer = writer_into(&out);
  tetstream_options* options = options_of(0.25);
  tetstream_simplifier* simplifier = NULL;
  CHECK_EQUAL(tetstream_simplifier_create(options, writer, &simplifier), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_run(simplifier, reader), TETSTREAM_UNSUPPORTED);
  CHECK_SAYS(tetstream_simplifier_message(simplifier), "126 field components are measured, 125");
  CHECK_EQUAL(out.is_open, 0);
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
  tetstream_options_destroy(options);
  options = measuring(0.25, "w0");
  CHECK_EQUAL(tetstream_options_add_field(options, "w3", 2.5), TETSTREAM_OK);
  out = simplified(reader_of(&in), options);
  CHECK(out.cell_count <= in.cell_count / 4);
  mesh_free(&out);
  mesh_free(&in);
}

/* With a hundred times the weight a field is followed more closely. */
static void weights_say_which_field_matters(void) {
  double miss[2] = {0, 0};
  for (int heavy = 0; heavy < 2; ++heavy) {
    mesh in = wavy_mesh(18);
    tetstream_options* options = options_of(0.15);
    CHECK_EQUAL(tetstream_options_add_field(options, "w0", heavy ? 100 : 0.01), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_options_add_field(options, "w1", 1), TETSTREAM_OK);
    mesh out = simplified(reader_of(&in), options);
    const float* values = out.fields[0];
    for (int64_t v = 0; v < out.vertex_count; ++v)
      for (int k = 0; k < 9; ++k)
        miss[heavy] += pow((double)values[9 * v + k] - wave(out.positions + 3 * v, k), 2) /
                       (double)out.vertex_count;
    mesh_free(&out);
    mesh_free(&in);
  }
  CHECK(miss[1] < miss[0]);
}

int main(void) {
  side = getenv("TETSTREAM_SLOW") ? 6 : 8;
  grid = hostile_mesh_create(side, side, side);
  RUN_CASE(fields_not_named_are_carried_labels_picked_and_bits_kept);
  RUN_CASE(files_keep_what_was_carried_and_picked);
  RUN_CASE(carried_fields_change_nothing);
  RUN_CASE(up_to_125_components_are_measured);
  RUN_CASE(more_than_125_components_are_refused_with_the_way_out);
  RUN_CASE(weights_say_which_field_matters);
  hostile_mesh_destroy(grid);
  return check_end();
}
