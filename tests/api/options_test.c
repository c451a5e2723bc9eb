/* Options: the table, the values, what is refused. */
#include <float.h>
#include <stdlib.h>

#include "check.h"
#include "tetstream/tetstream.h"

static tetstream_options* create(void) {
  tetstream_options* options = NULL;
  CHECK_EQUAL(tetstream_options_create(&options), TETSTREAM_OK);
  return options;
}

static tetstream_option_info row(int32_t index) {
  tetstream_option_info info = {0};
  info.struct_size = sizeof info;
  CHECK_EQUAL(tetstream_option_at(index, &info), TETSTREAM_OK);
  return info;
}

static void table_lists_every_option_once(void) {
  CHECK(tetstream_option_count() >= 14);
  for (int32_t i = 0; i < tetstream_option_count(); ++i) {
    const tetstream_option_info info = row(i);
    CHECK(info.name && info.name[0] && info.text && info.text[0] && info.default_text);
    CHECK(strchr(info.text, '\n') == NULL);
    CHECK(info.type >= TETSTREAM_OPTION_IS_INT64 && info.type <= TETSTREAM_OPTION_IS_TEXT);
    CHECK(info.minimum <= info.maximum);
    for (int32_t j = 0; j < i; ++j) {
      CHECK(row(j).id < info.id);
      CHECK(strcmp(row(j).name, info.name) != 0);
    }
  }
  tetstream_option_info info = {0};
  info.struct_size = sizeof info;
  CHECK_EQUAL(tetstream_option_at(-1, &info), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_option_at(tetstream_option_count(), &info), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_option_at(0, NULL), TETSTREAM_BAD_ARGUMENT);
}

static int32_t scope_of(int32_t id) {
  for (int32_t i = 0; i < tetstream_option_count(); ++i)
    if (row(i).id == id) return row(i).scope;
  return 0;
}

static void the_table_tells_where_options_count(void) {
  const int32_t all = TETSTREAM_SCOPE_READ + TETSTREAM_SCOPE_ORDER + TETSTREAM_SCOPE_SIMPLIFY +
                      TETSTREAM_SCOPE_COMPARE;
  CHECK_EQUAL(scope_of(TETSTREAM_OPTION_RATIO), TETSTREAM_SCOPE_SIMPLIFY);
  CHECK_EQUAL(scope_of(TETSTREAM_OPTION_SEED), TETSTREAM_SCOPE_SIMPLIFY + TETSTREAM_SCOPE_COMPARE);
  CHECK_EQUAL(scope_of(TETSTREAM_OPTION_BOX), TETSTREAM_SCOPE_COMPARE);
  CHECK_EQUAL(scope_of(TETSTREAM_OPTION_MEMORY), all);
  CHECK_EQUAL(scope_of(TETSTREAM_OPTION_ORDER), TETSTREAM_SCOPE_ORDER + TETSTREAM_SCOPE_SIMPLIFY);
  for (int32_t id = TETSTREAM_OPTION_SPLIT; id <= TETSTREAM_OPTION_CELLS_TO_POINTS; ++id)
    CHECK_EQUAL(scope_of(id), TETSTREAM_SCOPE_READ);
  for (int32_t i = 0; i < tetstream_option_count(); ++i)
    CHECK(row(i).scope > 0 && row(i).scope <= all);
}

