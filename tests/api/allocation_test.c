/* Memory may run out anywhere: the n-th allocation of a run fails, for all n, and each time there
 * is a status, no crash, and nothing is lost. This program defines the allocator itself, on top of
 * glibc's, and so counts what the library and its C++ run time take and give back. */
#define _GNU_SOURCE /* sched_setaffinity */
#include <stdlib.h>

#include "rig.h"

#define NOT_RUN 77

#if defined(TETSTREAM_SANITIZED) || !defined(__GLIBC__)

int main(void) {
  puts("not run: the allocator is not ours to replace here");
  return NOT_RUN;
}

#else

#include <errno.h>
#include <pthread.h>
#include <sched.h>
#include <unistd.h>

void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* old, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
void __libc_free(void* old);

static int watching; /* counts and fails only then */
static long allocations, frees, fail_at;
static int failed;

/* Counts one more, of whichever thread, and returns the count. */
static long count_one(long* counter) {
  return __atomic_add_fetch(counter, 1, __ATOMIC_RELAXED);
}

/* Whether this allocation is to fail. */
static int is_refused(void) {
  if (!watching || count_one(&allocations) != fail_at) return 0;
  failed = 1;
  errno = ENOMEM;
  return 1;
}

void* malloc(size_t size) {
  return is_refused() ? NULL : __libc_malloc(size);
}

void* calloc(size_t count, size_t size) {
  return is_refused() ? NULL : __libc_calloc(count, size);
}

void* aligned_alloc(size_t alignment, size_t size) {
  return is_refused() ? NULL : __libc_memalign(alignment, size);
}

int posix_memalign(void** out, size_t alignment, size_t size) {
  if (is_refused()) return ENOMEM;
  *out = __libc_memalign(alignment, size);
  return *out ? 0 : ENOMEM;
}

/* One that grows a block is an allocation and a free. */
void* realloc(void* old, size_t size) {
  if (is_refused()) return NULL;
  if (watching && old) count_one(&frees);
  return __libc_realloc(old, size);
}

void free(void* old) {
  if (watching && old) count_one(&frees);
  __libc_free(old);
}

/* The caller's own memory is not what is tested: his callbacks are left alone. */
static tetstream_reader_callbacks theirs;

static int32_t open_unwatched(void* user, tetstream_stream_info* info) {
  watching = 0;
  const int32_t value = theirs.open(user, info);
  watching = 1;
  return value;
}

static int32_t next_unwatched(void* user, tetstream_batch* batch) {
  watching = 0;
  const int32_t value = theirs.next(user, batch);
  watching = 1;
  return value;
}

static void close_unwatched(void* user) {
  watching = 0;
  theirs.close(user);
  watching = 1;
}

/* ------------------------------------------------------------------------------- the small runs */

static hostile_mesh* mesh;

/* Each gives the first failure, or OK, and has destroyed what it made. */
typedef tetstream_status (*small_run)(void);

static tetstream_status first(tetstream_status a, tetstream_status b) {
  return a < 0 ? a : b;
}

static tetstream_status configure(void) {
  tetstream_options* options = NULL;
  tetstream_status status = tetstream_options_create(&options);
  status = first(status, tetstream_options_set_text(options, TETSTREAM_OPTION_TMPDIR,
                                                    "/a/folder/with/a/rather/long/name"));
  status = first(status, tetstream_options_parse(options, "memory", "64M"));
  status = first(status, tetstream_options_add_field(options, "a field with a long name", 1));
  if (status < 0 && !tetstream_options_message(options)) status = TETSTREAM_INTERNAL;
  tetstream_options_destroy(options);
  return status;
}

/* A window of 64 cells is filled more than once; 0: by the front. */
static int64_t window_cells;
static const char* mode = "sweep";
/* Whether the run tells its map and its log, too. */
static int traced;

static int32_t take_map(void* user, const tetstream_map_rows* rows) {
  *(int64_t*)user += rows->count;
  return 0;
}
static int32_t take_log(void* user, const tetstream_log_rows* rows) {
  *(int64_t*)user += rows->count;
  return 0;
}

