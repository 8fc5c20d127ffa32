// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/law.h"

#include <gsl/gsl_interp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/gsl.h"

namespace rolling {

TableLaw::TableLaw(std::vector<double> v, std::vector<double> D) {
  if (v.empty() || v.size() != D.size())
    fail("a table of a law needs a point at least, and a D to each v");
  std::vector<std::size_t> order(v.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return v[i] < v[j]; });
  for (const std::size_t i : order) {
    if (!(v[i] >= 0 && std::isfinite(v[i])))
      fail("v = {} in the table of a law must be a number that is not negative", v[i]);
    if (!(D[i] > 0 && std::isfinite(D[i])))
      fail("D = {} at v = {} in the table of a law must be a positive number", D[i], v[i]);
    if (!v_.empty() && v[i] == v_.back()) fail("v = {} stands twice in the table of a law", v[i]);
    v_.push_back(v[i]);
    D_.push_back(D[i]);
  }
  const std::size_t n = v_.size();
  if (n == 1) return;
  silence_gsl();
  const auto gsl =
      own(gsl_interp_alloc(n > 2 ? gsl_interp_steffen : gsl_interp_linear, n), gsl_interp_free);
  gsl_interp_init(gsl.get(), v_.data(), D_.data(), n);
  const auto slope_at = [&](std::size_t i) {
    return gsl_interp_eval_deriv(gsl.get(), v_.data(), D_.data(), v_[i], nullptr);
  };
  // The coefficients are kept here: gsl_interp_eval in their place made rolls measurably slower.
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double h = v_[i + 1] - v_[i];
    const double s = (D_[i + 1] - D_[i]) / h;
    const double begin = slope_at(i);
    const double end = slope_at(i + 1);
    c1_.push_back(begin);
    c2_.push_back((3 * s - 2 * begin - end) / h);
    c3_.push_back((begin + end - 2 * s) / (h * h));
  }
}

Shift TableLaw::at(double v) const {
  if (v < v_.front() || v_.size() == 1) return {D_.front(), 0};
  if (v > v_.back()) return {D_.back() + c1_.back() * (v - v_.back()), v * c1_.back()};
  const auto above = std::upper_bound(v_.begin() + 1, v_.end() - 1, v);
  const auto i = static_cast<std::size_t>(above - v_.begin()) - 1;
  const double s = v - v_[i];
  const double c1 = c1_[i];
  const double c2 = c2_[i];
  const double c3 = c3_[i];
  const auto [least, most] = std::minmax(D_[i], D_[i + 1]);  // rounding may lead beyond them
  return {std::clamp(D_[i] + s * (c1 + s * (c2 + s * c3)), least, most),
          v * (c1 + s * (2 * c2 + 3 * s * c3))};
}

namespace {

Shift power(const double* c, double v, double* by_c) {
  by_c[0] = std::pow(v, c[1]);
  const double D = c[0] * by_c[0];
  by_c[1] = D * std::log(v);
  return {D, c[1] * D};
}

/// A sum of these powers of v, times the coefficients.
template <int... n>
Shift powers(const double* c, double v, double* by_c) {
  Shift s{};
  const auto add = [&](int power) {
    double x = 1;
    for (int i = 0; i < power; ++i) x *= v;
    *by_c++ = x;
    s.D += *c * x;
    s.by_log_v += power * *c++ * x;
  };
  (add(n), ...);
  return s;
}

Shift constant_and_power(const double* c, double v, double* by_c) {
  by_c[0] = 1;
  const Shift s = power(c + 1, v, by_c + 1);
  return {c[0] + s.D, s.by_log_v};
}

/// d0 + a v^b as h + s (v^b - 1)/b (Box and Cox 1964, J. R. Stat. Soc. B 26, 211): where b is
/// small, d0 and a are large and nearly cancel, while h, s and b stay what they are.
Shift searched_constant_and_power(const double* c, double v, double* by_c) {
  const double n = c[2];
  const double log = std::log(v);
  const double x = n * log;
  const double B = std::abs(x) < 1e-5 ? log * (1 + x / 2) : std::expm1(x) / n;
  const double B_n =
      std::abs(x) < 1e-3 ? log * log * (0.5 + x / 3 + x * x / 8) : (log * std::exp(x) - B) / n;
  by_c[0] = 1;
  by_c[1] = B;
  by_c[2] = c[1] * B_n;
  return {c[0] + c[1] * B, c[1] * std::exp(x)};
}

void written_constant_and_power(const double* c, double* d, double* by_c) {
  const double h = c[0];
  const double s = c[1];
  const double n = c[2];
  d[0] = h - s / n;
  d[1] = s / n;
  d[2] = n;
  const double J[]{1, -1 / n, s / (n * n), 0, 1 / n, -s / (n * n), 0, 0, 1};
  std::copy(std::begin(J), std::end(J), by_c);
}

Shift peak(const double* c, double v, double* by_c) {
  const double w = c[2];
  const double below = v * v + w * w;
  by_c[0] = 1;
  by_c[1] = 2 * v * w / below;
  by_c[2] = c[1] * 2 * v * (v * v - w * w) / (below * below);
  return {c[0] + c[1] * by_c[1], -w * by_c[2]};
}

/// The same curve has p w = (-p)(-w): the formula is written with w > 0.
void written_peak(const double* c, double* d, double* by_c) {
  const double sign = c[2] < 0 ? -1 : 1;
  d[0] = c[0];
  d[1] = sign * c[1];
  d[2] = sign * c[2];
  const double J[]{1, 0, 0, 0, sign, 0, 0, 0, sign};
  std::copy(std::begin(J), std::end(J), by_c);
}

}  // namespace

