/* Loaded before the C library: makes calls of a process fail. FAULT is "CALL NUMBER WHAT", as in
 * "write 3 28": from the third write on, errno 28. CALL is read, write, open, close, sync, rename
 * or memory; only files count, not the standard streams, and of those only what is opened to be
 * read or written, not the system's. WHAT is an errno, or
 *   only:ERRNO  that call fails, later ones do not
 *   short       that call and later ones transfer one byte, every other one is interrupted instead
 *   shrink      before that call, the file FAULT_FILE loses its second half
 *   grow        before that call, the file FAULT_FILE gets as many bytes again
 *   kill        the process is killed
 * Of memory only what has FAULT_LEAST bytes and more counts, where that is given.
 * Without FAULT, the calls are counted: at the end a line "CALL NUMBER" for each goes to
 * FAULT_COUNTS. What is done before main begins neither counts nor fails. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

enum { READ, WRITE, OPEN, CLOSE, SYNC, RENAME, MEMORY, CALLS };
static const char* const kNames[CALLS] = {"read", "write",  "open",  "close",
                                          "sync", "rename", "memory"};

static int begun, ready, chosen = -1, only, error, is_short, is_shrink, is_grow, is_kill;
static long number, counts[CALLS];
static size_t least;

/* No memory is asked for here. */
static void prepare(void) {
  const char *fault = getenv("FAULT"), *bytes = getenv("FAULT_LEAST");
  ready = 1;
  if (bytes) least = strtoul(bytes, NULL, 10);
  if (!fault) return;
  for (int call = 0; call < CALLS; ++call) {
    const size_t length = strlen(kNames[call]);
    if (strncmp(fault, kNames[call], length) != 0 || fault[length] != ' ') continue;
    char* what;
    chosen = call;
    number = strtol(fault + length, &what, 10);
    ++what;
    only = strncmp(what, "only:", 5) == 0;
    error = atoi(only ? what + 5 : what);
    is_short = strcmp(what, "short") == 0;
    is_shrink = strcmp(what, "shrink") == 0;
    is_grow = strcmp(what, "grow") == 0;
    is_kill = strcmp(what, "kill") == 0;
  }
}

static void changeFile(void) {
  struct stat info;
  const char* path = getenv("FAULT_FILE");
  if (path && stat(path, &info) == 0 &&
      truncate(path, is_shrink ? info.st_size / 2 : info.st_size * 2) != 0)
    _exit(99);
}

/* Whether this call fails, with errno set; or transfers little: -1. */
static int fails(int call) {
  if (!begun) return 0;
  if (!ready) prepare();
  const long count = __atomic_add_fetch(&counts[call], 1, __ATOMIC_RELAXED);
  if (call != chosen || count < number) return 0;
  if (is_kill) kill(getpid(), SIGKILL);
  if (is_shrink || is_grow) {
    if (count == number) changeFile();
    return 0;
  }
  if (is_short) {
    errno = EINTR;
    return count % 2 ? 1 : -1;
  }
  if (only && count > number) return 0;
  errno = error;
  return 1;
}

