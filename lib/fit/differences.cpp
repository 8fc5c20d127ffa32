// What made speeds of which nothing is known: a sensor's program may have made them of positions.
#include "fit/trajectory.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rolling {
namespace {

/// What may have made the speeds of all runs, and how much of their noise is white.
struct Maker {
  const LinearFilter* filter = nullptr;
  double white_share = rounding_share;
};

Making making_by(const Maker& maker, const std::vector<FitRun>& all) {
  Making making{{}, maker.white_share};
  for (const auto& run : all) making.responses.push_back(noise_response({*maker.filter}, run.t));
  return making;
}

/// The filter, and the white noise added to what it makes, under which the residuals of speeds are
/// most likely (the fit is linear around theta); none if white noise alone is nearly as likely.
Maker most_likely(const std::vector<FitRun>& all, const std::vector<Rows>& rows,
                  const std::vector<LinearFilter>& filters, const Parameters& q,
                  const std::vector<double>& theta) {
  Maker best;
  double most = 0;
  for (const LinearFilter& filter : filters) {
    Rolls rolls = make_rolls(all, rows, false, making_by({&filter, 1}, all), q.options);
    const KnownNoise none;  // the system refers to it
    System system = system_of(rolls.of, q, none);
    struct Linear {
      std::vector<double> f, J;
    };
    std::vector<Linear> of(rolls.of.size());
    system.evaluate(theta, [&](std::size_t r, std::span<double> f, std::span<double> J) {
      of[r] = {{f.begin(), f.end()}, {J.begin(), J.end()}};
    });
    KnownNoise& noise = rolls.noise;
    system.evaluate = [&](const std::vector<double>&, const TakeRows& take) {
      for (std::size_t r = 0; r < of.size(); ++r) {
        auto [f, J] = of[r];
        noise.weight(r, f, J);
        take(r, f, J);
      }
    };
    const auto likelihood = [&](double log_share) {
      noise.set_floor(std::exp(log_share));
      return restricted_likelihood(system, theta) - noise.log_size();
    };
    constexpr double decisive = 3;  // in white noise exceeded once in a hundred
    double low = -12, high = 4;     // golden section
    const double white = likelihood(high) + decisive;
    constexpr double golden = 0.6180339887498949;
    double left = high - golden * (high - low), right = low + golden * (high - low),
           at_left = likelihood(left), at_right = likelihood(right);
    while (high - low > 0.1) {
      if (at_left > at_right) {
        high = std::exchange(right, left);
        at_right = at_left;
        at_left = likelihood(left = high - golden * (high - low));
      } else {
        low = std::exchange(left, right);
        at_left = at_right;
        at_right = likelihood(right = low + golden * (high - low));
      }
    }
    const double gain = std::max(at_left, at_right) - white;
    if (gain <= most) continue;
    most = gain;
    best = {&filter, std::exp(at_left > at_right ? left : right)};
  }
  return best;
}

/// What programs do at the ends of a run and at a lost record differs; elsewhere they are known.
/// Leaves out the records of which an end or a gap is within reach; false if a run is too short to
/// tell.
bool leave_out_irregular(const std::vector<FitRun>& all, std::vector<Rows>& rows,
                         std::size_t reach) {
  for (std::size_t r = 0; r < all.size(); ++r) {
    const auto& t = all[r].t;
    std::vector<double> spans;  // of the windows
    for (std::size_t i = 2 * reach; i < t.size(); ++i) spans.push_back(t[i] - t[i - 2 * reach]);
    if (spans.empty()) return false;
    auto sorted = spans;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double most =
        *middle * (1 + 0.25 / static_cast<double>(reach));  // half a record more than is usual
    std::erase_if(rows[r], [&](std::size_t i) {
      return i < reach || i + reach >= t.size() || spans[i - reach] > most;
    });
  }
  return true;
}

/// How many records at the beginning of a run are asked what made its speeds: the factor e^3 of
/// likelihood shows in a hundred.
constexpr std::size_t telling = 2000;

}  // namespace

std::optional<RouteFit> fit_differences(const std::vector<FitRun>& all,
                                        const std::vector<Rows>& rows, Parameters& q,
                                        const std::vector<double>& theta) {
  std::size_t reach = 0;
  for (const auto& filter : q.options.possible_filters) reach = std::max(reach, filter.reach);
  std::vector<FitRun> heads;
  std::vector<Rows> head_rows;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const std::size_t n = std::min(all[r].t.size(), telling);
    const auto head = [n](const std::vector<double>& x) {
      return std::vector(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(n));
    };
    heads.push_back({.t = head(all[r].t),
                     .x = {},
                     .v = head(all[r].v),
                     .D = {},
                     .body = all[r].body,
                     .filters = {}});
    head_rows.emplace_back(rows[r].begin(), std::lower_bound(rows[r].begin(), rows[r].end(), n));
  }
  try {
    if (!leave_out_irregular(heads, head_rows, reach)) return {};
    const Maker maker = most_likely(heads, head_rows, q.options.possible_filters, q, theta);
    std::vector<Rows> regular;
    if (!maker.filter || maker.filter->from == "v" ||
        !leave_out_irregular(all, regular = rows, reach))
      return {};
    RouteFit fitted = fit_rolls(all, regular, q, making_by(maker, all), theta);
    fitted.judged = true;
    if (assess(system_of(fitted.rolls, q, fitted.noise), fitted)) return fitted;
  } catch (const Error&) {  // too few records, or no minimum
  }
  return {};
}

}  // namespace rolling
