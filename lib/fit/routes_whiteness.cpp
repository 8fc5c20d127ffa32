// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/golden_section.h"
#include "fit/routes.h"

namespace rolling {
namespace {

/// The model with the first `rows` of each run alone.
Model heads_of(const Model& model, std::size_t rows) {
  std::vector<ObservedRun> runs = model.runs();
  for (ObservedRun& run : runs) {
    Rows first(std::min(rows, run.y.size()));
    std::iota(first.begin(), first.end(), std::size_t{0});
    run.y.resize(first.size());
    run.H = std::make_shared<const BandMatrix>(run.H->of_rows(first));
  }
  return {std::move(runs), model.parameters()};
}

}  // namespace

WhiteShare most_likely_share(const Model& model, const std::vector<double>& theta, double least,
                             double most) {
  const Model heads = heads_of(model, searched_for_white_noise);
  const System linear = linearised(system_of(heads), theta);
  std::vector<Covariance> noise;
  for (const ObservedRun& run : heads.runs()) noise.emplace_back(*run.H);
  const auto likelihood = [&](double share) {
    double log_size = 0;
    System weighted = linear;
    weighted.evaluate = [&](const std::vector<double>& delta, const TakeRows& take) {
      linear.evaluate(delta, [&](std::size_t r, std::span<double> f, std::span<double> J) {
        const Whitener whitener(noise[r], share);
        log_size += whitener.log_size();
        whitener.apply(f);
        whitener.apply(J);
        take(r, f, J);
      });
    };
    const double of_weighted =
        restricted_likelihood(evaluated(weighted, std::vector<double>(theta.size())));
    return of_weighted - log_size;
  };
  const Largest found = golden_section(std::log(least), std::log(most), 0.1,
                                       [&](double log) { return likelihood(std::exp(log)); });
  return {std::exp(found.at), found.value, found.value - likelihood(0)};
}

}  // namespace rolling
