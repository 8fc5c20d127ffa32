// Scene files: the options that describe a roll, by their long names, in a TOML file.
#pragma once

#include <string>
#include <vector>

namespace rolling {

struct SceneValue {
  std::string key;    ///< the long name of an option
  std::string value;  ///< as it stands, without quotes
  std::size_t line;   ///< counted from 1
};

/// Reads a scene file of at most 64 KiB: a line is blank, a comment (#), or `key = value` with a
/// comment behind it perhaps. A value is a number, true, false, or a string in single or double
/// quotes without backslash, quote and #. A key is one of a scene and stands once. These files are
/// TOML; what else TOML allows (tables, arrays, dates, escapes) is refused. Throws InputError,
/// which names file and line.
std::vector<SceneValue> read_scene(const std::string& file);

}  // namespace rolling
