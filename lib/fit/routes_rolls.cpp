// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/routes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "base/golden_section.h"
#include "base/matrix.h"
#include "least_squares/minimise.h"

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

/// Throws Error if a v0 that is fixed has the other sign than the motion of a run.
void require_ways(const std::vector<ObservedRun>& runs, const FitOptions& options) {
  for (const ObservedRun& run : runs)
    if (options.v0 && run.way * *options.v0 < 0)
      fail("{}v0 = {} cannot be fixed: the body rolls towards {} x", run.place, *options.v0,
           run.way > 0 ? "growing" : "falling");
}

/// Removes from `rows` the rows whose fitted speed is below the limit; returns whether there
/// were any. The fitted speed decides, because a threshold on noisy speeds would select rows by
/// their noise.
bool leave_out_slow(const Model& model, const std::vector<double>& theta,
                    const std::vector<Run>& all, std::vector<Rows>& rows, double limit) {
  std::size_t slow = 0;
  for (std::size_t r = 0; r < all.size(); ++r) {
    Roll fitted = model.roll(theta, r);
    slow += std::erase_if(rows[r], [&](std::size_t i) {
      return std::abs(fitted.at(all[r].t[i] - model.runs()[r].origin).v) < limit;
    });
  }
  return slow > 0;
}

/// The sum of squares of the residuals without weights.
double unweighted(const Fitted& fit) {
  return evaluated(system_of(fit.model.unweighted()), fit.minimum.theta).rss;
}

/// True if the weighted sum of squares is more than four times what the unweighted residuals and
/// the filters predict, that is, if the columns hold noise that did not pass the filters.
bool rounded(const Fitted& fit) {
  if (!fit.noise().from_sources_alone()) return false;
  double variances = 0;
  const std::vector<std::size_t> rows = fit.model.rows();
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t i = 0; i < rows[r]; ++i) variances += fit.noise().whitener(r).variance(i);
  return fit.minimum.rss * variances >
         4 * unweighted(fit) * static_cast<double>(fit.minimum.f.size());
}

/// Columns that were rounded after a filter hold additional white noise. Its share is estimated by
/// restricted likelihood, and the fit is repeated with the new weights. In few rows the
/// residuals may be large by chance: there the likelihood decides.
void allow_for_rounding(Fitted& fit, const FitOptions& options) {
  if (!rounded(fit)) return;
  const bool many = std::ranges::max(fit.model.rows()) > searched_for_white_noise;
  fit.model = fit.model.unweighted();  // frees memory: the search needs as much
  const WhiteShare found = most_likely_share(fit.model, fit.minimum.theta, 1e-7, 100);
  const bool adopted = many || found.decisive();
  fit.model = fit.model.weighted({adopted ? found.share : 0});
  if (adopted) fit.minimum = search(fit.model, {fit.minimum.theta}, options);
  read_off(fit);
}

/// Throws Error if the rows leave a coefficient of the law unknown: its standard error at theta,
/// where coefficients are of order one, is above levels::largest_sigma_b. A search for them would
/// go on and on along a valley.
void require_known(const Model& model, const std::vector<double>& theta) {
  const Minimum at = evaluated(system_of(model), theta);
  const Parameters& q = model.parameters();
  const double freedom = static_cast<double>(at.f.size()) - static_cast<double>(theta.size());
  for (std::size_t j = q.own(); j < q.columns() && freedom > 0; ++j) {
    std::vector<double> unit(q.columns());
    unit[j] = 1;
    at.R.solve_transposed(0, unit);
    if (!(std::sqrt(dot(unit, unit) * at.rss / freedom) <= levels::largest_sigma_b))
      fail("the run does not determine a law");
  }
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

Fitted fit_of_run(const Fitted& joint, std::size_t r, const FitOptions& options) {
  const auto& theta = joint.minimum.theta;
  const Parameters& all = joint.parameters();
  ObservedRun run = joint.model.runs()[r];
  run.body = all.body(theta, run.body);
  const Model own = Model({run}, all.of_one_run()).weighted(joint.noise().added());
  require_rows(run.y.size(), own.parameters().count(), own.informative_rows());
  std::vector<double> start = all.theta_of_runs(theta, {r});
  start.resize(own.parameters().count());  // without the scene, which is fixed
  try {
    require_known(own, start);
    return fit_from(own, {start}, options);
  } catch (const Error&) {  // also where the joint law is far from that of the run
    if (own.noise().known() || !options.fits_power()) throw;
  }
  FitOptions alone = options;
  alone.fit_slope = alone.fit_wind = alone.fit_steepness = false;
  const FirstGuess guess = first_guess({run}, alone);
  require_known(own.with(guess.parameters), guess.starts.front());
  return fit_from(own.with(guess.parameters), guess.starts, alone);
}

Fitted fit_rolls(Route route, const std::vector<Run>& all, std::vector<Rows> rows,
                 std::vector<Response> responses, const FitOptions& options, AddedNoise added) {
  std::optional<FirstGuess> guess;
  Fitted fit{};
  for (int round = 0; round < 4; ++round) {  // each round removes the slow rows of the last fit
    const Parameters q(options, route == Route::position, all.size(), 1, 1);
    const Model model = Model(observe(route, all, rows, responses, options), q).weighted(added);
    if (!guess) {
      const bool known = model.noise().known();
      std::size_t n = 0;
      for (const ObservedRun& run : model.runs()) n += run.y.size();
      // Shifts are fitted for what all runs share: the v0 of their rolls is not reported.
      const bool asked = is_trajectory(route) || q.shared() > 0;
      require_rows(n, asked ? q.count() : 0, model.informative_rows());
      require_ways(model.runs(), options);
      guess = first_guess(known ? observe(route, all, rows, {}, options) : model.runs(), options);
      // The means of blocks lead a search of many rows to the minimum, or refuse for all of them.
      if (auto few = block_means(model.runs()); !few.empty() && !known && !options.robust)
        guess->starts.front() =
            fit_from({std::move(few), guess->parameters}, guess->starts, options).minimum.theta;
    }
    if (options.min_speed <= 0) {  // no round follows: frees memory
      responses = {};
      rows.clear();
    }
    fit = {};  // frees memory
    fit = fit_from(model.with(guess->parameters), guess->starts, options);
    guess->starts.front() = fit.minimum.theta;
    if (options.min_speed <= 0 ||
        !leave_out_slow(fit.model, guess->starts.front(), all, rows, options.min_speed))
      break;
  }
  allow_for_rounding(fit, options);
  return fit;
}

std::vector<Rows> usable(Route route, const std::vector<Run>& all) {
  std::vector<Rows> rows;
  for (const Run& run : all) {
    const auto& y = run[fitted_column(route)];
    Rows& of_run = rows.emplace_back();
    of_run.reserve(y.size());
    for (std::size_t i = 0; i < y.size(); ++i)
      if (std::isfinite(y[i]) && (is_trajectory(route) || std::isfinite(run.D[i])))
        of_run.push_back(i);
  }
  return rows;
}

double sum_of_squares(const Fitted& fit) {
  if (!fit.noise().known()) return fit.minimum.rss;
  const auto& runs = fit.model.runs();
  if (!runs.front().H_of_accelerations) return unweighted(fit);
  double sum = 0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const ObservedRun& run = runs[r];
    const double unit = (run.body.K + 1) * run.body.R / run.body.g;
    std::vector<double> off =
        run.H_of_accelerations->times(fit.model.raw_column(fit.minimum.theta, r));
    std::ranges::transform(off, run.accelerations, off.begin(), std::minus());
    sum += unit * unit * dot(off, off);
  }
  return sum;
}

}  // namespace rolling
