// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/fit_line.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/error.h"
#include "text/column.h"
#include "text/number.h"

namespace rolling {

std::optional<std::vector<ShiftOf>> read_contacts(std::span<const std::string> words,
                                                  std::size_t rows) {
  std::vector<ShiftOf> contacts(rows, {{NAN, NAN, NAN, NAN}});
  auto number = std::begin(words_of_body);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "exact") {
      for (ShiftOf& contact : contacts) contact.geometry = Geometry::exact;
      continue;
    }
    number = std::find_if(number, std::end(words_of_body),
                          [&](const Word& word) { return word.name == words[i]; });
    if (number == std::end(words_of_body) || ++i == words.size()) return {};
    const std::vector<std::string> texts = split_names(words[i], ',');
    if (texts.size() != 1 && texts.size() != rows) return std::vector<ShiftOf>{};
    for (std::size_t row = 0; row < rows; ++row) {
      const std::string& text = texts[texts.size() == 1 ? 0 : row];
      Estimate read{NAN};
      if (!parse_estimate(text, read) && !(text == "fit" && number->is_fitted)) return {};
      contacts[row].body.*number->value = read.value;
      if (number->sigma) contacts[row].body.*number->sigma = read.sigma;
    }
  }
  for (const auto& [body, geometry] : contacts)
    if (!(body.K >= 0 && body.R > 0 && body.g > 0)) return {};
  return contacts;
}

std::vector<ShiftOf> contacts_of_rows(const std::vector<std::string>& lines, std::size_t rows) {
  for (const std::string& line : lines) {
    const std::vector<std::string> words = split_names(line, '\0');
    if (words.front() != "fitpower") continue;
    const auto numbers = std::ranges::find(words, words_of_body[0].name);
    if (words.size() >= 3 && numbers == words.end()) return {};
    const auto contacts = read_contacts({numbers, words.end()}, rows);
    if (numbers - words.begin() > 4 || !contacts)
      fail("`## {}` is not what fitpower writes", shown(line));
    return *contacts;
  }
  return {};
}

}  // namespace rolling
