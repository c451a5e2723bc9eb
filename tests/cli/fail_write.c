/* Loaded before the C library: write number FAIL_WRITE of the process, and every later one to a
 * file, finds no space left. Standard output and error are not counted. Renaming number FAIL_RENAME
 * is not permitted. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static int refuses(int fd) {
  static long left = -1;
  if (fd < 3) return 0;
  if (left < 0) {
    const char* number = getenv("FAIL_WRITE");
    left = number ? atol(number) : 0x7fffffff;
  }
  if (left > 0) --left;
  if (left > 0) return 0;
  errno = ENOSPC;
  return 1;
}

ssize_t write(int fd, const void* data, size_t size) {
  ssize_t (*next)(int, const void*, size_t);
  *(void**)&next = dlsym(RTLD_NEXT, "write");
  return refuses(fd) ? -1 : next(fd, data, size);
}

ssize_t pwrite(int fd, const void* data, size_t size, off_t offset) {
  ssize_t (*next)(int, const void*, size_t, off_t);
  *(void**)&next = dlsym(RTLD_NEXT, "pwrite");
  return refuses(fd) ? -1 : next(fd, data, size, offset);
}

ssize_t pwrite64(int fd, const void* data, size_t size, off64_t offset) {
  return pwrite(fd, data, size, (off_t)offset);
}

int rename(const char* from, const char* to) {
  static long calls = 0;
  const char* number = getenv("FAIL_RENAME");
  int (*next)(const char*, const char*);
  *(void**)&next = dlsym(RTLD_NEXT, "rename");
  if (!number || ++calls != atol(number)) return next(from, to);
  errno = EPERM;
  return -1;
}
