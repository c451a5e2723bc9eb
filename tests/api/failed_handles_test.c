/* A handle that could not be created says why, however late it is asked, and so does whatever was
 * given it: a program may do everything and look at the last status alone. */
#include "check.h"
#include "tetstream/tetstream.h"

/* The program of the README, with the paths that a user may get wrong. */
static void check_program(const char* input, const char* output, const char* reason) {
  tetstream_reader* in = NULL;
  tetstream_writer* out = NULL;
  tetstream_simplifier* simplifier = NULL;
  tetstream_reader_open_file(input, NULL, &in);
  tetstream_writer_create_file(output, NULL, &out);
  tetstream_simplifier_create(NULL, out, &simplifier);
  CHECK_EQUAL(tetstream_simplifier_run(simplifier, in), TETSTREAM_BAD_STATE);
  CHECK_SAYS(tetstream_simplifier_message(simplifier), reason);
  CHECK_EQUAL(tetstream_simplifier_run(simplifier, in), TETSTREAM_BAD_STATE);
  CHECK_SAYS(tetstream_simplifier_message(simplifier), reason);
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(out);
  tetstream_reader_destroy(in);
}

static void a_program_that_looks_at_the_run_alone_is_told_why(void) {
  check_program("nowhere.vtu", "small.vtu", "reader could not be created: nowhere.vtu: ");
  check_program("nowhere.vtu", "small.what", "writer could not be created: ");
  check_program("nowhere.vtu", "small.what", "small.what");
  check_program("nowhere.vtu", "/nowhere/small.vtu", "/nowhere/small.vtu");
}

#define KEEPS(call, handle, message, reason) \
  CHECK_EQUAL(call, TETSTREAM_BAD_STATE);    \
  CHECK_SAYS(message(handle), reason)

static void a_failed_reader_keeps_its_message(void) {
  tetstream_reader* reader = NULL;
  tetstream_stream_info info = {0};
  tetstream_front_info front = {0};
  tetstream_face_label_info label = {0};
  info.struct_size = sizeof info;
  front.struct_size = sizeof front;
  label.struct_size = sizeof label;
  CHECK_EQUAL(tetstream_reader_open_file("nowhere.vtu", NULL, &reader), TETSTREAM_IO);
#define READER(call) KEEPS(call, reader, tetstream_reader_message, "nowhere.vtu: ")
  READER(tetstream_reader_get_info(reader, &info));
  READER(tetstream_reader_get_front(reader, &front));
  READER(tetstream_reader_get_face_label(reader, 0, &label));
  READER(tetstream_inspect(reader, NULL, NULL, NULL, &info));
  tetstream_reader_destroy(reader);
}

