/* In parallel: each process of an MPI program simplifies the part of a mesh that it has.
 *
 *   mpirun -n 4 ranks MESH OUT [RATIO]
 *   mpicc ranks.c $(pkg-config --cflags --libs tetstream) -lm -o ranks
 *
 * A solver has its mesh in parts already; here each process reads MESH, a file in any format that
 * tetstream reads, and keeps its share of the cells, in the order of the stream. Vertices that
 * other parts have, too, are locked, so that the parts still fit together, vertex to vertex and
 * face to face, whatever each of them does inside. All measure their errors by the box of the whole
 * mesh.
 *
 * Fields go along; cell arrays and labelled faces, which could in the same way, are left out.
 *
 * What is left, RATIO (0.1) of each part's cells, is in OUT-0.vtu, OUT-1.vtu and so on, and
 * OUT.pvtu names them. Along the seams it is as fine as before:
 *
 *   tetstream simplify OUT.pvtu coarse.vtu --ratio 0.5
 *
 * joins the parts and simplifies across. */
#include <inttypes.h>
#include <math.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <tetstream/tetstream.h>

enum { MOST_FIELDS = 32, MOST_VALUES = 3 + 9 * MOST_FIELDS };

/* Rows of a vertex's position or of one of its fields. */
struct rows {
  char* bytes;
  size_t size; /* of a row */
  int type, components;
};

struct mesh {
  tetstream_stream_info info;        /* its pointers are the reader's */
  struct rows rows[1 + MOST_FIELDS]; /* positions, fields */
  int64_t vertex_count, vertex_room, cell_count, cell_room;
  int64_t* cells;  /* [cell_count][4] */
  uint8_t* locked; /* [vertex_count]: another part has the vertex, too */
};

static int rank, ranks;

static int failed(const char* message) {
  fprintf(stderr, "ranks: %s\n", message);
  return 1;
}

static void* allocate(void* old, int64_t count, size_t size) {
  void* memory = realloc(old, (size_t)(count > 0 ? count : 1) * size);
  if (!memory) MPI_Abort(MPI_COMM_WORLD, failed("out of memory"));
  return memory;
}

/* -------------------------------------------------------------------------------- reading */

static void set_rows(struct rows* rows, int type, int components) {
  const int is_short = type == TETSTREAM_TYPE_FLOAT32 || type == TETSTREAM_TYPE_INT32;
  rows->type = type;
  rows->components = components;
  rows->size = (size_t)components * (is_short ? 4 : 8);
}

static int32_t take_batch(void* user, const tetstream_batch* batch) {
  struct mesh* m = user;
  const int64_t vertices = m->vertex_count + batch->vertex_count;
  const int64_t cells = m->cell_count + batch->cell_count;
  if (vertices > m->vertex_room) {
    m->vertex_room = 2 * vertices;
    for (int i = 0; i <= m->info.field_count; ++i)
      m->rows[i].bytes = allocate(m->rows[i].bytes, m->vertex_room, m->rows[i].size);
  }
  for (int i = 0; batch->vertex_count > 0 && i <= m->info.field_count; ++i)
    memcpy(m->rows[i].bytes + (size_t)m->vertex_count * m->rows[i].size,
           i == 0 ? batch->positions : batch->fields[i - 1],
           (size_t)batch->vertex_count * m->rows[i].size);
  if (cells > m->cell_room) {
    m->cell_room = 2 * cells;
    m->cells = allocate(m->cells, m->cell_room, sizeof(int64_t[4]));
  }
  if (batch->cell_count > 0)
    memcpy(m->cells + 4 * m->cell_count, batch->cells,
           (size_t)batch->cell_count * sizeof(int64_t[4]));
  m->vertex_count = vertices;
  m->cell_count = cells;
  return 0;
}

/* In an order that streams well: then a share of the cells is a slab with small sides. */
static int read_mesh(struct mesh* m, tetstream_reader* reader) {
  const tetstream_writer_callbacks callbacks = {
      .struct_size = sizeof callbacks, .user = m, .put = take_batch};
  tetstream_writer* writer = NULL;
  int bad = 0;
  m->info.struct_size = sizeof m->info;
  if (tetstream_reader_get_info(reader, &m->info) < 0)
    return failed(tetstream_reader_message(reader));
  if (m->info.field_count > MOST_FIELDS) return failed("there are too many fields");
  set_rows(&m->rows[0], m->info.position_type, 3);
  for (int i = 0; i < m->info.field_count; ++i)
    set_rows(&m->rows[i + 1], m->info.fields[i].type, m->info.fields[i].components);
  if (tetstream_writer_create(&callbacks, &writer) < 0 ||
      tetstream_convert(reader, writer, NULL, NULL, NULL) < 0)
    bad = failed(tetstream_writer_message(writer));
  else if (m->cell_count < ranks)
    bad = failed("there are more processes than cells");
  tetstream_writer_destroy(writer);
  return bad;
}

