#include "fit/white_share.h"

#include "base/golden_section.h"

#include <algorithm>
#include <cmath>

namespace rolling {
namespace {

/// The unweighted residuals of a run, their Jacobian, and the covariance of their noise.
struct Linear {
  Covariance noise;
  double norm;                  // norm of the median row of H
  std::vector<double> columns;  // f of the whole run, then the columns of J
};

std::vector<Linear> linear_around(const std::vector<double>& theta, const System& system,
                                  const RollModel& model) {
  std::vector<Linear> runs;
  std::vector<double*> next;  // place of the next f of each run
  for (const ObservedRun& run : model.runs()) {
    Covariance noise(*run.H);
    const double norm = noise.median_norm();
    runs.push_back(
        {std::move(noise), norm, std::vector<double>(run.y.size() * (1 + system.columns()))});
    next.push_back(runs.back().columns.data());
  }
  system.evaluate(theta, [&](std::size_t r, std::span<double> f, std::span<double> J) {
    double* to = std::exchange(next[r], next[r] + f.size());
    std::copy(f.begin(), f.end(), to);
    for (std::size_t j = 0; j < J.size(); j += f.size())
      std::copy_n(&J[j], f.size(), to += system.runs[r]);
  });
  return runs;
}

}  // namespace

WhiteShare most_likely_share(const std::shared_ptr<const RollModel>& model,
                             const std::vector<double>& theta, double least, double most,
                             double other) {
  System system = system_of(model, std::make_shared<const Noise>());
  const std::vector<Linear> runs = linear_around(theta, system, *model);
  const auto likelihood = [&](double log_share) {
    double log_size = 0;
    system.evaluate = [&](const std::vector<double>&, const TakeRows& take) {
      for (std::size_t r = 0; r < runs.size(); ++r) {
        const Whitener whitener(runs[r].noise, std::exp(log_share) * runs[r].norm);
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
  const Largest found = golden_section(std::log(least), std::log(most), 0.1, likelihood);
  return {std::exp(found.at), found.value - likelihood(std::log(other))};
}

}  // namespace rolling
