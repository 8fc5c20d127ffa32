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

TEST_CASE("tool: a check that does not hold is a line and 1, beside a refusal 2", "[cli]") {
  const auto with_check = [](bool refused) {
    const TemporaryFile file;
    const Redirect to_file(STDERR_FILENO, file.name());
    std::string name = "tool";
    std::array<char*, 2> arguments{name.data(), nullptr};
    Tool tool("tool", "");
    tool.checks = true;
    const int status = tool.run(1, arguments.data(), [&] {
      for (const char* run : {"one", "two", "three"})
        tool.object(run, run[0] == 't' && run[1] == 'w' ? "open" : "off by 1.5");
      if (refused) fail("no way");
      return 0;
    });
    return fmt::format("{} {}", status, file.text());
  };
  CHECK(with_check(false) == "1 tool: run one (and three): off by 1.5\ntool: run two: open\n");
  CHECK(with_check(true) ==
        "2 tool: run one (and three): off by 1.5\ntool: run two: open\n"
        "tool: no way\n");
}

TEST_CASE("messages: lines of several runs that differ in their numbers are one", "[cli]") {
  LinesOfRuns lines;
  lines.add("a", "sigma is 0.62 times a");
  lines.add("", "both disagree by 3");
  lines.add("b", "sigma is -1e+300 times a");
  lines.add("b", "no end");
  lines.add("", "both disagree by 4");
  for (const char* run : {"c", "d", "e", "f"}) lines.add(run, "sigma is 7 times a");
  CHECK(lines.all() ==
        std::vector<std::string>{"run a (and b, c, d and 2 more): sigma is 0.62 times a",
                                 "both disagree by 3", "run b: no end", "both disagree by 4"});
}
