// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/scene.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "text/input.h"
#include "text/number.h"

namespace rolling {
namespace {

constexpr std::size_t largest_file = 1 << 16;

/// The keys of a scene. A tool ignores those that it does not need.
constexpr std::array<std::string_view, 12> keys = {
    "mass",     "radius", "shape-factor", "gravity", "slope",  "coefficient",
    "exponent", "exact",  "v0",           "x0",      "memory", "damping"};

bool in_key(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '_';
}

bool is_control(char c) { return static_cast<unsigned char>(c) < ' ' && c != '\t'; }

/// True for a comment or a blank text.
bool is_comment(std::string_view text) {
  text = trim(text);
  return text.empty() ||
         (text.front() == '#' && std::none_of(text.begin(), text.end(), is_control));
}

/// The end of the value at the beginning of `text`; 0 if there is none.
std::size_t end_of_value(std::string_view text) {
  if (text.empty()) return 0;
  const char quote = text.front();
  if (quote == '"' || quote == '\'') {
    const auto end = text.find(quote, 1);
    if (end == std::string_view::npos) return 0;
    const std::string_view inside = text.substr(1, end - 1);
    const auto is_special = [](char c) {
      return c == '"' || c == '\'' || c == '\\' || c == '#' || is_control(c);
    };
    return std::any_of(inside.begin(), inside.end(), is_special) ? 0 : end + 1;
  }
  const auto end = std::min(text.find_first_of(" \t#"), text.size());
  const std::string_view word = text.substr(0, end);
  return is_number(word) || word == "true" || word == "false" ? end : 0;
}

/// Reads `key = value` with an optional comment. A line that is accepted has the same meaning in
/// TOML.
SceneValue read_line(std::string_view line) {
  const auto key_end = std::find_if_not(line.begin(), line.end(), in_key);
  const std::string_view key(line.begin(), key_end);
  std::string_view value = trim(line.substr(key.size()));
  if (key.empty() || !value.starts_with('='))
    fail("'{}' is neither `key = value` nor a comment", shown(line));
  value = trim(value.substr(1));
  const auto end = end_of_value(value);
  if (end == 0 || !is_comment(value.substr(end)))
    fail("{}: '{}' is neither a number, true, false nor a string in quotes", shown(key),
         shown(value));
  if (std::find(keys.begin(), keys.end(), key) == keys.end())
    fail("a scene has no '{}'; it has mass, radius, shape-factor, ...", shown(key));
  const bool quoted = value.front() == '"' || value.front() == '\'';
  value = quoted ? value.substr(1, end - 2) : value.substr(0, end);
  return {std::string(key), std::string(value), 0};
}

}  // namespace

std::vector<SceneValue> read_scene(const std::string& file) {
  Input input(file);
  std::vector<SceneValue> scene;
  std::size_t bytes = 0;
  for (std::string_view line; input.next(line); ++bytes) {  // and its line feed
    bytes += line.size();
    if (bytes > largest_file)
      fail<InputError>("{}: a scene file is at most {} bytes", file, largest_file);
    if (is_comment(line)) continue;
    try {
      SceneValue value = read_line(trim(line));
      for (const SceneValue& earlier : scene)
        if (earlier.key == value.key) fail("{} is in line {} too", value.key, earlier.line);
      value.line = input.line_number();
      scene.push_back(std::move(value));
    } catch (const Error& error) {
      fail<InputError>("{}:{}: {}", file, input.line_number(), error.what());
    }
  }
  return scene;
}

}  // namespace rolling
