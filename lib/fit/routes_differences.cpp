// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/routes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/matrix.h"
#include "base/median.h"
#include "fit/uncertainty.h"
#include "least_squares/minimise.h"
#include "statistics/residuals.h"

namespace rolling {
namespace {

std::vector<Response> responses_by(const LinearFilter& filter, const std::vector<Run>& all) {
  std::vector<Response> responses;
  for (const auto& run : all) responses.push_back(response_of({filter}, run.t));
  return responses;
}

/// A filter and the share of white noise in its output.
struct Maker {
  const LinearFilter* filter = nullptr;
  double share = 0;
  double gain = 0;       // ln of the likelihood ratio to white noise beside a roll without a filter
  bool another = false;  // filter is nearly as likely
};

/// The filter and the share with the largest restricted likelihood; no filter if white noise alone
/// is nearly as likely. A filter rounds off the stop, and what its roll leaves there looks like
/// correlated noise: so the roll without a filter is the one to compare with.
Maker most_likely(const std::vector<Run>& all, const std::vector<Rows>& rows,
                  const FitOptions& options, const Fitted& plain) {
  const double least = std::exp(-12);
  const double most = std::exp(4);
  const std::vector<double>& theta = plain.minimum.theta;
  const auto model_of = [&](const std::vector<Response>& responses) {
    return Model(observe(Route::velocity, all, rows, responses, options), plain.parameters());
  };
  const double of_white_noise = restricted_likelihood(evaluated(system_of(model_of({})), theta));
  Maker best;
  std::vector<double> gains;
  for (const LinearFilter& filter : options.possible_filters) {
    const WhiteShare found =
        most_likely_share(model_of(responses_by(filter, all)), theta, least, most);
    const double gain = found.likelihood - of_white_noise;
    if (gain >= levels::likely_filter && gain > best.gain) best = {&filter, found.share, gain};
    gains.push_back(gain);
  }
  const auto near = [&](double gain) { return gain > best.gain - levels::likely; };
  best.another = std::ranges::count_if(gains, near) > 1;
  return best;
}

/// For each row, the number of gaps before it: of steps that are much longer than the median of the
/// five before them, or of the five behind them. The steps of a wheel that slows down grow, and
/// uneven times differ, without a gap.
std::vector<std::size_t> gaps_before(const std::vector<double>& t) {
  constexpr double longer = 1.7;
  constexpr std::size_t aside = 3;  // from a step to the middle of those five
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
  const std::vector<double> usual = medians_of_five(steps);
  std::vector<std::size_t> gaps(t.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double before = usual[i < aside ? 0 : i - aside];
    const double behind = usual[std::min(i + aside, steps.size() - 1)];
    gaps[i + 1] = gaps[i] + (steps[i] > longer * std::min(before, behind));
  }
  return gaps;
}

/// Sensors' programs differ in how they treat the ends of a run and lost rows; elsewhere the
/// candidates are known. This function removes from `rows` the rows whose window reaches an end
/// or a gap; it returns false if that would be half of a run: what is left would be another run.
bool leave_out_irregular(const std::vector<Run>& all, std::vector<Rows>& rows, std::size_t reach) {
  for (std::size_t r = 0; r < all.size(); ++r) {
    const std::size_t n = all[r].t.size();
    const std::size_t before = rows[r].size();
    const auto gaps = gaps_before(all[r].t);
    std::erase_if(rows[r], [&](std::size_t i) {
      return i < reach || i + reach >= n || gaps[i + reach] > gaps[i - reach];
    });
    if (2 * rows[r].size() < before) return false;
  }
  return true;
}

/// How long before its row, on average, a filter takes its speed, on even times of this step.
double lag_of(const LinearFilter& filter, double step) {
  const std::size_t n = 4 * filter.reach + 1;
  const std::size_t middle = 2 * filter.reach;
  std::vector<double> t(n);
  std::vector<double> squares(n);
  for (std::size_t i = 0; i < n; ++i) {
    t[i] = step * static_cast<double>(i);
    squares[i] = t[i] * t[i];
  }
  return t[middle] - filter.apply(t, squares)[middle] / 2;
}

/// Differences to the row before and to the row after differ in the clock alone if the times are
/// even. If the rows cannot separate them, v0 is the mean of both, and half of their difference
/// is an error of it.
void set_clock(Fitted& fit, const LinearFilter& filter, const std::vector<Run>& all) {
  for (std::size_t r = 0; r < all.size(); ++r) {
    const std::vector<double>& t = all[r].t;
    const double step = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
    const double lost = lag_of(filter, step) * fit.roll(r).at(0).a;
    fit.v0[r].value -= fit.model.runs()[r].way * lost;
    if (r == 0) fit.error_of_clock = std::abs(lost);
  }
}

/// The search for the filter uses at most this many rows from the beginning of each run. About a
/// hundred rows usually give a likelihood ratio of e^3.
constexpr std::size_t searched = 2000;

/// False if the search would find nothing: where the rounding of the speeds alone leaves such
/// residuals, or where differences would leave a correlation that this many residuals show. In
/// fewer residuals the likelihood tells more than this test does.
bool may_be_differences(const Fitted& plain) {
  if (plain.minimum.rss < variance_of_rounding(plain) * static_cast<double>(plain.degrees_left()))
    return false;
  std::vector<double> f;
  std::vector<std::size_t> runs;
  for (const auto of_run : by_run(plain.minimum.f, plain.model.rows())) {
    const auto head = of_run.first(std::min(of_run.size(), searched));
    runs.push_back(head.size());
    f.insert(f.end(), head.begin(), head.end());
  }
  return f.size() < searched || ljung_box(f, taken_by_few(plain.minimum.theta.size()), runs) < 0.1;
}

}  // namespace

std::optional<Fitted> fit_differences(const std::vector<Run>& all, const FitOptions& options,
                                      const Fitted& plain) {
  if (!may_be_differences(plain)) return {};
  std::size_t reach = 0;
  for (const auto& filter : options.possible_filters) reach = std::max(reach, filter.reach);
  std::vector<Run> heads;
  for (std::size_t r = 0; r < all.size(); ++r) {
    Run& head = heads.emplace_back();
    head.body = all[r].body;
    head.x0 = all[r].x0;
    for (std::size_t i = 0; i < std::min(all[r].t.size(), searched); ++i) {
      head.t.push_back(all[r].t[i]);
      head.v.push_back(all[r].v[i]);
    }
  }
  std::vector<Rows> head_rows = usable(Route::velocity, heads);
  try {
    if (!leave_out_irregular(heads, head_rows, reach)) return {};
    const Maker maker = most_likely(heads, head_rows, options, plain);
    if (!maker.filter || maker.filter->from == Quantity::v) return {};
    std::vector<Rows> regular = usable(Route::velocity, all);
    if (!leave_out_irregular(all, regular, maker.filter->reach)) return {};
    Fitted fit = fit_rolls(Route::velocity, all, std::move(regular),
                           responses_by(*maker.filter, all), options, {maker.share, true});
    const Uncertainty found = uncertainty_of(fit);
    if (found.whiteness > levels::not_white && found.kind != Errors::uneven) {
      if (maker.another) set_clock(fit, *maker.filter, all);
      return fit;
    }
  } catch (const Error&) {  // too few rows, or no minimum
  }
  return {};
}

}  // namespace rolling
