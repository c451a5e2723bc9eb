/* The shared problem in C: same_answer_c FOLDER. The mesh in arrays; the result as the bytes of a
 * file in memory, and once more in callbacks. */
#include <stdlib.h>
#include <string.h>

#include "problem.h"

/* The result's arrays, one after the other when they are written. */
struct result {
  int64_t vertex_count, cell_count;
  double positions[POINTS][3];
  double pressure[POINTS];
  float velocity[POINTS][3];
  int64_t cells[CELLS][4];
  int32_t material[CELLS];
};
static struct result result;

static int32_t put(void* user, const tetstream_batch* batch) {
  struct result* r = user;
  const size_t n = (size_t)batch->vertex_count, m = (size_t)batch->cell_count;
  if (n > 0) {
    memcpy(r->positions[r->vertex_count], batch->positions, n * sizeof r->positions[0]);
    memcpy(r->pressure + r->vertex_count, batch->fields[0], n * sizeof r->pressure[0]);
    memcpy(r->velocity[r->vertex_count], batch->fields[1], n * sizeof r->velocity[0]);
  }
  if (m > 0) {
    memcpy(r->cells[r->cell_count], batch->cells, m * sizeof r->cells[0]);
    memcpy(r->material + r->cell_count, batch->cell_data[0], m * sizeof r->material[0]);
  }
  r->vertex_count += batch->vertex_count;
  r->cell_count += batch->cell_count;
  return 0;
}

static int write_result(void) {
  const size_t n = (size_t)result.vertex_count, m = (size_t)result.cell_count;
  FILE* file = fopen("c.raw", "wb");
  if (!file) return 1;
  fwrite(result.positions, sizeof result.positions[0], n, file);
  fwrite(result.pressure, sizeof result.pressure[0], n, file);
  fwrite(result.velocity, sizeof result.velocity[0], n, file);
  fwrite(result.cells, sizeof result.cells[0], m, file);
  fwrite(result.material, sizeof result.material[0], m, file);
  return fclose(file) == 0 ? 0 : 1;
}

/* Simplifies the mesh into `writer`. */
static tetstream_status solve(tetstream_writer* writer) {
  tetstream_stream_info info;
  tetstream_batch mesh;
  tetstream_options* options = NULL;
  tetstream_reader* reader = NULL;
  tetstream_simplifier* simplifier = NULL;
  tetstream_report report;
  memset(&info, 0, sizeof info);
  describe(&info);
  memset(&mesh, 0, sizeof mesh);
  mesh.struct_size = sizeof mesh;
  mesh.vertex_count = POINTS;
  mesh.positions = points;
  mesh.fields = field_pointers;
  mesh.cell_count = CELLS;
  mesh.cells = cells[0];
  mesh.cell_data = cell_data_pointers;
  report.struct_size = sizeof report;
  tetstream_status status = make_options(&options);
  if (status >= 0) status = tetstream_reader_open_mesh(&info, &mesh, &reader);
  if (status >= 0) status = tetstream_simplifier_create(options, writer, &simplifier);
  if (status >= 0) status = tetstream_simplifier_run(simplifier, reader);
  if (status < 0) fprintf(stderr, "C: %s\n", tetstream_simplifier_message(simplifier));
  if (status >= 0) status = tetstream_simplifier_get_report(simplifier, &report);
  if (status >= 0) printf("C: %ld cells, %s\n", (long)report.cells_out, report.reached);
  tetstream_simplifier_destroy(simplifier);
  tetstream_reader_destroy(reader);
  tetstream_options_destroy(options);
  return status;
}

int main(void) {
  tetstream_writer *memory = NULL, *arrays = NULL;
  tetstream_writer_callbacks callbacks;
  const void* data = NULL;
  size_t size = 0;
  memset(&callbacks, 0, sizeof callbacks);
  callbacks.struct_size = sizeof callbacks;
  callbacks.user = &result;
  callbacks.put = put;
  make_points();
  make_cells();
  tetstream_status status = tetstream_writer_create_memory("tets", &memory);
  if (status >= 0) status = solve(memory);
  if (status == TETSTREAM_OK) status = tetstream_writer_get_memory(memory, &data, &size);
  if (status == TETSTREAM_OK && write_bytes("c.tets", data, size)) status = TETSTREAM_IO;
  if (status == TETSTREAM_OK) status = tetstream_writer_create(&callbacks, &arrays);
  if (status == TETSTREAM_OK) status = solve(arrays);
  if (status == TETSTREAM_OK && write_result()) status = TETSTREAM_IO;
  tetstream_writer_destroy(memory);
  tetstream_writer_destroy(arrays);
  return status == TETSTREAM_OK ? 0 : 1;
}
