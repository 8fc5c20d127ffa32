#include "contact/law.h"

#include <algorithm>
#include <cmath>

namespace rolling {
namespace {

double power(const double* c, double v, double* by_c) {
  by_c[0] = std::pow(v, c[1]);
  by_c[1] = c[0] * by_c[0] * std::log(v);
  return c[0] * by_c[0];
}

double constant(const double* c, double, double* by_c) {
  by_c[0] = 1;
  return c[0];
}

double line(const double* c, double v, double* by_c) {
  by_c[0] = 1;
  by_c[1] = v;
  return c[0] + c[1] * v;
}

double parabola(const double* c, double v, double* by_c) {
  by_c[2] = v * v;
  return line(c, v, by_c) + c[2] * v * v;
}

double square(const double* c, double v, double* by_c) { return line(c, v * v, by_c); }

double constant_and_power(const double* c, double v, double* by_c) {
  by_c[0] = 1;
  return c[0] + power(c + 1, v, by_c + 1);
}

double peak(const double* c, double v, double* by_c) {
  const double w = c[2], below = v * v + w * w;
  by_c[0] = 1;
  by_c[1] = 2 * v * w / below;
  by_c[2] = c[1] * 2 * v * (v * v - w * w) / (below * below);
  return c[0] + c[1] * by_c[1];
}

}  // namespace

const std::vector<Law>& laws() {
  static const std::vector<Law> all{
      {"a v^b", {{"a", 1, 0, 1}, {"b", 0}}, power, {{1, 0.3}}, true},
      {"d0", {{"d0"}}, constant, {{1}}, true},
      {"d0 + d1 v", {{"d0"}, {"d1", 1, -1}}, line, {{1, 0}}},
      {"d0 + d1 v + d2 v^2", {{"d0"}, {"d1", 1, -1}, {"d2", 1, -2}}, parabola, {{1, 0, 0}}},
      {"d0 + d2 v^2", {{"d0"}, {"d2", 1, -2}}, square, {{1, 0}}},
      {"d0 + a v^n",
       {{"d0"}, {"a", 1, 0, 2}, {"n", 0}},
       constant_and_power,
       {{0.5, 0.5, 0.5}, {0.5, 0.5, 2}}},
      {"d0 + 2 p v w/(v^2 + w^2)",
       {{"d0"}, {"p"}, {"w", 0, 1}},
       peak,
       {{0.5, 0.5, 0.2}, {0.5, 0.5, 0.6}, {0.5, 0.5, 2}}},
  };
  return all;
}

double LawInUnits::in_SI(const double* c, std::size_t j, std::span<double> by_c) const {
  const Law::Coefficient& of = law->coefficients[j];
  const double exponent = of.exponent < 0 ? of.v : -c[of.exponent],
               unit = std::pow(D_unit, of.D) * std::pow(v_unit, exponent);
  std::fill(by_c.begin(), by_c.end(), 0.0);
  by_c[j] = unit;
  if (of.exponent >= 0)
    by_c[static_cast<std::size_t>(of.exponent)] = -c[j] * unit * std::log(v_unit);
  return c[j] * unit;
}

}  // namespace rolling
