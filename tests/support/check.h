/* tests/support: checks for programs in C: counts them, prints the ones that fail, goes on. */
#ifndef TETSTREAM_TEST_CHECK_H
#define TETSTREAM_TEST_CHECK_H

#include <stdio.h>
#include <string.h>

static int check_count, check_failures;

static inline int check_that(int holds, const char* what, const char* file, int line) {
  ++check_count;
  if (!holds) {
    ++check_failures;
    printf("%s:%d: does not hold: %s\n", file, line, what);
  }
  return holds;
}

static inline int check_equal(long long is, long long wanted, const char* what, const char* file,
                              int line) {
  const int holds = check_that(is == wanted, what, file, line);
  if (!holds) printf("    is %lld, wanted %lld\n", is, wanted);
  return holds;
}

/* Whether `part` stands in `text`. */
static inline int check_says(const char* text, const char* part, const char* what, const char* file,
                             int line) {
  const int holds = check_that(text != NULL && strstr(text, part) != NULL, what, file, line);
  if (!holds) printf("    is \"%s\", wanted \"%s\" in it\n", text ? text : "(null)", part);
  return holds;
}

#define CHECK(condition) check_that((condition) != 0, #condition, __FILE__, __LINE__)
#define CHECK_EQUAL(is, wanted) \
  check_equal((long long)(is), (long long)(wanted), #is " == " #wanted, __FILE__, __LINE__)
#define CHECK_SAYS(text, part) check_says(text, part, #text " says " #part, __FILE__, __LINE__)

/* Runs a case, a function whose name is a sentence. */
#define RUN_CASE(name)                                                  \
  do {                                                                  \
    const int failures_before = check_failures;                         \
    name();                                                             \
    if (check_failures > failures_before) printf("FAILED %s\n", #name); \
  } while (0)

/* What main returns. */
static inline int check_end(void) {
  printf("%d checks, %d failed\n", check_count, check_failures);
  return check_failures ? 1 : 0;
}

#endif