static void published_numbers_have_their_names_and_types(void) {
  static const struct {
    int32_t id, type;
    const char* name;
  } wanted[] = {
      {TETSTREAM_OPTION_RATIO, TETSTREAM_OPTION_IS_DOUBLE, "ratio"},
      {TETSTREAM_OPTION_CELLS, TETSTREAM_OPTION_IS_INT64, "cells"},
      {TETSTREAM_OPTION_ERROR, TETSTREAM_OPTION_IS_DOUBLE, "error"},
      {TETSTREAM_OPTION_BOUNDARY_WEIGHT, TETSTREAM_OPTION_IS_DOUBLE, "boundary-weight"},
      {TETSTREAM_OPTION_FIELD_RANGE, TETSTREAM_OPTION_IS_TEXT, "field-range"},
      {TETSTREAM_OPTION_BALANCE, TETSTREAM_OPTION_IS_TEXT, "balance"},
      {TETSTREAM_OPTION_FEATURE_ANGLE, TETSTREAM_OPTION_IS_DOUBLE, "feature-angle"},
      {TETSTREAM_OPTION_REGIONS, TETSTREAM_OPTION_IS_TEXT, "regions"},
      {TETSTREAM_OPTION_MODE, TETSTREAM_OPTION_IS_TEXT, "mode"},
      {TETSTREAM_OPTION_SEED, TETSTREAM_OPTION_IS_INT64, "seed"},
      {TETSTREAM_OPTION_QUADRIC, TETSTREAM_OPTION_IS_TEXT, "quadric"},
      {TETSTREAM_OPTION_CANDIDATES, TETSTREAM_OPTION_IS_INT64, "candidates"},
      {TETSTREAM_OPTION_PILOT, TETSTREAM_OPTION_IS_TEXT, "pilot"},
      {TETSTREAM_OPTION_RELEASE, TETSTREAM_OPTION_IS_TEXT, "release"},
      {TETSTREAM_OPTION_EFFORT, TETSTREAM_OPTION_IS_TEXT, "effort"},
      {TETSTREAM_OPTION_SHAPE, TETSTREAM_OPTION_IS_TEXT, "shape"},
      {TETSTREAM_OPTION_BOUNDARY_SAMPLES, TETSTREAM_OPTION_IS_INT64, "boundary-samples"},
      {TETSTREAM_OPTION_WINDOW, TETSTREAM_OPTION_IS_INT64, "window"},
      {TETSTREAM_OPTION_MEMORY, TETSTREAM_OPTION_IS_INT64, "memory"},
      {TETSTREAM_OPTION_TMPDIR, TETSTREAM_OPTION_IS_TEXT, "tmpdir"},
      {TETSTREAM_OPTION_THREADS, TETSTREAM_OPTION_IS_INT64, "threads"},
      {TETSTREAM_OPTION_SPLIT, TETSTREAM_OPTION_IS_TEXT, "split"},
      {TETSTREAM_OPTION_JOIN_POINTS, TETSTREAM_OPTION_IS_TEXT, "join-points"},
      {TETSTREAM_OPTION_CELLS_TO_POINTS, TETSTREAM_OPTION_IS_TEXT, "cells-to-points"},
      {TETSTREAM_OPTION_AXIS, TETSTREAM_OPTION_IS_TEXT, "axis"},
  };
  for (size_t i = 0; i < sizeof wanted / sizeof wanted[0]; ++i) {
    int found = 0;
    for (int32_t j = 0; j < tetstream_option_count(); ++j) {
      const tetstream_option_info info = row(j);
      if (info.id != wanted[i].id) continue;
      found = 1;
      CHECK(strcmp(info.name, wanted[i].name) == 0);
      CHECK_EQUAL(info.type, wanted[i].type);
    }
    CHECK(found);
  }
}

static void defaults_are_those_of_the_table(void) {
  tetstream_options* options = create();
  for (int32_t i = 0; i < tetstream_option_count(); ++i) {
    const tetstream_option_info info = row(i);
    int64_t integer = -77;
    double real = -77;
    const char* text = NULL;
    if (info.type == TETSTREAM_OPTION_IS_INT64) {
      CHECK_EQUAL(tetstream_options_get_int64(options, info.id, &integer), TETSTREAM_OK);
      CHECK_EQUAL(integer, atoll(info.default_text));
    } else if (info.type == TETSTREAM_OPTION_IS_DOUBLE) {
      CHECK_EQUAL(tetstream_options_get_double(options, info.id, &real), TETSTREAM_OK);
      CHECK(real == atof(info.default_text));
    } else {
      CHECK_EQUAL(tetstream_options_get_text(options, info.id, &text), TETSTREAM_OK);
      CHECK(text && strcmp(text, info.default_text) == 0);
    }
    CHECK_EQUAL(tetstream_options_parse(options, info.name, info.default_text), TETSTREAM_OK);
  }
  tetstream_options_destroy(options);
}

/* The bound itself is taken, the next number is not where there is one. */
static void check_bound(tetstream_options* options, const tetstream_option_info* info,
                        int64_t bound, int64_t last, int64_t step) {
  int64_t value = -77;
  CHECK_EQUAL(tetstream_options_set_int64(options, info->id, bound), TETSTREAM_OK);
  if (bound != last)
    CHECK_EQUAL(tetstream_options_set_int64(options, info->id, bound + step),
                TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_get_int64(options, info->id, &value), TETSTREAM_OK);
  CHECK_EQUAL(value, bound);
}

