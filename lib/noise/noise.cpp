// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise/noise.h"

#include <utility>

#include "base/matrix.h"

namespace rolling {
namespace {

/// Concatenates the results of function(run number, part) for the parts of the runs.
std::vector<double> each(const auto& parts, auto&& function) {
  std::vector<double> result;
  for (std::size_t r = 0; r < parts.size(); ++r) {
    std::vector<double> part = function(r, parts[r]);
    if (result.empty()) result = std::move(part);
    else result.insert(result.end(), part.begin(), part.end());
  }
  return result;
}

}  // namespace

Noise::Noise(std::vector<Filters> E, AddedNoise added) : E_(std::move(E)), added_(added) {
  for (const Filters& E_of_run : E_) {
    rows_.push_back(E_of_run->rows());
    sources_.push_back(E_of_run->columns());
    whiteners_.emplace_back(Covariance(*E_of_run), added.share);
  }
}

std::vector<double> Noise::to_sources(std::vector<double> x) const {
  return each(by_run(x, rows_), [&](std::size_t r, auto of_run) {
    whiteners_[r].apply_transposed(of_run);
    return E_[r]->transposed_times(of_run);
  });
}

std::size_t Noise::informative() const {
  std::size_t count = 0;
  for (std::size_t r = 0; r < rows_.size(); ++r)
    for (std::size_t i = 0; i < rows_[r]; ++i) count += whiteners_[r].informative(i);
  return count;
}

std::vector<double> Noise::innovations(const std::vector<double>& f,
                                       std::vector<std::size_t>& runs) const {
  runs.clear();
  return each(by_run(f, rows_), [&](std::size_t r, auto f_of) {
    std::vector<double> few;
    few.reserve(f_of.size());
    for (std::size_t i = 0; i < rows_[r]; ++i)
      if (whiteners_[r].informative(i)) few.push_back(f_of[i]);
    runs.push_back(few.size());
    return few;
  });
}

}  // namespace rolling
