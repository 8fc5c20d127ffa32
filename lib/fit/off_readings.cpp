// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/off_readings.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

#include "base/by_run.h"
#include "base/dot.h"
#include "base/error.h"
#include "fit/errors.h"
#include "fit/levels.h"
#include "fit/route.h"
#include "least_squares/robust.h"

namespace rolling {
namespace {

/// The residuals of a run, and the linear model around the fit, while readings are left out.
class Others {
 public:
  /// `of_run`: the columns of B = J R^-1 for this run; none where no reading determines the fit.
  Others(std::span<const double> e, const std::vector<std::span<double>>& B, double freedom)
      : B_(B), e_(e.begin(), e.end()), squares_(dot(e, e)), freedom_(freedom), left_(e.size(), 1),
        out_(e.size()) {
    for (const auto column : B_)
      for (std::size_t i = 0; i < left_.size(); ++i) left_[i] -= column[i] * column[i];
    const std::size_t q = B_.size();
    P_.assign(q * q, 0);
    for (std::size_t j = 0; j < q; ++j) P_[j * q + j] = 1;
  }

  /// How far a reading is off the motion of the others; 0 where the others do not tell.
  double size(std::size_t i) const {
    if (left_[i] < 1e-3) return 0;
    const double square = e_[i] * e_[i] / left_[i], rest = squares_ - square;
    return rest > 1e-12 * squares_ ? std::sqrt(square / rest * (freedom_ - 1)) : 0;
  }
  std::size_t furthest() const {
    std::size_t most = 0;
    double largest = -1;
    for (std::size_t i = 0; i < e_.size(); ++i)
      if (const double x = out_[i] ? -1 : std::abs(e_[i]) / std::sqrt(std::max(left_[i], 1e-3));
          x > largest)
        largest = x, most = i;
    return most;
  }
  /// Sherman and Morrison's formula.
  void leave_out(std::size_t i) {
    const std::size_t q = B_.size();
    std::vector<double> c(q);
    for (std::size_t j = 0; j < q; ++j)
      for (std::size_t k = 0; k < q; ++k) c[j] += P_[j * q + k] * B_[k][i];
    const double left = left_[i], e = e_[i];
    squares_ -= e * e / left, freedom_ -= 1, out_[i] = true;
    if (q == 0) return;
    for (std::size_t r = 0; r < e_.size(); ++r) {
      double h = 0;
      for (std::size_t k = 0; k < q; ++k) h += B_[k][r] * c[k];
      e_[r] += h * e / left;
      left_[r] -= h * h / left;
    }
    for (std::size_t j = 0; j < q; ++j)
      for (std::size_t k = 0; k < q; ++k) P_[j * q + k] += c[j] * c[k] / left;
  }
  double freedom() const { return freedom_; }
  /// The correlation of the residuals of the others with those of the reading before.
  double correlation() const {
    double sum = 0, squares = 0, before = 0;
    for (std::size_t i = 0; i < e_.size(); ++i) {
      if (out_[i]) continue;
      sum += e_[i] * before, squares += e_[i] * e_[i];
      before = e_[i];
    }
    return sum / squares;
  }
  /// The distance of a reading that was left out, in standard deviations of the others.
  double distance(std::size_t i) const {
    return std::abs(e_[i]) / std::sqrt(std::max(squares_, 0.0) / freedom_);
  }