/* Keeps this process's share of the cells, and their vertices. */
static void keep_part(struct mesh* m) {
  enum { MINE = 1, OTHERS = 2 };
  const int64_t first = m->cell_count * rank / ranks, end = m->cell_count * (rank + 1) / ranks;
  int64_t* number = allocate(NULL, m->vertex_count, sizeof *number);
  int64_t kept = 0;
  m->locked = allocate(NULL, m->vertex_count, 1);
  memset(m->locked, 0, (size_t)m->vertex_count);
  for (int64_t c = 0; c < m->cell_count; ++c)
    for (int j = 0; j < 4; ++j)
      m->locked[m->cells[4 * c + j]] |= c >= first && c < end ? MINE : OTHERS;
  for (int64_t v = 0; v < m->vertex_count; ++v) {
    if (!(m->locked[v] & MINE)) continue;
    for (int i = 0; i <= m->info.field_count; ++i) {
      const struct rows* rows = &m->rows[i];
      memmove(rows->bytes + (size_t)kept * rows->size, rows->bytes + (size_t)v * rows->size,
              rows->size);
    }
    m->locked[kept] = (m->locked[v] & OTHERS) != 0;
    number[v] = kept++;
  }
  for (int64_t i = 0; i < 4 * (end - first); ++i) m->cells[i] = number[m->cells[4 * first + i]];
  m->vertex_count = kept;
  m->cell_count = end - first;
  free(number);
}

/* ------------------------------------------------------------------------------ simplifying */

static double value_at(const struct rows* rows, int64_t row, int component) {
  const char* at = rows->bytes + (size_t)row * rows->size;
  switch (rows->type) {
    case TETSTREAM_TYPE_FLOAT32:
      return ((const float*)at)[component];
    case TETSTREAM_TYPE_FLOAT64:
      return ((const double*)at)[component];
    case TETSTREAM_TYPE_INT32:
      return ((const int32_t*)at)[component];
    default:
      return (double)((const int64_t*)at)[component];
  }
}

/* Of the whole mesh: x y z and each component of each field, of what is finite. Without it each
 * part would be measured by its own, and the same error would count more in one than in another. */
