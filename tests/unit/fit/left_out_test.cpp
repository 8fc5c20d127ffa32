// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/left_out.h"

#include <gsl/gsl_multifit.h>

#include <cmath>
#include <random>

#include "unit/catch.h"
#include "unit/normal.h"

using namespace rolling;

namespace {

constexpr std::size_t n = 30, q = 3;

/// The fit of a parabola to rows with these weights, by GSL.
struct Parabola {
  std::vector<double> residuals = std::vector<double>(n), leverages = residuals;
  double squares = 0;

  Parabola(const std::vector<double>& y, const std::vector<double>& weights) {
    gsl_matrix* const X = gsl_matrix_alloc(n, q);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < q; ++j)
        gsl_matrix_set(X, i, j, std::pow(static_cast<double>(i), static_cast<double>(j)));
    gsl_matrix* const covariance = gsl_matrix_alloc(q, q);
    gsl_vector* const c = gsl_vector_alloc(q);
    const auto view = gsl_vector_const_view_array(y.data(), n),
               w = gsl_vector_const_view_array(weights.data(), n);
    auto* const work = gsl_multifit_linear_alloc(n, q);
    gsl_multifit_wlinear(X, &w.vector, &view.vector, c, covariance, &squares, work);
    for (std::size_t i = 0; i < n; ++i) {
      const auto row = gsl_matrix_const_row(X, i);
      double value, error;
      gsl_multifit_linear_est(&row.vector, c, covariance, &value, &error);
      residuals[i] = value - y[i], leverages[i] = error * error;
    }
    gsl_multifit_linear_free(work);
    gsl_vector_free(c), gsl_matrix_free(covariance), gsl_matrix_free(X);
  }
};

/// Orthonormal columns that span those of a parabola (Gram and Schmidt).
std::vector<std::vector<double>> columns() {
  std::vector<std::vector<double>> all;
  for (std::size_t j = 0; j < q; ++j) {
    std::vector<double> x;
    for (std::size_t i = 0; i < n; ++i)
      x.push_back(std::pow(static_cast<double>(i) / n, static_cast<double>(j)));
    for (int twice = 0; twice < 2; ++twice)
      for (const auto& other : all) {
        const double along = dot(x, other);
        for (std::size_t i = 0; i < n; ++i) x[i] -= along * other[i];
      }
    const double length = std::sqrt(dot(x, x));
    for (double& value : x) value /= length;
    all.push_back(x);
  }
  return all;
}

}  // namespace

TEST_CASE("left out: residuals, leverages and squares are those of a fit to the other rows",
          "[fit]") {
  std::mt19937 random(7);
  Normal normal;
  std::vector<double> y;
  for (std::size_t i = 0; i < n; ++i) y.push_back(normal(random));
  std::vector<double> weights(n, 1);
  const auto B = columns();
  const std::vector<double> f = Parabola(y, weights).residuals;
  LeftOut others(f, {B.begin(), B.end()});
  for (const std::size_t out : {0U, 1U, 29U, 12U, 2U}) {
    others.leave_out(out);
    weights[out] = 0;
    const Parabola again(y, weights);
    CHECK(others.squares() == Approx(again.squares).epsilon(1e-11));
    for (std::size_t i = 0; i < n; ++i) {
      CAPTURE(out, i);
      CHECK(std::abs(others.residual(i) - again.residuals[i]) < 1e-11);
      // Of a row that is left out it is 1 + the variance of its prediction.
      if (weights[i] > 0) CHECK(std::abs(others.left(i) - (1 - again.leverages[i])) < 1e-11);
    }
  }
}

TEST_CASE("left out: without columns each row is by itself", "[fit]") {
  const std::vector<double> f{3, 4};
  LeftOut others(f, {});
  CHECK(others.squares() == 25);
  others.leave_out(0);
  CHECK(others.squares() == 16);
  CHECK(others.residual(0) == 3);
  CHECK(others.left(1) == 1);
}
