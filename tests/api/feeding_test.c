/* The same stream gives the same bytes, however it is cut into batches and whichever way it comes:
 * pulled, pushed, from a file, from arrays. */
#include <stdlib.h>

#include "rig.h"

static hostile_mesh* mesh;

static void* bytes;
static size_t size;

/* The first result is kept, the others must equal it. */
static void compare(rig r, const char* way) {
  const void* data = NULL;
  size_t length = 0;
  CHECK_EQUAL(tetstream_writer_get_memory(r.writer, &data, &length), TETSTREAM_OK);
  if (!bytes) {
    bytes = malloc(length);
    size = length;
    memcpy(bytes, data, length);
  }
  if (!CHECK(length == size && memcmp(bytes, data, size) == 0))
    printf("    %s: %lu bytes, wanted %lu\n", way, (unsigned long)length, (unsigned long)size);
}

static void forget(void) {
  free(bytes);
  bytes = NULL;
}

static void pull(int cut, uint32_t flags, const char* way) {
  rig r = rig_create("tets");
  hostile_reader hostile = {0};
  tetstream_reader* reader = NULL;
  hostile.mesh = mesh;
  hostile.cut = cut;
  hostile.flags = flags;
  const tetstream_reader_callbacks reads = hostile_reader_callbacks(&hostile);
  CHECK_EQUAL(tetstream_reader_create(&reads, &reader), TETSTREAM_OK);
  CHECK(tetstream_simplifier_run(r.simplifier, reader) >= 0);
  CHECK_SAYS(tetstream_simplifier_message(r.simplifier), "");
  compare(r, way);
  tetstream_reader_destroy(reader);
  rig_destroy(r);
}

static void push(int cut, uint32_t flags, const char* way) {
  rig r = rig_create("tets");
  hostile_reader hostile = {0};
  tetstream_stream_info info;
  hostile.mesh = mesh;
  hostile.cut = cut;
  hostile.flags = flags;
  const tetstream_reader_callbacks feed = hostile_reader_callbacks(&hostile);
  hostile_mesh_info(mesh, &info);
  CHECK_EQUAL(feed.open(feed.user, &info), 0);
  CHECK_EQUAL(tetstream_simplifier_begin(r.simplifier, &info), TETSTREAM_OK);
  while (!hostile.ended) {
    tetstream_batch batch = {0};
    batch.struct_size = sizeof batch;
    CHECK_EQUAL(feed.next(feed.user, &batch), 0);
    if (!CHECK_EQUAL(tetstream_simplifier_push(r.simplifier, &batch), TETSTREAM_OK)) break;
  }
  feed.close(feed.user);
  CHECK(tetstream_simplifier_finish(r.simplifier) >= 0);
  compare(r, way);
  rig_destroy(r);
}

static void pull_from(tetstream_reader* reader, const char* way) {
  rig r = rig_create("tets");
  CHECK(tetstream_simplifier_run(r.simplifier, reader) >= 0);
  CHECK_SAYS(tetstream_simplifier_message(r.simplifier), "");
  compare(r, way);
  tetstream_reader_destroy(reader);
  rig_destroy(r);
}

