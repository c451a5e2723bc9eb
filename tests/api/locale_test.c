/* Numbers in texts are those of the C locale, whatever locale the process has. */
#define _POSIX_C_SOURCE 200809L
#include <locale.h>
#include <stdlib.h>
#include <unistd.h>

#include "check.h"
#include "tetstream/tetstream.h"

#define NOT_RUN 77

/* A locale with a comma before decimals and points between thousands. */
static const char* const kCategories[] = {"CTYPE",     "COLLATE",     "MONETARY", "TIME",
                                          "MESSAGES",  "PAPER",       "NAME",     "ADDRESS",
                                          "TELEPHONE", "MEASUREMENT", NULL};
static int write_locale(const char* path) {
  FILE* file = fopen(path, "w");
  if (!file) return 0;
  for (const char* const* name = kCategories; *name; ++name)
    fprintf(file, "LC_%s\ncopy \"POSIX\"\nEND LC_%s\n", *name, *name);
  fputs(
      "LC_NUMERIC\ndecimal_point \",\"\nthousands_sep \".\"\ngrouping 3;3\nEND LC_NUMERIC\n"
      "LC_IDENTIFICATION\nEND LC_IDENTIFICATION\n",
      file);
  return fclose(file) == 0;
}

/* Sets it, where a system has none with the system's own compiler of locales. */
static int comma_locale(void) {
  static const char* const known[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE.utf8", "fr_FR.utf8",
                                      NULL};
  for (const char* const* name = known; *name; ++name)
    if (setlocale(LC_ALL, *name)) return 1;
  char folder[] = "/tmp/tetstream-locale.XXXXXX", path[64], command[256];
  if (!mkdtemp(folder)) return 0;
  snprintf(path, sizeof path, "%s/source", folder);
  snprintf(command, sizeof command,
           "cd %s && localedef -c -i ./source -f ANSI_X3.4-1968 ./comma >/dev/null 2>&1", folder);
  const int made = write_locale(path) && system(command) >= 0; /* warnings make it 1 */
  setenv("LOCPATH", folder, 1);
  const int set = made && setlocale(LC_ALL, "comma") != NULL;
  snprintf(command, sizeof command, "rm -r %s", folder);
  return system(command) == 0 && set;
}

/* The order of a mesh that lies slantwise is told by three numbers. */
static void the_report_has_points(void) {
  tetstream_options* options = NULL;
  tetstream_reader* reader = NULL;
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  tetstream_report report;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  CHECK_EQUAL(tetstream_options_create(&options), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_options_parse(options, "ratio", "0.9"), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_open_file(BRACKET, NULL, &reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_memory("tets", &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_create(options, writer, &simplifier), TETSTREAM_OK);
  CHECK(tetstream_simplifier_run(simplifier, reader) >= 0);
  CHECK_EQUAL(tetstream_simplifier_get_report(simplifier, &report), TETSTREAM_OK);
  CHECK_SAYS(report.order, "(-0.");
  CHECK_SAYS(report.order, ", 0.");
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
  tetstream_options_destroy(options);
}

static void messages_have_points_and_the_locale_stays(void) {
  char text[16];
  tetstream_options* options = NULL;
  tetstream_reader *a = NULL, *b = NULL;
  tetstream_comparison* comparison = NULL;
  CHECK_EQUAL(tetstream_options_create(&options), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_options_parse(options, "cut", "x=1030.5"), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_comparison_create(options, &comparison), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_open_file(BRACKET, NULL, &a), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_reader_open_file(BRACKET, NULL, &b), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_comparison_read(comparison, a, b, NULL, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_SAYS(tetstream_comparison_message(comparison), "x = 1030.5 ");
  snprintf(text, sizeof text, "%.2f", 0.25);
  CHECK(strcmp(text, "0,25") == 0);
  tetstream_comparison_destroy(comparison);
  tetstream_reader_destroy(a);
  tetstream_reader_destroy(b);
  tetstream_options_destroy(options);
}

int main(void) {
  if (!comma_locale()) {
    printf("not run: no locale with a decimal comma is here, and none can be made\n");
    return NOT_RUN;
  }
  RUN_CASE(the_report_has_points);
  RUN_CASE(messages_have_points_and_the_locale_stays);
  return check_end();
}