static void limits_are_included_and_what_lies_outside_is_refused(void) {
  tetstream_options* options = create();
  for (int32_t i = 0; i < tetstream_option_count(); ++i) {
    const tetstream_option_info info = row(i);
    if (info.type == TETSTREAM_OPTION_IS_DOUBLE) {
      CHECK_EQUAL(tetstream_options_set_double(options, info.id, info.minimum), TETSTREAM_OK);
      CHECK_EQUAL(tetstream_options_set_double(options, info.id, info.maximum), TETSTREAM_OK);
      CHECK_EQUAL(tetstream_options_set_double(options, info.id, info.maximum * 1.001),
                  TETSTREAM_BAD_ARGUMENT);
      CHECK_EQUAL(tetstream_options_set_double(options, info.id, -1), TETSTREAM_BAD_ARGUMENT);
      CHECK_SAYS(tetstream_options_message(options), info.name);
      double value = 0;
      CHECK_EQUAL(tetstream_options_get_double(options, info.id, &value), TETSTREAM_OK);
      CHECK(value == info.maximum);
    } else if (info.type == TETSTREAM_OPTION_IS_INT64) {
      check_bound(options, &info, info.lowest, INT64_MIN, -1);
      check_bound(options, &info, info.highest, INT64_MAX, 1);
    }
    const int is_integer = info.type == TETSTREAM_OPTION_IS_INT64;
    CHECK(info.lowest == 0 || is_integer);
    CHECK(is_integer ? info.lowest < info.highest : info.highest == 0);
    CHECK(!is_integer ||
          (info.minimum == (double)info.lowest && info.maximum == (double)info.highest));
  }
  CHECK_EQUAL(tetstream_options_parse(options, "ratio", "nan"), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_parse(options, "error", "nan"), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_parse(options, "boundary-weight", "inf"), TETSTREAM_BAD_ARGUMENT);
  tetstream_options_destroy(options);
}

static void choices_are_the_only_values(void) {
  tetstream_options* options = create();
  for (int32_t i = 0; i < tetstream_option_count(); ++i) {
    const tetstream_option_info info = row(i);
    if (info.type != TETSTREAM_OPTION_IS_TEXT || !info.choices) continue;
    char list[256];
    CHECK(strlen(info.choices) < sizeof list);
    strcpy(list, info.choices);
    for (char* word = strtok(list, " "); word; word = strtok(NULL, " ")) {
      const char* value = NULL;
      CHECK_EQUAL(tetstream_options_set_text(options, info.id, word), TETSTREAM_OK);
      CHECK_EQUAL(tetstream_options_get_text(options, info.id, &value), TETSTREAM_OK);
      CHECK(value && strcmp(value, word) == 0);
    }
    CHECK_EQUAL(tetstream_options_set_text(options, info.id, ""), TETSTREAM_BAD_ARGUMENT);
    CHECK_EQUAL(tetstream_options_set_text(options, info.id, info.choices),
                strchr(info.choices, ' ') ? TETSTREAM_BAD_ARGUMENT : TETSTREAM_OK);
    CHECK_EQUAL(tetstream_options_parse(options, info.name, "quux"), TETSTREAM_BAD_ARGUMENT);
    CHECK_SAYS(tetstream_options_message(options), "quux");
  }
  tetstream_options_destroy(options);
}

static int64_t parsed(tetstream_options* options, const char* name, int32_t id, const char* text) {
  int64_t value = -77;
  CHECK_EQUAL(tetstream_options_parse(options, name, text), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_options_get_int64(options, id, &value), TETSTREAM_OK);
  return value;
}

