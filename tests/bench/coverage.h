// SPDX-License-Identifier: GPL-3.0-or-later
// Do the errors of fitpower hold? Simulated runs with a known law, fitted again and again: by case
// and route the bias, the spread and how often the nominal 95 % intervals hold the truth. `make
// coverage` prints the table; a test takes a short form.
#pragma once

#include "base/error.h"
#include "bench/coverage_cases.h"
#include "cli/history.h"
#include "fit/fit.h"
#include "motion/roll.h"
#include "motion/scene.h"
#include "sensor/sonar.h"
#include "signal/method.h"
#include "selection/free_roll.h"
#include "selection/readings.h"
#include "unit/fit/simulated.h"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <chrono>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>

namespace coverage {

struct Row {
  double bias_a = 0, bias_b = 0;    ///< in standard deviations of one run
  double sd_b = 0, over_bound = 0;  ///< of b; over the Cramer-Rao bound, 0 where it does not apply
  double percent_a = 0;             ///< bias of a in per cent of a
  /// Shares of runs whose intervals of these levels hold the truth; of another law those of its
  /// first and of its last coefficient. One of 95 % is that of the profile where it is printed.
  static constexpr double levels[] = {0.50, 0.68, 0.95, 0.99};
  double covers_a[4] = {}, covers_b[4] = {};
  double cover_a = 0, cover_b = 0;  ///< those of 95 %
  double cover_slope = 0;
  double cover_v0 = 0;
  double sigma_a = 0, sigma_b = 0;  ///< root of the mean square of the standard errors, over the sd
  /// Share of runs of which is told that their noise is not white through the filters, that frames
  /// are lost, or that 1.96 standard errors are no interval.
  double told = 0;
  double differ = 0;  ///< share of joint fits whose runs are said to disagree
  int far = 0;        ///< runs further than 6 of their own standard errors from the truth
  int refused = 0;
  double seconds = 0;  ///< per fit
};

/// Least standard error of b that any unbiased fit of the run can have.
inline double bound_of_b(rolling::Roll& roll, std::size_t n, bool position) {
  double A[4][4] =
      {};  // b last: its pivot, after elimination of the others, is the inverse of its variance
  const std::size_t p = position ? 4 : 3;
  for (std::size_t i = 0; i < n; ++i) {
    const auto s = roll.at(dt * static_cast<double>(i));
    const std::vector<double> g =
        position ? Column{1, s.x_v0, s.x_c[0], s.x_c[1]} : Column{s.v_v0, s.v_c[0], s.v_c[1]};
    for (std::size_t j = 0; j < p; ++j)
      for (std::size_t k = 0; k < p; ++k) A[j][k] += g[j] * g[k];
  }
  for (std::size_t j = 0; j + 1 < p; ++j)
    for (std::size_t i = j + 1; i < p; ++i)
      for (std::size_t k = p; k-- > j;) A[i][k] -= A[i][j] / A[j][j] * A[j][k];
  return (position ? noise_x : noise_v) / std::sqrt(A[p - 1][p - 1]);
}

/// A run of readings with noise, and what the filters make of them.
class Simulation {
 public:
  Simulation(const Case& c, rolling::Roll& truth, const Scene& scene, unsigned seed)
      : c_(c), truth_(truth), scene_(scene),
        n_(c.few > 0 ? c.few
                     : static_cast<std::size_t>((c.rises > 0 ? 2 : 1) * truth.stop_time() / dt *
                                                c.finer) +
                           1),
        step_(c.few > 0 ? truth.stop_time() / static_cast<double>(c.few) : dt / c.finer),
        noise_(seed), random_(seed + 1) {}
  std::size_t rows() const { return n_; }

