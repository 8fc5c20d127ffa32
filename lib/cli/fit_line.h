// SPDX-License-Identifier: GPL-3.0-or-later
// The bodies in `##` lines: behind which body, slope and geometry numbers were made.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fit/input.h"

namespace rolling {

/// A number in the line.
struct Word {
  const char* name;
  double Body::*value;
  double Body::*sigma;                    ///< nullptr for one without an uncertainty
  bool FitOptions::*is_fitted = nullptr;  ///< the rows then have it
};
inline constexpr Word words_of_body[] = {
    {"K", &Body::K, &Body::sigma_K},
    {"R", &Body::R, &Body::sigma_R},
    {"g", &Body::g, &Body::sigma_g},
    {"slope", &Body::slope, &Body::sigma_slope, &FitOptions::fit_slope},
    {"wind", &Body::wind, nullptr, &FitOptions::fit_wind}};

/// The contact of each of so many rows in the words `K 0.5 R 0.04,0.05 g 9.81 [slope S] [wind W]
/// [exact]`; NaN for a slope and a wind that are in the rows. Empty if they are of more runs than
/// rows, nothing for other words.
std::optional<std::vector<ShiftOf>> read_contacts(std::span<const std::string> words,
                                                  std::size_t rows);

/// The same from the line of fitpower above the rows. Empty if there is no such line, or if it has
/// no numbers. Throws Error for a line that fitpower does not write.
std::vector<ShiftOf> contacts_of_rows(const std::vector<std::string>& lines, std::size_t rows);

}  // namespace rolling