static tetstream_status trace(tetstream_simplifier* simplifier) {
  static int64_t rows;
  const tetstream_map_callbacks map = {sizeof map, &rows, NULL, take_map, NULL, NULL};
  const tetstream_log_callbacks log = {sizeof log, &rows, NULL, take_log, NULL, NULL};
  tetstream_status status = tetstream_simplifier_set_map(simplifier, &map);
  if (status >= 0) status = tetstream_simplifier_set_log(simplifier, &log);
  return status;
}

static tetstream_status simplify(tetstream_reader* reader, const char* format) {
  tetstream_options* options = NULL;
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  tetstream_report report = {0};
  report.struct_size = sizeof report;
  tetstream_status status = tetstream_options_create(&options);
  if (status >= 0) status = tetstream_options_set_double(options, TETSTREAM_OPTION_RATIO, 0.5);
  if (status >= 0)
    status = tetstream_options_set_int64(options, TETSTREAM_OPTION_WINDOW, window_cells);
  if (status >= 0) status = tetstream_options_set_text(options, TETSTREAM_OPTION_MODE, mode);
  if (status >= 0) status = tetstream_writer_create_memory(format, &writer);
  if (status >= 0) status = tetstream_simplifier_create(options, writer, &simplifier);
  if (status >= 0 && traced) status = trace(simplifier);
  if (status >= 0) status = tetstream_simplifier_run(simplifier, reader);
  if (status >= 0) status = tetstream_simplifier_get_report(simplifier, &report);
  if (status < 0 && !tetstream_simplifier_message(simplifier)) status = TETSTREAM_INTERNAL;
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
  tetstream_options_destroy(options);
  return status;
}

static tetstream_status simplify_stream_into(const char* format) {
  hostile_reader hostile = {0};
  tetstream_reader* reader = NULL;
  hostile.mesh = mesh;
  hostile.cut = HOSTILE_ODD;
  theirs = hostile_reader_callbacks(&hostile);
  const tetstream_reader_callbacks reads = {sizeof reads, &hostile, open_unwatched, next_unwatched,
                                            close_unwatched};
  tetstream_status status = tetstream_reader_create(&reads, &reader);
  if (status >= 0) status = simplify(reader, format);
  tetstream_reader_destroy(reader);
  if (hostile.closes != hostile.opens) status = TETSTREAM_INTERNAL;
  return status;
}

static tetstream_status simplify_stream_to_tets(void) {
  return simplify_stream_into("tets");
}
static tetstream_status simplify_stream_to_vtu(void) {
  return simplify_stream_into("vtu");
}
static tetstream_status simplify_stream_to_sva(void) {
  return simplify_stream_into("sva");
}
static tetstream_status simplify_stream_to_svb(void) {
  return simplify_stream_into("svb");
}

static tetstream_status simplify_arrays(void) {
  tetstream_stream_info info;
  tetstream_batch batch;
  const void* pointers[3];
  tetstream_reader* reader = NULL;
  hostile_mesh_info(mesh, &info);
  hostile_mesh_batch(mesh, &batch, pointers);
  tetstream_status status = tetstream_reader_open_mesh(&info, &batch, &reader);
  if (status >= 0) status = simplify(reader, "tets");
  tetstream_reader_destroy(reader);
  return status;
}

static tetstream_status push_into_callbacks(void) {
  hostile_writer hostile = {0};
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  tetstream_stream_info info;
  tetstream_batch batch;
  const void* pointers[3];
  static unsigned char state[4096];
  hostile.state = state; /* so that the writer itself needs no memory */
  hostile.state_size = sizeof state;
  const tetstream_writer_callbacks writes = hostile_writer_callbacks(&hostile);
  hostile_mesh_info(mesh, &info);
  hostile_mesh_batch(mesh, &batch, pointers);
  tetstream_status status = tetstream_writer_create(&writes, &writer);
  if (status >= 0) status = tetstream_simplifier_create(NULL, writer, &simplifier);
  if (status >= 0) status = tetstream_simplifier_begin(simplifier, &info);
  if (status >= 0) status = tetstream_simplifier_push(simplifier, &batch);
  if (status >= 0) status = tetstream_simplifier_finish(simplifier);
  tetstream_writer_destroy(writer);
  tetstream_simplifier_destroy(simplifier);
  if (hostile.closes != hostile.opens || hostile.stream_errors) status = TETSTREAM_INTERNAL;
  return status;
}