  /// The run of this number in a joint fit.
  rolling::Run next(int i) {
    way_ = i < c_.runs - c_.down ? 1 : -1;
    times_the_noise_ = i < c_.runs - c_.noisy ? 1 : 5;
    rolling::Run run{};
    run.body = scene_.body();
    run.body.slope = c_.rises;
    const Column raw = c_.ending     ? pushed_roll(run.t)
                       : c_.whole    ? free_roll(run.t)
                       : c_.gate > 0 ? gates(run.t)
                                     : readings(run.t);
    run.x = run.v = run.D = raw;
    if (c_.unknown) run.v = c_.unknown(raw);
    if (c_.gate > 0 && c_.route == Route::velocity) pulses(run);
    if (c_.noise_of_a > 0)
      for (std::size_t k = 0; k < run.t.size(); ++k)
        run.D[k] = shift(truth_.at(run.t[k]).a + noise_(c_.noise_of_a));
    if (c_.history.empty()) return run;
    rolling::History history = rolling::history_of(c_.history, run.t);
    run.filters = std::move(history.filters);
    run.shift_of = history.shift_of;
    if (run.shift_of) run.shift_of->K = scene_.K;
    std::map<std::string, Column> columns{{c_.raw == Case::x ? "x" : "v", raw}};
    for (const std::string& line : c_.history) filter(line, run.t, columns);
    run.v = columns["v"];
    run.D = columns["a"];
    for (double& D : run.D) D = shift(D);
    return run;
  }

