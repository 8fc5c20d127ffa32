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
    if (std::isfinite(W.aa) && std::isfinite(W.ab) && std::isfinite(W.bb))
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

/// The line x = mean + slope (g - its mean) through numbers x of the runs with standard errors
/// sigma, which scatter by tau from run to run beside them: least squares with the weights
/// 1/(sigma^2 + tau^2). If g is the same in all runs, the slope is 0.
struct Line {
  double tau_square = 0;
  double mean = 0, mean_g = 0, slope = 0;
  double weight = 0, spread = 0;  ///< sum of w, and of w (g - mean_g)^2
  double chi2 = 0;                ///< sum of w r^2 of the residuals r
  double fall = 0;                ///< -d chi2/d tau^2
  std::vector<double> residuals;  ///< sqrt(w) r

  double weight_of(const Estimate& x) const { return 1 / (x.sigma * x.sigma + tau_square); }
};

Line line_through(const std::vector<Estimate>& x, const std::vector<double>& g, double tau_square) {
  Line line;
  line.tau_square = tau_square;
  const auto w = [&](std::size_t i) { return line.weight_of(x[i]); };
  for (std::size_t i = 0; i < x.size(); ++i) line.weight += w(i);
  for (std::size_t i = 0; i < x.size(); ++i) {
    line.mean += w(i) / line.weight * x[i].value;
    line.mean_g += w(i) / line.weight * g[i];
  }
  double together = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double off = g[i] - line.mean_g;
    line.spread += w(i) * off * off;
    together += w(i) * off * (x[i].value - line.mean);
  }
  if (line.spread > 0) line.slope = together / line.spread;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double r = x[i].value - line.mean - line.slope * (g[i] - line.mean_g);
    line.residuals.push_back(std::sqrt(w(i)) * r);
    line.chi2 += w(i) * r * r;
    line.fall += w(i) * w(i) * r * r;
  }
  return line;
}

/// The line whose tau makes chi^2 what it is on average, `freedom`, or 0 where chi^2 is not above
/// that (Mandel and Paule 1970, Anal. Chem. 42, 1194). Newton's method on 1/chi^2, which is linear
/// in tau^2 where all errors are equal.
Line scattered_line(const std::vector<Estimate>& x, const std::vector<double>& g, double freedom) {
  double tau_square = 0;
  Line line = line_through(x, g, 0);
  for (int i = 0; i < 100 && line.chi2 > 0 && std::isfinite(line.weight); ++i) {
    const double step = (line.chi2 / freedom - 1) * line.chi2 / line.fall,
                 next = std::max(0.0, tau_square + step);
    const bool done = std::abs(next - tau_square) <= 1e-12 * next;
    tau_square = next;
    line = line_through(x, g, tau_square);
    if (done) break;
  }
  return line;
}

/// What the few runs say of their scatter is itself uncertain: the factor of errors that rest on
/// it, for these degrees of freedom. Where the scatter shows less than the noise alone, 1.
double student(const Line& line, double freedom) {
  const double t = gsl_cdf_tdist_Pinv(0.975, freedom) / 1.96;
  return std::max(1.0, t * std::sqrt(line.chi2 / freedom));
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
    raw.means_taken += one->raw_noise->means_taken;
    append(raw.sources, one->raw_noise->sources);
    append(raw.source_runs, one->raw_noise->source_runs);
    append(raw.innovations, one->raw_noise->innovations);
    append(raw.innovation_runs, one->raw_noise->innovation_runs);
  }
  const std::size_t n = joint.minimum.f.size();
  const bool same_noise = !joint.raw_noise || raw.source_runs == joint.raw_noise->source_runs;
  if (fit.minimum.f.size() != n || n <= p || !same_noise) return joint;
  // So many parameters more have been fitted.
  const double more =
      static_cast<double>(n - joint.minimum.theta.size()) / static_cast<double>(n - p);
  for (auto* of_noise : {&fit.minimum.f, &raw.sources})
    for (double& x : *of_noise) x *= std::sqrt(more);
  fit.minimum.rss = rss * more;
  if (fit.raw_noise) fit.raw_noise = std::move(raw);
  return fit;
}

