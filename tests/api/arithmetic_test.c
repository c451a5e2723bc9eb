/* Whatever the caller's floating-point arithmetic is like, the library computes the same and gives
 * it back: solvers are built with traps (gfortran -ffpe-trap), to flush to zero (-Ofast), or round
 * otherwise. */
#define _GNU_SOURCE
#include <fenv.h>
#include <stdlib.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "rig.h"

static hostile_mesh* mesh;
static int wanted_traps, wanted_rounding;

static void have_it_otherwise(void) {
#if defined(__GLIBC__)
  feclearexcept(FE_ALL_EXCEPT);
  feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
  wanted_traps = fegetexcept(); /* 0 where it cannot be had, as under Valgrind */
#endif
  fesetround(FE_UPWARD);
  wanted_rounding = fegetround();
#if defined(__SSE2__)
  _mm_setcsr(_mm_getcsr() | 0x8040); /* denormals are 0 */
#endif
}

static void check_that_it_is_otherwise(unsigned int state) {
#if defined(__GLIBC__)
  CHECK_EQUAL(fegetexcept(), wanted_traps);
#endif
  CHECK_EQUAL(fegetround(), wanted_rounding);
  CHECK_EQUAL(fetestexcept(FE_ALL_EXCEPT), 0);
#if defined(__SSE2__)
  CHECK_EQUAL(_mm_getcsr(), state);
#else
  (void)state;
#endif
}

/* The bytes of a simplification. */
static size_t simplified(const char* shape, int64_t threads, void** bytes) {
  tetstream_options* options = NULL;
  tetstream_writer* writer = NULL;
  tetstream_simplifier* simplifier = NULL;
  const void* data = NULL;
  size_t size = 0;
  tetstream_reader* reader = arrays_of(mesh);
  CHECK_EQUAL(tetstream_options_create(&options), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_options_parse(options, "ratio", "0.2"), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_options_parse(options, "shape", shape), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_options_set_int64(options, TETSTREAM_OPTION_THREADS, threads),
              TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_create_memory("vtk", &writer), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_create(options, writer, &simplifier), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_simplifier_run(simplifier, reader), TETSTREAM_OK);
  CHECK_EQUAL(tetstream_writer_get_memory(writer, &data, &size), TETSTREAM_OK);
  *bytes = malloc(size);
  if (CHECK(*bytes != NULL)) memcpy(*bytes, data, size);
  tetstream_simplifier_destroy(simplifier);
  tetstream_writer_destroy(writer);
  tetstream_reader_destroy(reader);
  tetstream_options_destroy(options);
  return size;
}

static void results_are_the_same_and_the_callers_state_stays(void) {
  static const char* const shapes[] = {"field", "solver"};
  for (size_t s = 0; s < 2; ++s)
    for (int64_t threads = 1; threads <= 3; threads += 2) {
      void *usual = NULL, *otherwise = NULL;
      fenv_t before;
      unsigned int state = 0;
      const size_t size = simplified(shapes[s], threads, &usual);
      fegetenv(&before);
      have_it_otherwise();
#if defined(__SSE2__)
      state = _mm_getcsr();
#endif
      const size_t again = simplified(shapes[s], threads, &otherwise);
      check_that_it_is_otherwise(state);
      fesetenv(&before);
      CHECK_EQUAL(again, size);
      CHECK(usual && otherwise && memcmp(usual, otherwise, size) == 0);
      free(usual);
      free(otherwise);
    }
}

int main(void) {
  mesh = hostile_mesh_create(8, 9, 10);
  CHECK(mesh != NULL);
  RUN_CASE(results_are_the_same_and_the_callers_state_stays);
  hostile_mesh_destroy(mesh);
  return check_end();
}
