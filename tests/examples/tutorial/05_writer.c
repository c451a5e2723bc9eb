/* A writer of one's own: the volume of a mesh, and the integrals of its fields over it.
 *
 *   ./05_writer MESH
 *
 * Introduces a writer's open, which tells what will come, and a run without simplification. The
 * fields are linear on each cell: its volume times the mean of its corners is exact. Only what the
 * sum needs is kept of a vertex; heat.c and isosurface.c beside this folder do more. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <tetstream/tetstream.h>

enum { FIELDS = 8 };

struct sums {
  int position_type, field_count;
  tetstream_column fields[FIELDS];
  char names[FIELDS][256];
  int64_t vertex_count, room;
  double (
      *rows)[3 + FIELDS]; /* [room]: a vertex's position, and the first component of its fields */
  double volume, integrals[FIELDS];
};

static double number(const void* array, int type, int64_t i) {
  switch (type) {
    case TETSTREAM_TYPE_FLOAT32:
      return ((const float*)array)[i];
    case TETSTREAM_TYPE_FLOAT64:
      return ((const double*)array)[i];
    case TETSTREAM_TYPE_INT32:
      return ((const int32_t*)array)[i];
    default:
      return (double)((const int64_t*)array)[i];
  }
}

/* *info lives during the call: names are copied. */
static int32_t begin(void* user, const tetstream_stream_info* info) {
  struct sums* s = user;
  s->position_type = info->position_type;
  s->field_count = info->field_count < FIELDS ? info->field_count : FIELDS;
  for (int i = 0; i < s->field_count; ++i) {
    s->fields[i] = info->fields[i];
    strcpy(s->names[i], info->fields[i].name); /* 255 bytes at most */
  }
  return 0;
}

static void add_cell(struct sums* s, const int64_t* cell) {
  const double* row[4];
  double e[3][3];
  for (int j = 0; j < 4; ++j) row[j] = s->rows[cell[j]];
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < 3; ++k) e[j][k] = row[j + 1][k] - row[0][k];
  const double volume = fabs(e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
                             e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
                             e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
                        6;
  s->volume += volume;
  for (int f = 0; f < s->field_count; ++f)
    s->integrals[f] += volume * (row[0][3 + f] + row[1][3 + f] + row[2][3 + f] + row[3][3 + f]) / 4;
}

static int32_t put(void* user, const tetstream_batch* batch) {
  struct sums* s = user;
  if (s->vertex_count + batch->vertex_count > s->room) {
    const int64_t room = 2 * (s->vertex_count + batch->vertex_count);
    void* larger = realloc(s->rows, (size_t)room * sizeof *s->rows);
    if (!larger) return 1; /* the run stops, and its message has the number */
    s->rows = larger;
    s->room = room;
  }
  for (int64_t i = 0; i < batch->vertex_count; ++i) {
    double* row = s->rows[s->vertex_count++];
    for (int k = 0; k < 3; ++k) row[k] = number(batch->positions, s->position_type, 3 * i + k);
    for (int f = 0; f < s->field_count; ++f)
      row[3 + f] = number(batch->fields[f], s->fields[f].type, i * s->fields[f].components);
  }
  for (int64_t i = 0; i < batch->cell_count; ++i) add_cell(s, batch->cells + 4 * i);
  return 0;
}

int main(int argc, char** argv) {
  static struct sums sums;
  const tetstream_writer_callbacks callbacks = {
      .struct_size = sizeof callbacks, .user = &sums, .open = begin, .put = put};
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  const char* problem = NULL;
  if (argc != 2) return fprintf(stderr, "usage: 05_writer MESH\n"), 1;

  if (tetstream_reader_open_file(argv[1], NULL, &reader) < 0)
    problem = tetstream_reader_message(reader);
  else if (tetstream_writer_create(&callbacks, &writer) < 0 ||
           tetstream_convert(reader, writer, NULL, NULL, NULL) < 0)
    problem = tetstream_writer_message(writer);
  if (problem) {
    fprintf(stderr, "05_writer: %s\n", problem);
  } else {
    printf("volume %.12g\n", sums.volume);
    for (int f = 0; f < sums.field_count; ++f)
      printf("%s %.12g\n", sums.names[f], sums.integrals[f]);
  }
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
  free(sums.rows);
  return problem != NULL;
}