static void a_failed_writer_keeps_its_message(void) {
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  const void* data = NULL;
  size_t size = 0;
  CHECK_EQUAL(tetstream_reader_generate("ball", 1000, 1, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_memory("what", &writer), TETSTREAM_UNSUPPORTED);
#define WRITER(call) KEEPS(call, writer, tetstream_writer_message, "\"what\"")
  WRITER(tetstream_writer_set(writer, "compress", "no"));
  WRITER(tetstream_writer_get_memory(writer, &data, &size));
  WRITER(tetstream_convert(reader, writer, NULL, NULL, NULL));
  WRITER(tetstream_layout(reader, writer, NULL, NULL, NULL, NULL));
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
}

static void a_failed_simplifier_keeps_its_message(void) {
  tetstream_simplifier* simplifier = NULL;
  tetstream_report report = {0};
  report.struct_size = sizeof report;
  CHECK_EQUAL(tetstream_simplifier_create(NULL, NULL, &simplifier), TETSTREAM_BAD_ARGUMENT);
#define SIMPLIFIER(call) KEEPS(call, simplifier, tetstream_simplifier_message, "writer is NULL")
  SIMPLIFIER(tetstream_simplifier_set_progress(simplifier, NULL, NULL));
  SIMPLIFIER(tetstream_simplifier_set_map(simplifier, NULL));
  SIMPLIFIER(tetstream_simplifier_begin(simplifier, NULL));
  SIMPLIFIER(tetstream_simplifier_push(simplifier, NULL));
  SIMPLIFIER(tetstream_simplifier_finish(simplifier));
  SIMPLIFIER(tetstream_simplifier_get_report(simplifier, &report));
  tetstream_simplifier_destroy(simplifier);
}

static void what_measures_keeps_its_message_too(void) {
  tetstream_diagram* diagram = NULL;
  CHECK_EQUAL(tetstream_diagram_create(NULL, 0, 0, &diagram), TETSTREAM_BAD_ARGUMENT);
  KEEPS(tetstream_diagram_check_path(diagram, "a.svg"), diagram, tetstream_diagram_message,
        "tetstream_diagram_create: ");
  tetstream_diagram_destroy(diagram);

  tetstream_options* options = NULL;
  tetstream_comparison* comparison = NULL;
  CHECK_EQUAL(tetstream_options_create(&options), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_options_set_text(options, TETSTREAM_OPTION_CUT, "w=1"), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_comparison_create(options, &comparison), TETSTREAM_BAD_ARGUMENT);
  KEEPS(tetstream_comparison_check_path(comparison, "a.svg"), comparison,
        tetstream_comparison_message, "tetstream_comparison_create: ");
  tetstream_comparison_destroy(comparison);
  tetstream_options_destroy(options);
}

static int32_t stop(void* user, const tetstream_progress* progress) {
  (void)user, (void)progress;
  return 1;
}

static void what_took_part_in_a_failed_layout_is_over(void) {
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  tetstream_stream_info info = {0};
  info.struct_size = sizeof info;
  CHECK_EQUAL(tetstream_reader_generate("ball", 1000, 1, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_memory("tets", &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_layout(reader, writer, NULL, stop, NULL, NULL), TETSTREAM_CANCELLED);
  CHECK_EQUAL(tetstream_inspect(reader, NULL, NULL, NULL, &info), TETSTREAM_BAD_STATE);
  CHECK_SAYS(tetstream_reader_message(reader), "failed before");
  CHECK_EQUAL(tetstream_writer_set(writer, "compress", "no"), TETSTREAM_BAD_STATE);
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
}

static int32_t not_now(void* user, tetstream_stream_info* info) {
  (void)user, (void)info;
  return 42;
}

static int32_t never(void* user, tetstream_batch* batch) {
  (void)user, (void)batch;
  CHECK(!"next is called");
  return 0;
}

static void a_reader_of_callbacks_that_does_not_open_is_over(void) {
  tetstream_reader* reader = NULL;
  tetstream_reader_callbacks reads = {0};
  tetstream_stream_info info = {0};
  reads.struct_size = sizeof reads;
  reads.open = not_now;
  reads.next = never;
  info.struct_size = sizeof info;
  CHECK_EQUAL(tetstream_reader_create(&reads, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_get_info(reader, &info), TETSTREAM_CALLBACK);
  CHECK_SAYS(tetstream_reader_message(reader), "returned 42");
  CHECK_EQUAL(tetstream_inspect(reader, NULL, NULL, NULL, &info), TETSTREAM_BAD_STATE);
  tetstream_reader_destroy(reader);
}

int main(void) {
  RUN_CASE(a_program_that_looks_at_the_run_alone_is_told_why);
  RUN_CASE(a_failed_reader_keeps_its_message);
  RUN_CASE(a_failed_writer_keeps_its_message);
  RUN_CASE(a_failed_simplifier_keeps_its_message);
  RUN_CASE(what_measures_keeps_its_message_too);
  RUN_CASE(what_took_part_in_a_failed_layout_is_over);
  RUN_CASE(a_reader_of_callbacks_that_does_not_open_is_over);
  return check_end();
}
