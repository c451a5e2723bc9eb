/* open_file FILE...: opens each with tetstream_reader_open_file, which reads text and other indexed
 * files whole, into temporary files; prints processor seconds and wall seconds. */
#include <stdio.h>
#include <sys/resource.h>
#include <tetstream/tetstream.h>
#include <time.h>

static double processor(void) {
  struct rusage u;
  getrusage(RUSAGE_SELF, &u);
  return (double)(u.ru_utime.tv_sec + u.ru_stime.tv_sec) +
         1e-6 * (double)(u.ru_utime.tv_usec + u.ru_stime.tv_usec);
}

static double wall(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

int main(int count, char** words) {
  for (int i = 1; i < count; ++i) {
    const double processor_before = processor(), wall_before = wall();
    tetstream_reader* reader = NULL;
    const tetstream_status status = tetstream_reader_open_file(words[i], NULL, &reader);
    const double processor_after = processor(), wall_after = wall();
    if (status < 0) fprintf(stderr, "%s\n", tetstream_reader_message(reader));
    tetstream_reader_destroy(reader);
    if (status < 0) return 1;
    printf("%.4f %.4f\n", processor_after - processor_before, wall_after - wall_before);
  }
  return 0;
}