 private:
  std::vector<std::span<double>> B_;
  std::vector<double> e_;
  double squares_, freedom_;
  std::vector<double> left_, P_;  // left_: 1 - leverage; P_: the inverse of B^T B of the others
  std::vector<bool> out_;
};

/// The time is the number of the reading here. `most_off`: becomes the distance of the first
/// reading that is left out, if that is larger.
OffReadings of_run(Others others, std::size_t n, double& most_off) {
  OffReadings found{};
  std::vector<std::size_t> out;
  const std::size_t most = std::min<std::size_t>(n / 10 + 1, 100);
  const double by_chance = std::sqrt(2 * std::log(static_cast<double>(n)));
  while (out.size() < most && others.freedom() > 12) {
    const std::size_t i = others.furthest();
    const double size = others.size(i), freedom = others.freedom() - 1;
    most_off = std::max(most_off, size);
    if (size < by_chance) break;
    others.leave_out(i);
    out.push_back(i);
    // Smooth residuals are those of another law, which no single reading makes.
    if (size < levels::off || others.correlation() > 0.5 ||
        static_cast<double>(n) * gsl_cdf_tdist_Q(size, freedom) > levels::off_chance / 2)
      continue;
    found = {};
    for (const std::size_t k : out)
      if (const double distance = others.distance(k); distance > found.distance)
        found.distance = distance, found.time = static_cast<double>(k);
    found.count = out.size();
  }
  return found;
}

std::optional<OffReadings> around(const Fitted& fit, double& most_off) {
  const bool known = fit.noise->from_sources_alone();
  const auto raw = [&](std::vector<double> x) {
    return known ? fit.noise->to_sources(std::move(x)) : x;
  };
  const auto& sizes = known ? fit.noise->sources() : fit.system.runs;
  std::vector<double> e = raw(fit.minimum.f);
  Matrix B;  // in long runs no reading has a share in the fit
  if (e.size() <= 1000 * sizes.size())
    for (std::vector<double>& column : orthonormal(fit)) B.push_back(raw(std::move(column)));
  const auto project = [](std::span<const double> column, std::span<double> from) {
    const double along = dot(column, from);
    for (std::size_t i = 0; i < from.size(); ++i) from[i] -= along * column[i];
  };
  for (std::size_t j = 0; j < B.size(); ++j) {  // to the minimum, if this is not one
    if (j >= fit.system.own) project(B[j], e);
    else
      for (std::size_t r = 0; r < sizes.size(); ++r)
        project(by_run(B[j], sizes)[r], by_run(e, sizes)[r]);
  }
  std::optional<OffReadings> found;
  const auto e_of = by_run(e, sizes);
  const auto B_of = rows_by_run(B, sizes);
  for (std::size_t r = 0; r < sizes.size(); ++r) {
    const double freedom =
        static_cast<double>(sizes[r]) - static_cast<double>(fit.system.columns());
    if (freedom < 13) continue;
    OffReadings off =
        of_run({e_of[r], B_of.empty() ? std::vector<std::span<double>>() : B_of[r], freedom},
               sizes[r], most_off);
    if (off.count == 0 || (found && found->distance > off.distance)) continue;
    const ObservedRun& run = fit.rolls->runs()[r];
    off.run = r;
    auto at = static_cast<std::size_t>(off.time);
    if (run.H && !known) {  // the middle of what a filtered reading has read
      const auto [first, end] = run.H->columns_of(at);
      at = (first + end) / 2;
    }
    off.time = run.origin + run.t[at];
    found = off;
  }
  return found;
}

}  // namespace

std::optional<OffReadings> off_readings(Route route, const std::vector<FitRun>& runs,
                                        const FitOptions& options, const Fitted& fit) {
  if (!fit.rolls || fit.degrees_left() == 0 || options.robust) return {};
  double most_off = 0;
  auto found = around(fit, most_off);
  if (found || most_off < 5) return found;
  try {  // a reading far off may have bent the roll to itself, away from where it is linear
    FitOptions robust = options;
    robust.robust = true;
    Fitted straight = fit.noise->known() ? fit : fit_route(route, runs, robust);
    if (fit.noise->known())
      straight.minimum = minimise_robust(straight.system, {fit.minimum.theta});
    straight.minimum = evaluated(straight.system, straight.minimum.theta);
    return around(straight, most_off);
  } catch (const Error&) {
    return {};
  }
}

}  // namespace rolling
