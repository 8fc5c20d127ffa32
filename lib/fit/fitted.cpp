// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/fitted.h"

#include <algorithm>
#include <array>

#include "base/enumeration.h"
#include "base/error.h"

namespace rolling {

void require_rows(std::size_t n, std::size_t p, std::size_t independent) {
  if (n == 0) fail("no row can be fitted");
  if (p == 0) fail("every coefficient is fixed: nothing is left to fit");
  if (independent < p)
    fail("{} cannot determine {} parameters{}", counted(n, "row"), p,
         independent < n
             ? fmt::format(", for their filters leave {} of them independent", independent)
             : "");
}

std::size_t Fitted::degrees_left() const {
  const std::size_t n = model.informative_rows();
  const std::size_t p = minimum.theta.size();
  const std::size_t left = n > p ? n - p : 0;
  return noise_of_roll ? std::min(left, noise_of_roll->freedom) : left;
}

void read_off(Fitted& fit) {
  const std::vector<double>& theta = fit.minimum.theta;
  const Parameters& q = fit.parameters();
  const Law law = q.law(theta);
  const auto number = [&](double value, const Parameters::Numbers& by) {
    FittedNumber result{value, std::vector<double>(q.columns())};
    q.chain(result.gradient.data(), 1, law.c(0), by);
    return result;
  };
  fit.coefficients.clear();
  fit.v0.clear();
  fit.x0.clear();
  for (std::size_t j = 0; j < law.size(); ++j) {
    Parameters::Numbers by{};
    const double value = law.in_SI(j, std::span(by).subspan(q.first_of_law));
    if (q.fixed(j)) by = {};
    fit.coefficients.push_back(number(q.fixed(j).value_or(value), by));
  }
  if (!fit.is_roll()) return;
  fit.scene.clear();
  for (std::size_t i = 0; i < scene_numbers.size(); ++i) {
    Parameters::Numbers by{};
    by[q.first_of_scene + i] = 1;
    if (q.fits(i)) fit.scene.push_back(number(q.body(theta, {}).*scene_numbers[i].value, by));
  }
  for (std::size_t r = 0; r < fit.model.runs().size(); ++r) {
    const double way = fit.model.runs()[r].way;
    fit.v0.push_back(number(way * q.v0(theta, r), {way}));
    if (!q.has_x0()) continue;
    fit.x0.push_back(number(q.x0(theta, r), {0, 1}));
    fit.x0.back().run = r;
  }
}

Law Fitted::law() const {
  std::array<double, LawForm::most> written{};
  for (std::size_t j = 0; j < coefficients.size(); ++j) written[j] = coefficients[j].value;
  return {parameters().form(), written};
}

std::vector<FittedNumber> Fitted::numbers() const {
  std::vector<FittedNumber> all = coefficients;
  all.insert(all.end(), scene.begin(), scene.end());
  if (!v0.empty()) all.push_back(v0.front());
  for (const FittedNumber& x : x0)
    if (x.run == 0 || !parameters().of_positions()) all.push_back(x);
  return all;
}

double Fitted::fastest() const {
  double speed = 0;
  for (const FittedNumber& number : v0) speed = std::max(speed, std::abs(number.value));
  for (const ObservedRun& run : model.runs())  // of shifts, t are the speeds
    if (!is_roll()) speed = std::max(speed, std::ranges::max(run.t));
  return speed;
}

}  // namespace rolling
