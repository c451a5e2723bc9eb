/* Status names, the version, the table of formats. */
#include "check.h"
#include "tetstream/tetstream.h"

#define NAMED(status) CHECK(strcmp(tetstream_status_name(status), #status) == 0)

static void every_status_has_the_name_of_its_macro(void) {
  NAMED(TETSTREAM_OK);
  NAMED(TETSTREAM_END);
  NAMED(TETSTREAM_TARGET_MISSED);
  NAMED(TETSTREAM_BAD_ARGUMENT);
  NAMED(TETSTREAM_BAD_STATE);
  NAMED(TETSTREAM_NO_MEMORY);
  NAMED(TETSTREAM_BAD_DATA);
  NAMED(TETSTREAM_IO);
  NAMED(TETSTREAM_UNSUPPORTED);
  NAMED(TETSTREAM_CANCELLED);
  NAMED(TETSTREAM_CALLBACK);
  NAMED(TETSTREAM_INTERNAL);
}

static void unknown_statuses_have_a_name_too(void) {
  CHECK(tetstream_status_name(4711) != NULL);
  CHECK(tetstream_status_name(INT32_MIN) != NULL);
}

static void version_of_the_library_is_that_of_the_header(void) {
  char text[32];
  CHECK_EQUAL(tetstream_version_number(), TETSTREAM_VERSION_NUMBER);
  snprintf(text, sizeof text, "%d.%d.%d", TETSTREAM_VERSION_MAJOR, TETSTREAM_VERSION_MINOR,
           TETSTREAM_VERSION_PATCH);
  CHECK(strncmp(tetstream_version_text(), text, strlen(text)) == 0);
}

static void formats_are_listed(void) {
  int32_t count = 0, read = 0, write = 0;
  const char *name = NULL, *extensions = NULL, *text = NULL;
  while (tetstream_format_at(count, &name, &extensions, &text, &read, &write) == TETSTREAM_OK) {
    CHECK(name && name[0]);
    CHECK(extensions && extensions[0] == '.');
    CHECK(text && text[0]);
    CHECK(read || write);
    CHECK_EQUAL(tetstream_format_at(count, NULL, NULL, NULL, NULL, NULL), TETSTREAM_OK);
    ++count;
  }
  CHECK(count >= 4);
  CHECK_EQUAL(tetstream_format_at(count, &name, NULL, NULL, NULL, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_format_at(-1, &name, NULL, NULL, NULL, NULL), TETSTREAM_BAD_ARGUMENT);
}

int main(void) {
  RUN_CASE(every_status_has_the_name_of_its_macro);
  RUN_CASE(unknown_statuses_have_a_name_too);
  RUN_CASE(version_of_the_library_is_that_of_the_header);
  RUN_CASE(formats_are_listed);
  return check_end();
}
