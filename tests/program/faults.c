/* Faults on purpose, loaded before the C library (LD_PRELOAD): the n-th call that writes files fails, is cut short, or is the moment
   of a signal. Counted are calls on regular files, or of names, while a results file is being written: from its opening on.

   POUNDING_FAULT_CALL   write, fsync, rename, open, ftruncate, or memory (operator new and malloc inside HDF5)
   POUNDING_FAULT_AT     the number of the call that fails, from 1
   POUNDING_FAULT_KIND   an error number; or short (half is written, then the disk is full), kill, or signal NUMBER as -NUMBER
   POUNDING_FAULT_COUNT  file to which the number of calls is written at the end */
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
#include <unistd.h>

static long calls = 0;
static int full_disk = 0;

static const char* setting(const char* name) {
  const char* value = getenv(name);
  return value ? value : "";
}

static void count_to_file(void) {
  const char* path = setting("POUNDING_FAULT_COUNT");
  if (!*path) return;
  FILE* file = fopen(path, "w");
  if (!file) return;
  fprintf(file, "%ld\n", calls);
  fclose(file);
}

__attribute__((destructor)) static void at_the_end(void) { count_to_file(); }

enum Fate { passes, fails, is_cut };

static enum Fate fate(const char* call) {
  if (strcmp(setting("POUNDING_FAULT_CALL"), call) != 0) return passes;
  if (++calls != atol(setting("POUNDING_FAULT_AT"))) return passes;
  const char* kind = setting("POUNDING_FAULT_KIND");
  if (strcmp(kind, "short") == 0) return is_cut;
  if (strcmp(kind, "kill") == 0) raise(SIGKILL);
  if (kind[0] == '-') {
    raise(atoi(kind + 1));
    return passes;
  }
  errno = atoi(kind);
  return fails;
}

static int is_file(int descriptor) {
  struct stat status;
  return descriptor > 2 && fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

static int is_results(const char* path) { return strstr(path, ".h5") != NULL; }

#define REAL(type, name, ...) \
  static type (*real)(__VA_ARGS__) = NULL; \
  if (!real) real = (type(*)(__VA_ARGS__))dlsym(RTLD_NEXT, name)

ssize_t write(int descriptor, const void* bytes, size_t count) {
  REAL(ssize_t, "write", int, const void*, size_t);
  if (!is_file(descriptor)) return real(descriptor, bytes, count);
  if (full_disk) {
    errno = ENOSPC;
    return -1;
  }
  switch (fate("write")) {
    case fails: return -1;
    case is_cut: full_disk = 1; return real(descriptor, bytes, count / 2);
    default: return real(descriptor, bytes, count);
  }
}

int fsync(int descriptor) {
  REAL(int, "fsync", int);
  return fate("fsync") == passes ? real(descriptor) : -1;
}

int ftruncate(int descriptor, off_t length) {
  REAL(int, "ftruncate", int, off_t);
  return !is_file(descriptor) || fate("ftruncate") == passes ? real(descriptor, length) : -1;
}

int rename(const char* from, const char* to) {
  REAL(int, "rename", const char*, const char*);
  return !is_results(to) || fate("rename") == passes ? real(from, to) : -1;
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned int flags) {
  REAL(int, "renameat2", int, const char*, int, const char*, unsigned int);
  return !is_results(to) || fate("rename") == passes ? real(from_folder, from, to_folder, to, flags) : -1;
}

int open(const char* path, int flags, ...) {
  REAL(int, "open", const char*, int, ...);
  va_list more;
  va_start(more, flags);
  const mode_t mode = flags & O_CREAT ? va_arg(more, mode_t) : 0;
  va_end(more);
  return !is_results(path) || fate("open") == passes ? real(path, flags, mode) : -1;
}

/* Allocations of HDF5 alone, the library of the results file: others end a process of MPI in ways of their own. */
static int is_in_hdf5(const void* caller) {
  static int inside = 0;
  if (inside) return 0;
  inside = 1;
  Dl_info where;
  const int found = dladdr(caller, &where) != 0 && where.dli_fname && strstr(where.dli_fname, "hdf5");
  inside = 0;
  return found;
}

extern void* __libc_malloc(size_t size);
extern void* __libc_calloc(size_t count, size_t size);
extern void* __libc_realloc(void* block, size_t size);
static int counts_memory = -1;

static int memory_fails(const void* caller) {
  if (counts_memory < 0) counts_memory = strcmp(setting("POUNDING_FAULT_CALL"), "memory") == 0;
  return counts_memory && is_in_hdf5(caller) && fate("memory") != passes;
}

void* malloc(size_t size) { return memory_fails(__builtin_return_address(0)) ? NULL : __libc_malloc(size); }
void* calloc(size_t count, size_t size) { return memory_fails(__builtin_return_address(0)) ? NULL : __libc_calloc(count, size); }
void* realloc(void* block, size_t size) { return memory_fails(__builtin_return_address(0)) ? NULL : __libc_realloc(block, size); }
