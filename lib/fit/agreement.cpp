#include "fit/agreement.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_eigen.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/gsl.h"

namespace rolling {
namespace {

/// Of a number pair (ln a, b); the symmetric matrices of such pairs.
struct Pair {
  double a, b;
};
struct Symmetric {
  double aa, ab, bb;

  Pair operator*(Pair x) const { return {aa * x.a + ab * x.b, ab * x.a + bb * x.b}; }
  double square(Pair x) const { return x.a * (aa * x.a + 2 * ab * x.b) + x.b * bb * x.b; }
  /// A row of zeros, of what is held fixed, stays one.
  Symmetric inverse() const {
    if (aa == 0 || bb == 0) return {aa == 0 ? 0 : 1 / aa, 0, bb == 0 ? 0 : 1 / bb};
    const double det = aa * bb - ab * ab;
    return {bb / det, -ab / det, aa / det};
  }
};
Pair operator-(Pair x, Pair y) { return {x.a - y.a, x.b - y.b}; }
Symmetric operator+(Symmetric X, Symmetric Y) { return {X.aa + Y.aa, X.ab + Y.ab, X.bb + Y.bb}; }
Symmetric operator-(Symmetric X, Symmetric Y) { return {X.aa - Y.aa, X.ab - Y.ab, X.bb - Y.bb}; }

/// What one run says of the law by itself.
struct OwnLaw {
  std::size_t run;
  Pair law;
  Symmetric covariance;
  double freedom;  // of its noise
};

std::vector<OwnLaw> own_laws(const std::vector<std::optional<Fitted>>& own) {
  std::vector<OwnLaw> laws;
  for (std::size_t r = 0; r < own.size(); ++r) {
    if (!own[r]) continue;
    const Fitted& fit = *own[r];
    const Spread covariance = uncertainty_of(fit).covariance;
    auto by_log_a = fit.a.gradient;
    for (double& slope : by_log_a) slope /= fit.a.value;
    const Symmetric C{covariance(by_log_a, by_log_a), covariance(by_log_a, fit.b.gradient),
                      covariance(fit.b.gradient, fit.b.gradient)};
    const Symmetric W = C.inverse();
    if (!std::isfinite(W.aa) || !std::isfinite(W.ab) || !std::isfinite(W.bb)) continue;
    laws.push_back({r,
                    {std::log(fit.a.value), fit.b.value},
                    C,
                    static_cast<double>(fit.minimum.f.size() - fit.minimum.theta.size())});
  }
  return laws;
}

/// How far a run is from the others: chi^2 of its distance to their mean.
void stand_out(Agreement& result, const OwnLaw& one, Pair others, Symmetric C, double& most) {
  const Pair d = one.law - others;
  C = C + one.covariance;
  const double distance = C.inverse().square(d);
  if (!(distance > most)) return;
  most = distance;
  // D is known best at the speed where its error does not depend on that of b.
  const double log_v = C.bb > 0 ? -C.ab / C.bb : 0;
  result.run = one.run;
  result.speed = std::exp(log_v);
  result.log_D = {d.a + log_v * d.b,
                  std::sqrt(std::max(0.0, C.aa + log_v * (2 * C.ab + log_v * C.bb)))};
  result.b = {d.b, std::sqrt(C.bb)};
}

Agreement compare(const std::vector<OwnLaw>& laws, std::size_t parameters, bool slope) {
  Symmetric W{};
  Pair sum{};
  for (const OwnLaw& one : laws) {
    const Symmetric weight = one.covariance.inverse();
    const Pair weighted = weight * one.law;
    W = W + weight;
    sum = {sum.a + weighted.a, sum.b + weighted.b};
  }
  Agreement result{};
  result.runs = laws.size();
  const Pair mean = W.inverse() * sum;
  result.mean = {std::exp(mean.a), mean.b};
  double most = -1, likelihood = 0;
  for (const OwnLaw& one : laws) {
    const Symmetric weight = one.covariance.inverse();
    const double distance = weight.square(one.law - mean);
    result.chi2 += distance;
    // The size of the noise of each run is an estimate too: the ratio of likelihoods allows for it.
    likelihood += one.freedom * std::log1p(distance / one.freedom);
    const Symmetric rest = (W - weight).inverse();
    stand_out(result, one, rest * (sum - weight * one.law), rest, most);
  }
  result.dof = parameters * (laws.size() - 1);
  if (slope) --result.dof;
  if (result.dof > 0)
    result.significance = gsl_cdf_chisq_Q(likelihood, static_cast<double>(result.dof));
  return result;
}

using Matrix = std::vector<double>;  // square, row by row

void add_square(Matrix& A, const std::vector<double>& x, double factor) {
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < x.size(); ++j) A[i * x.size() + j] += factor * x[i] * x[j];
}

/// (1 - H)^-1/2 z for a symmetric H; nothing of z in directions in which H is 1.
std::vector<double> freed(Matrix H, const std::vector<double>& z) {
  silence_gsl();
  const std::size_t n = z.size();
  auto view = gsl_matrix_view_array(H.data(), n, n);
  auto values = own(gsl_vector_alloc(n), gsl_vector_free);
  auto vectors = own(gsl_matrix_alloc(n, n), gsl_matrix_free);
  auto work = own(gsl_eigen_symmv_alloc(n), gsl_eigen_symmv_free);
  check_gsl(gsl_eigen_symmv(&view.matrix, values.get(), vectors.get(), work.get()),
            "the runs cannot be compared");
  std::vector<double> result(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double rest = 1 - gsl_vector_get(values.get(), k);
    if (rest < 1e-6) continue;
    double part = 0;
    for (std::size_t i = 0; i < n; ++i) part += gsl_matrix_get(vectors.get(), i, k) * z[i];
    for (std::size_t i = 0; i < n; ++i)
      result[i] += gsl_matrix_get(vectors.get(), i, k) * part / std::sqrt(rest);
  }
  return result;
}

/// The middle of the sandwich of the shared parameters by the scatter of the runs: the sum of
/// z z^T, z = (1 - H)^-1/2 Q^T f and H = Q^T Q of each run.
Matrix scatter(const Fitted& joint) {
  const std::size_t q = joint.system.columns(), s = joint.system.shared;
  const auto Q = orthonormal(joint.system, joint.minimum);
  Matrix all(s * s);
  std::size_t row = 0;
  for (const std::size_t n : joint.system.runs) {
    Matrix H(s * s);
    std::vector<double> z(s);
    for (const std::size_t end = row + n; row < end; ++row) {
      const std::vector<double> of_row(&Q[row * q + q - s], &Q[row * q] + q);
      add_square(H, of_row, 1);
      for (std::size_t i = 0; i < s; ++i) z[i] += of_row[i] * joint.minimum.f[row];
    }
    add_square(all, freed(std::move(H), z), 1);
  }
  return all;
}

/// The joint fit with the noise that the runs show around their own laws: around the common one the
/// residuals hold what the runs disagree by.
Fitted with_own_noise(const Fitted& joint, const std::vector<std::optional<Fitted>>& own) {
  Fitted fit = joint;
  fit.minimum.f.clear();
  fit.sources.clear();
  fit.innovations.clear();
  double rss = 0, variance = 0;
  std::size_t p = 0;
  const auto append = [](std::vector<double>& to, const std::vector<double>& more) {
    to.insert(to.end(), more.begin(), more.end());
  };
  for (const auto& one : own) {
    if (!one) return joint;
    append(fit.minimum.f, one->minimum.f);
    append(fit.sources, one->sources);
    append(fit.innovations, one->innovations);
    rss += one->minimum.rss;
    variance += one->noise_variance.value_or(0) / static_cast<double>(own.size());
    p += one->minimum.theta.size();
  }
  const std::size_t n = joint.minimum.f.size();
  if (fit.minimum.f.size() != n || fit.sources.size() != joint.sources.size() ||
      fit.innovations.size() != joint.innovations.size() || n <= p)
    return joint;
  // So many parameters more have been fitted.
  const double more =
      static_cast<double>(n - joint.minimum.theta.size()) / static_cast<double>(n - p);
  for (auto* of_noise : {&fit.minimum.f, &fit.sources})
    for (double& x : *of_noise) x *= std::sqrt(more);
  fit.minimum.rss = rss * more;
  if (fit.noise_variance) fit.noise_variance = variance;
  return fit;
}

}  // namespace

