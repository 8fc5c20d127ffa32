// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/options.h"

#include <unistd.h>

#include <cmath>

#include "cli/tool.h"
#include "unit/catch.h"
#include "unit/text/files.h"

using namespace rolling;

TEST_CASE("options: what is given about a body, on the command line and in a scene", "[cli]") {
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
    tool.list("--word", "WORD", "", [&](const auto& word) { operands.push_back(word); });
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
  CHECK(
      given({"-R", "0,04 +- 0,001"}, {}) ==
      "2 tool: -R,--radius: '0,04 +- 0,001' is not a number; its decimal mark has to be a point\n");
  for (const std::string text : {"0.04,0.03", "0,04m", ","})
    CHECK(given({"-R", text}, {}) == "2 tool: -R,--radius: '" + text + "' is not a number\n");
  const TemporaryFile wrong("\nmass = \"1+-1\"\n");
  CHECK(given({"--scene", wrong.name()}, {}) == "2 tool: FILE:2: mass: '1+-1' is not a number\n");

  // Words are what they are, brackets and all.
  CHECK(given({"--word", "[a,b]", "--word", "\x01[c]", "--word={}"}, {}) == "0 ");
  CHECK(operands == std::vector<std::string>{"[a,b]", "\x01[c]", "{}"});
}
