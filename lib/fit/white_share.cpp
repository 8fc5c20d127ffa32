// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/white_share.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/golden_section.h"
#include "least_squares/minimise.h"

namespace rolling {

namespace {

/// The unweighted residuals at the beginning of a run, their Jacobian, and the covariance of their
/// noise.
struct Linearised {
  Covariance noise;
  std::vector<double> columns;  // f, then the columns of J
};

/// Takes as many residuals of each run as the system has.
std::vector<Linearised> linear_around(const std::vector<double>& theta, const System& system,
                                      const RollModel& model) {
  std::vector<Linearised> runs;
  for (std::size_t r = 0; r < system.runs.size(); ++r)
    runs.push_back({Covariance(*model.runs()[r].H, system.runs[r]),
                    std::vector<double>(system.runs[r] * (1 + system.columns()))});
  std::vector<std::size_t> done(runs.size());
  system.evaluate(theta, [&](std::size_t r, std::span<double> f, std::span<double> J) {
    const std::size_t n = system.runs[r], few = std::min(f.size(), n - done[r]);
    double* to = runs[r].columns.data() + std::exchange(done[r], done[r] + few);
    std::copy_n(f.begin(), few, to);
    for (std::size_t j = 0; j < J.size(); j += f.size()) std::copy_n(&J[j], few, to += n);
  });
  return runs;
}

}  // namespace

WhiteShare most_likely_share(const std::shared_ptr<const RollModel>& model,
                             const std::vector<double>& theta, double least, double most) {
  System system = system_of(model, std::make_shared<const Noise>());
  for (std::size_t& rows : system.runs) rows = std::min(rows, searched_for_white_noise);
  const std::vector<Linearised> runs = linear_around(theta, system, *model);
  const auto likelihood = [&](double share) {
    double log_size = 0;
    system.evaluate = [&](const std::vector<double>&, const TakeRows& take) {
      for (std::size_t r = 0; r < runs.size(); ++r) {
        const Whitener whitener(runs[r].noise, share);
        log_size += whitener.log_size();
        std::vector<double> columns = runs[r].columns;
        whitener.apply(columns);
        take(r, std::span(columns).first(system.runs[r]),
             std::span(columns).subspan(system.runs[r]));
      }
    };
    const double of_weighted = restricted_likelihood(system, theta);
    return of_weighted - log_size;
  };
  const Largest found = golden_section(std::log(least), std::log(most), 0.1,
                                       [&](double log) { return likelihood(std::exp(log)); });
  return {std::exp(found.at), found.value, found.value - likelihood(0)};
}

}  // namespace rolling
