// SPDX-License-Identifier: GPL-3.0-or-later
// Scene files: TOML files with the long names of the options that describe a roll.
#pragma once

#include <string>
#include <vector>

namespace rolling {

struct SceneValue {
  std::string key;    ///< the long name of an option
  std::string value;  ///< as in the file, without quotes
  std::size_t line;   ///< counted from 1
};

/// Reads a scene file of at most 64 KiB. Each line is blank, a comment (#), or `key = value`, which
/// a comment may follow. A value is a number, true, false, or a string in single or double quotes
/// that contains no backslash, no quote and no #. Each key may occur once. These files are TOML;
/// other TOML (tables, arrays, dates, escapes) is refused. Throws InputError with file and line.
std::vector<SceneValue> read_scene(const std::string& file);

}  // namespace rolling
