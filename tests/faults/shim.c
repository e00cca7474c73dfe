// LD_PRELOAD library that lets calls of the system fail, from the program's main on, in it and in the processes that it
// starts.
//   ATRIUM_FAULT=KIND:N        the N-th call of that kind fails, once (counted from 1, all threads of a process
//   together) ATRIUM_FAULT=KIND:N:all    that one and all later ones ATRIUM_FAULT_COUNTS=FILE   at the end each process
//   appends "KIND CALLS" for every kind
// Kinds: malloc (malloc, calloc, realloc, aligned ones: ENOMEM), write (files and stdio, not stderr: ENOSPC), fsync
// (EIO), rename (EXDEV), mmap (ENOMEM), thread (pthread_create: EAGAIN), open (EMFILE), read (EIO), link (links and
// folders: ENOSPC), fork (EAGAIN).
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

enum kind { k_malloc, k_write, k_fsync, k_rename, k_mmap, k_thread, k_open, k_read, k_link, k_fork, kinds };
static const char* const names[kinds] = {"malloc", "write", "fsync", "rename", "mmap",
                                         "thread", "open",  "read",  "link",   "fork"};

static atomic_long counts[kinds];
static atomic_int active;
static enum kind failing = kinds;
static long first = 0;
static int all = 0;

// Whether this call is to fail.
static int fails(enum kind kind) {
  if (!atomic_load_explicit(&active, memory_order_relaxed)) return 0;
  const long number = atomic_fetch_add(&counts[kind], 1) + 1;
  return kind == failing && (number == first || (all && number > first));
}

static void read_environment(void) {
  const char* fault = getenv("ATRIUM_FAULT");
  if (fault == NULL) return;
  for (enum kind k = 0; k < kinds; ++k) {
    const size_t length = strlen(names[k]);
    if (strncmp(fault, names[k], length) != 0 || fault[length] != ':') continue;
    char* end = NULL;
    first = strtol(fault + length + 1, &end, 10);
    all = strcmp(end, ":all") == 0;
    failing = k;
  }
}

static void append_counts(void) {
  const char* file = getenv("ATRIUM_FAULT_COUNTS");
  atomic_store(&active, 0);
  if (file == NULL) return;
  char text[400];
  int size = 0;
  for (enum kind k = 0; k < kinds; ++k)
    size += snprintf(text + size, sizeof text - (size_t)size, "%s %ld\n", names[k], atomic_load(&counts[k]));
  const int number = open(file, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
  if (number < 0) return;
  if (write(number, text, (size_t)size) != size) abort();
  close(number);
}

// From main on: what the loader and the constructors of libraries do before is not the program's.
static int (*real_main)(int, char**, char**);
static int counting_main(int argc, char** argv, char** environment) {
  read_environment();
  atexit(append_counts);
  atomic_store(&active, 1);
  return real_main(argc, argv, environment);
}
int __libc_start_main(int (*given)(int, char**, char**), int argc, char** argv, void (*begin)(void), void (*end)(void),
                      void (*end_of_loader)(void), void* stack) {
  int (*start)(int (*)(int, char**, char**), int, char**, void (*)(void), void (*)(void), void (*)(void), void*) =
      dlsym(RTLD_NEXT, "__libc_start_main");
  real_main = given;
  return start(counting_main, argc, argv, begin, end, end_of_loader, stack);
}

// The C library's own, under names that need no dlsym (which allocates).
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);

static void* no_memory(void) {
  errno = ENOMEM;
  return NULL;
}
void* malloc(size_t size) { return fails(k_malloc) ? no_memory() : __libc_malloc(size); }
void* calloc(size_t count, size_t size) { return fails(k_malloc) ? no_memory() : __libc_calloc(count, size); }
void* realloc(void* before, size_t size) { return fails(k_malloc) ? no_memory() : __libc_realloc(before, size); }
void* memalign(size_t alignment, size_t size) {
  return fails(k_malloc) ? no_memory() : __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) { return memalign(alignment, size); }
int posix_memalign(void** to, size_t alignment, size_t size) {
  void* place = memalign(alignment, size);
  if (place == NULL) return ENOMEM;
  *to = place;
  return 0;
}

