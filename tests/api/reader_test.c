/* Readers: callbacks that behave badly, files that are none. */
#include <math.h>
#include <stdlib.h>

#include "check.h"
#include "hostile.h"

static hostile_mesh* mesh;

/* Simplifies what `hostile` gives, into a writer that counts. */
static tetstream_status run(hostile_reader* hostile, hostile_writer* out, char message[256]) {
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  hostile->mesh = mesh;
  const tetstream_reader_callbacks reads = hostile_reader_callbacks(hostile);
  const tetstream_writer_callbacks writes = hostile_writer_callbacks(out);
  CHECK_EQUAL(tetstream_reader_create(&reads, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create(&writes, &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_create(NULL, writer, &simplifier), TETSTREAM_OK);
  const tetstream_status status = tetstream_simplifier_run(simplifier, reader);
  snprintf(message, 256, "%s", tetstream_simplifier_message(simplifier));
  CHECK_EQUAL(hostile->opens, 1);
  CHECK_EQUAL(hostile->closes, 1);
  CHECK_EQUAL(hostile->calls_after_end, 0);
  CHECK_EQUAL(tetstream_simplifier_run(simplifier, reader), TETSTREAM_BAD_STATE);
  tetstream_simplifier_destroy(simplifier);
  tetstream_reader_destroy(reader);
  tetstream_writer_destroy(writer);
  CHECK_EQUAL(hostile->opens, 1);
  CHECK_EQUAL(hostile->closes, 1);
  hostile_reader_free(hostile);
  hostile_writer_free(out);
  return status;
}

static void every_way_of_cutting_gives_a_valid_stream(void) {
  static const int cuts[] = {HOSTILE_WHOLE, HOSTILE_ITEMS, HOSTILE_ODD, HOSTILE_VERTICES,
                             HOSTILE_LISTS};
  for (int i = 0; i < 5; ++i)
    for (uint32_t flags = 0; flags <= TETSTREAM_STREAM_INDEXED; ++flags) {
      hostile_reader reader = {0};
      hostile_writer writer = {0};
      char message[256];
      reader.cut = cuts[i];
      reader.flags = flags;
      CHECK(run(&reader, &writer, message) >= 0);
      CHECK_SAYS(message, "");
      CHECK(writer.cells > 0 && writer.vertices > 0);
      CHECK_EQUAL(writer.stream_errors, 0);
      CHECK_EQUAL(writer.finalized, writer.vertices);
      CHECK_EQUAL(writer.order_errors, 0);
      CHECK_EQUAL(writer.finishes, 1);
    }
}

static void an_empty_stream_gives_an_empty_one(void) {
  hostile_reader reader = {0};
  hostile_writer writer = {0};
  hostile_mesh none = {0};
  hostile_mesh* const full = mesh;
  char message[256];
  mesh = &none;
  reader.empty = 1;
  CHECK_EQUAL(run(&reader, &writer, message), TETSTREAM_OK);
  CHECK_EQUAL(writer.cells, 0);
  CHECK_EQUAL(writer.vertices, 0);
  CHECK_EQUAL(writer.opens, 1);
  CHECK_EQUAL(writer.finishes, 1);
  CHECK_EQUAL(writer.closes, 1);
  mesh = full;
}

static void a_failure_at_any_call_stops_the_run_and_closes_once(void) {
  for (int call = 1; call < 40; ++call) {
    hostile_reader reader = {0};
    hostile_writer writer = {0};
    char message[256];
    reader.cut = HOSTILE_ODD;
    reader.fail_call = call;
    reader.fail_value = 40 + call;
    CHECK_EQUAL(run(&reader, &writer, message), TETSTREAM_CALLBACK);
    char value[16];
    snprintf(value, sizeof value, "%d", 40 + call);
    CHECK_SAYS(message, value);
    CHECK_SAYS(message, call == 1 ? "open" : "next");
    CHECK_EQUAL(writer.finishes, 0);
    CHECK_EQUAL(writer.closes, writer.opens);
    CHECK_EQUAL(reader.nexts, call - 1);
  }
}

static void spoilt_batches_are_named_and_refused(void) {
  static const struct {
    int spoil;
    const char* says;
  } cases[] = {{HOSTILE_GARBAGE_ID, "9223372036854775804"},
               {HOSTILE_NEGATIVE_ID, "-7"},
               {HOSTILE_NEGATIVE_COUNT, "-5"},
               {HOSTILE_NULL_POSITIONS, "positions"},
               {HOSTILE_NULL_FIELD, "field 1"},
               {HOSTILE_LAST_USES, "16"},
               {HOSTILE_NAN, ""},
               {HOSTILE_TWICE, ""}};
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i)
    for (int batch = 5; batch < 12; batch += 3)
      for (uint32_t flags = 0; flags <= TETSTREAM_STREAM_INDEXED; ++flags) {
        hostile_reader reader = {0};
        hostile_writer writer = {0};
        char message[256];
        if (cases[i].spoil == HOSTILE_TWICE && flags) continue;
        reader.cut = HOSTILE_ODD;
        reader.flags = flags;
        reader.spoil = cases[i].spoil;
        reader.spoil_batch = cases[i].spoil == HOSTILE_TWICE ? batch + 35 : batch;
        if (!CHECK_EQUAL(run(&reader, &writer, message), TETSTREAM_BAD_DATA))
          printf("    spoil %d, batch %d, flags %u: \"%s\"\n", cases[i].spoil, batch,
                 (unsigned)flags, message);
        CHECK_SAYS(message, cases[i].says);
        CHECK(message[0] != 0);
        CHECK_EQUAL(writer.finishes, 0);
      }
}

/* What `open` may put into *info, one wrong thing at a time. */
static int wrong;
static tetstream_column columns[2];
static double box[7] = {0, 0, 0, 0, 0, 0, 0};

static int32_t open_wrongly(void* user, tetstream_stream_info* info) {
  (void)user;
  CHECK_EQUAL(info->struct_size, sizeof *info);
  CHECK_EQUAL(info->cell_count, -1);
  columns[0].name = "a";
  columns[0].components = 1;
  columns[0].type = TETSTREAM_TYPE_FLOAT32;
  columns[1] = columns[0];
  columns[1].name = "b";
  info->position_type = TETSTREAM_TYPE_FLOAT32;
  info->field_count = 2;
  info->fields = columns;
  switch (wrong) {
    case 0:
      info->position_type = TETSTREAM_TYPE_INT32;
      break;
    case 1:
      info->position_type = 0;
      break;
    case 2:
      info->field_count = -1;
      break;
    case 3:
      info->field_count = INT32_MAX;
      break;
    case 4:
      info->fields = NULL;
      break;
    case 5:
      columns[1].name = NULL;
      break;
    case 6:
      columns[1].name = "a";
      break;
    case 7:
      columns[1].name = "";
      break;
    case 8:
      columns[1].components = 0;
      break;
    case 9:
      columns[1].components = 10;
      break;
    case 10:
      columns[1].type = 5;
      break;
    case 11:
      info->flags = 2;
      break;
    case 12:
      info->box_min = box;
      break;
    case 13:
      info->box_min = info->box_max = box;
      box[2] = -1;
      info->box_max = box + 1;
      break;
    case 14:
      info->cell_data_count = 1;
      break;
    default:
      return 99;
  }
  return 0;
}

static int32_t next_never(void* user, tetstream_batch* batch) {
  (void)user;
  (void)batch;
  CHECK(!"next is called after a failure of open");
  return 0;
}

static void count_close(void* user) {
  ++*(int*)user;
}

static void wrong_stream_infos_are_refused(void) {
  for (wrong = 0; wrong < 15; ++wrong) {
    int closes = 0;
    const tetstream_reader_callbacks reads = {sizeof reads, &closes, open_wrongly, next_never,
                                              count_close};
    tetstream_stream_info info = {0};
    tetstream_reader* reader = NULL;
    info.struct_size = sizeof info;
    CHECK_EQUAL(tetstream_reader_create(&reads, &reader), TETSTREAM_OK);
    if (!CHECK_EQUAL(tetstream_reader_get_info(reader, &info), TETSTREAM_BAD_ARGUMENT))
      printf("    wrong %d\n", wrong);
    CHECK(tetstream_reader_message(reader)[0] != 0);
    CHECK_EQUAL(tetstream_reader_get_info(reader, &info), TETSTREAM_BAD_STATE);
    tetstream_reader_destroy(reader);
    CHECK_EQUAL(closes, 1);
  }
}

/* Of two fields: of the first nothing is finite; the second has half a bound in two rows. */
static double low[5] = {0, 0, 0, INFINITY, 0}, high[5] = {1, 1, 1, -INFINITY, 1};

static int32_t open_with_bounds(void* user, tetstream_stream_info* info) {
  wrong = 99;
  if (open_wrongly(user, info) != 99) return 1;
  info->box_min = low;
  info->box_max = high;
  return 0;
}

static void a_box_tells_where_nothing_is_finite(void) {
  const tetstream_reader_callbacks reads = {sizeof reads, NULL, open_with_bounds, next_never, NULL};
  for (int row = 0; row < 3; ++row) {
    tetstream_stream_info info = {0};
    tetstream_reader* reader = NULL;
    info.struct_size = sizeof info;
    low[4] = row == 1 ? INFINITY : 0;
    high[4] = row == 2 ? -INFINITY : 1;
    CHECK_EQUAL(tetstream_reader_create(&reads, &reader), TETSTREAM_OK);
    const tetstream_status status = tetstream_reader_get_info(reader, &info);
    CHECK_EQUAL(status, row == 0 ? TETSTREAM_OK : TETSTREAM_BAD_ARGUMENT);
    if (row == 0) CHECK(info.box_min[3] > info.box_max[3] && info.box_max[4] == 1);
    tetstream_reader_destroy(reader);
  }
}

static void info_of_a_callback_reader_opens_it_once(void) {
  hostile_reader hostile = {0};
  tetstream_reader* reader = NULL;
  tetstream_stream_info info = {0};
  hostile.mesh = mesh;
  const tetstream_reader_callbacks reads = hostile_reader_callbacks(&hostile);
  info.struct_size = sizeof info;
  CHECK_EQUAL(tetstream_reader_create(&reads, &reader), TETSTREAM_OK);
  CHECK_EQUAL(hostile.opens, 0);
  CHECK_EQUAL(tetstream_reader_get_info(reader, &info), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_get_info(reader, &info), TETSTREAM_OK);
  CHECK_EQUAL(hostile.opens, 1);
  CHECK_EQUAL(info.cell_count, mesh->cell_count);
  CHECK_EQUAL(info.field_count, 2);
  CHECK(strcmp(info.fields[1].name, "velocity") == 0);
  CHECK_EQUAL(info.fields[1].components, 3);
  CHECK_EQUAL(info.cell_data[0].type, TETSTREAM_TYPE_INT32);
  CHECK_EQUAL(hostile.closes, 0);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(hostile.closes, 1);
}

static void a_reader_that_was_never_opened_is_not_closed(void) {
  hostile_reader hostile = {0};
  tetstream_reader* reader = NULL;
  const tetstream_reader_callbacks reads = hostile_reader_callbacks(&hostile);
  CHECK_EQUAL(tetstream_reader_create(&reads, &reader), TETSTREAM_OK);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(hostile.opens + hostile.nexts + hostile.closes, 0);
}

static void tables_of_other_sizes_are_told_apart(void) {
  hostile_reader hostile = {0};
  struct {
    tetstream_reader_callbacks table;
    void (*later)(void);
  } longer;
  tetstream_reader* reader = NULL;
  longer.table = hostile_reader_callbacks(&hostile);
  longer.later = NULL;
  longer.table.struct_size = sizeof longer;
  CHECK_EQUAL(tetstream_reader_create(&longer.table, &reader), TETSTREAM_OK);
  tetstream_reader_destroy(reader);
  longer.table.struct_size = offsetof(tetstream_reader_callbacks, close);
  CHECK_EQUAL(tetstream_reader_create(&longer.table, &reader), TETSTREAM_BAD_ARGUMENT);
  CHECK_SAYS(tetstream_reader_message(reader), "struct_size");
  tetstream_reader_destroy(reader);
  longer.table.struct_size = sizeof longer.table;
  longer.table.next = NULL;
  CHECK_EQUAL(tetstream_reader_create(&longer.table, &reader), TETSTREAM_BAD_ARGUMENT);
  CHECK_SAYS(tetstream_reader_message(reader), "next");
  tetstream_reader_destroy(reader);
}

static void a_failed_creation_leaves_a_handle_with_a_message(void) {
  tetstream_reader* reader = NULL;
  tetstream_stream_info info = {0};
  info.struct_size = sizeof info;
  CHECK_EQUAL(tetstream_reader_open_file("/nowhere/mesh.vtu", NULL, &reader), TETSTREAM_IO);
  CHECK_SAYS(tetstream_reader_message(reader), "/nowhere/mesh.vtu");
  CHECK_EQUAL(tetstream_reader_get_info(reader, &info), TETSTREAM_BAD_STATE);
  CHECK(tetstream_reader_note(reader, 0) == NULL);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_reader_open_file("mesh.unknown", NULL, &reader), TETSTREAM_UNSUPPORTED);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_reader_open_file("mesh.vtu", "unknown", &reader), TETSTREAM_UNSUPPORTED);
  CHECK_SAYS(tetstream_reader_message(reader), "unknown");
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_reader_open_memory("nonsense", 8, "tets", &reader), TETSTREAM_BAD_DATA);
  CHECK(tetstream_reader_message(reader)[0] != 0);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_reader_generate("cube", 1000, 1, &reader), TETSTREAM_BAD_ARGUMENT);
  CHECK_SAYS(tetstream_reader_message(reader), "cube");
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_reader_open_fd(-1, "tets", &reader), TETSTREAM_IO);
  tetstream_reader_destroy(reader);
}

