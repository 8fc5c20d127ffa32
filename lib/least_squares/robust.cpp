// SPDX-License-Identifier: GPL-3.0-or-later
#include "least_squares/robust.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/dot.h"
#include "base/error.h"
#include "least_squares/trimmed.h"

namespace rolling {
namespace {

/// psi(u)/u and psi'(u) of a loss with influence function psi.
struct Influence {
  double weight, slope;
};
Influence huber(double u) {
  constexpr double c = 1.345;
  return std::abs(u) <= c ? Influence{1, 1} : Influence{c / std::abs(u), 0};
}
Influence bisquare(double u) {
  constexpr double c = 4.685;
  const double rest = 1 - u * u / (c * c);
  return rest > 0 ? Influence{rest * rest, rest * (5 * rest - 4)} : Influence{0, 0};
}

/// The sizes of residuals in units of their scale.
std::vector<double> sizes_of(const Residuals& at) {
  std::vector<double> sizes;
  for (const double x : at.f) sizes.push_back(std::abs(x) / at.scale);
  return sizes;
}

/// The system whose residuals are multiplied by these factors. It refers to both.
System weighted(const System& system, const std::vector<double>& factors) {
  return {system.runs, system.own, system.shared,
          [&](const std::vector<double>& theta, const TakeRows& take) {
    auto factor = factors.begin();
    system.evaluate(theta, [&](std::size_t run, std::span<double> f, std::span<double> J) {
      for (std::size_t i = 0; i < f.size(); ++i, ++factor) {
        f[i] *= *factor;
        for (std::size_t k = i; k < J.size(); k += f.size()) J[k] *= *factor;
      }
      take(run, f, J);
    });
          }};
}

/// The fit from a theta that fits most rows exactly: of those alone that it fits to rounding,
/// since theta is of order one.
Minimum exact_fit(const System& system, const std::vector<double>& theta) {
  std::vector<double> kept;
  system.evaluate(theta, [&](std::size_t, std::span<double> f, std::span<double> J) {
    for (std::size_t i = 0; i < f.size(); ++i) {
      double size = 0;
      for (std::size_t k = i; k < J.size(); k += f.size()) size += std::abs(J[k]);
      kept.push_back(std::abs(f[i]) <= 1e-13 * size);
    }
  });
  Minimum minimum = evaluated(system, minimise(weighted(system, kept), theta).theta);
  std::ranges::transform(minimum.f, kept, minimum.f.begin(), std::multiplies());
  minimum.rss = dot(minimum.f, minimum.f);
  return minimum;
}

}  // namespace

Minimum minimise_robust(const System& system, const std::vector<std::vector<double>>& starts) {
  constexpr std::size_t few = 1000, few_parameters = 12;
  const std::size_t p = system.parameters();
  const bool trimmed = system.residuals() <= few && p <= few_parameters;
  std::vector<double> theta = trimmed ? least_trimmed(system, starts) : starts.front();
  Residuals at = residuals_at(system, theta);
  std::vector<double> u = sizes_of(at), factors(u.size());
  std::vector<bool> outliers;
  for (const double size : u) outliers.push_back(trimmed && size > 30);
  for (const auto influence : {huber, bisquare}) {
    double change = influence == huber ? 1 : 0.01;
    for (int round = 0; change > 1e-8; ++round) {
      if (round == 200) fail("the robust fit does not converge");
      if (!(at.scale > 0)) return exact_fit(system, theta);
      double squares = 0, slopes = 0;  // sums of the weights and of psi'
      for (std::size_t i = 0; i < u.size(); ++i) {
        const bool out = influence == huber && outliers[i];
        const Influence of = out ? Influence{0, 0} : influence(u[i]);
        factors[i] = std::sqrt(of.weight);
        squares += of.weight, slopes += of.slope;
      }
      const System weights = weighted(system, factors);
      // A step of reweighted squares is too short by the ratio of these sums: with it Newton's.
      const double longer = slopes > squares / 2 ? squares / slopes : 1;
      const auto next =
          change > 0.01 ? minimise(weights, theta).theta : stepped(weights, theta, longer);
      change = 0;
      for (std::size_t j = 0; j < p; ++j)
        change = std::max(change, std::abs(next[j] - theta[j]) / std::max(1.0, std::abs(next[j])));
      theta = next;
      Residuals now = residuals_at(system, theta);
      // The bisquare loss has a fixed scale, and so has Huber's after a while: it is made of
      // medians, which may go to and fro between two rows without end.
      if (influence == bisquare || round > 50) now.scale = at.scale;
      at = std::move(now);
      u = sizes_of(at);
    }
  }
  const double n = static_cast<double>(u.size());
  double mean = 0, squares = 0;
  for (const double size : u) {
    const double slope = bisquare(size).slope;
    mean += slope / n;
    squares += slope * slope / n;
  }
  if (!(mean > 0)) fail("too many outliers: no robust fit");
  const double correction =
      1 + static_cast<double>(p) / n * (squares - mean * mean) / (mean * mean);
  Minimum minimum = evaluated(system, theta);
  for (std::size_t i = 0; i < u.size(); ++i)
    minimum.f[i] *= bisquare(u[i]).weight * correction / mean;
  minimum.rss = dot(minimum.f, minimum.f);
  return minimum;
}

}  // namespace rolling
