/* The problem that every language solves, in C and C++: a cube of 12 x 12 x 12 boxes, each cut into
 * six tetrahedra, in exact arithmetic. README.md states it for the other languages. */
#ifndef PROBLEM_H
#define PROBLEM_H

#include <stdint.h>
#include <stdio.h>
#include <tetstream/tetstream.h>

#define BOXES 12
#define SIDE (BOXES + 1)
#define POINTS (SIDE * SIDE * SIDE)
#define CELLS (6 * BOXES * BOXES * BOXES)

static double points[POINTS][3];
static double pressure[POINTS];
static float velocity[POINTS][3];
static int64_t cells[CELLS][4];
static int32_t material[CELLS];

static const void* const field_pointers[2] = {pressure, velocity};
static const void* const cell_data_pointers[1] = {material};
static const tetstream_column field_columns[2] = {{"pressure", 1, TETSTREAM_TYPE_FLOAT64},
                                                  {"velocity", 3, TETSTREAM_TYPE_FLOAT32}};
static const tetstream_column cell_columns[1] = {{"material", 1, TETSTREAM_TYPE_INT32}};

static void make_points(void) {
  for (int p = 0; p < POINTS; ++p) {
    const int x = p % SIDE, y = p / SIDE % SIDE, z = p / SIDE / SIDE;
    points[p][0] = x / 4.0;
    points[p][1] = y / 4.0;
    points[p][2] = z / 4.0;
    pressure[p] = x * x * y - 3 * z;
    velocity[p][0] = (float)(y - z);
    velocity[p][1] = (float)(x * z);
    velocity[p][2] = (float)(x + y);
  }
}

/* The six ways from a box's lowest corner to its highest along the axes. */
static void make_cells(void) {
  static const int ways[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  static const int steps[3] = {1, SIDE, SIDE * SIDE};
  for (int c = 0; c < CELLS; ++c) {
    const int box = c / 6, x = box % BOXES, y = box / BOXES % BOXES, z = box / BOXES / BOXES;
    cells[c][0] = x + SIDE * (y + SIDE * z);
    for (int i = 0; i < 3; ++i) cells[c][i + 1] = cells[c][i] + steps[ways[c % 6][i]];
    material[c] = x < BOXES / 2 ? 1 : 2;
  }
}

static void describe(tetstream_stream_info* info) {
  info->struct_size = sizeof *info;
  info->position_type = TETSTREAM_TYPE_FLOAT64;
  info->flags = TETSTREAM_STREAM_INDEXED;
  info->field_count = 2;
  info->fields = field_columns;
  info->cell_data_count = 1;
  info->cell_data = cell_columns;
  info->vertex_count = POINTS;
  info->cell_count = CELLS;
}

static tetstream_status make_options(tetstream_options** options) {
  tetstream_status status = tetstream_options_create(options);
  if (status >= 0) status = tetstream_options_set_double(*options, TETSTREAM_OPTION_RATIO, 0.2);
  if (status >= 0) status = tetstream_options_parse(*options, "boundary-weight", "4");
  if (status >= 0)
    status = tetstream_options_set_text(*options, TETSTREAM_OPTION_REGIONS, "material");
  if (status >= 0) status = tetstream_options_add_field(*options, "pressure", 1);
  if (status >= 0) status = tetstream_options_add_field(*options, "velocity", 0.5);
  return status;
}

static int32_t write_bytes(const char* path, const void* data, size_t size) {
  FILE* file = fopen(path, "wb");
  const size_t written = file ? fwrite(data, 1, size, file) : 0;
  return file && fclose(file) == 0 && written == size ? 0 : 1;
}

#endif
