#include "cli/tool.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <new>
#include <stdexcept>

#include "unit/catch.h"
#include "unit/text/files.h"

using namespace rolling;

namespace {

/// Exit status and standard error of a tool whose work this is.
std::string run(const std::function<int()>& work) {
  const TemporaryFile file;
  const Redirect to_file(STDERR_FILENO, file.name());
  std::string name = "tool";
  std::array<char*, 2> arguments{name.data(), nullptr};
  const int status = Tool("tool", "").run(1, arguments.data(), work);
  return fmt::format("{} {}", status, file.text());
}

/// The same of a process in which nothing catches what `work` throws.
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

TEST_CASE("tool: whatever its work throws is one line on standard error and 2", "[cli]") {
  CHECK(run([] { return 0; }) == "0 ");
  CHECK(run([]() -> int { fail("no {}", "way"); }) == "2 tool: no way\n");
  CHECK(run([]() -> int { throw std::bad_alloc(); }) == "2 tool: out of memory\n");
  CHECK(run([]() -> int { throw std::length_error("too\nlong"); }) == "2 tool: too?long\n");
}

TEST_CASE("tool: what is thrown where nothing catches is one line and 2 too", "[cli]") {
  const std::string name = program_invocation_short_name;
  CHECK(terminate([] { throw std::bad_alloc(); }) == "2 " + name + ": out of memory\n");
  CHECK(terminate([] { throw std::length_error("too\nlong"); }) == "2 " + name + ": too?long\n");
  CHECK(terminate([] { throw 1; }) == "2 " + name + ": unknown trouble\n");
}
