// Makes the system fail: to be preloaded (LD_PRELOAD) into a program under test. The environment selects what
// fails:
//
//   MORSEL_FAULT_KIND    memory, map, open, read, write, sync, name, remove, folder, status, thread,
//                        process; or signal, which delivers MORSEL_FAULT_CODE at the n-th call of all kinds
//                        but memory and map
//   MORSEL_FAULT_AT      n: the first call of that kind to fail, counted from 1; 0: none
//   MORSEL_FAULT_ALL     1: all calls from there on fail, not that one alone
//   MORSEL_FAULT_CODE    the error number that the call fails with, or the signal
//   MORSEL_FAULT_SCOPE   p: this process alone; c: the processes that it starts
//   MORSEL_FAULT_NAMED   1: there are no files without names (O_TMPFILE)
//   MORSEL_FAULT_MARK    a file that is made when something failed
//   MORSEL_FAULT_COUNTS  a file that gets "KIND NUMBER" lines at the end
//
// Standard error is never disturbed: the sentence about the failure is what is tested.
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

enum kind {
  MEMORY,
  MAP,
  OPEN,
  READ,
  WRITE,
  SYNC,
  NAME,
  REMOVE,
  FOLDER,
  STATUS,
  THREAD,
  PROCESS,
  SIGNAL,
  KINDS
};
static const char* const names[KINDS] = {"memory", "map",    "open",   "read",   "write",   "sync",  "name",
                                         "remove", "folder", "status", "thread", "process", "signal"};

static int active = 0;
static enum kind chosen = KINDS;
static long first = 0;
static int all = 0;
static int code = 0;
static int named = 0;
static const char* mark = NULL;
static const char* counts = NULL;
static atomic_long calls[KINDS];

void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);