std::optional<Agreement> agreement_of(Route route, const std::vector<FitRun>& runs,
                                      const FitOptions& options, const Fitted& joint,
                                      Uncertainty& errors) {
  const std::size_t s = joint.system.shared, parameters = !options.a + !options.b;
  if (runs.size() < 2 || errors.kind == Errors::none) return {};
  std::vector<std::optional<Fitted>> own;
  for (std::size_t r = 0; r < runs.size(); ++r) try {
      own.emplace_back(joint.rolls ? fit_of_run(joint, r, options)
                                   : fit_route(route, {runs[r]}, options));
    } catch (const Error&) {  // it does not determine a law by itself
      own.emplace_back();
    }
  const auto laws = own_laws(own);
  if (laws.size() < 2) return {};
  Agreement result = compare(laws, parameters, options.fit_slope);
  if (result.agree()) return result;
  errors = uncertainty_of(with_own_noise(joint, own));
  const double freedom =
      static_cast<double>(laws.size()) - 1 - static_cast<double>(options.fit_slope);
  Matrix middle;
  if (freedom >= 1) {
    const double t = gsl_cdf_tdist_Pinv(0.975, freedom) / 1.96;
    middle = scatter(joint);
    for (double& x : middle) x *= t * t;
  } else {
    middle = errors.covariance.shared_middle(s);
    for (double& x : middle) x *= result.chi2 / static_cast<double>(result.dof);
  }
  errors.covariance.widen(middle, s);
  return result;
}

}  // namespace rolling
