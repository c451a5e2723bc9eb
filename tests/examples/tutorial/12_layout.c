/* A mesh brought into an order once, so that it streams well from then on; and a picture of the
 * order.
 *
 *   ./12_layout IN OUT.tets ORDER [PICTURE.svg]
 *
 * Introduces what a front is, laying out, and diagrams. ORDER is "spatial", "hilbert",
 * "breadth-first" or another of the option `order`; memory is bounded by the option `memory`,
 * whatever the mesh. */
#include <stdio.h>
#include <tetstream/tetstream.h>

/* The front of the cells as they are in a file: what a stream in that order would have in core. */
static int front_of(const char* path, const char* picture) {
  tetstream_options* options = NULL;
  tetstream_reader* reader = NULL;
  tetstream_diagram* diagram = NULL;
  tetstream_diagram_info info = {.struct_size = sizeof info};
  const char* problem = NULL;
  if (tetstream_options_create(&options) < 0 ||
      tetstream_options_set_text(options, TETSTREAM_OPTION_ORDER, "none") < 0)
    problem = tetstream_options_message(options);
  else if (tetstream_reader_open_file(path, NULL, &reader) < 0)
    problem = tetstream_reader_message(reader);
  else if (tetstream_diagram_create(options, 600, 400, &diagram) < 0 ||
           tetstream_diagram_read(diagram, reader, 0, NULL, NULL) < 0 ||
           tetstream_diagram_get_info(diagram, &info) < 0 ||
           (picture && tetstream_diagram_write(diagram, TETSTREAM_PAGE_LAYOUT, picture, path) < 0))
    problem = tetstream_diagram_message(diagram);
  if (problem)
    fprintf(stderr, "12_layout: %s\n", problem);
  else
    printf("%s: %lld vertices wait at most, %.0f in the mean, of %lld\n", path,
           (long long)info.front_width, info.mean_width, (long long)info.vertex_count);
  tetstream_diagram_destroy(diagram);
  tetstream_reader_destroy(reader);
  tetstream_options_destroy(options);
  return problem != NULL;
}

static int lay_out(const char* from, const char* to, const char* order) {
  tetstream_options* options = NULL;
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  tetstream_layout_report report = {.struct_size = sizeof report};
  const char* problem = NULL;
  if (tetstream_options_create(&options) < 0 ||
      tetstream_options_set_text(options, TETSTREAM_OPTION_ORDER, order) < 0)
    problem = tetstream_options_message(options);
  else if (tetstream_reader_open_file(from, NULL, &reader) < 0)
    problem = tetstream_reader_message(reader);
  else if (tetstream_writer_create_file(to, NULL, &writer) < 0 ||
           tetstream_layout(reader, writer, options, NULL, NULL, &report) < 0)
    problem = tetstream_writer_message(writer);
  if (problem)
    fprintf(stderr, "12_layout: %s\n", problem);
  else
    printf("%lld cells in the order %s\n", (long long)report.cells, report.order);
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
  tetstream_options_destroy(options);
  return problem != NULL;
}

int main(int argc, char** argv) {
  if (argc < 4 || argc > 5)
    return fprintf(stderr, "usage: 12_layout IN OUT.tets ORDER [PICTURE.svg]\n"), 1;
  return front_of(argv[1], NULL) || lay_out(argv[1], argv[2], argv[3]) ||
         front_of(argv[2], argc == 5 ? argv[4] : NULL);
}
