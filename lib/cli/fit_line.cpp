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

namespace {

/// A number in the line.
struct Word {
  const char* name;
  double Body::*value;
  double Body::*sigma;                    ///< nullptr for one without an uncertainty
  bool FitOptions::*is_fitted = nullptr;  ///< the rows then have it
};
constexpr Word words_of_body[] = {
    {"K", &Body::K, &Body::sigma_K},
    {"R", &Body::R, &Body::sigma_R},
    {"g", &Body::g, &Body::sigma_g},
    {"slope", &Body::slope, &Body::sigma_slope, &FitOptions::fit_slope},
    {"wind", &Body::wind, nullptr, &FitOptions::fit_wind}};
constexpr std::size_t without_wind = std::size(words_of_body) - 1;

}  // namespace

std::string line_of_fit(const std::string& route, const FitOptions& options,
                        const std::vector<std::optional<ShiftOf>>& of_runs) {
  const LawForm& law = *options.law;
  std::string line = fmt::format("fitpower {} {}", version(), route);
  if (!options.fits_power()) line += ' ' + replace_all(law.formula, {{" + ", "+"}, {" ", "*"}});
  const auto known = [&](const std::optional<ShiftOf>& of) {
    return of && of->geometry == of_runs.front()->geometry;
  };
  if (!std::ranges::all_of(of_runs, known)) return line;
  const auto words = std::span(words_of_body).first(without_wind + (law.drag >= 0));
  for (const auto& [name, value, sigma, is_fitted] : words) {
    std::vector<std::string> texts;
    for (const auto& of : of_runs)
      texts.push_back(to_text({of->body.*value, sigma ? of->body.*sigma : 0}));
    if (std::ranges::count(texts, texts.front()) == std::ssize(texts)) texts.resize(1);
    if (is_fitted && options.*is_fitted) texts = {"fit"};
    line += fmt::format(" {} {}", name, fmt::join(texts, ","));
  }
  if (of_runs.front()->geometry == Geometry::exact) line += " exact";
  return line;
}

std::vector<ShiftOf> contacts_of_rows(const std::vector<std::string>& lines, std::size_t rows) {
  const auto is_of_fit = [](const std::string& line) {
    return split_names(line, '\0').front() == "fitpower";
  };
  const auto line = std::ranges::find_if(lines, is_of_fit);
  if (line == lines.end()) return {};
  const auto believe = [&](bool is_right) {
    if (!is_right) fail("`## {}` is not what fitpower writes", shown(*line));
  };
  const std::vector<std::string> words = split_names(*line, '\0');
  const auto first = std::ranges::find(words, words_of_body[0].name);
  believe(words.size() >= 3 && first - words.begin() <= 4);
  auto numbers = std::span(first, words.end());
  if (numbers.empty()) return {};
  const bool exact = numbers.back() == "exact";
  if (exact) numbers = numbers.first(numbers.size() - 1);
  const std::size_t count = numbers.size() / 2;
  believe(numbers.size() % 2 == 0 && (count == without_wind || count == without_wind + 1));
  std::vector<ShiftOf> contacts(rows);
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [name, value, sigma, is_fitted] = words_of_body[i];
    const std::vector<std::string> texts = split_names(numbers[2 * i + 1], ',');
    believe(numbers[2 * i] == name);
    if (texts.size() != 1 && texts.size() != rows) return {};
    for (std::size_t row = 0; row < rows; ++row) {
      const std::string& text = texts[texts.size() == 1 ? 0 : row];
      Estimate read{NAN};
      believe(parse_estimate(text, read) || (text == "fit" && is_fitted));
      contacts[row].body.*value = read.value;
      if (sigma) contacts[row].body.*sigma = read.sigma;
      if (exact) contacts[row].geometry = Geometry::exact;
    }
  }
  return contacts;
}

}  // namespace rolling