static void find_box(const struct mesh* m, double* low, double* high) {
  int n = 0;
  for (int i = 0; i <= m->info.field_count; ++i)
    for (int k = 0; k < m->rows[i].components; ++k, ++n) {
      low[n] = INFINITY;
      high[n] = -INFINITY;
      for (int64_t v = 0; v < m->vertex_count; ++v) {
        const double value = value_at(&m->rows[i], v, k);
        if (!isfinite(value)) continue;
        low[n] = fmin(low[n], value);
        high[n] = fmax(high[n], value);
      }
    }
  MPI_Allreduce(MPI_IN_PLACE, low, n, MPI_DOUBLE, MPI_MIN, MPI_COMM_WORLD);
  MPI_Allreduce(MPI_IN_PLACE, high, n, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
}

/* One thread each: the other cores belong to the other processes. */
static int set_options(tetstream_options** options, double ratio) {
  if (tetstream_options_create(options) >= 0 &&
      tetstream_options_set_double(*options, TETSTREAM_OPTION_RATIO, ratio) >= 0 &&
      tetstream_options_set_int64(*options, TETSTREAM_OPTION_THREADS, 1) >= 0)
    return 0;
  return failed(tetstream_options_message(*options));
}

static int write_part(const struct mesh* m, const tetstream_options* options, const char* out,
                      int64_t* cells_out) {
  char path[4096];
  double low[MOST_VALUES], high[MOST_VALUES];
  const void* fields[MOST_FIELDS];
  tetstream_stream_info info = m->info;
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  tetstream_report report = {.struct_size = sizeof report};
  int bad = 0;
  find_box(m, low, high); /* with all others: before anything can fail */
  info.box_min = low;
  info.box_max = high;
  info.cell_data_count = 0; /* nor are there labels of regions and faces, to have names */
  info.label_name_count = 0;
  for (int i = 0; i < info.field_count; ++i) fields[i] = m->rows[i + 1].bytes;
  const tetstream_batch part = {.struct_size = sizeof part,
                                .vertex_count = m->vertex_count,
                                .positions = m->rows[0].bytes,
                                .fields = fields,
                                .locked = m->locked,
                                .cell_count = m->cell_count,
                                .cells = m->cells};
  if (snprintf(path, sizeof path, "%s-%d.vtu", out, rank) >= (int)sizeof path)
    bad = failed("the name of the output is too long");
  else if (tetstream_reader_open_mesh(&info, &part, &reader) < 0)
    bad = failed(tetstream_reader_message(reader));
  else if (tetstream_writer_create_file(path, NULL, &writer) < 0)
    bad = failed(tetstream_writer_message(writer));
  else if (tetstream_simplifier_create(options, writer, &simplifier) < 0 ||
           tetstream_simplifier_run(simplifier, reader) < 0 ||
           tetstream_simplifier_get_report(simplifier, &report) < 0)
    bad = failed(tetstream_simplifier_message(simplifier));
  *cells_out = report.cells_out;
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
  return bad;
}

/* -------------------------------------------------------------------------- naming the parts */

static void put_name(FILE* file, const char* name) {
  for (; *name; ++name) {
    if (strchr("<>&\"", *name))
      fprintf(file, "&#%d;", *name);
    else
      fputc(*name, file);
  }
}

static void put_array(FILE* file, const struct rows* rows, const char* name) {
  static const char* const types[] = {"", "Float32", "Float64", "Int32", "Int64"};
  fprintf(file, "      <PDataArray type=\"%s\" NumberOfComponents=\"%d\" Name=\"",
          types[rows->type], rows->components);
  put_name(file, name);
  fputs("\"/>\n", file);
}

/* OUT.pvtu. The parts are looked for in its own folder. */
static int write_index(const struct mesh* m, const char* out) {
  char path[4096];
  const char* const slash = strrchr(out, '/');
  snprintf(path, sizeof path, "%s.pvtu", out); /* it is no longer than the names of the parts */
  FILE* file = fopen(path, "w");
  if (!file) return failed("the .pvtu file cannot be written");
  fputs(
      "<VTKFile type=\"PUnstructuredGrid\" version=\"0.1\">\n"
      "  <PUnstructuredGrid GhostLevel=\"0\">\n    <PPoints>\n",
      file);
  put_array(file, &m->rows[0], "Points");
  fputs("    </PPoints>\n    <PPointData>\n", file);
  for (int i = 0; i < m->info.field_count; ++i)
    put_array(file, &m->rows[i + 1], m->info.fields[i].name);
  fputs("    </PPointData>\n", file);
  for (int i = 0; i < ranks; ++i) {
    fputs("    <Piece Source=\"", file);
    put_name(file, slash ? slash + 1 : out);
    fprintf(file, "-%d.vtu\"/>\n", i);
  }
  fputs("  </PUnstructuredGrid>\n</VTKFile>\n", file);
  const int bad = ferror(file);
  return fclose(file) || bad ? failed("the .pvtu file cannot be written") : 0;
}

/* True if it failed in any process, so that none goes on alone. */
static int anywhere(int bad) {
  MPI_Allreduce(MPI_IN_PLACE, &bad, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return bad;
}

static int work(struct mesh* m, tetstream_reader* reader, const char* out, double ratio) {
  tetstream_options* options = NULL;
  int bad = anywhere(set_options(&options, ratio) || read_mesh(m, reader));
  if (!bad) {
    keep_part(m);
    int64_t count[3] = {m->cell_count, 0, 0}; /* cells before and after, locked vertices */
    for (int64_t v = 0; v < m->vertex_count; ++v) count[2] += m->locked[v];
    bad = anywhere(write_part(m, options, out, &count[1]));
    if (!bad)
      printf("part %d: %" PRId64 " -> %" PRId64 " cells, %" PRId64
             " vertices are other parts', too\n",
             rank, count[0], count[1], count[2]);
  }
  tetstream_options_destroy(options);
  return bad || rank > 0 ? bad : write_index(m, out);
}

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  struct mesh m = {.vertex_count = 0};
  tetstream_reader* reader = NULL;
  int bad = 0;
  if (argc < 3 || argc > 4)
    bad = rank > 0 || failed("usage: mpirun -n N ranks MESH OUT [RATIO]");
  else if (anywhere(tetstream_reader_open_file(argv[1], NULL, &reader) < 0))
    bad = rank > 0 || failed(tetstream_reader_message(reader));
  else
    bad = anywhere(work(&m, reader, argv[2], argc > 3 ? strtod(argv[3], NULL) : 0.1));
  tetstream_reader_destroy(reader);
  for (int i = 0; i <= MOST_FIELDS; ++i) free(m.rows[i].bytes);
  free(m.cells);
  free(m.locked);
  MPI_Finalize();
  return bad;
}
