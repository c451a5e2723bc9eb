/* calibrate: how fast this machine's memory is at the moment, as one JSON object: nanoseconds of a
 * load that waits for the one before, in working sets of several sizes, and GB/s of memcpy. Figures
 * of speed taken at different times can only be compared beside these. Takes about half a second.
 */
#define _GNU_SOURCE
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define LINE 64u      /* bytes of a cache line: one load from each */
#define ROUNDS 5      /* odd; the median counts */
#define COPY_MB 64u   /* far more than a cache holds */
#define LOADS 200000u /* of one round: 1 ms in a cache, 20 ms outside */

/* Of the processor: while others have it the memory is not waited for. */
static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int ascending(const void* a, const void* b) {
  const double x = *(const double*)a, y = *(const double*)b;
  return (x > y) - (x < y);
}

static double median(double* values) {
  qsort(values, ROUNDS, sizeof *values, ascending);
  return values[ROUNDS / 2];
}

/* Xorshift: the same cycles in every run. */
static uint32_t below(uint32_t end) {
  static uint64_t state = 88172645463325252u;
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return (uint32_t)((state >> 32) * end >> 32);
}

/* Sattolo's shuffle: one cycle through all lines, in random order. Each line holds the address of
 * the next one at its start. */
static int link_lines(char* block, uint32_t lines) {
  uint32_t* next = malloc(lines * sizeof *next);
  if (!next) return -1;
  for (uint32_t i = 0; i < lines; ++i) next[i] = i;
  for (uint32_t i = lines - 1; i > 0; --i) {
    const uint32_t other = below(i), kept = next[i];
    next[i] = next[other];
    next[other] = kept;
  }
  for (uint32_t i = 0; i < lines; ++i)
    *(void**)(block + (size_t)i * LINE) = block + (size_t)next[i] * LINE;
  free(next);
  return 0;
}

static void* follow(void* at, uint32_t loads) {
  for (; loads > 0; --loads) at = *(void**)at;
  return at;
}

/* Negative: no memory. */
static double load_nanoseconds(char* block, size_t bytes) {
  const uint32_t lines = (uint32_t)(bytes / LINE);
  if (link_lines(block, lines) != 0) return -1;
  void* at = follow(block, lines < LOADS ? lines : LOADS); /* into the caches, if they hold it */
  double times[ROUNDS];
  for (int i = 0; i < ROUNDS; ++i) {
    const double begin = now();
    at = follow(at, LOADS);
    times[i] = (now() - begin) / LOADS;
  }
  /* The last address is used, or the loads would not have to be done. */
  return at ? 1e9 * median(times) : -1;
}

static double copy_rate(char* from, char* to) {
  const size_t bytes = (size_t)COPY_MB << 20;
  double times[ROUNDS];
  memset(from, 1, bytes);
  memset(to, 2, bytes);
  for (int i = 0; i < ROUNDS; ++i) {
    from[i] = (char)i;
    const double begin = now();
    memcpy(to, from, bytes);
    times[i] = now() - begin;
  }
  return 1e-9 * (double)bytes / median(times);
}

int main(void) {
  static const unsigned kilobytes[] = {256, 1024, 4096, 65536};
  void *block, *other;
  if (posix_memalign(&block, 4096, (size_t)COPY_MB << 20) != 0 ||
      posix_memalign(&other, 4096, (size_t)COPY_MB << 20) != 0)
    return fputs("calibrate: no memory\n", stderr), 1;
  printf("{\"load_ns\": {");
  for (int i = 0; i < 4; ++i) {
    const double time = load_nanoseconds(block, (size_t)kilobytes[i] << 10);
    if (time < 0) return fputs("calibrate: no memory\n", stderr), 1;
    printf("%s\"%u\": %.2f", i ? ", " : "", kilobytes[i], time);
  }
  printf("}, \"memcpy_gb_per_s\": %.2f}\n", copy_rate(block, other));
  free(block);
  free(other);
  return 0;
}
