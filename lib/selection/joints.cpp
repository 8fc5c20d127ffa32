// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/joints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "selection/polynomial.h"

namespace rolling {
namespace {

constexpr double three_sigma = 9;  // in units of chi square

/// value() of the polynomial through the first k samples of [begin, end), for each k; if
/// `backwards`, through the last k.
template <std::size_t P>
std::vector<double> of_first(std::span<const Sample> samples, double noise, bool backwards,
                             auto value) {
  const std::size_t n = samples.size();
  const Sample& origin = backwards ? samples.back() : samples.front();
  Polynomial<P> fit;
  std::vector<double> values{0};
  for (std::size_t i = 0; i < n; ++i) {
    const Sample& s = samples[backwards ? n - 1 - i : i];
    fit.add(s.t - origin.t, s.y / noise);
    values.push_back(value(fit));
  }
  return values;
}

}  // namespace

template <Quantity of>
std::vector<double> Joints<of>::costs(std::size_t begin, std::size_t order, std::size_t order_after,
                                      std::size_t end) const {
  const auto rss = [](std::size_t n) { return [n](const auto& fit) { return fit.rss(n); }; };
  const auto samples = samples_.subspan(begin, end - begin);
  auto cost = of_first<P>(samples, noise_, false, rss(order));
  const auto after = of_first<P>(samples, noise_, true, rss(order_after));
  for (std::size_t k = 0; k < cost.size(); ++k) cost[k] += after[cost.size() - 1 - k];
  return cost;
}

template <Quantity of>
std::size_t Joints<of>::inner(const std::vector<double>& cost, std::size_t joint, std::size_t far,
                              int inwards) {
  const auto at = [&](std::size_t k) { return inwards > 0 ? joint + k : joint - k; };
  double least = cost[joint];
  for (std::size_t k = 1; k <= far; ++k) least = std::min(least, cost[at(k)]);
  while (far > 0 && cost[at(far)] > least + three_sigma) --far;
  return at(far);
}

template <Quantity of>
std::size_t Joints<of>::agreeing(std::size_t from, std::size_t to) const {
  const double weight = 0.75 * std::log(static_cast<double>(samples_.size()));
  const auto [first, last] = std::minmax(from, to);
  const auto cost = of_first<P + 1>(samples_.subspan(first, last + 1 - first), noise_, to < from,
                                    [&](const auto& fit) {
    double least = fit.rss(1) + weight;
    for (std::size_t k = 2; k <= P + 1; ++k)
      least = std::min(least, fit.rss(k) + weight * static_cast<double>(k));
    return least;
  });
  const std::size_t n = cost.size() - 1;
  const double unit = n > P ? 2 * std::max(1.0, cost[n] / static_cast<double>(n - P)) : 2;
  std::size_t best = n;
  for (std::size_t k = n; k > n / 2; --k)
    if (cost[k] - cost[best] + unit * static_cast<double>(best - k) < 0) best = k;
  return best;
}

/// The RSS of a roll from `begin` on that stops at the time `stop`; the samples from `joint` on
/// are at rest.
template <Quantity of>
double Joints<of>::rss_of_stop(std::size_t begin, std::size_t joint, double stop,
                               std::size_t end) const {
  Polynomial<P + 1> fit;
  std::array<double, P + 1> row{};
  row[P] = 1;
  if (positions) fit.add(row, 0);
  for (std::size_t i = begin; i < end; ++i) {
    const double u = i < joint ? samples_[i].t - stop : 0;
    row = {1, positions ? u * u : u};
    for (std::size_t k = 2; k <= P; ++k) row[k] = row[k - 1] * u;
    if (positions) row[P] = i >= joint;
    fit.add(row, samples_[i].y / noise_);
  }
  return fit.rss();
}

template <Quantity of>
Ending Joints<of>::before_stop(std::size_t begin, std::size_t roughly, std::size_t end) const {
  const std::size_t least = begin + (roughly - begin) / 2;
  std::vector<double> cost;
  for (std::size_t joint = least; joint < end; ++joint) {
    cost.push_back(INFINITY);
    for (const double part : {0.0, 0.25, 0.5, 0.75}) {
      const double stop = std::lerp(samples_[joint - 1].t, samples_[joint].t, part);
      cost.back() = std::min(cost.back(), rss_of_stop(begin, joint, stop, end));
    }
  }
  const auto all = of_first<P>(samples_.subspan(begin, end - begin), noise_, false,
                               [](const auto& fit) { return fit.rss(); });
  cost.push_back(all.back());
  const auto lowest = std::min_element(cost.begin(), cost.end());
  const auto best = static_cast<std::size_t>(lowest - cost.begin());
  return {least + inner(cost, best, best, -1), *lowest};
}

template <Quantity of>
struct Joints<of>::Held {
  Polynomial<P + 1> roll;                  ///< up to the joint
  std::array<double, P + 1> row, slope{};  ///< of the roll at the joint
  double joint;                            ///< its time

  /// The row of a reading at t, where the hand needs the time T.
  std::array<double, P + 1> held(double t, double T) const {
    const double pi = std::numbers::pi;
    const double s = std::min(1.0, (t - joint) / T);
    const double share = (1 + std::cos(pi * s)) / 2;
    const double way = T * (s + std::sin(pi * s) / pi) / 2;
    auto of_reading = row;
    for (std::size_t k = 0; k < P; ++k)
      of_reading[k] = positions ? row[k] + way * slope[k] : share * row[k];
    of_reading[P] = positions && s == 1;
    return of_reading;
  }
};

template <Quantity of>
Ending Joints<of>::before_hand(std::size_t begin, std::size_t roughly, std::size_t end) const {
  Ending best{roughly, INFINITY};
  Held hand{};
  hand.row[P] = 1;
  hand.roll.add(hand.row, 0);
  for (std::size_t joint = begin; joint + 1 < roughly; ++joint) {
    hand.joint = samples_[joint].t;
    const double past = hand.joint - samples_[begin].t;
    hand.row = {1};
    for (std::size_t k = 1; k < P; ++k) {
      hand.slope[k] = static_cast<double>(k) * hand.row[k - 1];
      hand.row[k] = hand.row[k - 1] * past;
    }
    hand.roll.add(hand.row, samples_[joint].y / noise_);
    if (3 * (joint - begin) < 2 * (roughly - begin)) continue;
    const double longest = std::min(samples_[end - 1].t - hand.joint, past / 4);
    for (double T = samples_[joint + 1].t - hand.joint; T < longest; T *= 1.25) {
      Polynomial<P + 1> fit = hand.roll;
      for (std::size_t i = joint + 1; i < end && fit.rss() < best.rss; ++i)
        fit.add(hand.held(samples_[i].t, T), samples_[i].y / noise_);
      if (fit.rss() < best.rss) best = {joint, fit.rss()};
    }
  }
  return best;
}

template class Joints<Quantity::x>;
template class Joints<Quantity::v>;

}  // namespace rolling
