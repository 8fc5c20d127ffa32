// SPDX-License-Identifier: GPL-3.0-or-later
// A tool as a whole: the first line is its command line, the rest is its standard input. TOOL is
// its name, tool_main its main().
#include <cstdint>
#include <sstream>
#include <vector>

#include "streams.h"

int tool_main(int argc, char** argv);

namespace {

/// Comments and names may say anything; a computed number is finite. Fields that pass through may
/// not be told from computed ones, so an input that has these letters in it is left alone.
bool has_no_number(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    if (!line.starts_with('#') &&
        (line.find("nan") != std::string_view::npos || line.find("inf") != std::string_view::npos))
      return true;
    at = end + 1;
  }
  return false;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view input = text.substr(std::min(end + 1, text.size()));
  std::vector<std::string> words = {TOOL};
  std::istringstream line{std::string(text.substr(0, end))};
  for (std::string word; line >> word;) words.push_back(word);
  for (const std::string& word : words)
    if (word.find('/') != std::string::npos || word.starts_with("--rep"))
      return 0;  // no files, and no measurements of time
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const Ran ran = with_streams(
      input, [&] { return tool_main(static_cast<int>(words.size()), arguments.data()); });
  check_contract(ran, TOOL);
  if (ran.status == 0 && !has_no_number(input) &&
      input.find_first_of("nN") == std::string_view::npos &&
      input.find_first_of("iI") == std::string_view::npos)
    require(!has_no_number(ran.out), "nan or inf with exit 0", ran.out);
  return 0;
}
