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
    tool.add(
        "FILE", "", "", [&](const auto& word) { operands.push_back(word); }, Tool::Values::many);
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
  CHECK(given({}, {"radius"}) ==
        "2 tool: neither given nor in a scene: --radius (-R, in metres)\n");
  CHECK(given({"-K", "1"}, {"mass", "radius", "shape-factor"}) ==
        "2 tool: neither given nor in a scene: --mass and --radius (-R, in metres)\n");
  CHECK(given({}, {"mass", "radius", "shape-factor"}) ==
        "2 tool: neither given nor in a scene: --mass, --radius (-R, in metres) and "
        "--shape-factor (-K, 0.5 for a solid cylinder)\n");

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
                      before = "2 tool: FILE:";
    return said.starts_with(before) ? said.substr(before.size()) : said;
  };
  for (const char* text : {"", "# [a]\n\nradius = 0.04 # m, \"R\" = 2\r\n", "radius='.04'",
                           "\xEF\xBB\xBFgravity = 9.81\n", "v0 = 1\nx0 = 0\nmass = -1\n",
                           "radius = \"0.04\" # \"", "exact = true", "exact = \"true\""})
    CHECK(refused(text) == "0 ");
  // As written, no line of a scene has another meaning than in TOML, where all but the last three
  // are something else than a number, a string, true or false.
  for (const char* text :
       {"1 2",           "[1, 2]",     "[0.045", "[0.045]",  "0x1",  "1_0",     "inf",
        "{a=1}",         "1979-05-27", "\"1",    "1\"",      "'1",   "\"1\" 2", "\"1\\\"2\"",
        "\"\"\"1\"\"\"", "\\u0031",    "True",   "0.5+-0.1", "0,04", "4 cm",    "1e"})
    CHECK(refused("mass = 1\nradius = " + std::string(text)) ==
          fmt::format("2: 'radius = {}' is not KEY = VALUE with a number (decimal point, no unit), "
                      "true, false, or a text in quotes\n",
                      text));
  for (const char* text : {"exact", "[radius]\na = 1", "--scene", "= 1 2", "[[a]]", "radius ="})
    CHECK(refused(text).find(" is not KEY = VALUE with a number") != std::string::npos);
  CHECK(refused("radius = 1\nradius = 1") == "2: radius is there twice\n");
  CHECK(refused("radius = 1\n\ngravity = 9\nradius = 1") == "4: radius is there twice\n");
  for (const char* text : {"true", "\"1e\"", "'0,04'", "\"1 2\""})
    CHECK(refused("radius = " + std::string(text)) ==
          fmt::format("1: -R,--radius: '{}' is not a number (decimal point, no unit)\n",
                      replace_all(text, {{"'", ""}, {"\"", ""}})));
  for (const char* text : {"raduis = 1", "Radius = 1", "a.radius = 1", "; radius = 1", "= 1"})
    CHECK(refused(text).find("1: a scene has no '") == 0);

  // Words are what they are, brackets and all, as values of options and as operands.
  CHECK(given({"--word", "[a,b]", "--word", "\x01[c]", "--word={}"}, {}) == "0 ");
  CHECK(operands == std::vector<std::string>{"[a,b]", "\x01[c]", "{}"});
  const std::vector<std::string> files = {"[a,g]", "[]",    "[[x]]", "b]",
                                          "[",     "{c,d}", "\"e\"", "[\"f\"]"};
  operands.clear();
  CHECK(given(files, {}) == "0 ");
  CHECK(operands == files);
  operands.clear();
  CHECK(given({"--", "[a,g]", "-m", "[b]"}, {}) == "0 ");
  CHECK(operands == std::vector<std::string>{"[a,g]", "-m", "[b]"});
}
