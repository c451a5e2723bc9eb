/* A program of somebody else's: makes a mesh, simplifies it, reads it back. */
#include <stdio.h>
#include <tetstream/tetstream.h>

int main(void) {
  tetstream_reader *reader = NULL, *again = NULL;
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  tetstream_stream_info info = {0};
  const void* data = NULL;
  size_t size = 0;
  tetstream_status status = tetstream_reader_generate("fluid", 2000, 1, &reader);
  info.struct_size = sizeof info;
  if (status >= 0) status = tetstream_writer_create_memory("vtu", &writer);
  if (status >= 0) status = tetstream_simplifier_create(NULL, writer, &simplifier);
  if (status >= 0) status = tetstream_simplifier_run(simplifier, reader);
  if (status >= 0) status = tetstream_writer_get_memory(writer, &data, &size);
  if (status >= 0) status = tetstream_reader_open_memory(data, size, "vtu", &again);
  if (status >= 0) status = tetstream_reader_get_info(again, &info);
  if (status < 0)
    printf("%s: %s\n", tetstream_status_name(status), tetstream_simplifier_message(simplifier));
  printf("tetstream %s: %ld cells\n", tetstream_version_text(), (long)info.cell_count);
  tetstream_simplifier_destroy(simplifier);
  tetstream_reader_destroy(reader);
  tetstream_reader_destroy(again);
  tetstream_writer_destroy(writer);
  return status >= 0 && info.cell_count > 0 &&
                 tetstream_version_number() == TETSTREAM_VERSION_NUMBER
             ? 0
             : 1;
}
