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
