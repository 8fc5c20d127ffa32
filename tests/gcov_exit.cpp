// SPDX-License-Identifier: GPL-3.0-or-later
// Linked into what `make coverage-lines` builds: a process that ends by _exit() or raise(), or in
// which allocations fail, leaves its counts of lines too. Not where files may not grow: what gcov
// cannot finish to write would be lost for all.
#include <cstdlib>
#include <dlfcn.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

extern "C" void __gcov_dump();

namespace {

bool can_write() {
  rlimit limit;
  return getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY;
}

void end_faults() {
  if (const auto end = reinterpret_cast<void (*)()>(dlsym(RTLD_DEFAULT, "end_faults")))
    end();  // of tests/faults/shim.cpp
}

void before_gcov(int status, void*) {
  end_faults();
  if (!can_write()) _exit(status);
}

__attribute__((constructor)) void at_exit() { on_exit(before_gcov, nullptr); }

void dump() {
  end_faults();
  if (can_write()) __gcov_dump();
}

}  // namespace

extern "C" int raise(int signal) {
  dump();
  return static_cast<int>(syscall(SYS_tgkill, getpid(), gettid(), signal));
}

extern "C" void _exit(int status) {
  dump();
  for (;;) syscall(SYS_exit_group, status);
}