static void make_mark(void) {
  if (mark != NULL) {
    const long file = syscall(SYS_openat, AT_FDCWD, mark, O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (file >= 0) syscall(SYS_close, file);
  }
}

/// Whether this call, which is one of that kind, shall fail.
static int fails(enum kind kind) {
  if (!active) return 0;
  if (kind > MAP) {
    const long n = 1 + atomic_fetch_add(&calls[SIGNAL], 1);
    if (chosen == SIGNAL && first > 0 && (n == first || (all && n > first))) {
      make_mark();
      syscall(SYS_kill, getpid(), code);
    }
  }
  const long n = 1 + atomic_fetch_add(&calls[kind], 1);
  if (chosen != kind || first <= 0 || !(n == first || (all && n > first))) return 0;
  make_mark();
  errno = code;
  return 1;
}

__attribute__((constructor)) static void begin(int argc, char** argv, char** environment) {
  (void)argc;
  (void)argv;
  int passive = 0;
  for (char** entry = environment; *entry != NULL; ++entry) {
    if (strncmp(*entry, "MORSEL_FAULT_", 13) != 0) continue;
    char* const equals = strchr(*entry, '=');
    if (equals == NULL) continue;
    const char* const key = *entry + 13;
    char* const value = equals + 1;
    const size_t length = (size_t)(equals - key);
    const int is_kind = strncmp(key, "KIND", length) == 0;
    for (int k = 0; is_kind && k < KINDS; ++k)
      if (strcmp(value, names[k]) == 0) chosen = (enum kind)k;
    if (strncmp(key, "AT", length) == 0) first = atol(value);
    if (strncmp(key, "ALL", length) == 0) all = atoi(value);
    if (strncmp(key, "CODE", length) == 0) code = atoi(value);
    if (strncmp(key, "NAMED", length) == 0) named = atoi(value);
    if (strncmp(key, "MARK", length) == 0) mark = value;
    if (strncmp(key, "COUNTS", length) == 0) counts = value;
    if (strncmp(key, "SCOPE", length) == 0) {  // the next process gets its own settings
      passive = *value != 'p';
      *value = *value == 'c' ? 'p' : 'x';
    }
  }
  active = !passive;
}

__attribute__((destructor)) static void end(void) {
  if (!active || counts == NULL) return;
  active = 0;
  FILE* const file = fopen(counts, "we");
  if (file == NULL) return;
  for (int k = 0; k < KINDS; ++k) fprintf(file, "%s %ld\n", names[k], atomic_load(&calls[k]));
  fclose(file);
}

// Of a name and a type, the function that the program would have called.
#define REAL(result, name, ...)              \
  static result (*real)(__VA_ARGS__) = NULL; \
  if (real == NULL) *(void**)&real = dlsym(RTLD_NEXT, #name)

void* malloc(size_t size) { return fails(MEMORY) ? NULL : __libc_malloc(size); }
void* calloc(size_t count, size_t size) { return fails(MEMORY) ? NULL : __libc_calloc(count, size); }
void* realloc(void* memory, size_t size) { return fails(MEMORY) ? NULL : __libc_realloc(memory, size); }
void* memalign(size_t alignment, size_t size) {
  return fails(MEMORY) ? NULL : __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) { return memalign(alignment, size); }
int posix_memalign(void** result, size_t alignment, size_t size) {
  void* const memory = memalign(alignment, size);
  if (memory == NULL) return ENOMEM;
  *result = memory;
  return 0;
}

void* mmap(void* address, size_t size, int protection, int flags, int file, off_t offset) {
  if (fails(MAP)) return MAP_FAILED;
  return (void*)syscall(SYS_mmap, address, size, protection, flags, file, offset);
}
void* mmap64(void* address, size_t size, int protection, int flags, int file, off64_t offset) {
  return mmap(address, size, protection, flags, file, offset);
}

static int open_fails(int flags) {
  if (fails(OPEN)) return 1;
  if (!named || (flags & O_TMPFILE) != O_TMPFILE) return 0;
  errno = EOPNOTSUPP;
  return 1;
}
static mode_t mode_of(int flags, va_list arguments) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
}
#define OPEN_FUNCTION(name)                                       \
  int name(const char* path, int flags, ...) {                    \
    va_list arguments;                                            \
    va_start(arguments, flags);                                   \
    const mode_t mode = mode_of(flags, arguments);                \
    va_end(arguments);                                            \
    if (open_fails(flags)) return -1;                             \
    return (int)syscall(SYS_openat, AT_FDCWD, path, flags, mode); \
  }
OPEN_FUNCTION(open)
OPEN_FUNCTION(open64)
#define OPENAT_FUNCTION(name)                                   \
  int name(int folder, const char* path, int flags, ...) {      \
    va_list arguments;                                          \
    va_start(arguments, flags);                                 \
    const mode_t mode = mode_of(flags, arguments);              \
    va_end(arguments);                                          \
    if (open_fails(flags)) return -1;                           \
    return (int)syscall(SYS_openat, folder, path, flags, mode); \
  }
OPENAT_FUNCTION(openat)
OPENAT_FUNCTION(openat64)
FILE* fopen(const char* path, const char* mode) {
  REAL(FILE*, fopen, const char*, const char*);
  return fails(OPEN) ? NULL : real(path, mode);
}
FILE* fopen64(const char* path, const char* mode) {
  REAL(FILE*, fopen64, const char*, const char*);
  return fails(OPEN) ? NULL : real(path, mode);
}
DIR* opendir(const char* path) {
  REAL(DIR*, opendir, const char*);
  return fails(OPEN) ? NULL : real(path);
}

ssize_t read(int file, void* data, size_t size) {
  return fails(READ) ? -1 : syscall(SYS_read, file, data, size);
}
ssize_t pread(int file, void* data, size_t size, off_t offset) {
  return fails(READ) ? -1 : syscall(SYS_pread64, file, data, size, offset);
}
struct dirent* readdir(DIR* folder) {
  REAL(struct dirent*, readdir, DIR*);
  return fails(READ) ? NULL : real(folder);
}
struct dirent64* readdir64(DIR* folder) {
  REAL(struct dirent64*, readdir64, DIR*);
  return fails(READ) ? NULL : real(folder);
}

static int write_fails(int file) { return file != STDERR_FILENO && fails(WRITE); }
ssize_t write(int file, const void* data, size_t size) {
  return write_fails(file) ? -1 : syscall(SYS_write, file, data, size);
}
ssize_t pwrite(int file, const void* data, size_t size, off_t offset) {
  return write_fails(file) ? -1 : syscall(SYS_pwrite64, file, data, size, offset);
}
ssize_t writev(int file, const struct iovec* parts, int count) {
  return write_fails(file) ? -1 : syscall(SYS_writev, file, parts, count);
}
size_t fwrite(const void* data, size_t size, size_t count, FILE* stream) {
  REAL(size_t, fwrite, const void*, size_t, size_t, FILE*);
  return stream != stderr && fails(WRITE) ? 0 : real(data, size, count, stream);
}
int fflush(FILE* stream) {
  REAL(int, fflush, FILE*);
  return stream != stderr && fails(WRITE) ? EOF : real(stream);
}
int ftruncate(int file, off_t size) { return fails(WRITE) ? -1 : (int)syscall(SYS_ftruncate, file, size); }
int ftruncate64(int file, off64_t size) { return ftruncate(file, size); }

int fsync(int file) { return fails(SYNC) ? -1 : (int)syscall(SYS_fsync, file); }
int fdatasync(int file) { return fails(SYNC) ? -1 : (int)syscall(SYS_fdatasync, file); }

int rename(const char* from, const char* to) { return fails(NAME) ? -1 : (int)syscall(SYS_rename, from, to); }
int renameat(int from_folder, const char* from, int to_folder, const char* to) {
  return fails(NAME) ? -1 : (int)syscall(SYS_renameat, from_folder, from, to_folder, to);
}
int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned int flags) {
  return fails(NAME) ? -1 : (int)syscall(SYS_renameat2, from_folder, from, to_folder, to, flags);
}
int link(const char* from, const char* to) { return fails(NAME) ? -1 : (int)syscall(SYS_link, from, to); }
int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) {
  return fails(NAME) ? -1 : (int)syscall(SYS_linkat, from_folder, from, to_folder, to, flags);
}