 private:
  double shift(double a) const {
    const rolling::Body body = scene_.body();
    return -a * (1 + body.K) * body.R / body.g;
  }
  /// The raw column from the beginning of the roll to its stop, at the times t.
  Column readings(Column& times) {
    rolling::Body body = scene_.body();
    if (c_.down > 0) body.slope = way_ * slope;
    rolling::Roll truth =
        c_.scatter > 0 || c_.down > 0
            ? rolling::Roll(body, rolling::PowerLaw{scene_.a * (1 + noise_(c_.scatter)), scene_.b},
                            0.5)
            : truth_;
    const double origin = c_.only_rounded ? c_.resolution * uniform() : 0;
    const std::size_t n = c_.down > 0 ? static_cast<std::size_t>(truth.stop_time() / dt) + 1 : n_;
    Column raw;
    double error = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double t = i == 0 ? 0 : step_ * (static_cast<double>(i) + noise_(c_.jitter)),
                   share = t / truth.stop_time();
      const auto s = truth.at(t);
      const double size = c_.only_rounded ? 0
                                          : (c_.raw == Case::x ? noise_x : noise_v) *
                                                times_the_noise_ * (1 + c_.growth * share);
      error = c_.AR * error + noise_(i == 0 ? 1 : std::sqrt(1 - c_.AR * c_.AR));
      double y = origin + way_ * (c_.raw == Case::x ? s.x : s.v) + size * error;
      if (c_.resolution > 0) y = c_.resolution * std::round(y / c_.resolution);
      if (uniform() < c_.outliers) y += uniform() - 0.5;
      if (i > 0 && (uniform() < c_.lost || t <= times.back())) continue;
      if (i > 0 && uniform() < c_.dropped) continue;
      times.push_back(c_.dropped > 0 ? step_ * static_cast<double>(times.size()) : t);
      raw.push_back(y);
    }
    return raw;
  }
  /// The times at which the body passes each gate, measured to 0.2 ms.
  Column gates(Column& times) {
    Column x;
    const double stop = truth_.stop_time();
    for (double to = c_.gate; to < truth_.at(stop).x - c_.gate / 2; to += c_.gate) {
      double from = 0, end = stop;
      while (end - from > 1e-9)
        (truth_.at((from + end) / 2).x < to ? from : end) = (from + end) / 2;
      times.push_back(from + noise_(2e-4));
      x.push_back(to);
    }
    return x;
  }
  /// The speeds of a wheel: the way of a pulse over the time since the one before.
  void pulses(rolling::Run& run) {
    for (std::size_t i = 1; i < run.t.size(); ++i) run.v[i] = c_.gate / (run.t[i] - run.t[i - 1]);
    if (const auto way = rolling::way_between_pulses(run.t, run.v))
      for (std::size_t i = 0; i < run.t.size(); ++i) run.x[i] = *way * static_cast<double>(i);
  }
  /// Rest, a push of 0.3 s, the roll, and what ends it; readings of 0.3 mm at 25 Hz. smooth --coast
  Column pushed_roll(Column& times) {
    constexpr double rest = 0.6, push = 0.3;
    const double begin = rest + push + 0.04 * uniform(), of_push = 0.5 * push * truth_.at(0).v,
                 ends = truth_.stop_time() * (c_.ending == Case::stop ? 1 : 0.5 + 0.2 * uniform()),
                 v = truth_.at(ends).v,
                 slows = c_.ending == Case::caught   ? v / 0.3
                         : c_.ending == Case::braked ? -3 * truth_.at(ends).a
                                                     : 1e3;
    std::vector<rolling::Sample> samples;
    for (double t = 0; t < begin + ends + std::min(v / slows, 2.0) + 0.6; t += dt) {
      const double since = t - begin, after = std::clamp(since - ends, 0.0, v / slows),
                   pushed = std::clamp(1 + since / push, 0.0, 1.0),
                   x = since < 0
                           ? of_push * (pushed * pushed - 1)
                           : truth_.at(std::min(since, ends)).x + after * (v - slows * after / 2);
      samples.push_back({t, x + 1 + noise_(noise_x)});
    }
    return kept(samples, times);
  }
  static Column kept(const std::vector<rolling::Sample>& samples, Column& times) {
    const rolling::Stretch stretch = rolling::free_roll(samples, true).kept;
    Column x;
    for (std::size_t i = stretch.begin; i < stretch.end; ++i)
      times.push_back(samples[i].t), x.push_back(samples[i].y);
    return x;
  }
  /// simulate --sensor pasco | smooth --coast -c x -w 1
  Column free_roll(Column& times) {
    const rolling::Scene roll{scene_.body(), scene_.law(), c_.bulge, 0.5, 0};
    rolling::SonarOptions sonar;
    sonar.seed = random_();
    std::vector<rolling::Sample> samples;
    rolling::sonar_run(*rolling::start(roll, rolling::best_method(roll), 1e-10), sonar,
                       [&](const rolling::SonarSample& s) {
      if (s.x) samples.push_back({s.t, *s.x});
    });
    return kept(samples, times);
  }
  /// Does to the columns what a `##` line of smooth or differentiate says.
  void filter(const std::string& line, const Column& t, std::map<std::string, Column>& columns) {
    std::istringstream words(line);
    std::string tool, column, rest;
    std::getline(words >> tool >> column >> std::ws, rest);
    if (tool == "shift-from-accel") return;
    const bool derivative = tool == "differentiate";
    const auto signal = rolling::make_signal(
        rolling::signal_options(
            derivative ? rolling::derivative_methods : rolling::smoothing_methods, rest)
            .value());
    Column y;
    const auto take = [&](std::span<const double> known) {
      y.insert(y.end(), known.begin(), known.end());
    };
    for (std::size_t i = 0; i < t.size(); ++i) take(signal->push(t[i], columns[column][i]));
    take(signal->finish());
    if (c_.digits > 0)
      for (double& value : y)
        value = std::strtod(fmt::format("{:.{}g}", value, c_.digits).c_str(), nullptr);
    columns[!derivative ? column : column == "x" ? "v" : "a"] = std::move(y);
  }
  double uniform() { return static_cast<double>(random_()) / 4294967296.0; }

  const Case& c_;
  rolling::Roll& truth_;
  const Scene& scene_;
  std::size_t n_;
  double step_;  // of time
  double way_ = 1, times_the_noise_ = 1;
  simulated::Noise noise_;
  std::mt19937 random_;
};

