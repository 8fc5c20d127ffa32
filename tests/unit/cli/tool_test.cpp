// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/tool.h"

#include <unistd.h>

#include <array>
#include <new>

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

}  // namespace

TEST_CASE("tool: whatever its work throws is one line on standard error and 2", "[cli]") {
  CHECK(run([] { return 0; }) == "0 ");
  CHECK(run([]() -> int { fail("no {}", "way"); }) == "2 tool: no way\n");
  CHECK(run([]() -> int { throw std::bad_alloc(); }) == "2 tool: out of memory\n");
  CHECK(run([]() -> int { throw std::length_error("too\nlong"); }) == "2 tool: too?long\n");
}

TEST_CASE("tool: a check that does not hold is one line and 1, and a refusal is the only line",
          "[cli]") {
  const auto with_check = [](bool refused) {
    const TemporaryFile file;
    const Redirect to_file(STDERR_FILENO, file.name());
    std::string name = "tool";
    std::array<char*, 2> arguments{name.data(), nullptr};
    Tool tool("tool", "");
    const int status = tool.run(1, arguments.data(), [&] {
      for (const char* text : {"one", "two", "three"}) tool.check_failed("", text);
      if (refused) fail("no way");
      return 0;
    });
    return fmt::format("{} {}", status, file.text());
  };
  CHECK(with_check(false) == "1 tool: one (and 2 more)\n");
  CHECK(with_check(true) == "2 tool: no way\n");
}