int unlink(const char* path) { return fails(REMOVE) ? -1 : (int)syscall(SYS_unlink, path); }
int unlinkat(int folder, const char* path, int flags) {
  return fails(REMOVE) ? -1 : (int)syscall(SYS_unlinkat, folder, path, flags);
}
int rmdir(const char* path) { return fails(REMOVE) ? -1 : (int)syscall(SYS_rmdir, path); }
int remove(const char* path) {
  REAL(int, remove, const char*);
  return fails(REMOVE) ? -1 : real(path);
}

int mkdir(const char* path, mode_t mode) { return fails(FOLDER) ? -1 : (int)syscall(SYS_mkdir, path, mode); }
int mkdirat(int folder, const char* path, mode_t mode) {
  return fails(FOLDER) ? -1 : (int)syscall(SYS_mkdirat, folder, path, mode);
}
char* mkdtemp(char* pattern) {
  REAL(char*, mkdtemp, char*);
  return fails(FOLDER) ? NULL : real(pattern);
}

int stat(const char* path, struct stat* status) {
  REAL(int, stat, const char*, struct stat*);
  return fails(STATUS) ? -1 : real(path, status);
}
int lstat(const char* path, struct stat* status) {
  REAL(int, lstat, const char*, struct stat*);
  return fails(STATUS) ? -1 : real(path, status);
}
int fstat(int file, struct stat* status) {
  REAL(int, fstat, int, struct stat*);
  return fails(STATUS) ? -1 : real(file, status);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*body)(void*),
                   void* argument) {
  REAL(int, pthread_create, pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  return fails(THREAD) ? code : real(thread, attributes, body, argument);
}

pid_t fork(void) {
  REAL(pid_t, fork, void);
  return fails(PROCESS) ? -1 : real();
}
int pipe2(int files[2], int flags) { return fails(PROCESS) ? -1 : (int)syscall(SYS_pipe2, files, flags); }
int eventfd(unsigned int value, int flags) {
  return fails(PROCESS) ? -1 : (int)syscall(SYS_eventfd2, value, flags);
}