/* The stream as the bytes of a file in memory; the writer holds them. */
static tetstream_reader* file(const char* format, uint32_t flags, tetstream_writer** writer) {
  tetstream_reader* reader = NULL;
  const void* data = NULL;
  size_t length = 0;
  hostile_reader hostile = {0};
  hostile.mesh = mesh;
  hostile.flags = flags;
  const tetstream_reader_callbacks reads = hostile_reader_callbacks(&hostile);
  CHECK_EQUAL(tetstream_reader_create(&reads, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_memory(format, writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(reader, *writer, NULL, NULL, NULL), TETSTREAM_OK);
  tetstream_reader_destroy(reader);
  CHECK_EQUAL(tetstream_writer_get_memory(*writer, &data, &length), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_open_memory(data, length, format, &reader), TETSTREAM_OK);
  return reader;
}

static void a_stream_gives_the_same_bytes_however_it_is_cut_and_fed(void) {
  tetstream_writer* writer = NULL;
  pull(HOSTILE_WHOLE, 0, "pull, one batch");
  pull(HOSTILE_ITEMS, 0, "pull, item by item");
  pull(HOSTILE_ODD, 0, "pull, odd sizes");
  pull(HOSTILE_VERTICES, 0, "pull, vertices first");
  push(HOSTILE_WHOLE, 0, "push, one batch");
  push(HOSTILE_ITEMS, 0, "push, item by item");
  push(HOSTILE_ODD, 0, "push, odd sizes");
  pull_from(file("tets", 0, &writer), "file");
  tetstream_writer_destroy(writer);
  forget();
}

static void an_indexed_mesh_gives_the_same_bytes_however_it_is_cut_and_fed(void) {
  const uint32_t indexed = TETSTREAM_STREAM_INDEXED;
  pull_from(arrays_of(mesh), "arrays");
  pull(HOSTILE_WHOLE, indexed, "pull, one batch");
  pull(HOSTILE_ITEMS, indexed, "pull, item by item");
  pull(HOSTILE_ODD, indexed, "pull, odd sizes");
  pull(HOSTILE_VERTICES, indexed, "pull, vertices first");
  push(HOSTILE_WHOLE, indexed, "push, one batch");
  push(HOSTILE_ITEMS, indexed, "push, item by item");
  push(HOSTILE_VERTICES, indexed, "push, vertices first");
  forget();
}

static int32_t sees_pilot(void* user, const tetstream_progress* progress) {
  if (strcmp(progress->phase, "pilot") == 0) *(int*)user = 1;
  return 0;
}

/* What can be read twice is, where that is allowed; the bytes depend on nothing else. */
static void pull_twice_from(tetstream_reader* reader, int pilot, const char* way) {
  rig r = rig_create_with_pilot("tets", "auto");
  int flown = 0;
  CHECK_EQUAL(tetstream_simplifier_set_progress(r.simplifier, sees_pilot, &flown), TETSTREAM_OK);
  CHECK(tetstream_simplifier_run(r.simplifier, reader) >= 0);
  CHECK_SAYS(tetstream_simplifier_message(r.simplifier), "");
  if (!CHECK_EQUAL(flown, pilot)) printf("    %s\n", way);
  compare(r, way);
  tetstream_reader_destroy(reader);
  rig_destroy(r);
}

static void input_that_is_read_twice_gives_the_same_bytes_again(void) {
  tetstream_writer* writer = NULL;
  for (int run = 0; run < 2; ++run) {
    pull_twice_from(file("tets", 0, &writer), 1, "file");
    tetstream_writer_destroy(writer);
  }
  forget();
  for (int run = 0; run < 2; ++run) pull_twice_from(arrays_of(mesh), 1, "arrays");
  forget();
  /* Callbacks come once: as with no pilot. */
  pull(HOSTILE_WHOLE, 0, "pull without a pilot");
  hostile_reader hostile = {0};
  tetstream_reader* reader = NULL;
  hostile.mesh = mesh;
  const tetstream_reader_callbacks reads = hostile_reader_callbacks(&hostile);
  CHECK_EQUAL(tetstream_reader_create(&reads, &reader), TETSTREAM_OK);
  pull_twice_from(reader, 0, "callbacks");
  forget();
}

int main(void) {
  mesh = hostile_mesh_create(5, 5, 7);
  CHECK(mesh != NULL);
  RUN_CASE(a_stream_gives_the_same_bytes_however_it_is_cut_and_fed);
  RUN_CASE(an_indexed_mesh_gives_the_same_bytes_however_it_is_cut_and_fed);
  RUN_CASE(input_that_is_read_twice_gives_the_same_bytes_again);
  hostile_mesh_destroy(mesh);
  return check_end();
}