/* From bytes in memory, which are made beforehand, to an inspection. */
static const void* bytes[4];
static size_t sizes[4];
static const char* const names[4] = {"tets", "vtu", "sva", "svb"};
static int kind;

static tetstream_status inspect_file(void) {
  tetstream_reader* reader = NULL;
  tetstream_stream_info info = {0};
  info.struct_size = sizeof info;
  tetstream_status status =
      tetstream_reader_open_memory(bytes[kind], sizes[kind], names[kind], &reader);
  if (status >= 0) status = tetstream_inspect(reader, NULL, NULL, NULL, &info);
  if (status >= 0 && info.cell_count != mesh->cell_count) status = TETSTREAM_INTERNAL;
  if (status < 0 && !tetstream_reader_message(reader)) status = TETSTREAM_INTERNAL;
  tetstream_reader_destroy(reader);
  return status;
}

/* What is drawn from is collected; drawing itself is the business of other libraries. */
static tetstream_status read_diagram(void) {
  tetstream_reader* reader = NULL;
  tetstream_diagram* diagram = NULL;
  tetstream_status status =
      tetstream_reader_open_memory(bytes[kind], sizes[kind], names[kind], &reader);
  if (status >= 0) status = tetstream_diagram_create(NULL, 9, 9, &diagram);
  if (status >= 0)
    status = tetstream_diagram_read(diagram, reader, TETSTREAM_PAGE_SWEEP, NULL, NULL);
  if (status < 0 && !tetstream_diagram_message(diagram)) status = TETSTREAM_INTERNAL;
  tetstream_diagram_destroy(diagram);
  tetstream_reader_destroy(reader);
  return status;
}

/* The original's bytes and a stream, with the raster that a picture is drawn from; exactly, or by
 * samples. Of more memory the raster would have more pixels, which is all that would take time. */
static const char* samples;

static tetstream_status compare_stream(void) {
  hostile_reader hostile = {0};
  tetstream_options* options = NULL;
  tetstream_comparison* comparison = NULL;
  tetstream_reader *original = NULL, *simplified = NULL;
  tetstream_comparison_info info = {0};
  info.struct_size = sizeof info;
  hostile.mesh = mesh;
  hostile.cut = HOSTILE_ODD;
  theirs = hostile_reader_callbacks(&hostile);
  const tetstream_reader_callbacks reads = {sizeof reads, &hostile, open_unwatched, next_unwatched,
                                            close_unwatched};
  tetstream_status status = tetstream_options_create(&options);
  if (status >= 0) status = tetstream_options_parse(options, "cut", "auto");
  if (status >= 0) status = tetstream_options_parse(options, "memory", "1M");
  if (status >= 0) status = tetstream_options_parse(options, "samples", samples);
  if (status >= 0) status = tetstream_options_parse(options, "boundary-samples", "500");
  if (status >= 0) status = tetstream_comparison_create(options, &comparison);
  if (status >= 0)
    status = tetstream_reader_open_memory(bytes[kind], sizes[kind], names[kind], &original);
  if (status >= 0) status = tetstream_reader_create(&reads, &simplified);
  if (status >= 0) status = tetstream_comparison_read(comparison, original, simplified, NULL, NULL);
  if (status >= 0) status = tetstream_comparison_get_info(comparison, &info);
  if (status >= 0 && !(info.topology_kept && info.distance < 1e-9)) status = TETSTREAM_INTERNAL;
  if (status < 0 && !tetstream_comparison_message(comparison)) status = TETSTREAM_INTERNAL;
  tetstream_comparison_destroy(comparison);
  tetstream_reader_destroy(simplified);
  tetstream_reader_destroy(original);
  tetstream_options_destroy(options);
  if (hostile.closes != hostile.opens) status = TETSTREAM_INTERNAL;
  return status;
}

