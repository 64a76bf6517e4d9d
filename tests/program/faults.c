/* Faults on purpose, loaded before the C library (LD_PRELOAD): the n-th call of a kind fails, is cut short, or is the
   moment of a signal. Of the calls that write, those on regular files count, and on names of results files.

   POUNDING_FAULT_CALL   write, fsync, rename, open, ftruncate; step, a kept step of the run; hdf5_memory, petsc_memory,
   own_memory: what these libraries ask for, or the program itself and its libraries of C++, from main on; other_memory:
   what all others ask for, such as MPI, BLAS and the C library, in the thread of main POUNDING_FAULT_AT     the number
   of the call that fails, from 1 POUNDING_FAULT_KIND   an error number; or short (half is written, then the disk is
   full), kill, or signal NUMBER as -NUMBER; or each: see meets_in_children POUNDING_FAULT_COUNT  file to which the
   number of calls is written at the end POUNDING_FAULT_SERVES when set, the program does not run itself: for each line
   CALL AT KIND of its input it runs once in a child, which writes its messages to this file, and answers with the
   child's status as wait gives it. Libraries load once. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <execinfo.h>
#include <fcntl.h>
#include <link.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
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

/* Set in a child and while one runs: nothing counts then. */
static int in_child = 0;

/* Tells whether a file is another one, or was written to. */
struct Version {
  ino_t inode;
  struct timespec written;
};
static struct Version version_of(const char* path) {
  struct stat status;
  struct Version none = {0};
  return stat(path, &status) == 0 ? (struct Version){status.st_ino, status.st_mtim} : none;
}
static int differs(struct Version a, struct Version b) {
  return a.inode != b.inode || a.written.tv_sec != b.written.tv_sec || a.written.tv_nsec != b.written.tv_nsec;
}

static void write_stack(void) {
  void* frames[64];
  const int stack = open("stack", O_CREAT | O_TRUNC | O_WRONLY, 0600);
  backtrace_symbols_fd(frames, backtrace(frames, 64), stack);
  close(stack);
}

/* Every POUNDING_FAULT_STRIDE-th call from POUNDING_FAULT_AT to POUNDING_FAULT_LAST fails, each in a child that goes on
   from there to its end, while the run itself meets no fault: the way to each of them is gone once. The folder of the
   run holds out.h5, which each child finds as the run has it. After a child the file `endings` gets a line: the number
   of the call, the child's status as wait gives it, the inode of out.h5 that it found, the name under which an out.h5
   that it wrote was put aside, or a dash, and its messages with their lines parted by the byte 1, parted by tabs. The
   stack of a call whose child ended by a signal stays in `stack_NUMBER`. With POUNDING_FAULT_APART set a child goes on
   in a copy of the folder, which stays beside it as `apart_NUMBER`. */
static enum Fate meets_in_children(void) {
  const long first = atol(setting("POUNDING_FAULT_AT")),
             stride = *setting("POUNDING_FAULT_STRIDE") ? atol(setting("POUNDING_FAULT_STRIDE")) : 1;
  if (calls < first || calls > atol(setting("POUNDING_FAULT_LAST")) || (calls - first) % stride != 0) return passes;
  in_child = 1;
  const int apart = *setting("POUNDING_FAULT_APART") != 0;
  char folder[40], copy[60];
  snprintf(folder, sizeof folder, "../apart_%ld", calls);
  snprintf(copy, sizeof copy, "cp -a . %s", folder);
  if (apart && system(copy) != 0) exit(1);
  const struct Version before = version_of("out.h5");
  unlink("kept");
  if (before.inode && link("out.h5", "kept") != 0) exit(1);
  const pid_t child = fork();
  if (child == 0) {
    const int messages = open("messages", O_CREAT | O_TRUNC | O_WRONLY, 0600);
    dup2(messages, 2);
    close(messages);
    if (apart && chdir(folder) != 0) exit(1);
    alarm(60);
    write_stack();
    /* MPI may start a program, for which nothing shall fail. unsetenv would wait for ever where setenv has asked for
     * this memory. */
    for (char** word = environ; *word; ++word)
      if (strncmp(*word, "LD_PRELOAD=", 11) == 0) **word = 'X';
    errno = ENOMEM;
    return fails;
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child) exit(1);
  if (WIFSIGNALED(status)) {
    char stack[32];
    snprintf(stack, sizeof stack, "stack_%ld", calls);
    rename("stack", stack);
  }
  char written[32] = "-", text[20000];
  if (differs(version_of("out.h5"), before)) {
    snprintf(written, sizeof written, "written_%ld", calls);
    rename("out.h5", written);
    if (before.inode) rename("kept", "out.h5");
  }
  FILE *messages = fopen("messages", "r"), *endings = fopen("endings", "a");
  if (!messages || !endings) exit(1);
  text[fread(text, 1, sizeof text - 1, messages)] = 0;
  for (char* c = text; *c; ++c)
    if (*c == '\n' || *c == '\r' || *c == '\t') *c = *c == '\n' ? '\001' : ' ';
  fprintf(endings, "%ld\t%d\t%lu\t%s\t%s\n", calls, status, (unsigned long)before.inode, written, text);
  fclose(messages);
  fclose(endings);
  in_child = 0;
  return passes;
}

