/* Writers: callbacks that fail, files that appear only when complete, memory, properties. */
#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "check.h"
#include "hostile.h"

static char folder[64];

static const char* in_folder(const char* name) {
  static char path[128];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  return path;
}

static int files_in_folder(void) {
  int count = 0;
  DIR* dir = opendir(folder);
  if (!dir) return -1;
  for (struct dirent* entry = readdir(dir); entry; entry = readdir(dir))
    count += entry->d_name[0] != '.';
  closedir(dir);
  return count;
}

/* Simplifies a generated mesh into `writer`. */
static tetstream_status run_into(tetstream_writer* writer, char message[256]) {
  tetstream_reader* reader = NULL;
  tetstream_simplifier* simplifier = NULL;
  CHECK_EQUAL(tetstream_reader_generate("fluid", 3000, 1, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_create(NULL, writer, &simplifier), TETSTREAM_OK);
  const tetstream_status status = tetstream_simplifier_run(simplifier, reader);
  snprintf(message, 256, "%s", tetstream_simplifier_message(simplifier));
  tetstream_reader_destroy(reader);
  tetstream_simplifier_destroy(simplifier);
  return status;
}

static tetstream_status run_hostile(hostile_writer* out, int minimal, char message[256]) {
  const tetstream_writer_callbacks writes =
      minimal ? hostile_writer_minimal(out) : hostile_writer_callbacks(out);
  tetstream_writer* writer = NULL;
  CHECK_EQUAL(tetstream_writer_create(&writes, &writer), TETSTREAM_OK);
  const tetstream_status status = run_into(writer, message);
  const int closes = out->closes;
  tetstream_writer_destroy(writer);
  CHECK_EQUAL(out->closes, closes);
  CHECK_EQUAL(out->order_errors, 0);
  CHECK_EQUAL(out->stream_errors, 0);
  hostile_writer_free(out);
  return status;
}

static void put_alone_is_enough(void) {
  hostile_writer writer = {0};
  char message[256];
  CHECK(run_hostile(&writer, 1, message) >= 0);
  CHECK(writer.cells > 0);
  CHECK_EQUAL(writer.finalized, writer.vertices);
}

static void all_callbacks_come_in_order_and_once(void) {
  hostile_writer writer = {0};
  char message[256];
  CHECK(run_hostile(&writer, 0, message) >= 0);
  CHECK_EQUAL(writer.opens, 1);
  CHECK_EQUAL(writer.finishes, 1);
  CHECK_EQUAL(writer.closes, 1);
}

static void failures_stop_the_run_and_close_once(void) {
  for (int at = -2; at <= 2; ++at) {
    if (at == 0) continue;
    hostile_writer writer = {0};
    char message[256];
    writer.fail_open = at == -2;
    writer.fail_finish = at == -1;
    writer.fail_put = at > 0 ? at : 0;
    writer.fail_value = 70 + at;
    const tetstream_status status = run_hostile(&writer, 0, message);
    if (at > 1 && writer.puts < at) continue; /* so few puts that none of them failed */
    CHECK_EQUAL(status, TETSTREAM_CALLBACK);
    char value[16];
    snprintf(value, sizeof value, "%d", 70 + at);
    CHECK_SAYS(message, value);
    CHECK_SAYS(message, at == -2 ? "open" : at == -1 ? "finish" : "put");
    CHECK_EQUAL(writer.finishes, at == -1);
    CHECK_EQUAL(writer.opens, 1);
    CHECK_EQUAL(writer.closes, 1);
  }
}

static void a_writer_that_was_never_used_is_not_closed(void) {
  hostile_writer hostile = {0};
  const tetstream_writer_callbacks writes = hostile_writer_callbacks(&hostile);
  tetstream_writer* writer = NULL;
  CHECK_EQUAL(tetstream_writer_create(&writes, &writer), TETSTREAM_OK);
  tetstream_writer_destroy(writer);
  CHECK_EQUAL(hostile.opens + hostile.closes, 0);
}

static void a_file_has_its_name_only_when_complete(void) {
  tetstream_writer* writer = NULL;
  char message[256];
  CHECK_EQUAL(tetstream_writer_create_file(in_folder("a.tets"), NULL, &writer), TETSTREAM_OK);
  CHECK(access(in_folder("a.tets"), F_OK) != 0);
  CHECK(run_into(writer, message) >= 0);
  CHECK(access(in_folder("a.tets"), F_OK) == 0);
  CHECK_EQUAL(files_in_folder(), 1);
  tetstream_writer_destroy(writer);
  unlink(in_folder("a.tets"));
}

static int32_t cancel(void* user, const tetstream_progress* progress) {
  (void)user;
  (void)progress;
  return 3;
}

static void nothing_is_left_of_a_file_after_a_failure(void) {
  tetstream_writer* writer = NULL;
  tetstream_reader* reader = NULL;
  CHECK_EQUAL(tetstream_writer_create_file(in_folder("b.tets"), NULL, &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_generate("ball", 3000, 1, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(reader, writer, NULL, cancel, NULL), TETSTREAM_CANCELLED);
  CHECK_SAYS(tetstream_writer_message(writer), "3");
  CHECK_EQUAL(files_in_folder(), 0);
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);

  CHECK_EQUAL(tetstream_writer_create_file(in_folder("c.tets"), NULL, &writer), TETSTREAM_OK);
  tetstream_writer_destroy(writer);
  CHECK_EQUAL(files_in_folder(), 0);
}

/* Cancels when the end of the file was told so often. */
typedef struct writing {
  int told, most;
} writing;

static int32_t cancel_writing(void* user, const tetstream_progress* progress) {
  writing* w = user;
  if (strcmp(progress->phase, "write") != 0) return 0;
  CHECK(progress->fraction == -1);
  CHECK(progress->cells_read > 0);
  return ++w->told == w->most;
}

static void the_end_is_cancelled(const char* format, int most) {
  tetstream_writer *converted = NULL, *simplified = NULL;
  tetstream_reader *first = NULL, *second = NULL;
  tetstream_simplifier* simplifier = NULL;
  writing convert = {0, most}, simplify = {0, most};
  CHECK_EQUAL(tetstream_reader_generate("ball", 3000, 1, &first), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_generate("ball", 3000, 1, &second), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_file(in_folder("d"), format, &converted), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(first, converted, NULL, cancel_writing, &convert),
              TETSTREAM_CANCELLED);
  CHECK_EQUAL(convert.told, most);
  CHECK_EQUAL(tetstream_writer_create_file(in_folder("e"), format, &simplified), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_create(NULL, simplified, &simplifier), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_set_progress(simplifier, cancel_writing, &simplify),
              TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_run(simplifier, second), TETSTREAM_CANCELLED);
  CHECK_EQUAL(simplify.told, most);
  CHECK_EQUAL(files_in_folder(), 0);
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(converted);
  tetstream_writer_destroy(simplified);
  tetstream_reader_destroy(first);
  tetstream_reader_destroy(second);
}

/* Before it is written, and then, where all is written at the end, while it is. */
static void the_end_of_a_file_is_told_and_can_be_cancelled(void) {
  static const char* const at_end[] = {"vtu", "vtk", "exodus", "msh", "mesh", "meshb"};
  const char *name, *extensions, *text;
  int32_t reads, writes;
  for (int32_t i = 0;
       tetstream_format_at(i, &name, &extensions, &text, &reads, &writes) == TETSTREAM_OK; ++i)
    if (writes) the_end_is_cancelled(name, 1);
  for (size_t i = 0; i < sizeof at_end / sizeof at_end[0]; ++i) the_end_is_cancelled(at_end[i], 2);
}

static void a_failed_creation_leaves_a_handle_with_a_message(void) {
  tetstream_writer* writer = NULL;
  const void* data = NULL;
  size_t size = 0;
  CHECK_EQUAL(tetstream_writer_create_file("/nowhere/mesh.vtu", NULL, &writer), TETSTREAM_IO);
  CHECK_SAYS(tetstream_writer_message(writer), "/nowhere/mesh.vtu");
  CHECK_EQUAL(tetstream_writer_set(writer, "compress", "no"), TETSTREAM_BAD_STATE);
  CHECK_EQUAL(tetstream_writer_get_memory(writer, &data, &size), TETSTREAM_BAD_STATE);
  tetstream_writer_destroy(writer);
  CHECK_EQUAL(tetstream_writer_create_file(in_folder("mesh.docx"), NULL, &writer),
              TETSTREAM_UNSUPPORTED);
  tetstream_writer_destroy(writer);
  CHECK_EQUAL(tetstream_writer_create_memory("docx", &writer), TETSTREAM_UNSUPPORTED);
  CHECK_SAYS(tetstream_writer_message(writer), "docx");
  tetstream_writer_destroy(writer);
  CHECK_EQUAL(files_in_folder(), 0);
}

static void memory_is_given_only_when_complete(void) {
  tetstream_writer* writer = NULL;
  const void* data = NULL;
  size_t size = 0;
  char message[256];
  CHECK_EQUAL(tetstream_writer_create_memory("tets", &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_get_memory(writer, &data, &size), TETSTREAM_BAD_STATE);
  CHECK_SAYS(tetstream_writer_message(writer), "has not begun");
  CHECK(run_into(writer, message) >= 0);
  CHECK_EQUAL(tetstream_writer_get_memory(writer, &data, &size), TETSTREAM_OK);
  CHECK(data != NULL && size > 100);
  tetstream_reader* reader = NULL;
  CHECK_EQUAL(tetstream_reader_open_memory(data, size, "tets", &reader), TETSTREAM_OK);
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);
}

static void a_descriptor_gets_the_bytes_that_memory_gets(void) {
  tetstream_writer *memory = NULL, *file = NULL;
  const void* data = NULL;
  size_t size = 0;
  char message[256];
  FILE* temporary = tmpfile();
  CHECK(temporary != NULL);
  CHECK_EQUAL(tetstream_writer_create_memory("sva", &memory), TETSTREAM_OK);
  CHECK(run_into(memory, message) >= 0);
  CHECK_EQUAL(tetstream_writer_get_memory(memory, &data, &size), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_fd(fileno(temporary), "sva", &file), TETSTREAM_OK);
  CHECK(run_into(file, message) >= 0);
  char* bytes = malloc(size + 1);
  rewind(temporary);
  CHECK_EQUAL(fread(bytes, 1, size + 1, temporary), size);
  CHECK(memcmp(bytes, data, size) == 0);
  free(bytes);
  fclose(temporary);
  tetstream_writer_destroy(memory);
  tetstream_writer_destroy(file);
}

static void a_descriptor_for_the_other_way_is_refused_at_once(void) {
  tetstream_reader* reader = NULL;
  int ends[2];
  CHECK_EQUAL(pipe(ends), 0);
  const int wrong[] = {ends[0], -1};
  for (int i = 0; i < 2; ++i) {
    tetstream_writer* writer = NULL;
    CHECK_EQUAL(tetstream_writer_create_fd(wrong[i], "vtu", &writer), TETSTREAM_IO);
    CHECK_SAYS(tetstream_writer_message(writer), "cannot write");
    tetstream_writer_destroy(writer);
  }
  CHECK_EQUAL(tetstream_reader_open_fd(ends[1], "tets", &reader), TETSTREAM_IO);
  CHECK_SAYS(tetstream_reader_message(reader), "cannot read");
  tetstream_reader_destroy(reader);
  close(ends[0]);
  close(ends[1]);
}

static void a_pipe_can_be_written_and_read(void) {
  tetstream_writer* writer = NULL;
  tetstream_reader* reader = NULL;
  tetstream_stream_info info = {0};
  int ends[2];
  CHECK_EQUAL(pipe(ends), 0);
  CHECK_EQUAL(tetstream_reader_generate("fluid", 200, 1, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_fd(ends[1], "tets", &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(reader, writer, NULL, NULL, NULL), TETSTREAM_OK);
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);
  CHECK_EQUAL(close(ends[1]), 0); /* the descriptor stayed the caller's */

  info.struct_size = sizeof info;
  CHECK_EQUAL(tetstream_reader_open_fd(ends[0], "tets", &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_inspect(reader, NULL, NULL, NULL, &info), TETSTREAM_OK);
  CHECK(info.cell_count > 100 && info.cell_count < 400);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(close(ends[0]), 0);
}

static void properties_belong_to_formats(void) {
  static const struct {
    const char *format, *property, *value;
    tetstream_status status;
  } cases[] = {
      {"tets", "compress", "no", TETSTREAM_OK},
      {"vtu", "compress", "yes", TETSTREAM_OK},
      {"sva", "order", "post", TETSTREAM_OK},
      {"svb", "order", "pre", TETSTREAM_OK},
      {"tets", "compress", "maybe", TETSTREAM_BAD_ARGUMENT},
      {"tets", "order", "pre", TETSTREAM_BAD_ARGUMENT},
      {"sva", "compress", "no", TETSTREAM_BAD_ARGUMENT},
      {"vtu", "colour", "red", TETSTREAM_BAD_ARGUMENT},
  };
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
    tetstream_writer* writer = NULL;
    CHECK_EQUAL(tetstream_writer_create_memory(cases[i].format, &writer), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_writer_set(writer, cases[i].property, cases[i].value), cases[i].status);
    if (cases[i].status < 0) CHECK_SAYS(tetstream_writer_message(writer), cases[i].property);
    tetstream_writer_destroy(writer);
  }
  tetstream_writer* writer = NULL;
  char message[256];
  CHECK_EQUAL(tetstream_writer_create_memory("tets", &writer), TETSTREAM_OK);
  CHECK(run_into(writer, message) >= 0);
  CHECK_EQUAL(tetstream_writer_set(writer, "compress", "no"), TETSTREAM_BAD_STATE);
  tetstream_writer_destroy(writer);

  hostile_writer hostile = {0};
  const tetstream_writer_callbacks writes = hostile_writer_callbacks(&hostile);
  CHECK_EQUAL(tetstream_writer_create(&writes, &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_set(writer, "compress", "no"), TETSTREAM_BAD_ARGUMENT);
  tetstream_writer_destroy(writer);
}

static void what_a_format_cannot_hold_is_noted(void) {
  hostile_mesh* mesh = hostile_mesh_create(2, 2, 2);
  tetstream_stream_info info;
  tetstream_batch batch;
  const void* pointers[3];
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  hostile_mesh_info(mesh, &info);
  hostile_mesh_batch(mesh, &batch, pointers);
  CHECK_EQUAL(tetstream_reader_open_mesh(&info, &batch, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_memory("svb", &writer), TETSTREAM_OK);
  CHECK(tetstream_writer_note(writer, 0) == NULL);
  CHECK_EQUAL(tetstream_convert(reader, writer, NULL, NULL, NULL), TETSTREAM_OK);
  CHECK_SAYS(tetstream_writer_note(writer, 0), "float32");
  CHECK_SAYS(tetstream_writer_note(writer, 0), "density");
  CHECK(tetstream_writer_note(writer, 1) != NULL); /* the fields beyond the first */
  CHECK(tetstream_writer_note(writer, -1) == NULL);
  CHECK(tetstream_writer_note(writer, 1000) == NULL);
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);
  hostile_mesh_destroy(mesh);
}

/* One cell, of which something must stay: its first edge, a vertex, or nothing. */
typedef struct one_cell {
  int64_t locked_edges;
  const uint8_t* locked;
  int at_end;
} one_cell;

static int32_t one_cell_open(void* user, tetstream_stream_info* info) {
  (void)user;
  info->position_type = TETSTREAM_TYPE_FLOAT32;
  return 0;
}
static int32_t one_cell_next(void* user, tetstream_batch* batch) {
  static const float positions[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  static const int64_t cell[4] = {0, 1, 2, 3}, edge[2] = {0, 1};
  static const uint8_t all = 15;
  one_cell* cell_of = user;
  if (cell_of->at_end) return 0;
  cell_of->at_end = 1;
  batch->vertex_count = 4;
  batch->positions = positions;
  batch->cell_count = 1;
  batch->cells = cell;
  batch->last_uses = &all;
  batch->locked_edge_count = cell_of->locked_edges;
  batch->locked_edges = edge;
  batch->locked = cell_of->locked;
  return 0;
}

/* How many notes tell of locks where the cell is written. */
static int notes_of_locks(const char* format, one_cell cell) {
  tetstream_reader_callbacks reads = {0};
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  reads.struct_size = sizeof reads;
  reads.user = &cell;
  reads.open = one_cell_open;
  reads.next = one_cell_next;
  CHECK_EQUAL(tetstream_reader_create(&reads, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_memory(format, &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(reader, writer, NULL, NULL, NULL), TETSTREAM_OK);
  int noted = 0;
  for (int32_t k = 0; tetstream_writer_note(writer, k); ++k)
    noted += strstr(tetstream_writer_note(writer, k), "lock") != NULL;
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);
  return noted;
}

static void locks_that_a_format_cannot_hold_are_noted(void) {
  static const char* const formats[] = {"vtu", "vtk", "sva", "svb", "msh", "exodus", "mesh"};
  static const uint8_t none[4] = {0, 0, 0, 0}, last[4] = {0, 0, 0, 1};
  for (size_t i = 0; i < sizeof formats / sizeof formats[0]; ++i) {
    const int holds_vertices = strcmp(formats[i], "mesh") == 0;
    CHECK_EQUAL(notes_of_locks(formats[i], (one_cell){1, NULL, 0}), 1);
    CHECK_EQUAL(notes_of_locks(formats[i], (one_cell){0, last, 0}), !holds_vertices);
    CHECK_EQUAL(notes_of_locks(formats[i], (one_cell){0, none, 0}), 0);
    CHECK_EQUAL(notes_of_locks(formats[i], (one_cell){0, NULL, 0}), 0);
  }
}

/* Whoever writes, and nobody ignores the signal: an error of the write, in every format. */
static void a_limit_of_the_process_is_an_error(void) {
  struct rlimit before, small;
  const char *name, *extensions, *text;
  int32_t reads, writes;
  CHECK_EQUAL(getrlimit(RLIMIT_FSIZE, &before), 0);
  small = before;
  small.rlim_cur = 5000;
  for (int32_t i = 0;
       tetstream_format_at(i, &name, &extensions, &text, &reads, &writes) == TETSTREAM_OK; ++i) {
    tetstream_reader* reader = NULL;
    tetstream_writer* writer = NULL;
    if (!writes) continue;
    CHECK_EQUAL(tetstream_reader_generate("ball", 3000, 1, &reader), TETSTREAM_OK);
    CHECK_EQUAL(tetstream_writer_create_file(in_folder("limited"), name, &writer), TETSTREAM_OK);
    CHECK_EQUAL(setrlimit(RLIMIT_FSIZE, &small), 0);
    const tetstream_status status = tetstream_convert(reader, writer, NULL, NULL, NULL);
    CHECK_EQUAL(setrlimit(RLIMIT_FSIZE, &before), 0);
    CHECK_EQUAL(status, TETSTREAM_IO);
    tetstream_writer_destroy(writer);
    tetstream_reader_destroy(reader);
    CHECK_EQUAL(files_in_folder(), 0);
  }
}

static void null_is_refused_everywhere(void) {
  hostile_writer hostile = {0};
  tetstream_writer_callbacks writes = hostile_writer_callbacks(&hostile);
  tetstream_writer* writer = NULL;
  const void* data = NULL;
  size_t size = 0;
#define REFUSED(call)                                   \
  CHECK_EQUAL(call, TETSTREAM_BAD_ARGUMENT);            \
  CHECK_SAYS(tetstream_writer_message(writer), "NULL"); \
  tetstream_writer_destroy(writer)
  REFUSED(tetstream_writer_create(NULL, &writer));
  REFUSED(tetstream_writer_create_file(NULL, "vtu", &writer));
  REFUSED(tetstream_writer_create_fd(1, NULL, &writer));
  REFUSED(tetstream_writer_create_memory(NULL, &writer));
  writes.put = NULL;
  REFUSED(tetstream_writer_create(&writes, &writer));
  writes = hostile_writer_callbacks(&hostile);
  writes.struct_size = offsetof(tetstream_writer_callbacks, close);
  CHECK_EQUAL(tetstream_writer_create(&writes, &writer), TETSTREAM_BAD_ARGUMENT);
  CHECK_SAYS(tetstream_writer_message(writer), "struct_size");
  tetstream_writer_destroy(writer);
  CHECK_EQUAL(tetstream_writer_create(&writes, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_writer_create_file("a.vtu", NULL, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_writer_create_fd(1, "vtu", NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_writer_create_memory("vtu", NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_writer_set(NULL, "compress", "no"), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_writer_get_memory(NULL, &data, &size), TETSTREAM_BAD_ARGUMENT);
  CHECK(tetstream_writer_note(NULL, 0) == NULL);
  CHECK(tetstream_writer_message(NULL) != NULL);
  tetstream_writer_destroy(NULL);
  CHECK_EQUAL(tetstream_writer_create_memory("tets", &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_get_memory(writer, NULL, &size), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_writer_get_memory(writer, &data, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_writer_set(writer, NULL, "no"), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_writer_set(writer, "compress", NULL), TETSTREAM_BAD_ARGUMENT);
  tetstream_writer_destroy(writer);
}

int main(void) {
  const char* dir = getenv("TMPDIR");
  snprintf(folder, sizeof folder, "%.40s/tetstream.XXXXXX", dir && *dir ? dir : "/tmp");
  CHECK(mkdtemp(folder) != NULL);
  RUN_CASE(put_alone_is_enough);
  RUN_CASE(all_callbacks_come_in_order_and_once);
  RUN_CASE(failures_stop_the_run_and_close_once);
  RUN_CASE(a_writer_that_was_never_used_is_not_closed);
  RUN_CASE(a_file_has_its_name_only_when_complete);
  RUN_CASE(nothing_is_left_of_a_file_after_a_failure);
  RUN_CASE(the_end_of_a_file_is_told_and_can_be_cancelled);
  RUN_CASE(a_failed_creation_leaves_a_handle_with_a_message);
  RUN_CASE(memory_is_given_only_when_complete);
  RUN_CASE(a_descriptor_gets_the_bytes_that_memory_gets);
  RUN_CASE(a_descriptor_for_the_other_way_is_refused_at_once);
  RUN_CASE(a_pipe_can_be_written_and_read);
  RUN_CASE(properties_belong_to_formats);
  RUN_CASE(what_a_format_cannot_hold_is_noted);
  RUN_CASE(locks_that_a_format_cannot_hold_are_noted);
  RUN_CASE(a_limit_of_the_process_is_an_error);
  RUN_CASE(null_is_refused_everywhere);
  rmdir(folder);
  return check_end();
}