/* Bytes that can be read twice: a pilot may come first. */
static tetstream_status simplify_file(void) {
  tetstream_reader* reader = NULL;
  tetstream_status status =
      tetstream_reader_open_memory(bytes[kind], sizes[kind], names[kind], &reader);
  if (status >= 0) status = simplify(reader, "tets");
  tetstream_reader_destroy(reader);
  return status;
}

/* Text of so many points that two threads read it. */
#define POINTS 40000
static char long_text[POINTS * 8 + 200];

static void write_long_text(void) {
  char* at =
      long_text + sprintf(long_text, "MeshVersionFormatted 2 Dimension 3 Vertices %d\n", POINTS);
  for (int i = 0; i < POINTS; ++i) at += sprintf(at, "%d %d %d 0\n", i % 7, i % 5, i % 3);
  strcpy(at, "Tetrahedra 1\n1 2 3 4 0\nEnd\n");
}

static tetstream_status open_long_text(void) {
  tetstream_reader* reader = NULL;
  tetstream_options* options = NULL;
  tetstream_status status = tetstream_options_create(&options);
  if (!status) status = tetstream_options_set_int64(options, TETSTREAM_OPTION_THREADS, 2);
  if (!status)
    status =
        tetstream_reader_open_memory_with(long_text, strlen(long_text), "mesh", options, &reader);
  tetstream_reader_destroy(reader);
  tetstream_options_destroy(options);
  return status;
}

/* A result whose stream makes no fields of cells, so that it is opened again without that option.
 */
static char result_path[] = "/tmp/tetstream-result-XXXXXX";

static tetstream_status open_result(void) {
  tetstream_reader* reader = NULL;
  tetstream_options* options = NULL;
  tetstream_status status = tetstream_options_create(&options);
  if (!status) status = tetstream_options_parse(options, "cells-to-points", "yes");
  if (!status) status = tetstream_options_parse(options, "tmpdir", "/tmp/../tmp/../tmp/../tmp");
  if (!status) status = tetstream_reader_open_result(result_path, names[kind], options, &reader);
  if (status < 0 && reader && !tetstream_reader_message(reader)) status = TETSTREAM_INTERNAL;
  tetstream_reader_destroy(reader);
  tetstream_options_destroy(options);
  return status;
}

static void write_result(const void* data, size_t size) {
  const int fd = mkstemp(result_path);
  CHECK(fd >= 0 && write(fd, data, size) == (ssize_t)size && !close(fd));
}

/* ---------------------------------------------------------------------------- one after another */

static void fails_cleanly_wherever_memory_ends(const char* name, small_run run) {
  const int failures_before = check_failures;
  long n = 1;
  run(); /* what the C library allocates once and keeps */
  for (;; ++n) {
    allocations = frees = 0;
    failed = 0;
    fail_at = n;
    watching = 1;
    const tetstream_status status = run();
    watching = 0;
    if (!failed) {
      if (!CHECK(status >= 0)) printf("    %s: status %d\n", name, (int)status);
      break;
    }
    /* note: a refusal may be survived, as when a stream is written unbuffered; never crashed. */
    if (!CHECK(status == TETSTREAM_NO_MEMORY || status >= 0))
      printf("    %s, allocation %ld: %s\n", name, n, tetstream_status_name(status));
    if (!CHECK_EQUAL(allocations - 1, frees)) printf("    %s, allocation %ld\n", name, n);
    if (check_failures > failures_before + 5) return;
  }
  CHECK_EQUAL(allocations, frees);
  printf("%s: %ld allocations, each of them refused\n", name, allocations);
}

