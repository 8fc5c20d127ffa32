// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/fit_line.h"

#include <algorithm>
#include <cmath>
#include <fmt/ranges.h>
#include <span>

#include "base/error.h"
#include "base/version.h"
#include "text/column.h"
#include "text/number.h"

namespace rolling {

std::string line_of_fit(const std::string& route, const LawForm& law,
                        const std::vector<std::optional<ShiftOf>>& of_runs, bool fits_slope) {
  std::string line = fmt::format("fitpower {} {}", version(), route);
  if (&law != &laws().front()) line += ' ' + replace_all(law.formula, {{" + ", "+"}, {" ", "*"}});
  const auto known = [&](const std::optional<ShiftOf>& of) {
    return of && of->geometry == of_runs.front()->geometry;
  };
  if (!std::ranges::all_of(of_runs, known)) return line;
  for (const UncertainNumber& number : uncertain_numbers) {
    std::vector<std::string> texts;
    for (const auto& of : of_runs)
      texts.push_back(to_text({of->body.*number.value, of->body.*number.sigma}));
    if (std::ranges::count(texts, texts.front()) == std::ssize(texts)) texts.resize(1);
    if (fits_slope && number.value == &Body::slope) texts = {"fit"};
    line += fmt::format(" {} {}", number.name, fmt::join(texts, ","));
  }
  if (of_runs.front()->geometry == Geometry::exact) line += " exact";
  return line;
}

std::vector<ShiftOf> contacts_of_rows(const std::vector<std::string>& lines, std::size_t rows) {
  for (const std::string& line : lines) {
    const auto words = split_names(line, '\0');
    if (words.front() != "fitpower") continue;
    const auto believe = [&](bool is_right) {
      if (!is_right) fail("`## {}` is not what fitpower writes", shown(line));
    };
    const auto first = std::ranges::find(words, uncertain_numbers.front().name);
    const auto numbers = std::span(first, words.end());
    const bool exact = !numbers.empty() && numbers.back() == "exact";
    believe(first - words.begin() <= 4 && words.size() >= 3);
    if (numbers.empty()) return {};
    believe(numbers.size() == 2 * uncertain_numbers.size() + exact);
    std::vector<ShiftOf> contacts(rows);
    for (std::size_t i = 0; i < uncertain_numbers.size(); ++i) {
      const UncertainNumber& number = uncertain_numbers[i];
      believe(numbers[2 * i] == number.name);
      const std::vector<std::string> texts = split_names(numbers[2 * i + 1], ',');
      if (texts.size() != 1 && texts.size() != rows) return {};
      for (std::size_t row = 0; row < rows; ++row) {
        const std::string& text = texts[texts.size() == 1 ? 0 : row];
        Estimate read{NAN};
        believe(parse_estimate(text, read) || (text == "fit" && number.value == &Body::slope));
        contacts[row].body.*number.value = read.value;
        contacts[row].body.*number.sigma = read.sigma;
        if (exact) contacts[row].geometry = Geometry::exact;
      }
    }
    return contacts;
  }
  return {};
}

}  // namespace rolling