#define NEXT(function)               \
  static __typeof__(&function) next; \
  if (!next) *(void**)&next = dlsym(RTLD_NEXT, #function)

/* How a transfer goes on: RUN with `size`, which may have become 1. */
#define TRANSFER(call, run)               \
  if (fd > 2) {                           \
    const int failed = fails(call);       \
    if (failed > 0) return -1;            \
    if (failed < 0 && size > 1) size = 1; \
  }                                       \
  return run

ssize_t read(int fd, void* data, size_t size) {
  NEXT(read);
  TRANSFER(READ, next(fd, data, size));
}
ssize_t pread(int fd, void* data, size_t size, off_t offset) {
  NEXT(pread);
  TRANSFER(READ, next(fd, data, size, offset));
}
ssize_t pread64(int fd, void* data, size_t size, off64_t offset) {
  NEXT(pread64);
  TRANSFER(READ, next(fd, data, size, offset));
}
ssize_t write(int fd, const void* data, size_t size) {
  NEXT(write);
  TRANSFER(WRITE, next(fd, data, size));
}
ssize_t pwrite(int fd, const void* data, size_t size, off_t offset) {
  NEXT(pwrite);
  TRANSFER(WRITE, next(fd, data, size, offset));
}
ssize_t pwrite64(int fd, const void* data, size_t size, off64_t offset) {
  NEXT(pwrite64);
  TRANSFER(WRITE, next(fd, data, size, offset));
}

static int isOurs(const char* path) {
  static const char* const kSystem[] = {"/proc/", "/sys/", "/etc/", "/usr/", "/lib", "/dev/"};
  for (size_t i = 0; i < sizeof kSystem / sizeof *kSystem; ++i)
    if (strncmp(path, kSystem[i], strlen(kSystem[i])) == 0) return 0;
  return 1;
}

static int openCounted(int (*next)(const char*, int, ...), const char* path, int flags,
                       mode_t mode) {
  if (isOurs(path) && fails(OPEN) > 0) return -1;
  return next(path, flags, mode);
}
#define OPEN_AS(function)                          \
  int function(const char* path, int flags, ...) { \
    NEXT(function);                                \
    va_list words;                                 \
    va_start(words, flags);                        \
    const mode_t mode = va_arg(words, mode_t);     \
    va_end(words);                                 \
    return openCounted(next, path, flags, mode);   \
  }
OPEN_AS(open)
OPEN_AS(open64)

/* What is closed is closed, as by the system, also where that fails. */
int close(int fd) {
  NEXT(close);
  const int failed = fd > 2 && fails(CLOSE) > 0, kept = errno;
  const int result = next(fd);
  if (!failed) return result;
  errno = kept;
  return -1;
}
int fdatasync(int fd) {
  NEXT(fdatasync);
  return fails(SYNC) > 0 ? -1 : next(fd);
}
int rename(const char* from, const char* to) {
  NEXT(rename);
  return fails(RENAME) > 0 ? -1 : next(from, to);
}

#ifdef FAULTS_OF_MEMORY
static int isDenied(size_t size) {
  if (begun && !ready) prepare();
  return size >= least && fails(MEMORY) > 0;
}

void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* old, size_t size);
void* __libc_memalign(size_t alignment, size_t size);

void* malloc(size_t size) {
  return isDenied(size) ? NULL : __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
  return isDenied(count * size) ? NULL : __libc_calloc(count, size);
}
void* realloc(void* old, size_t size) {
  return isDenied(size) ? NULL : __libc_realloc(old, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
  return isDenied(size) ? NULL : __libc_memalign(alignment, size);
}
int posix_memalign(void** out, size_t alignment, size_t size) {
  if (isDenied(size)) return ENOMEM;
  *out = __libc_memalign(alignment, size);
  return *out ? 0 : ENOMEM;
}
#endif

static int (*their_main)(int, char**, char**);

static int mainThatBegins(int argc, char** argv, char** environment) {
  begun = 1;
  return their_main(argc, argv, environment);
}

int __libc_start_main(int (*main)(int, char**, char**), int argc, char** argv, void (*init)(void),
                      void (*fini)(void), void (*loader_fini)(void), void* stack_end) {
  NEXT(__libc_start_main);
  their_main = main;
  return next(mainThatBegins, argc, argv, init, fini, loader_fini, stack_end);
}

__attribute__((destructor)) static void tellCounts(void) {
  const char* path = getenv("FAULT_COUNTS");
  char text[512];
  int length = 0;
  if (!path) return;
  for (int call = 0; call < CALLS; ++call)
    length += snprintf(text + length, sizeof text - (size_t)length, "%s %ld\n", kNames[call],
                       counts[call]);
  const long fd = syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (fd < 0 || syscall(SYS_write, fd, text, (size_t)length) < 0) _exit(99);
}