static void suffixes_and_exponents_are_understood(void) {
  tetstream_options* options = create();
  const int32_t cells = TETSTREAM_OPTION_CELLS, memory = TETSTREAM_OPTION_MEMORY;
  CHECK_EQUAL(parsed(options, "cells", cells, "12"), 12);
  CHECK_EQUAL(parsed(options, "cells", cells, "12k"), 12000);
  CHECK_EQUAL(parsed(options, "cells", cells, "3M"), 3000000);
  CHECK_EQUAL(parsed(options, "cells", cells, "2G"), 2000000000);
  CHECK_EQUAL(parsed(options, "cells", cells, "1.5M"), 1500000);
  CHECK_EQUAL(parsed(options, "cells", cells, "1e9"), 1000000000);
  CHECK_EQUAL(parsed(options, "cells", cells, "9223372036854775807"), INT64_MAX);
  CHECK_EQUAL(parsed(options, "memory", memory, "2G"), INT64_C(2) << 30);
  CHECK_EQUAL(parsed(options, "memory", memory, "20M"), 20 << 20);
  CHECK_EQUAL(parsed(options, "memory", memory, "0.5k"), 512);
  CHECK_EQUAL(parsed(options, "memory", memory, "0.5GB"), 512 << 20);
  CHECK_EQUAL(parsed(options, "memory", memory, "64MiB"), 64 << 20);
  CHECK_EQUAL(parsed(options, "memory", memory, "4KB"), 4096);
  CHECK_EQUAL(parsed(options, "memory", memory, "1e6"), 1000000);
  CHECK_EQUAL(parsed(options, "seed", TETSTREAM_OPTION_SEED, "-9223372036854775808"), INT64_MIN);
  tetstream_options_destroy(options);
}

static void texts_that_are_no_values_are_refused_and_change_nothing(void) {
  static const char* const bad[] = {"",
                                    "k",
                                    "1.5",
                                    "12kk",
                                    "12kB",
                                    "12K",
                                    "0x10",
                                    " 12",
                                    "12 ",
                                    "1e30",
                                    "9223372036854775808",
                                    "-1",
                                    "10000000000G",
                                    "+1",
                                    "1,5k",
                                    "1.0001k",
                                    "nan",
                                    "inf"};
  tetstream_options* options = create();
  for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
    int64_t value = -77;
    CHECK_EQUAL(tetstream_options_set_int64(options, TETSTREAM_OPTION_CELLS, 5), TETSTREAM_OK);
    if (!CHECK_EQUAL(tetstream_options_parse(options, "cells", bad[i]), TETSTREAM_BAD_ARGUMENT))
      printf("    \"%s\" was taken\n", bad[i]);
    CHECK_SAYS(tetstream_options_message(options), "\"cells\"");
    CHECK_EQUAL(tetstream_options_get_int64(options, TETSTREAM_OPTION_CELLS, &value), TETSTREAM_OK);
    CHECK_EQUAL(value, 5);
  }
  CHECK_EQUAL(tetstream_options_parse(options, "ratio", "0.25x"), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_parse(options, "memory", "64 MB"), TETSTREAM_BAD_ARGUMENT);
  CHECK_SAYS(tetstream_options_message(options), "is no number of bytes, such as 64M");
  CHECK_EQUAL(tetstream_options_parse(options, "no-such", "1"), TETSTREAM_BAD_ARGUMENT);
  CHECK_SAYS(tetstream_options_message(options), "no-such");
  tetstream_options_destroy(options);
}

static void other_types_and_unknown_numbers_are_refused(void) {
  tetstream_options* options = create();
  int64_t integer = 0;
  double real = 0;
  const char* text = NULL;
  CHECK_EQUAL(tetstream_options_set_int64(options, TETSTREAM_OPTION_RATIO, 1),
              TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_set_double(options, TETSTREAM_OPTION_CELLS, 1),
              TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_set_text(options, TETSTREAM_OPTION_CELLS, "1"),
              TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_get_int64(options, TETSTREAM_OPTION_RATIO, &integer),
              TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_get_double(options, TETSTREAM_OPTION_AXIS, &real),
              TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_get_text(options, TETSTREAM_OPTION_SEED, &text),
              TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_set_int64(options, 99999, 1), TETSTREAM_BAD_ARGUMENT);
  CHECK_SAYS(tetstream_options_message(options), "99999");
  CHECK_SAYS(tetstream_options_message(options), "tetstream_options_set_int64");
  tetstream_options_destroy(options);
}

static void texts_are_copied(void) {
  tetstream_options* options = create();
  char folder[] = "/some/folder";
  const char* value = NULL;
  CHECK_EQUAL(tetstream_options_set_text(options, TETSTREAM_OPTION_TMPDIR, folder), TETSTREAM_OK);
  memset(folder, 'x', sizeof folder - 1);
  CHECK_EQUAL(tetstream_options_get_text(options, TETSTREAM_OPTION_TMPDIR, &value), TETSTREAM_OK);
  CHECK(value && strcmp(value, "/some/folder") == 0);
  tetstream_options_destroy(options);
}

