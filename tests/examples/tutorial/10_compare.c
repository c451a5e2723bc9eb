/* How well one mesh stands for another: fields, boundary, topology, shapes, regions.
 *
 *   ./10_compare ORIGINAL SIMPLIFIED
 *
 * Introduces comparisons. Errors of fields are exact integrals; the meshes may be in any format and
 * order, and larger than the memory. */
#include <stdio.h>
#include <tetstream/tetstream.h>

static void print(const tetstream_comparison* comparison) {
  tetstream_comparison_info info = {.struct_size = sizeof info};
  tetstream_mesh_figures figures = {.struct_size = sizeof figures};
  tetstream_field_comparison field = {.struct_size = sizeof field};
  tetstream_region_comparison region = {.struct_size = sizeof region};
  tetstream_comparison_get_info(comparison, &info);
  for (int32_t i = 0; i < info.field_count; ++i) {
    tetstream_comparison_get_field(comparison, i, &field);
    printf("%-12s RMS %.6g %%, at most %.6g %% of the range\n", field.name, field.rms_percent,
           field.largest_percent);
  }
  printf("boundary     at most %.6g %% of the diagonal\n", 100 * info.distance / info.diagonal);
  printf("topology     %s\n", info.topology_kept ? "kept" : "changed");
  for (int32_t i = 0; i < info.region_count; ++i) {
    tetstream_comparison_get_region(comparison, i, &region);
    printf("region %-5lld %.6g -> %.6g\n", (long long)region.label, region.original_volume,
           region.simplified_volume);
  }
  tetstream_comparison_get_mesh(comparison, TETSTREAM_SIMPLIFIED, &figures);
  printf("least angle  %.3g degrees, in the mean %.3g\n", figures.least_angle,
         figures.mean_least_angle);
}

int main(int argc, char** argv) {
  tetstream_reader *original = NULL, *simplified = NULL;
  tetstream_comparison* comparison = NULL;
  const char* problem = NULL;
  if (argc != 3) return fprintf(stderr, "usage: 10_compare ORIGINAL SIMPLIFIED\n"), 1;
  if (tetstream_reader_open_file(argv[1], NULL, &original) < 0)
    problem = tetstream_reader_message(original);
  else if (tetstream_reader_open_file(argv[2], NULL, &simplified) < 0)
    problem = tetstream_reader_message(simplified);
  else if (tetstream_comparison_create(NULL, &comparison) < 0 ||
           tetstream_comparison_read(comparison, original, simplified, NULL, NULL) < 0)
    problem = tetstream_comparison_message(comparison);
  if (problem)
    fprintf(stderr, "10_compare: %s\n", problem);
  else
    print(comparison);
  tetstream_comparison_destroy(comparison);
  tetstream_reader_destroy(original);
  tetstream_reader_destroy(simplified);
  return problem != NULL;
}