static enum Fate fate(const char* call) {
  if (in_child || strcmp(setting("POUNDING_FAULT_CALL"), call) != 0) return passes;
  const char* kind = setting("POUNDING_FAULT_KIND");
  ++calls;
  if (strcmp(kind, "each") == 0) return meets_in_children();
  if (calls != atol(setting("POUNDING_FAULT_AT"))) return passes;
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

#define REAL(type, name, ...)              \
  static type (*real)(__VA_ARGS__) = NULL; \
  if (!real) real = (type (*)(__VA_ARGS__))dlsym(RTLD_NEXT, name)

/* How many of the bytes are to be written, or -1. */
static ssize_t granted(int descriptor, size_t count) {
  if (!is_file(descriptor)) return (ssize_t)count;
  if (full_disk) {
    errno = ENOSPC;
    return -1;
  }
  switch (fate("write")) {
    case fails: return -1;
    case is_cut: full_disk = 1; return (ssize_t)(count / 2);
    default: return (ssize_t)count;
  }
}

ssize_t write(int descriptor, const void* bytes, size_t count) {
  REAL(ssize_t, "write", int, const void*, size_t);
  const ssize_t some = granted(descriptor, count);
  return some < 0 ? some : real(descriptor, bytes, (size_t)some);
}

ssize_t pwrite64(int descriptor, const void* bytes, size_t count, off64_t place) {
  REAL(ssize_t, "pwrite64", int, const void*, size_t, off64_t);
  const ssize_t some = granted(descriptor, count);
  return some < 0 ? some : real(descriptor, bytes, (size_t)some, place);
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

#define OPEN(name)                                                                     \
  int name(const char* path, int flags, ...) {                                         \
    REAL(int, #name, const char*, int, ...);                                           \
    va_list more;                                                                      \
    va_start(more, flags);                                                             \
    const mode_t mode = flags & O_CREAT ? va_arg(more, mode_t) : 0;                    \
    va_end(more);                                                                      \
    return !is_results(path) || fate("open") == passes ? real(path, flags, mode) : -1; \
  }
OPEN(open)
OPEN(open64)

/* PETSc calls its TSPostStep after each kept step, but one that is bound inside its library does so unseen. The program
   has it call this one there. */
static int (*after_step)(void*) = NULL;
static int after_counted_step(void* ts) {
  fate("step");
  return after_step(ts);
}
static int open_petsc(struct dl_phdr_info* library, size_t size, void* found) {
  (void)size;
  if (!strstr(library->dlpi_name, "libpetsc")) return 0;
  *(void**)found = dlopen(library->dlpi_name, RTLD_LAZY | RTLD_NOLOAD);
  return 1;
}
int TSSetPostStep(void* ts, int (*call)(void*)) {
  static int (*real)(void*, int (*)(void*)) = NULL;
  if (!real) {
    /* Python loads PETSc for its package alone, out of the sight of RTLD_NEXT. */
    void* petsc_library = RTLD_NEXT;
    dl_iterate_phdr(open_petsc, &petsc_library);
    real = (int (*)(void*, int (*)(void*)))dlsym(petsc_library, "TSSetPostStep");
  }
  after_step = call;
  return real(ts, after_counted_step);
}

/* In the child that is to run the program, back with the messages going to `path`; in the parent never. */
static void serve(const char* path) {
  char call[32], number[32], kind[32];
  unsetenv("POUNDING_FAULT_SERVES");
  while (scanf("%31s %31s %31s", call, number, kind) == 3) {
    const pid_t child = fork();
    if (child == 0) {
      setenv("POUNDING_FAULT_CALL", call, 1);
      setenv("POUNDING_FAULT_AT", number, 1);
      setenv("POUNDING_FAULT_KIND", kind, 1);
      const int nothing = open("/dev/null", O_RDWR), messages = open(path, O_CREAT | O_TRUNC | O_WRONLY, 0600);
      dup2(nothing, 0);
      dup2(nothing, 1);
      dup2(messages, 2);
      close(nothing);
      close(messages);
      return;
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child) exit(1);
    printf("%d\n", status);
    fflush(stdout);
  }
  unsetenv("POUNDING_FAULT_COUNT");
  exit(0);
}

/* It would wait for a thread of MPI, which a child has not. */
int MPI_Finalize(void) {
  REAL(int, "MPI_Finalize", void);
  return in_child ? 0 : real();
}

static __thread int in_main = 0;
static int (*true_main)(int, char**, char**) = NULL;
static int counted_main(int count, char** words, char** environment) {
  if (*setting("POUNDING_FAULT_SERVES")) serve(setting("POUNDING_FAULT_SERVES"));
  in_main = 1;
  const int code = true_main(count, words, environment);
  in_main = 0;
  return code;
}

typedef int Main(int, char**, char**);
int __libc_start_main(Main* main, int count, char** words, void (*init)(void), void (*fini)(void), void (*linker)(void),
                      void* stack) {
  REAL(int, "__libc_start_main", Main*, int, char**, void (*)(void), void (*)(void), void (*)(void), void*);
  true_main = main;
  return real(counted_main, count, words, init, fini, linker, stack);
}

/* Allocations of the named libraries alone: MPI ends a process in ways of its own when it gets no memory. */
static const char* const hdf5[] = {"libhdf5", NULL};
static const char* const petsc[] = {"libpetsc", NULL};
static const char* const own[] = {"/pounding", "libstdc++", "libyaml-cpp", "libfmt", NULL};
static const char* const others[] = {NULL};
static const char* const* counted_libraries(void) {
  const char* call = setting("POUNDING_FAULT_CALL");
  return strcmp(call, "hdf5_memory") == 0    ? hdf5
         : strcmp(call, "petsc_memory") == 0 ? petsc
         : strcmp(call, "own_memory") == 0   ? own
         : strcmp(call, "other_memory") == 0 ? others
                                             : NULL;
}

static int has_any(const char* name, const char* const* libraries) {
  for (; *libraries; ++libraries)
    if (strstr(name, *libraries)) return 1;
  return 0;
}

/* Whether the code at this address belongs to one of the libraries, or for `others` to none of all lists. Answers are
 * kept, since to find one takes longer than to allocate. */
static int is_in(const void* caller, const char* const* libraries) {
  static struct {
    const void* caller;
    int found;
  } known[1 << 14];
  static int inside = 0;
  const size_t place = ((size_t)caller >> 1) % (sizeof known / sizeof known[0]);
  if (known[place].caller == caller) return known[place].found;
  if (inside) return 0;
  inside = 1;
  Dl_info where;
  int found = 0;
  if (dladdr(caller, &where) != 0 && where.dli_fname)
    found = libraries == others
                ? !has_any(where.dli_fname, hdf5) && !has_any(where.dli_fname, petsc) && !has_any(where.dli_fname, own)
                : has_any(where.dli_fname, libraries);
  known[place].caller = caller;
  known[place].found = found;
  inside = 0;
  return found;
}

extern void* __libc_malloc(size_t size);
extern void* __libc_calloc(size_t count, size_t size);
extern void* __libc_realloc(void* block, size_t size);
extern void* __libc_memalign(size_t alignment, size_t size);

static int memory_fails(const void* caller) {
  if (!in_main) return 0;
  static int read = 0;
  static const char* const* libraries = NULL;
  if (!read) {
    libraries = counted_libraries();
    read = 1;
  }
  return libraries && is_in(caller, libraries) && fate(setting("POUNDING_FAULT_CALL")) != passes;
}

void* malloc(size_t size) { return memory_fails(__builtin_return_address(0)) ? NULL : __libc_malloc(size); }
void* calloc(size_t count, size_t size) {
  return memory_fails(__builtin_return_address(0)) ? NULL : __libc_calloc(count, size);
}
void* realloc(void* block, size_t size) {
  return memory_fails(__builtin_return_address(0)) ? NULL : __libc_realloc(block, size);
}
int posix_memalign(void** block, size_t alignment, size_t size) {
  if (memory_fails(__builtin_return_address(0))) return ENOMEM;
  *block = __libc_memalign(alignment, size);
  return *block ? 0 : ENOMEM;
}
