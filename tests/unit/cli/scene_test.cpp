// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/scene.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <random>
#include <regex>
#include <set>
#include <sstream>

#include "unit/catch.h"
#include "unit/text/files.h"

using namespace rolling;

namespace {

/// "key=value key=value ", or the number of the line that is refused.
std::string read(const std::string& text) {
  const TemporaryFile file(text);
  std::string read;
  try {
    for (const SceneValue& value : read_scene(file.name())) {
      read += value.key + '=' + value.value + ' ';
      // The line that is named is the one where the key stands.
      std::istringstream lines(text);
      std::string line;
      for (std::size_t i = 0; i < value.line; ++i) std::getline(lines, line);
      CHECK(line.find(value.key) != std::string::npos);
    }
  } catch (const InputError& error) {
    const std::string said = error.what(), head = file.name() + ':';
    REQUIRE(said.substr(0, head.size()) == head);
    return "refused in line " + std::to_string(std::stoi(said.substr(head.size())));
  }
  return read;
}

/// The same by regular expressions, which are the grammar of scene.h written another way.
std::string read_by_grammar(const std::string& text) {
  static const std::regex nothing("[ \t]*(#[^\\x00-\\x08\\x0a-\\x1f]*)?");
  static const std::regex assignment(
      "[ \t]*([A-Za-z0-9_-]+)[ \t]*=[ \t]*"
      "([+-]?(?:[0-9]+\\.?[0-9]*|\\.[0-9]+)(?:[eE][+-]?[0-9]+)?|true|false|"
      "\"[^\"'\\\\#\\x00-\\x08\\x0a-\\x1f]*\"|'[^\"'\\\\#\\x00-\\x08\\x0a-\\x1f]*')"
      "[ \t]*(#[^\\x00-\\x08\\x0a-\\x1f]*)?");
  static const std::set<std::string> known = {"mass",  "radius",      "shape-factor", "gravity",
                                              "slope", "coefficient", "exponent",     "exact",
                                              "v0",    "x0",          "memory",       "damping"};
  std::istringstream lines(text);
  std::set<std::string> seen;
  std::string line, read;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::smatch parts;
    if (std::regex_match(line, nothing)) continue;
    if (!std::regex_match(line, parts, assignment) || !known.count(parts[1]) ||
        !seen.insert(parts[1]).second)
      return "refused in line " + std::to_string(number);
    std::string value = parts[2];
    if (value.front() == '"' || value.front() == '\'') value = value.substr(1, value.size() - 2);
    read += parts[1].str() + '=' + value + ' ';
  }
  return read;
}

/// A scene of some lines, all of them right.
class Scenes {
 public:
  explicit Scenes(unsigned seed) : random_(seed) {}

  std::string valid() {
    std::vector<std::string> keys = {"mass",     "radius", "shape-factor", "gravity", "slope",
                                     "exponent", "exact",  "v0",           "x0",      "memory"};
    std::shuffle(keys.begin(), keys.end(), random_);
    keys.resize(one_of(6U));
    std::string text;
    for (const std::string& key : keys) {
      if (one_of(4U) == 0)
        text += pick({"", "# a comment", " \t", "#", "# 'x' = [1, \"", "#\xe9"}) + end();
      text += blank() + key + blank() + '=' + blank() + value() + blank() +
              pick({"", "", "", "#", "# m, \"R\" = 2"}) + end();
    }
    if (!text.empty() && one_of(5U) == 0) text.pop_back();  // the last line may lack its end
    return text;
  }

  /// With a byte changed, left out or put in, or a line of another kind put in.
  std::string damaged() {
    std::string text = valid();
    const std::string odd = "=#'\"[],.;{}\\ \t\r\n\x01\x7f+-e_1a`%";
    const std::size_t at = one_of(text.size() + 1);
    switch (one_of(4U)) {
      case 0:
        return text.insert(at, 1, odd[one_of(odd.size())]);
      case 1:
        return at < text.size() ? text.erase(at, 1) : text;
      case 2:
        if (at < text.size()) text[at] = odd[one_of(odd.size())];
        return text;
      default: {
        const std::size_t line = text.rfind('\n', at);
        return text.insert(line == std::string::npos ? 0 : line + 1,
                           pick({"[default]\n",
                                 "[[a]]\n",
                                 "; note\n",
                                 "x\n",
                                 "=1\n",
                                 "m=\n",
                                 "mass\n",
                                 "a.b = 1\n",
                                 "\"mass\" = 1\n",
                                 "radius = [1, 2]\n",
                                 "radius = [\n",
                                 "radius = 1, 2\n",
                                 "radius = 1 2\n",
                                 "radius = {a = 1}\n",
                                 "radius = \"\"\"1\"\"\"\n",
                                 "radius = \"1\" 2\n",
                                 "radius = 1_0\n",
                                 "radius = 0x1\n",
                                 "radius = inf\n",
                                 "radius = 1e\n",
                                 "Radius = 1\n",
                                 "radius = 2026-01-01\n",
                                 "radius=\"\\u0031\"\n"}));
      }
    }
  }

 private:
  std::size_t one_of(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
  }
  std::string pick(std::vector<std::string> texts) { return texts[one_of(texts.size())]; }
  std::string end() { return pick({"\n", "\n", "\n", "\r\n"}); }
  std::string blank() { return pick({"", " ", " ", "\t "}); }
  std::string value() {
    return pick({"0.5", "1", "-0.215", "1.87e-3", ".5", "5.", "+1E5", "true", "false", "\"0.5\"",
                 "'0.5'", "\"0.50 +- 0.005\"", "'0.5,0.83'", "\"a=b;c [d]\"", "\"\"",
                 "\"\xc3\xa9\""});
  }

  std::mt19937_64 random_;
};

}  // namespace

TEST_CASE("scene: right and damaged files are read as the grammar reads them", "[cli]") {
  Scenes scenes(1);
  int accepted = 0, refused = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::string text = i % 4 ? scenes.damaged() : scenes.valid();
    CAPTURE(text);
    const std::string expected = read_by_grammar(text);
    REQUIRE(read(text) == expected);
    const bool is_refused = expected.starts_with("refused");
    if (i % 4 == 0) REQUIRE(!is_refused);
    ++(is_refused ? refused : accepted);
  }
  CHECK(accepted > 600);
  CHECK(refused > 600);
}

TEST_CASE("scene: a file is at most 64 KiB", "[cli]") {
  const auto scene = [](std::size_t size) {
    const std::string head = "radius = 1\n#";
    return head + std::string(size - head.size(), 'x');
  };
  CHECK(read(scene(65536)) == "radius=1 ");
  const TemporaryFile large(scene(65537));
  CHECK(anonymous(refusal([&] { read_scene(large.name()); })) ==
        "FILE: a scene file is at most 65536 bytes");
}

TEST_CASE("scene: a byte order mark, and a key that stands twice", "[cli]") {
  CHECK(read("\xEF\xBB\xBFradius = 1\n") == "radius=1 ");
  CHECK(read("\xEF\xBB\xBFradius = 1\n\xEF\xBB\xBF\xEF\xBB\xBFgravity = 9.8\n") ==
        "radius=1 gravity=9.8 ");
  const TemporaryFile twice("radius = 1\n\nradius = 1\n");
  CHECK(anonymous(refusal([&] { read_scene(twice.name()); })) == "FILE:3: radius is in line 1 too");
}