static void make_bytes(int i, tetstream_writer** writer) {
  tetstream_reader* reader = arrays_of(mesh);
  CHECK_EQUAL(tetstream_writer_create_memory(names[i], writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_convert(reader, *writer, NULL, NULL, NULL), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_get_memory(*writer, &bytes[i], &sizes[i]), TETSTREAM_OK);
  tetstream_reader_destroy(reader);
}

/* glibc keeps the stacks of some threads that have ended, with a block of memory each: as many as
 * will run at once beside this one. */
#define STACKS 4

static void* wait_for_all(void* barrier) {
  pthread_barrier_wait(barrier);
  return NULL;
}

static void leave_stacks(void) {
  pthread_barrier_t barrier;
  pthread_t threads[STACKS];
  pthread_barrier_init(&barrier, NULL, STACKS);
  for (int i = 0; i < STACKS; ++i)
    CHECK(!pthread_create(&threads[i], NULL, wait_for_all, &barrier));
  for (int i = 0; i < STACKS; ++i) CHECK(!pthread_join(threads[i], NULL));
  pthread_barrier_destroy(&barrier);
}

/* With one core nothing runs beside; with many more threads run than stacks are kept. */
static void use_two_cores(void) {
  cpu_set_t cores;
  CHECK(!sched_getaffinity(0, sizeof cores, &cores));
  for (int i = 0, left = 2; i < CPU_SETSIZE; ++i)
    if (CPU_ISSET(i, &cores) && left-- <= 0) CPU_CLR(i, &cores);
  CHECK(!sched_setaffinity(0, sizeof cores, &cores));
}

int main(void) {
  tetstream_writer* writers[4];
  if (getenv("TETSTREAM_MEMCHECK")) {
    puts("not run: memcheck has its own allocator");
    return NOT_RUN;
  }
  setvbuf(stdout, NULL, _IONBF, 0);
  use_two_cores();
  leave_stacks();
  mesh = hostile_mesh_create(2, 2, 3);
  CHECK(mesh != NULL);
  fails_cleanly_wherever_memory_ends("options", configure);
  fails_cleanly_wherever_memory_ends("stream to .tets", simplify_stream_to_tets);
  fails_cleanly_wherever_memory_ends("stream to .vtu", simplify_stream_to_vtu);
  fails_cleanly_wherever_memory_ends("stream to .sva", simplify_stream_to_sva);
  fails_cleanly_wherever_memory_ends("stream to .svb", simplify_stream_to_svb);
  fails_cleanly_wherever_memory_ends("arrays to .tets", simplify_arrays);
  fails_cleanly_wherever_memory_ends("push", push_into_callbacks);
  write_long_text();
  fails_cleanly_wherever_memory_ends("long text", open_long_text);
  for (kind = 0; kind < 4; ++kind) {
    make_bytes(kind, &writers[kind]);
    fails_cleanly_wherever_memory_ends(names[kind], inspect_file);
    if (kind == 0) {
      fails_cleanly_wherever_memory_ends("diagram of .tets", read_diagram);
      samples = "500";
      fails_cleanly_wherever_memory_ends("comparison by samples", compare_stream);
      samples = "0";
      fails_cleanly_wherever_memory_ends("comparison", compare_stream);
      window_cells = 64;
      fails_cleanly_wherever_memory_ends(".tets through a small window", simplify_file);
      fails_cleanly_wherever_memory_ends("stream through a small window", simplify_stream_to_tets);
      write_result(bytes[kind], sizes[kind]);
      fails_cleanly_wherever_memory_ends("a result", open_result);
      unlink(result_path);
      traced = 1;
      fails_cleanly_wherever_memory_ends("stream, map and log", simplify_stream_to_tets);
      fails_cleanly_wherever_memory_ends("arrays, map and log", simplify_arrays);
      traced = 0;
      mode = "paper";
      fails_cleanly_wherever_memory_ends("the same in the paper's mode", simplify_stream_to_tets);
      mode = "queue";
      fails_cleanly_wherever_memory_ends("the same with a queue", simplify_stream_to_tets);
    }
    tetstream_writer_destroy(writers[kind]);
  }
  hostile_mesh_destroy(mesh);
  return check_end();
}

#endif
