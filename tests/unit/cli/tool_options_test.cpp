// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/tool.h"

#include <unistd.h>

#include <cmath>

#include "unit/catch.h"
#include "unit/text/files.h"

using namespace rolling;

TEST_CASE("options: what is given about a body, on the command line and in a scene", "[cli]") {
  Body body{};
  std::vector<std::string> operands;
  const auto given = [&](std::vector<std::string> words, const std::vector<std::string>& needed) {
    const TemporaryFile file;
    const Redirect to_file(STDERR_FILENO, file.name());
    words.insert(words.begin(), "tool");
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    Tool tool("tool", "");
    tool.body(body, {&Body::m, &Body::R, &Body::K, &Body::g, &Body::slope});
    tool.scene();
    tool.add(
        "--word", "WORD", "", [&](const auto& word) { operands.push_back(word); },
        Tool::Values::many);
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
  CHECK(given({}, {"radius"}) == "2 tool: neither given nor in a scene: --radius\n");
  CHECK(given({"-K", "1"}, {"mass", "radius", "shape-factor"}) ==
        "2 tool: neither given nor in a scene: --mass and --radius\n");
  CHECK(given({}, {"mass", "radius", "shape-factor"}) ==
        "2 tool: neither given nor in a scene: --mass, --radius and --shape-factor\n");

  const TemporaryFile scene(
      "shape-factor = \"0.50 +- 0.005\"\nradius = 0.04\nslope = '1e-3+-1e-4'\n");
  CHECK(given({"--scene", scene.name(), "-R0.05+-0.001", "-g", "9.8 +- 0.1"}, {"radius"}) == "0 ");
  CHECK(body.K == 0.5);
  CHECK(body.sigma_K == 0.005);
  CHECK(body.R == 0.05);
  CHECK(body.sigma_R == 0.001);
  CHECK(body.g == 9.8);
  CHECK(body.sigma_g == 0.1);
  CHECK(body.slope == 1e-3);
  CHECK(body.sigma_slope == 1e-4);
  CHECK(given({"-K", "0.5+--1"}, {}) ==
        "2 tool: -K,--shape-factor: '0.5+--1' is not a number (decimal point, no unit)\n");
  CHECK(given({"-R", "0+-1"}, {}) == "2 tool: -R,--radius: '0+-1' must be greater than 0\n");
  CHECK(given({"-m", "1+-1"}, {}) ==
        "2 tool: -m,--mass: '1+-1' is not a number (decimal point, no unit)\n");
  for (const std::string text : {"0,04 +- 0,001", "0.04,0.03", "0,04m", ","})
    CHECK(given({"-R", text}, {}) ==
          "2 tool: -R,--radius: '" + text + "' is not a number (decimal point, no unit)\n");

  // What a scene says is what TOML means by it, or refused.
  const auto refused = [&](const std::string& text) {
    const TemporaryFile file(text);
    const std::string said = given({"--scene", file.name(), "-m", "2"}, {}),
                      before = "2 tool: FILE: ";
    return said.starts_with(before) ? said.substr(before.size()) : said;
  };
  for (const char* text : {"", "# [a]\n\nradius = 0.04 # m, \"R\" = 2\r\n", "radius='.04'",
                           "\xEF\xBB\xBFgravity = 9.81\n", "v0 = 1\nx0 = 0\nmass = -1\n"})
    CHECK(refused(text) == "0 ");
  for (const char* text : {"radius = 1 2", "radius = 0,04", "radius = [1, 2]", "radius = 4 cm",
                           "radius = 1\nradius = 1"})
    CHECK(refused(text) == "radius is not one value\n");
  CHECK(refused("radius = 1\ngravity = 9\nradius = 1") == "radius is there twice\n");
  for (const char* text : {"0x1", "1_0", "inf", "1e", "\"1", "1\"", "\\u0031", "{a=1}", "true"})
    CHECK(refused("radius = " + std::string(text)) ==
          fmt::format("-R,--radius: '{}' is not a number (decimal point, no unit)\n", text));
  CHECK(refused("exact") == "0 ");
  for (const char* text :
       {"raduis = 1", "Radius = 1", "[radius]\na = 1", "a.radius = 1", "--scene"})
    CHECK(refused(text).find("a scene has no '") == 0);

  // Words are what they are, brackets and all.
  CHECK(given({"--word", "[a,b]", "--word", "\x01[c]", "--word={}"}, {}) == "0 ");
  CHECK(operands == std::vector<std::string>{"[a,b]", "\x01[c]", "{}"});
}
