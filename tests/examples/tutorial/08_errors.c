/* What can go wrong, and how it is told: a status for the program, a sentence for its user.
 *
 * Each line of the output is a failure on purpose. Nothing is printed by the library, nothing
 * aborts. */
#include <stdio.h>
#include <tetstream/tetstream.h>

/* note: C may evaluate arguments in any order. A message is asked for after the call has returned.
 */
static void tell(tetstream_status status, const char* message) {
  printf("%s: %s\n", tetstream_status_name(status), message);
}

/* A file that is not there: the handle is made nevertheless, for its message, and is to be
 * destroyed. */
static void open_nothing(void) {
  tetstream_reader* reader = NULL;
  const tetstream_status status = tetstream_reader_open_file("no-such-mesh.vtu", NULL, &reader);
  tell(status, tetstream_reader_message(reader));
  tetstream_reader_destroy(reader);
}

/* A file that breaks the rules of its format. */
static void read_nonsense(void) {
  static const char bytes[] = "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece";
  tetstream_reader* reader = NULL;
  const tetstream_status status =
      tetstream_reader_open_memory(bytes, sizeof bytes - 1, "vtu", &reader);
  tell(status, tetstream_reader_message(reader));
  tetstream_reader_destroy(reader);
}

/* A format that is not written. */
static void write_another_format(void) {
  tetstream_writer* writer = NULL;
  const tetstream_status status = tetstream_writer_create_file("mesh.step", NULL, &writer);
  tell(status, tetstream_writer_message(writer));
  tetstream_writer_destroy(writer);
}

static int32_t refuse(void* user, const tetstream_batch* batch) {
  (void)user;
  (void)batch;
  return 28; /* ENOSPC, say */
}

/* A callback that gives up: its value is in the message. Then the stream is over. */
static void push_into_refusal(void) {
  static const double points[5][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  static const int64_t cells[2][4] = {{0, 1, 2, 3}, {1, 2, 3, 7}}; /* there is no vertex 7 */
  const tetstream_writer_callbacks callbacks = {.struct_size = sizeof callbacks, .put = refuse};
  const tetstream_stream_info info = {.struct_size = sizeof info,
                                      .position_type = TETSTREAM_TYPE_FLOAT64};
  tetstream_batch batch = {
      .struct_size = sizeof batch, .vertex_count = 5, .positions = points, .cells = cells[0]};
  for (batch.cell_count = 1; batch.cell_count <= 2; ++batch.cell_count) {
    tetstream_writer* writer = NULL;
    tetstream_simplifier* simplifier = NULL;
    tetstream_writer_create(&callbacks, &writer);
    tetstream_simplifier_create(NULL, writer, &simplifier);
    /* In the wrong state a call has no effect. */
    tetstream_status status = tetstream_simplifier_finish(simplifier);
    if (batch.cell_count == 1) tell(status, tetstream_simplifier_message(simplifier));
    status = tetstream_simplifier_begin(simplifier, &info);
    if (status >= 0) status = tetstream_simplifier_push(simplifier, &batch);
    if (status >= 0) status = tetstream_simplifier_finish(simplifier);
    tell(status, tetstream_simplifier_message(simplifier));
    tetstream_simplifier_destroy(simplifier);
    tetstream_writer_destroy(writer);
  }
}

int main(void) {
  open_nothing();
  read_nonsense();
  write_another_format();
  push_into_refusal();
  return 0;
}
