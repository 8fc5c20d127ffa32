#include "fit/agreement.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"

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

/// ln D at a speed, and its error.
Estimate log_D_of(Pair law, const Symmetric& C, double log_v) {
  return {law.a + log_v * law.b,
          std::sqrt(std::max(0.0, C.aa + log_v * (2 * C.ab + log_v * C.bb)))};
}
/// ln of the speed at which D is known best: there its error does not depend on that of b.
double best_known(const Symmetric& C) { return C.bb > 0 ? -C.ab / C.bb : 0; }

/// What one run says of the law by itself.
struct OwnLaw {
  std::size_t run;
  Pair law;
  Symmetric covariance;
  double freedom;  // of its noise

  Estimate log_D(double log_v) const { return log_D_of(law, covariance, log_v); }
  Estimate b() const { return {law.b, std::sqrt(covariance.bb)}; }
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
  if (!(distance > most * (1 + 1e-9))) return;  // two runs are as far from each other
  most = distance;
  const double log_v = best_known(C);
  result.run = one.run;
  result.speed = std::exp(log_v);
  result.log_D = log_D_of(d, C, log_v);
  result.b = {d.b, std::sqrt(C.bb)};
}

/// The mean of numbers with standard errors (all 0 for one that is held), weighted by their inverse
/// squares, and the root of chi^2 over `freedom`.
struct Average {
  Estimate mean;
  double scale;
};
Average average(const std::vector<Estimate>& numbers, double freedom) {
  double weights = 0, sum = 0, chi2 = 0;
  for (const Estimate& x : numbers) weights += 1 / (x.sigma * x.sigma);
  if (std::isinf(weights)) return {numbers.front(), 1};
  for (const Estimate& x : numbers) sum += x.value / (x.sigma * x.sigma);
  const Estimate mean{sum / weights, 1 / std::sqrt(weights)};
  for (const Estimate& x : numbers) chi2 += std::pow((x.value - mean.value) / x.sigma, 2);
  return {mean, std::sqrt(chi2 / freedom)};
}

/// Of ln D at a speed.
Average average_of_D(const std::vector<OwnLaw>& laws, double log_v, double freedom) {
  std::vector<Estimate> all;
  for (const OwnLaw& one : laws) all.push_back(one.log_D(log_v));
  return average(all, freedom);
}

/// What the few runs say of their scatter is itself uncertain: for these degrees of freedom.
double student(double freedom) { return gsl_cdf_tdist_Pinv(0.975, freedom) / 1.96; }

struct Comparison {
  Agreement result;
  double freedom = 0;  // of the scatter of a number from run to run
  double scale = 1;    // of the error of the D that is known best, or of all together
};

Comparison compare(const std::vector<OwnLaw>& laws, std::size_t parameters, bool slope) {
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
  if (result.dof == 0) return {result};
  result.significance = gsl_cdf_chisq_Q(likelihood, static_cast<double>(result.dof));
  const double freedom = static_cast<double>(laws.size()) - 1 - slope;
  const double together = std::sqrt(result.chi2 / static_cast<double>(result.dof));
  if (freedom < 1) return {result, freedom, std::max(1.0, together)};
  const Average D = average_of_D(laws, best_known(W.inverse()), freedom);
  return {result, freedom, std::max(1.0, student(freedom) * D.scale)};
}

/// The joint fit with the noise that the runs show around their own laws: around the common one the
/// residuals hold what the runs disagree by.
Fitted with_own_noise(const Fitted& joint, const std::vector<std::optional<Fitted>>& own) {
  Fitted fit = joint;
  fit.minimum.f.clear();
  RawNoise raw{};
  double rss = 0;
  std::size_t p = 0;
  const auto append = [](auto& to, const auto& more) {
    to.insert(to.end(), more.begin(), more.end());
  };
  for (const auto& one : own) {
    if (!one || one->raw_noise.has_value() != joint.raw_noise.has_value()) return joint;
    append(fit.minimum.f, one->minimum.f);
    rss += one->minimum.rss;
    p += one->minimum.theta.size();
    if (!one->raw_noise) continue;
    raw.variance += one->raw_noise->variance / static_cast<double>(own.size());
    append(raw.sources, one->raw_noise->sources);
    append(raw.source_runs, one->raw_noise->source_runs);
    append(raw.innovations, one->raw_noise->innovations);
    append(raw.innovation_runs, one->raw_noise->innovation_runs);
  }
  const std::size_t n = joint.minimum.f.size();
  if (fit.minimum.f.size() != n || n <= p ||
      (joint.raw_noise && raw.source_runs != joint.raw_noise->source_runs))
    return joint;
  // So many parameters more have been fitted.
  const double more =
      static_cast<double>(n - joint.minimum.theta.size()) / static_cast<double>(n - p);
  for (auto* of_noise : {&fit.minimum.f, &raw.sources})
    for (double& x : *of_noise) x *= std::sqrt(more);
  fit.minimum.rss = rss * more;
  if (fit.raw_noise) fit.raw_noise = std::move(raw);
  return fit;
}

/// By how much the mean of ln a moves with the slope that the runs were held at: R S acts like a
/// shift along the way. Nothing, if as many runs roll up as down.
double by_slope(const std::vector<OwnLaw>& laws, const Fitted& joint) {
  double sum = 0;
  if (!joint.slope) return 0;
  for (const OwnLaw& one : laws) {
    const ObservedRun& run = joint.rolls->runs()[one.run];
    const double log_D = one.log_D(best_known(one.covariance)).value;
    sum += run.way * run.body.R / std::exp(log_D) / static_cast<double>(laws.size());
  }
  return sum;
}

/// a and b as the means of those of the runs.
void take_means(const std::vector<OwnLaw>& laws, double freedom, NoiseErrors& errors,
                Fitted& joint) {
  const double t = student(freedom);
  std::vector<Estimate> bs;
  for (const OwnLaw& one : laws) bs.push_back(one.b());
  const Average a = average_of_D(laws, 0, freedom), b = average(bs, freedom);
  double together = 0, scatter = 0;  // of the products of the deviations of both
  for (const OwnLaw& one : laws) {
    const double weight =
        std::pow(a.mean.sigma * b.mean.sigma, 2) / (one.covariance.aa * one.covariance.bb);
    together += weight * one.covariance.ab;
    scatter += std::sqrt(weight) * (one.law.a - a.mean.value) * (one.law.b - b.mean.value);
  }
  if (a.mean.sigma > 0) joint.a.value = std::exp(a.mean.value);
  if (b.mean.sigma > 0) joint.b.value = b.mean.value;
  errors.a = joint.a.value * std::hypot(a.mean.sigma * std::max(1.0, t * a.scale),
                                        by_slope(laws, joint) * errors.slope);
  errors.b = b.mean.sigma * std::max(1.0, t * b.scale);
  if (errors.a == 0 || errors.b == 0) return;
  errors.together =
      joint.a.value * (t * std::min(a.scale, b.scale) > 1 ? t * t * scatter / freedom : together);
}

}  // namespace

std::optional<Agreement> agreement_of(Route route, const std::vector<FitRun>& runs,
                                      const FitOptions& options, NoiseErrors& errors,
                                      Fitted& joint) {
  const std::size_t parameters = !options.a + !options.b;
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
  const Comparison found = compare(laws, parameters, options.fit_slope);
  if (found.result.agree()) return found.result;
  const Fitted around_own = with_own_noise(joint, own);
  errors = noise_errors(around_own, uncertainty_of(around_own));
  errors.multiply(found.scale);
  if (found.freedom >= 1) take_means(laws, found.freedom, errors, joint);
  return found.result;
}

}  // namespace rolling