const std::vector<LawForm>& laws() {
  using C = LawForm::Coefficient;
  const C d0{.name = "d0"};
  const C d1{.name = "d1", .v = -1};
  const C d2{.name = "d2", .v = -2};
  const C b{.name = "b", .D = 0};
  static const std::vector<LawForm> all{
      {.formula = "a v^b",
       .coefficients = {{.name = "a", .exponent = 1}, b},
       .shift = power,
       .is_power = true},
      {.formula = "d0",
       .coefficients = {d0},
       .shift = powers<0>,
       .starts = {{1}},
       .is_power = true},
      {.formula = "d0 + d1 v", .coefficients = {d0, d1}, .shift = powers<0, 1>, .starts = {{1, 0}}},
      {.formula = "d0 + d1 v + d2 v^2",
       .coefficients = {d0, d1, d2},
       .shift = powers<0, 1, 2>,
       .starts = {{1, 0, 0}},
       .drag = 2},
      {.formula = "d0 + d2 v^2",
       .coefficients = {d0, d2},
       .shift = powers<0, 2>,
       .starts = {{1, 0}},
       .drag = 1},
      {.formula = "d0 + a v^b",
       .coefficients = {d0, {.name = "a", .exponent = 2}, b},
       .shift = constant_and_power,
       .searched = searched_constant_and_power,
       .written = written_constant_and_power,
       .starts = {{1, 0.3, 0.5}, {1, 0.3, 2}}},
      {.formula = "d0 + 2 p v w/(v^2 + w^2)",
       .coefficients = {d0, {.name = "p"}, {.name = "w", .D = 0, .v = 1}},
       .shift = peak,
       .searched = peak,
       .written = written_peak,
       .starts = {{0.5, 0.5, 0.2}, {0.5, 0.5, 0.6}, {0.5, 0.5, 2}}},
  };
  return all;
}

/// Replaces v^2 by (v + w)|v + w|, all in the law's unit of speed.
void Law::blow(double v, Shift& s, double* by_c) const {
  const auto j = static_cast<std::size_t>(form_->drag);
  const double air = v + wind_ / v_unit_;
  by_c[j] = air * std::abs(air);
  s.D += c_[j] * (by_c[j] - v * v);
  s.by_log_v += c_[j] * 2 * v * (std::abs(air) - v);
}

void Law::check_speed(double v) const {
  if (std::abs(v) > highest() * (1 + 1e-9))
    fail("the speed {:.6g} m/s is above the table of the law, which ends at {:.6g} m/s",
         std::abs(v), highest());
}

double Law::in_SI(std::size_t j, std::span<double> by_c) const {
  std::array<double, LawForm::most> d = c_;
  std::array<double, LawForm::most * LawForm::most> J{};
  if (of_search_) form_->written(c_.data(), d.data(), J.data());
  else
    for (std::size_t i = 0; i < size(); ++i) J[i * size() + i] = 1;
  const LawForm::Coefficient& of = form_->coefficients[j];
  const bool by_exponent = of.exponent >= 0;
  const auto e = static_cast<std::size_t>(std::max(of.exponent, 0));
  const double unit = std::pow(D_unit_, of.D) * std::pow(v_unit_, by_exponent ? -d[e] : of.v);
  for (std::size_t i = 0; i < size(); ++i)
    by_c[i] = unit * (J[j * size() + i] -
                      (by_exponent ? d[j] * std::log(v_unit_) * J[e * size() + i] : 0));
  return d[j] * unit;
}

}  // namespace rolling