inline Row measure(const Case& c, const Scene& scene, int runs, unsigned seed) {
  rolling::FitOptions options;
  options.law = &rolling::laws()[c.law];
  const Column truths = c.law > 0 ? c.c : Column{scene.a, scene.b};
  rolling::Body body = scene.body();
  body.slope = c.rises;
  rolling::Roll truth(body, c.law > 0 ? rolling::Law(*options.law, c.c) : rolling::Law(scene.law()),
                      0.5);
  options.robust = c.outliers > 0;
  options.fit_slope = c.down > 0;
  options.possible_filters = rolling::filters_of_sensors();
  Simulation simulation(c, truth, scene, seed);
  Row row;
  std::vector<double> as, bs;
  for (int k = 0; k < runs; ++k) {
    std::vector<rolling::Run> joint;
    for (int i = 0; i < c.runs; ++i) joint.push_back(simulation.next(i));
    const auto begin = std::chrono::steady_clock::now();
    try {
      const bool pulses = c.gate > 0 && c.route == Route::velocity;
      const auto r = rolling::fit(pulses ? Route::position : c.route, joint, options);
      const rolling::Estimate first = r.coefficients.front(), last = r.coefficients.back();
      for (std::size_t i = 0; i < 4; ++i) {
        const double P = (1 + Row::levels[i]) / 2,
                     most = c.student ? gsl_cdf_tdist_Pinv(P, static_cast<double>(r.freedom))
                                      : gsl_cdf_ugaussian_Pinv(P);
        const auto holds = [&](std::size_t number, double value) {
          const auto profile = std::ranges::find(r.not_visited, number, &rolling::Interval::number);
          if (Row::levels[i] == 0.95 && profile != r.not_visited.end())
            return profile->lower <= value && value <= profile->upper;
          const rolling::Estimate x = r.coefficients[number];
          return std::abs(x.value - value) < most * x.sigma;
        };
        row.covers_a[i] += holds(0, truths.front());
        row.covers_b[i] += holds(truths.size() - 1, truths.back());
      }
      if (!r.v0.empty())
        row.cover_v0 += std::abs(std::abs(r.v0[0].value) - 0.5) < 1.96 * r.v0[0].sigma;
      row.cover_slope +=
          c.down > 0 && std::abs(r.scene[0]->value - slope) < 1.96 * r.scene[0]->sigma;
      const double error_a = first.value - truths.front(), error_b = last.value - truths.back();
      row.far += std::abs(error_b) > 6 * last.sigma || std::abs(error_a) > 6 * first.sigma;
      row.told += rolling::noise_is_correlated(r) || r.errors == rolling::Errors::uneven ||
                  r.reversals <= rolling::levels::few_reversals || r.clock_jump ||
                  !r.not_visited.empty() ||
                  (c.route == Route::loglog && rolling::logarithms_biased(r));
      row.differ += r.agreement && !r.agreement->agree();
      row.sigma_a += first.sigma * first.sigma;
      row.sigma_b += last.sigma * last.sigma;
      as.push_back(error_a);
      bs.push_back(error_b);
    } catch (const rolling::Error&) {
      ++row.refused;
    }
    row.seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / runs;
  }
  const auto fits = static_cast<double>(bs.size());
  const auto moments = [&](const std::vector<double>& errors, double& bias) {
    double sum = 0, squares = 0;
    for (double e : errors) sum += e, squares += e * e;
    const double sd = std::sqrt((squares - sum * sum / fits) / (fits - 1));
    bias = sum / fits / sd;
    return sd;
  };
  const double sd_a = moments(as, row.bias_a);
  row.percent_a = 100 * row.bias_a * sd_a / truths.front();
  row.sd_b = moments(bs, row.bias_b);
  if (c.bound)
    row.over_bound = row.sd_b / bound_of_b(truth, simulation.rows(), c.route == Route::position);
  row.sigma_a = std::sqrt(row.sigma_a / fits) / sd_a;
  row.sigma_b = std::sqrt(row.sigma_b / fits) / row.sd_b;
  for (double* cover : {row.covers_a, row.covers_b})
    for (std::size_t i = 0; i < 4; ++i) cover[i] /= runs;
  row.cover_a = row.covers_a[2], row.cover_b = row.covers_b[2];
  row.cover_slope /= runs;
  row.cover_v0 /= runs;
  row.told /= runs;
  row.differ /= runs;
  return row;
}

}  // namespace coverage
