// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/fit_line_written.h"

#include <algorithm>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <iterator>
#include <span>

#include "base/version.h"
#include "cli/fit_line.h"
#include "text/column.h"
#include "text/number.h"

namespace rolling {

std::string line_of_fit(const std::string& route, const FitOptions& options,
                        const std::vector<std::optional<ShiftOf>>& of_runs) {
  const LawForm& law = *options.law;
  std::string line = fmt::format("fitpower {} {}", version(), route);
  if (!options.fits_power()) line += ' ' + replace_all(law.formula, {{" + ", "+"}, {" ", "*"}});
  const auto known = [&](const std::optional<ShiftOf>& of) {
    return of && of->geometry == of_runs.front()->geometry;
  };
  if (!std::ranges::all_of(of_runs, known)) return line;
  const auto words = std::span(words_of_body).first(std::size(words_of_body) - (law.drag < 0));
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

}  // namespace rolling