bool of_one_way(const std::vector<OwnLaw>& laws, const Fitted& joint) {
  const auto way = [&](const OwnLaw& one) { return joint.rolls->runs()[one.run].way; };
  return std::all_of(laws.begin(), laws.end(),
                     [&](const OwnLaw& one) { return way(one) == way(laws.front()); });
}

/// The slope of the mat at which the runs of both directions agree best, and the laws as they are
/// there: R S acts like a shift along the way, so that ln D changes by -way R/D with S.
void take_slope(std::vector<OwnLaw>& laws, double freedom, std::vector<double>& by_slope,
                NoiseErrors& errors, Fitted& joint) {
  const auto n = static_cast<double>(laws.size());
  double log_v = 0;  // of the speed at which the D of the runs are known best, on average
  for (const OwnLaw& one : laws) log_v += best_known(one.covariance) / n;
  std::vector<Estimate> log_D;
  double mean = 0;
  for (const OwnLaw& one : laws) {
    log_D.push_back(one.log_D(log_v));
    mean += log_D.back().value / n;
  }
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const ObservedRun& run = joint.rolls->runs()[laws[i].run];
    by_slope[i] = run.way * run.body.R / std::exp(mean);
  }
  const Line line = scattered_line(log_D, by_slope, freedom);
  joint.slope->value += line.slope;
  errors.slope = student(line, freedom) / std::sqrt(line.spread);
  for (std::size_t i = 0; i < laws.size(); ++i) laws[i].law.a -= by_slope[i] * line.slope;
}

/// a and b as the means of those of the runs, and the slope that goes with them.
void take_means(std::vector<OwnLaw> laws, double freedom, NoiseErrors& errors, Fitted& joint) {
  const std::vector<double> same(laws.size(), 0);
  std::vector<double> by_slope = same;
  if (joint.slope) take_slope(laws, freedom, by_slope, errors, joint);
  std::vector<Estimate> as, bs;
  for (const OwnLaw& one : laws) as.push_back(one.log_D(0)), bs.push_back(one.b());
  const Line a = scattered_line(as, same, freedom), b = scattered_line(bs, same, freedom);
  double mean_by_slope = 0, noise = 0, scatter = 0;  // of a; of the products of a and b
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const double of_a = a.weight_of(as[i]) / a.weight, of_b = b.weight_of(bs[i]) / b.weight;
    mean_by_slope += of_a * by_slope[i];
    noise += of_a * of_b * laws[i].covariance.ab;
    scatter += a.residuals[i] * b.residuals[i] / std::sqrt(a.weight * b.weight) / freedom;
  }
  const double by_a = student(a, freedom), by_b = student(b, freedom);
  const bool free_a = std::isfinite(a.weight), free_b = std::isfinite(b.weight);
  if (free_a) joint.a.value = std::exp(a.mean);
  if (free_b) joint.b.value = b.mean;
  errors.a =
      free_a ? joint.a.value * std::hypot(by_a / std::sqrt(a.weight), mean_by_slope * errors.slope)
             : 0;
  errors.b = free_b ? by_b / std::sqrt(b.weight) : 0;
  if (!free_a || !free_b) return;
  const bool scattered = a.tau_square > 0 && b.tau_square > 0;
  errors.together = joint.a.value * (scattered ? scatter * by_a * by_b : noise);
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
  const Agreement found = compare(laws, parameters, options.fit_slope);
  if (found.agree()) return found;
  const Fitted around_own = with_own_noise(joint, own);
  errors = noise_errors(around_own, uncertainty_of(around_own));
  const double freedom = static_cast<double>(laws.size()) - 1 - options.fit_slope;
  const bool by_means =
      freedom >= 1 && !(options.fit_slope && (options.a || of_one_way(laws, joint)));
  if (!by_means)
    errors.multiply(std::max(1.0, std::sqrt(found.chi2 / static_cast<double>(found.dof))));
  else take_means(laws, freedom, errors, joint);
  return found;
}

}  // namespace rolling