static void fields_take_finite_weights(void) {
  tetstream_options* options = create();
  char name[300];
  memset(name, 'n', sizeof name);
  name[256] = 0;
  CHECK_EQUAL(tetstream_options_add_field(options, "density", 1), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_options_add_field(options, "density", 0), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_options_add_field(options, "density", -1), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_add_field(options, "density", 1e300 * 1e300),
              TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_add_field(options, "", 1), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_add_field(options, name, 1), TETSTREAM_BAD_ARGUMENT);
  name[255] = 0;
  CHECK_EQUAL(tetstream_options_add_field(options, name, 1), TETSTREAM_OK);
  tetstream_options_destroy(options);
}

static void null_is_refused_everywhere(void) {
  tetstream_options* options = create();
  int64_t integer = 0;
  double real = 0;
  const char* text = NULL;
  const int32_t seed = TETSTREAM_OPTION_SEED;
  CHECK_EQUAL(tetstream_options_create(NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_set_int64(NULL, seed, 1), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_set_double(NULL, seed, 1), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_set_text(NULL, seed, "1"), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_set_text(options, TETSTREAM_OPTION_TMPDIR, NULL),
              TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_parse(NULL, "seed", "1"), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_parse(options, NULL, "1"), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_parse(options, "seed", NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_get_int64(NULL, seed, &integer), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_get_int64(options, seed, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_get_double(NULL, seed, &real), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_get_double(options, seed, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_get_text(NULL, seed, &text), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_get_text(options, seed, NULL), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_add_field(NULL, "f", 1), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(tetstream_options_add_field(options, NULL, 1), TETSTREAM_BAD_ARGUMENT);
  CHECK_SAYS(tetstream_options_message(options), "name is NULL");
  CHECK(tetstream_options_message(NULL) != NULL);
  tetstream_options_destroy(NULL);
  tetstream_options_destroy(options);
}

/* A caller of an older version brings a shorter struct, one of a newer version a longer one. */
static void struct_sizes_are_respected(void) {
  struct {
    tetstream_option_info info;
    unsigned char more[32];
  } later;
  memset(&later, 0x5a, sizeof later);
  later.info.struct_size = sizeof later;
  CHECK_EQUAL(tetstream_option_at(0, &later.info), TETSTREAM_OK);
  CHECK_EQUAL(later.info.struct_size, sizeof later);
  CHECK(strcmp(later.info.name, "ratio") == 0);
  for (size_t i = 0; i < sizeof later.more; ++i) CHECK_EQUAL(later.more[i], 0x5a);

  memset(&later, 0x5a, sizeof later);
  later.info.struct_size = offsetof(tetstream_option_info, scope);
  CHECK_EQUAL(tetstream_option_at(0, &later.info), TETSTREAM_OK);
  CHECK_EQUAL(later.info.type, TETSTREAM_OPTION_IS_DOUBLE);
  CHECK_EQUAL(later.info.scope, 0x5a5a5a5a);

  memset(&later, 0x5a, sizeof later);
  later.info.struct_size = offsetof(tetstream_option_info, choices);
  CHECK_EQUAL(tetstream_option_at(0, &later.info), TETSTREAM_BAD_ARGUMENT);
  CHECK_EQUAL(later.info.id, 0x5a5a5a5a);
  later.info.struct_size = 0;
  CHECK_EQUAL(tetstream_option_at(0, &later.info), TETSTREAM_BAD_ARGUMENT);
}

int main(void) {
  RUN_CASE(table_lists_every_option_once);
  RUN_CASE(the_table_tells_where_options_count);
  RUN_CASE(published_numbers_have_their_names_and_types);
  RUN_CASE(defaults_are_those_of_the_table);
  RUN_CASE(limits_are_included_and_what_lies_outside_is_refused);
  RUN_CASE(choices_are_the_only_values);
  RUN_CASE(suffixes_and_exponents_are_understood);
  RUN_CASE(texts_that_are_no_values_are_refused_and_change_nothing);
  RUN_CASE(other_types_and_unknown_numbers_are_refused);
  RUN_CASE(texts_are_copied);
  RUN_CASE(fields_take_finite_weights);
  RUN_CASE(null_is_refused_everywhere);
  RUN_CASE(struct_sizes_are_respected);
  return check_end();
}
