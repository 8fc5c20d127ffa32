// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/joints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "selection/polynomial.h"

namespace rolling {
namespace {

/// One coefficient more than a piece of positions has.
using Fit = Polynomial<5>;

constexpr double three_sigma = 9;  // in units of chi square

/// value() of the polynomial through the first k samples of [begin, end), for each k; if
/// `backwards`, through the last k.
std::vector<double> of_first(std::span<const Sample> samples, double noise, bool backwards,
                             auto value) {
  const std::size_t n = samples.size();
  const Sample& origin = backwards ? samples.back() : samples.front();
  Fit fit;
  std::vector<double> values{0};
  for (std::size_t i = 0; i < n; ++i) {
    const Sample& s = samples[backwards ? n - 1 - i : i];
    fit.add(s.t - origin.t, s.y / noise);
    values.push_back(value(fit));
  }
  return values;
}

}  // namespace

std::vector<double> Joints::costs(std::size_t begin, std::size_t order, std::size_t order_after,
                                  std::size_t end) const {
  const auto rss = [](std::size_t n) { return [n](const auto& fit) { return fit.rss(n); }; };
  const auto samples = samples_.subspan(begin, end - begin);
  auto cost = of_first(samples, noise_, false, rss(order));
  const auto after = of_first(samples, noise_, true, rss(order_after));
  for (std::size_t k = 0; k < cost.size(); ++k) cost[k] += after[cost.size() - 1 - k];
  return cost;
}

std::size_t Joints::inner(const std::vector<double>& cost, std::size_t joint, std::size_t far,
                          int inwards) {
  const auto at = [&](std::size_t k) { return inwards > 0 ? joint + k : joint - k; };
  double least = cost[joint];
  for (std::size_t k = 1; k <= far; ++k) least = std::min(least, cost[at(k)]);
  while (far > 0 && cost[at(far)] > least + three_sigma) --far;
  return at(far);
}

std::size_t Joints::agreeing(std::size_t from, std::size_t to) const {
  const double weight = 0.75 * std::log(static_cast<double>(samples_.size()));
  const auto [first, last] = std::minmax(from, to);
  const auto cost =
      of_first(samples_.subspan(first, last + 1 - first), noise_, to < from, [&](const auto& fit) {
        double least = fit.rss(1) + weight;
        for (std::size_t k = 2; k <= most_ + 1; ++k)
          least = std::min(least, fit.rss(k) + weight * static_cast<double>(k));
        return least;
      });
  const std::size_t n = cost.size() - 1;
  const double unit = n > most_ ? 2 * std::max(1.0, cost[n] / static_cast<double>(n - most_)) : 2;
  std::size_t best = n;
  for (std::size_t k = n; k > n / 2; --k)
    if (cost[k] - cost[best] + unit * static_cast<double>(best - k) < 0) best = k;
  return best;
}

/// The RSS of a roll from `begin` on that stops at the time `stop`; the samples from `joint` on
/// are at rest. An RSS above `most` is not of interest: what is returned then is above that, too.
double Joints::rss_of_stop(std::size_t begin, std::size_t joint, double stop, std::size_t end,
                           double most) const {
  Fit fit;
  std::array<double, 5> row{};
  row[4] = 1;
  if (positions_) fit.add(row, 0);
  for (std::size_t i = begin; i < end && fit.rss() <= most; ++i) {
    const double u = i < joint ? samples_[i].t - stop : 0;
    row = {1, positions_ ? u * u : u};
    for (std::size_t k = 2; k < 4; ++k) row[k] = row[k - 1] * u;
    row[4] = positions_ && i >= joint;
    fit.add(row, samples_[i].y / noise_);
  }
  return fit.rss();
}

Ending Joints::before_stop(std::size_t begin, std::size_t roughly, std::size_t end) const {
  const std::size_t least = begin + (roughly - begin) / 2;
  const auto cost_of = [&](std::size_t joint, double most) {
    double cost = INFINITY;
    for (const double part : {0.0, 0.25, 0.5, 0.75}) {
      const double stop = std::lerp(samples_[joint - 1].t, samples_[joint].t, part);
      cost = std::min(cost, rss_of_stop(begin, joint, stop, end, std::min(cost, most)));
    }
    return cost;
  };
  double lowest_yet = cost_of(std::min(roughly, end - 1), INFINITY);
  std::vector<double> cost;
  for (std::size_t joint = least; joint < end; ++joint) {
    cost.push_back(cost_of(joint, lowest_yet + three_sigma));
    lowest_yet = std::min(lowest_yet, cost.back());
  }
  const auto all = of_first(samples_.subspan(begin, end - begin), noise_, false,
                            [this](const Fit& fit) { return fit.rss(most_); });
  cost.push_back(all.back());
  const auto lowest = std::min_element(cost.begin(), cost.end());
  const auto best = static_cast<std::size_t>(lowest - cost.begin());
  return {least + inner(cost, best, best, -1), *lowest};
}

Ending Joints::before_hand(std::size_t begin, std::size_t roughly, std::size_t end) const {
  constexpr double pi = std::numbers::pi;
  Ending best{roughly, INFINITY};
  Fit roll;                     // up to the joint
  std::array<double, 5> row{};  // of the roll at the joint
  std::array<double, 5> slope{};
  row[4] = 1;
  roll.add(row, 0);
  for (std::size_t joint = begin; joint + 1 < roughly; ++joint) {
    const double t = samples_[joint].t;
    const double past = t - samples_[begin].t;
    row = {1};
    for (std::size_t k = 1; k < most_; ++k) {
      slope[k] = static_cast<double>(k) * row[k - 1];
      row[k] = row[k - 1] * past;
    }
    roll.add(row, samples_[joint].y / noise_);
    if (3 * (joint - begin) < 2 * (roughly - begin)) continue;
    const double longest = std::min(samples_[end - 1].t - t, past / 4);
    for (double T = samples_[joint + 1].t - t; T < longest; T *= 1.25) {
      Fit fit = roll;
      for (std::size_t i = joint + 1; i < end && fit.rss() < best.rss; ++i) {
        const double s = std::min(1.0, (samples_[i].t - t) / T);
        const double share = (1 + std::cos(pi * s)) / 2;
        const double way = T * (s + std::sin(pi * s) / pi) / 2;
        std::array<double, 5> held{};
        for (std::size_t k = 0; k < most_; ++k)
          held[k] = positions_ ? row[k] + way * slope[k] : share * row[k];
        held[4] = positions_ && s == 1;
        fit.add(held, samples_[i].y / noise_);
      }
      if (fit.rss() < best.rss) best = {joint, fit.rss()};
    }
  }
  return best;
}

double Joints::unseen(const Piece& p, double t) const {
  const double time = positions_ ? 12 * noise_ / std::abs(p.v(t).value) : 0;
  return std::min(time, p.duration() / 4);
}

double Joints::unseen_push(const Piece& push, const Piece& roll) const {
  if (!is_known(push.a(push.middle()))) return 0;
  const double v = std::abs(roll.v(roll.from).value);
  const double T = push.duration();
  const double share = 2 * noise_ / v;
  const double s = positions_ ? std::cbrt(12 * share * T * T / 9.87) : T * std::sqrt(share / 2.47);
  return std::min({s, T / 2, roll.duration() / 8});
}

}  // namespace rolling
