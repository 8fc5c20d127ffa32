// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/tool.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <new>

#include "unit/catch.h"
#include "unit/text/files.h"

using namespace rolling;

namespace {

/// Exit status and standard error of a process in which nothing catches what `work` throws.
std::string terminate(const std::function<void()>& work) {
  const TemporaryFile file;
  const Redirect to_file(STDERR_FILENO, file.name());
  const pid_t child = ::fork();
  if (child == 0) [&]() noexcept { work(); }();
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  REQUIRE(WIFEXITED(status));
  return fmt::format("{} {}", WEXITSTATUS(status), file.text());
}

}  // namespace

TEST_CASE("messages: what is thrown where nothing catches is one line and 2 too", "[cli]") {
  const std::string name = program_invocation_short_name;
  CHECK(terminate([] { throw std::bad_alloc(); }) == "2 " + name + ": out of memory\n");
}

TEST_CASE("messages: one line of printable ASCII of at most 512 bytes", "[cli]") {
  const auto written = [](const std::string& text) {
    const TemporaryFile file;
    const Redirect to_file(STDERR_FILENO, file.name());
    write_message("name", text);
    return file.text();
  };
  CHECK(written("a\tb\nc\x7f\xc3\xa9 ~") == "name: a?b?c??? ~\n");
  CHECK(written(std::string(505, 'x')) == "name: " + std::string(505, 'x') + "\n");
  CHECK(written(std::string(506, 'x')) == "name: " + std::string(505, 'x') + "\n");
}