#define FUNCTION(result, name, parameters, arguments, kind, error, failure) \
  result name parameters {                                                  \
    static result(*real) parameters;                                        \
    if (real == NULL) *(void**)&real = dlsym(RTLD_NEXT, #name);             \
    if (fails(kind)) {                                                      \
      errno = error;                                                        \
      return failure;                                                       \
    }                                                                       \
    return real arguments;                                                  \
  }
FUNCTION(ssize_t, pwrite, (int f, const void* b, size_t n, off_t o), (f, b, n, o), k_write, ENOSPC, -1)
FUNCTION(ssize_t, pwrite64, (int f, const void* b, size_t n, off64_t o), (f, b, n, o), k_write, ENOSPC, -1)
FUNCTION(int, ftruncate, (int f, off_t size), (f, size), k_write, ENOSPC, -1)
FUNCTION(int, fsync, (int f), (f), k_fsync, EIO, -1)
FUNCTION(int, fdatasync, (int f), (f), k_fsync, EIO, -1)
FUNCTION(int, rename, (const char* a, const char* b), (a, b), k_rename, EXDEV, -1)
FUNCTION(void*, mmap, (void* p, size_t n, int r, int m, int f, off_t o), (p, n, r, m, f, o), k_mmap, ENOMEM, MAP_FAILED)
FUNCTION(void*, mmap64, (void* p, size_t n, int r, int m, int f, off64_t o), (p, n, r, m, f, o), k_mmap, ENOMEM,
         MAP_FAILED)
FUNCTION(ssize_t, pread, (int f, void* b, size_t n, off_t o), (f, b, n, o), k_read, EIO, -1)
FUNCTION(ssize_t, pread64, (int f, void* b, size_t n, off64_t o), (f, b, n, o), k_read, EIO, -1)
FUNCTION(ssize_t, read, (int f, void* b, size_t n), (f, b, n), k_read, EIO, -1)
FUNCTION(int, link, (const char* a, const char* b), (a, b), k_link, ENOSPC, -1)
FUNCTION(int, symlink, (const char* a, const char* b), (a, b), k_link, ENOSPC, -1)
FUNCTION(int, mkdir, (const char* a, mode_t m), (a, m), k_link, ENOSPC, -1)
FUNCTION(FILE*, fopen, (const char* a, const char* m), (a, m), k_open, EMFILE, NULL)
FUNCTION(FILE*, fopen64, (const char* a, const char* m), (a, m), k_open, EMFILE, NULL)
FUNCTION(pid_t, fork, (void), (), k_fork, EAGAIN, -1)

// stderr is left alone: an error must be said to be seen.
#define WRITES(result, name, parameters, arguments, stream, failure) \
  result name parameters {                                           \
    static result(*real) parameters;                                 \
    if (real == NULL) *(void**)&real = dlsym(RTLD_NEXT, #name);      \
    if ((stream) && fails(k_write)) {                                \
      errno = ENOSPC;                                                \
      return failure;                                                \
    }                                                                \
    return real arguments;                                           \
  }
WRITES(ssize_t, write, (int f, const void* b, size_t n), (f, b, n), f != STDERR_FILENO, -1)
WRITES(ssize_t, writev, (int f, const struct iovec* b, int n), (f, b, n), f != STDERR_FILENO, -1)
WRITES(size_t, fwrite, (const void* b, size_t s, size_t n, FILE* f), (b, s, n, f), f != stderr, 0)
WRITES(int, fflush, (FILE * f), (f), f != NULL && f != stderr, EOF)

// A closed stream is gone, whatever is said of its last bytes.
int fclose(FILE* file) {
  static int (*real)(FILE*);
  if (real == NULL) *(void**)&real = dlsym(RTLD_NEXT, "fclose");
  const int failure = fails(k_write);
  const int result = real(file);
  if (failure) errno = ENOSPC;
  return failure ? EOF : result;
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*), void* given) {
  static int (*real)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  if (real == NULL) *(void**)&real = dlsym(RTLD_NEXT, "pthread_create");
  return fails(k_thread) ? EAGAIN : real(thread, attributes, start, given);
}

#define OPENS(name)                                                                    \
  int name(const char* path, int how, ...) {                                           \
    static int (*real)(const char*, int, ...);                                         \
    if (real == NULL) *(void**)&real = dlsym(RTLD_NEXT, #name);                        \
    va_list rest;                                                                      \
    va_start(rest, how);                                                               \
    const mode_t mode = (how & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0; \
    va_end(rest);                                                                      \
    if (fails(k_open)) {                                                               \
      errno = EMFILE;                                                                  \
      return -1;                                                                       \
    }                                                                                  \
    return real(path, how, mode);                                                      \
  }
OPENS(open)
OPENS(open64)
