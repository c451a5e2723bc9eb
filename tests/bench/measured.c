/* measured REPORT PROGRAM [ARGUMENT...]: runs a program and writes to the file REPORT, as one JSON
 * object, its wall and processor seconds, its peak resident bytes and its exit code, which is also
 * this program's. A process of its own and small, because a child's peak counts what its parent
 * held when it was forked. */
#define _GNU_SOURCE
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static double seconds(struct timeval t) {
  return (double)t.tv_sec + 1e-6 * (double)t.tv_usec;
}

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int report(const char* path, double wall, const struct rusage* use, int code) {
  FILE* file = fopen(path, "w");
  if (!file) return -1;
  fprintf(file, "{\"wall\": %.6f, \"user\": %.6f, \"system\": %.6f, \"peak_bytes\": %lld, ", wall,
          seconds(use->ru_utime), seconds(use->ru_stime), 1024LL * use->ru_maxrss);
  fprintf(file, "\"exit\": %d}\n", code);
  return fclose(file);
}

int main(int argc, char** argv) {
  if (argc < 3) {
    fputs("usage: measured REPORT PROGRAM [ARGUMENT...]\n", stderr);
    return 125;
  }
  const double begin = now();
  const pid_t child = fork();
  if (child < 0) return perror("measured"), 125;
  if (child == 0) {
    execvp(argv[2], argv + 2);
    perror(argv[2]);
    _exit(127);
  }
  int status;
  struct rusage use;
  if (wait4(child, &status, 0, &use) != child) return perror("measured"), 125;
  const double wall = now() - begin;
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (report(argv[1], wall, &use, code) != 0) return perror(argv[1]), 125;
  return code;
}
