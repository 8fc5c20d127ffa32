// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>

#include "report/fit_runs.h"

namespace rolling {
namespace {

const std::map<Errors, const char*> kinds{{Errors::none, "none"},
                                          {Errors::classical, "classical"},
                                          {Errors::filters, "of the filters"},
                                          {Errors::differences, "of differences of positions"},
                                          {Errors::uneven, "of noise of uneven size"},
                                          {Errors::autocorrelation, "of the autocorrelation"}};

/// "sigma_a 1.9e-05: noise 1.2e-05, K 6.2e-06 (95 effective degrees of freedom); ..."
std::string budget(const FitResult& r) {
  std::string all;
  for (std::size_t j = 0; j < r.coefficients.size(); ++j) {
    const double sigma = r.coefficients[j].sigma;
    all += fmt::format("{}sigma_{} {:.2g}{} of:", j == 0 ? "" : "; ",
                       r.law.form().coefficients[j].name, sigma,
                       j == 0 ? " is the root of the sum of squares" : ",");
    for (const ErrorShare& share : r.shares) {
      // A contribution of the size of the rounding error is shown as 0.
      const double part = share.sigma(j);
      all += fmt::format("{} {} {:.2g}", &share == &r.shares.front() ? "" : ",", share.of,
                         part < 1e-9 * sigma ? 0 : part);
    }
    // Of Welch and Satterthwaite (GUM, G.4.1), since the input quantities have no limit of theirs.
    const double noise = r.shares.front().sigma(j);
    if (r.freedom > 0 && noise > 0)
      all += fmt::format(" ({:.0f} effective degrees of freedom)",
                         std::floor(static_cast<double>(r.freedom) * std::pow(sigma / noise, 4)));
  }
  return all;
}

/// The text with the value; nothing for NaN, which a fit of as many parameters as rows has.
std::string known(const char* text, double value, const char* more = "") {
  return std::isnan(value) ? "" : fmt::format(fmt::runtime(text), value, more);
}

/// Whether the value and its standard error give an interval of 95 %.
std::string intervals(const FitResult& r) {
  if (r.errors == Errors::none) return "";
  return r.not_visited.empty() ? "; intervals: +- 1.96 sigma"
                               : "; intervals: of the sum of squares";
}

/// "D = d0 + d1 v: d0 = 0.0012 +- 1e-05, d1 = 0.0005 +- 3e-05; corr d0 d1 -0.93; AICc 1.2"
std::string described(const LawFit& fit, double least) {
  const auto& names = fit.law->coefficients;
  const auto finite = [](const Estimate& c) { return std::isfinite(c.value); };
  if (fit.coefficients.empty() || !std::ranges::all_of(fit.coefficients, finite))
    return fmt::format("D = {}: not determined", fit.law->formula);
  std::string line = fmt::format("D = {}:", fit.law->formula);
  std::string corr;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Estimate& c = fit.coefficients[i];
    line += fmt::format(" {} = {:.6g}{}{}", names[i].name, c.value, known(" +- {:.2g}", c.sigma),
                        i + 1 < names.size() ? "," : ";");
    for (std::size_t j = 0; j < i; ++j)
      corr += fmt::format("{} {} {} {:.3f}", corr.empty() ? " corr" : ",", names[j].name,
                          names[i].name, fit.correlations[i][j]);
  }
  return line + (corr.empty() ? "" : corr + ";") +
         (std::isfinite(fit.aicc) ? fmt::format(" AICc {:.1f} above the least", fit.aicc - least)
                                  : " too few rows for its AICc");
}

}  // namespace

void report(Tool& tool, const FitOfRuns& fit, const LawForm& law) {
  const FitResult& r = *fit.result;
  const char* few = r.n < levels::least_tested ? "; few rows hardly show correlated noise" : "";
  tool.say(fmt::format("n {} ({} of freedom), errors {}{}{}", r.n, counted(r.freedom, "degree"),
                       kinds.at(r.errors),
                       known(" (Ljung and Box: p = {:.2g}{})", r.whiteness, few), intervals(r)));
  if (r.shares.size() > 1 && r.errors != Errors::none) tool.say(budget(r));
  if (!fit.laws) return;
  const std::vector<LawFit>& fits = fit.laws->fits;
  const double against = fit.laws->against;
  if (std::isnan(against))
    return tool.say(
        fmt::format("too few independent readings to compare {} with other laws", law.formula));
  const double least = std::ranges::min(fits, {}, &LawFit::aicc).aicc;
  for (const LawFit& one : fits) tool.say(described(one, least));
  tool.say(against <= levels::no_better_law
               ? fmt::format("no law that was tried is better than D = {} by more than {} in AICc",
                             law.formula, levels::no_better_law)
               : fmt::format("another law is better than D = {}", law.formula));
}

}  // namespace rolling
