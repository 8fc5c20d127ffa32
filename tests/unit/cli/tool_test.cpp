#include "cli/tool.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
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

TEST_CASE("tool: a check that does not hold is one line and 1, and a refusal is the only line",
          "[cli]") {
  const auto with_check = [](bool refused) {
    const TemporaryFile file;
    const Redirect to_file(STDERR_FILENO, file.name());
    std::string name = "tool";
    std::array<char*, 2> arguments{name.data(), nullptr};
    Tool tool("tool", "");
    const int status = tool.run(1, arguments.data(), [&] {
      for (const char* run : {"one", "two", "three"}) tool.check_failed(run);
      if (refused) fail("no way");
      return 0;
    });
    return fmt::format("{} {}", status, file.text());
  };
  CHECK(with_check(false) == "1 tool: one (and 2 more)\n");
  CHECK(with_check(true) == "2 tool: no way\n");
}

TEST_CASE("tool: what is given about a body, on the command line and in a scene", "[cli]") {
  using enum BodyOption;
  Body body{};
  BodyUncertainty sigma;
  std::vector<std::string> operands;
  const auto given = [&](std::vector<std::string> words, const std::vector<std::string>& needed) {
    const TemporaryFile file;
    const Redirect to_file(STDERR_FILENO, file.name());
    words.insert(words.begin(), "tool");
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    sigma = {};
    Tool tool("tool", "");
    tool.body(body, {mass, radius, shape_factor, gravity, slope}, &sigma);
    tool.scene();
    tool.list("--word", operands, "WORD", "");
    const int status = tool.run(static_cast<int>(words.size()), arguments.data(), [&] {
      tool.need(needed);
      return 0;
    });
    return fmt::format("{} {}", status, anonymous(file.text()));
  };

  CHECK(given({}, {}) == "0 ");
  CHECK(std::isnan(body.R));
  CHECK(body.g == 9.81);
  CHECK(body.slope == 0);
  CHECK(given({"-R", "0.04"}, {"radius"}) == "0 ");
  CHECK(given({}, {"radius"}) == "2 tool: --radius is not given, nor is it in a scene\n");
  CHECK(given({"-K", "1"}, {"mass", "radius", "shape-factor"}) ==
        "2 tool: --mass and --radius are not given, nor are they in a scene\n");
  CHECK(given({}, {"mass", "radius", "shape-factor"}) ==
        "2 tool: --mass, --radius and --shape-factor are not given, nor are they in a scene\n");

  const TemporaryFile scene(
      "shape-factor = \"0.50 +- 0.005\"\nradius = 0.04\nslope = '1e-3+-1e-4'\n");
  CHECK(given({"--scene", scene.name(), "-R0.05+-0.001", "-g", "9.8 +- 0.1"}, {"radius"}) == "0 ");
  CHECK(body.K == 0.5);
  CHECK(sigma.K == 0.005);
  CHECK(body.R == 0.05);
  CHECK(sigma.R == 0.001);
  CHECK(body.g == 9.8);
  CHECK(sigma.g == 0.1);
  CHECK(body.slope == 1e-3);
  CHECK(sigma.slope == 1e-4);
  CHECK(given({"-K", "0.5+--1"}, {}) == "2 tool: -K,--shape-factor: '0.5+--1' is not a number\n");
  CHECK(given({"-R", "0+-1"}, {}) == "2 tool: -R,--radius: '0+-1' must be greater than 0\n");
  CHECK(given({"-m", "1+-1"}, {}) == "2 tool: -m,--mass: '1+-1' is not a number\n");
  const TemporaryFile wrong("\nmass = \"1+-1\"\n");
  CHECK(given({"--scene", wrong.name()}, {}) == "2 tool: FILE:2: mass: '1+-1' is not a number\n");

  // Words are what they are, brackets and all.
  CHECK(given({"--word", "[a,b]", "--word", "\x01[c]", "--word={}"}, {}) == "0 ");
  CHECK(operands == std::vector<std::string>{"[a,b]", "\x01[c]", "{}"});
}

TEST_CASE("tool: what is thrown where nothing catches is one line and 2 too", "[cli]") {
  const std::string name = program_invocation_short_name;
  CHECK(terminate([] { throw std::bad_alloc(); }) == "2 " + name + ": out of memory\n");
  CHECK(terminate([] { throw std::length_error("too\nlong"); }) == "2 " + name + ": too?long\n");
  CHECK(terminate([] { throw 1; }) == "2 " + name + ": unknown error\n");
}