static void null_is_refused_everywhere(void) {
  hostile_reader hostile = {0};
  const tetstream_reader_callbacks reads = hostile_reader_callbacks(&hostile);
  tetstream_stream_info info;
  tetstream_batch batch;
  const void* pointers[3];
  tetstream_reader* reader = NULL;
  hostile_mesh_info(mesh, &info);
  hostile_mesh_batch(mesh, &batch, pointers);
/* The sentence begins with the function that was called. */
#define REFUSED(call)                                                                 \
  CHECK_EQUAL(call, TETSTREAM_BAD_ARGUMENT);                                          \
  CHECK_SAYS(tetstream_reader_message(reader), " is NULL");                           \
  CHECK(strncmp(tetstream_reader_message(reader), #call, strcspn(#call, "(")) == 0 && \
        tetstream_reader_message(reader)[strcspn(#call, "(")] == ':');                \
  tetstream_reader_destroy(reader)
  REFUSED(tetstream_reader_create(NULL, &reader));
  REFUSED(tetstream_reader_open_file(NULL, "vtu", &reader));
  REFUSED(tetstream_reader_open_fd(0, NULL, &reader));
  REFUSED(tetstream_reader_open_memory(NULL, 5, "vtu", &reader));
  REFUSED(tetstream_reader_open_memory("12345", 5, NULL, &reader));
  REFUSED(tetstream_reader_open_mesh(NULL, &batch, &reader));
  REFUSED(tetstream_reader_open_mesh(&info, NULL, &reader));
  REFUSED(tetstream_reader_generate(NULL, 1000, 1, &reader));
  CHECK_EQUAL(tetstream_reader_create(&reads, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_reader_open_file("a.vtu", NULL, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_reader_open_fd(0, "vtu", NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_reader_open_memory("", 0, "vtu", NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_reader_open_mesh(&info, &batch, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_reader_generate("ball", 1000, 1, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_reader_get_info(NULL, &info), TETSTREAM_BAD_ARGUMENT);
  CHECK(tetstream_reader_note(NULL, 0) == NULL);
  CHECK(tetstream_reader_message(NULL) != NULL);
  tetstream_reader_destroy(NULL);
  CHECK_EQUAL(tetstream_reader_create(&reads, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_get_info(reader, NULL), TETSTREAM_BAD_ARGUMENT);
  info.struct_size = offsetof(tetstream_stream_info, box_max);
  CHECK_EQUAL(tetstream_reader_get_info(reader, &info), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(hostile.opens, 0);
  tetstream_reader_destroy(reader);
}

int main(void) {
  mesh = hostile_mesh_create(3, 4, 5);
  CHECK(mesh != NULL);
  RUN_CASE(every_way_of_cutting_gives_a_valid_stream);
  RUN_CASE(an_empty_stream_gives_an_empty_one);
  RUN_CASE(a_failure_at_any_call_stops_the_run_and_closes_once);
  RUN_CASE(spoilt_batches_are_named_and_refused);
  RUN_CASE(wrong_stream_infos_are_refused);
  RUN_CASE(a_box_tells_where_nothing_is_finite);
  RUN_CASE(info_of_a_callback_reader_opens_it_once);
  RUN_CASE(a_reader_that_was_never_opened_is_not_closed);
  RUN_CASE(tables_of_other_sizes_are_told_apart);
  RUN_CASE(a_failed_creation_leaves_a_handle_with_a_message);
  RUN_CASE(null_is_refused_everywhere);
  hostile_mesh_destroy(mesh);
  return check_end();
}
