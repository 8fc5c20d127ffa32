// SPDX-License-Identifier: GPL-3.0-or-later
// Preloaded into a tool (LD_PRELOAD), what a system may do to it at any time:
//   FAULT_READ=1     one byte a read, and every second call interrupted or told to try again
//   FAULT_WRITE=1    a few bytes a write, and every second call interrupted or told to try again
//   FAULT_MALLOC=once | on   runs the tool again and again: with its first allocation failing, its
//                    second, ... (`on`: that one and all after it; with /N, only every N-th run),
//                    and checks that each is refused with 2 in one line on standard error, behind
//                    its warnings, and prints whole rows only, all of them rows of the run without
//                    a fault.
//   FAULT_DENORMALS=1  denormal numbers are 0 when the tool starts, as -ffast-math has it where it
//                    links
// No C++ library here: the shim must not allocate, nor be initialised after anything that does.
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
}

namespace {

long allocations, fail_at;
bool fail_on, *fired;

bool refuse() {
  if (fail_at == 0) return false;
  ++allocations;
  if (allocations != fail_at && !(fail_on && allocations > fail_at)) return false;
  *fired = true;
  errno = ENOMEM;
  return true;
}

struct Run {
  bool failed;
  int status;
  long out_size, err_size;
  char out[1 << 16], err[1 << 12];
};
Run whole, run;

/// True in the child, which goes on to main().
bool child(long n) {
  int files[2];
  for (int& file : files) file = static_cast<int>(syscall(SYS_memfd_create, "stream", 0));
  *fired = false;
  const pid_t pid = fork();
  if (pid == 0) {
    fail_at = n;
    dup2(files[0], STDOUT_FILENO);
    dup2(files[1], STDERR_FILENO);
    return true;
  }
  waitpid(pid, &run.status, 0);
  run.failed = *fired;
  run.out_size = pread(files[0], run.out, sizeof run.out, 0);
  run.err_size = pread(files[1], run.err, sizeof run.err, 0);
  for (const int file : files) close(file);
  return false;
}

/// The exit status and both streams are those of the run without a fault, as where the memory was
/// for an exception: the C++ library has some of its own for that.
bool same_as_whole() {
  return run.status == whole.status && run.out_size == whole.out_size &&
         run.err_size == whole.err_size &&
         memcmp(run.out, whole.out, static_cast<size_t>(run.out_size)) == 0 &&
         memcmp(run.err, whole.err, static_cast<size_t>(run.err_size)) == 0;
}

/// What a run says behind the warnings that the run without a fault gives too.
const char* behind_warnings() {
  long same = 0;
  for (long i = 0; i < run.err_size && i < whole.err_size && run.err[i] == whole.err[i]; ++i)
    if (run.err[i] == '\n') same = i + 1;
  return run.err + same;
}

const char* what_is_wrong(const char* tool) {
  const long prefix = static_cast<long>(strlen(tool));
  if (WIFSIGNALED(run.status)) return "was killed by a signal";
  if (same_as_whole()) return nullptr;  // it did without
  if (WEXITSTATUS(run.status) != 2) return "does not exit with 2";
  const char* why = behind_warnings();
  const long length = run.err + run.err_size - why;
  if (length < prefix + 3 || memcmp(why, tool, static_cast<size_t>(prefix)) != 0)
    return "does not say why";
  if (memchr(why, '\n', static_cast<size_t>(length)) != why + length - 1)
    return "does not say why in one line";
  const char end[] = ": ended with an error\n";  // which a tool says when it has begun to print
  const long last = 3 + prefix + static_cast<long>(sizeof end) - 1;
  if (run.out_size >= last &&
      memcmp(run.out + run.out_size - (sizeof end - 1), end, sizeof end - 1) == 0)
    run.out_size -= last;
  if (run.out_size > whole.out_size ||
      memcmp(run.out, whole.out, static_cast<size_t>(run.out_size)) != 0)
    return "prints other rows";
  if (run.out_size > 0 && run.out[run.out_size - 1] != '\n') return "prints half a row";
  return nullptr;
}

__attribute__((constructor)) void every_allocation() {
  const char* mode = getenv("FAULT_MALLOC");
  if (!mode) return;
  fail_on = mode[0] == 'o' && mode[1] == 'n' && mode[2] != 'c';
  const long step = strchr(mode, '/') ? atol(strchr(mode, '/') + 1) : 1;
  fired = static_cast<bool*>(
      mmap(nullptr, sizeof(bool), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  if (child(0)) return;
  whole = run;
  int wrong = whole.status != 0 || whole.out_size <= 0;
  long n = 1, tried = 0, refused = 0;
  for (;; n += step) {
    if (child(n)) return;
    if (!run.failed) break;
    ++tried;
    refused += run.status != whole.status;
    if (const char* what = what_is_wrong(program_invocation_short_name)) {
      if (wrong++ < 5)
        dprintf(STDOUT_FILENO, "%s %s where allocation %ld fails: %.*s\n",
                program_invocation_short_name, what, n, static_cast<int>(run.err_size), run.err);
    }
  }
  dprintf(STDOUT_FILENO, "%s: %ld allocations failed, %ld runs refused\n",
          program_invocation_short_name, tried, refused);
  _exit(wrong || tried == 0);
}

__attribute__((constructor)) void flush_denormals() {
  if (!getenv("FAULT_DENORMALS")) return;
#if defined __x86_64__
  __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() | 0x8040);
#elif defined __aarch64__
  __builtin_aarch64_set_fpcr(__builtin_aarch64_get_fpcr() | 1U << 24);
#endif
}

bool interrupted(const char* variable, unsigned& calls) {
  if (!getenv(variable) || ++calls % 2 == 0) return false;
  errno = calls % 4 == 1 ? EINTR : EAGAIN;
  return true;
}

}  // namespace

extern "C" {

void end_faults() { fail_at = 0; }  // before gcov writes: see tests/gcov_exit.cpp

void* malloc(size_t size) { return refuse() ? nullptr : __libc_malloc(size); }
void* calloc(size_t count, size_t size) { return refuse() ? nullptr : __libc_calloc(count, size); }
void* realloc(void* old, size_t size) { return refuse() ? nullptr : __libc_realloc(old, size); }
void* aligned_alloc(size_t alignment, size_t size) {
  return refuse() ? nullptr : __libc_memalign(alignment, size);
}

ssize_t read(int file, void* to, size_t count) {
  static unsigned calls;
  if (interrupted("FAULT_READ", calls)) return -1;
  return syscall(SYS_read, file, to, getenv("FAULT_READ") && count > 1 ? 1 : count);
}

ssize_t write(int file, const void* from, size_t count) {
  static unsigned calls;
  if (interrupted("FAULT_WRITE", calls)) return -1;
  return syscall(SYS_write, file, from, getenv("FAULT_WRITE") && count > 7 ? 1 + calls % 7 : count);
}
}
