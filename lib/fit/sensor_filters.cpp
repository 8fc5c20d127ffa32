#include "fit/sensor_filters.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/golden_section.h"
#include "fit/errors.h"

namespace rolling {
namespace {

Making making_by(const LinearFilter& filter, const std::vector<FitRun>& all) {
  Making making;
  for (const auto& run : all) making.responses.push_back(response_of({filter}, run.t));
  return making;
}

/// A filter, and how much of the noise is white, as a share of what the filter makes.
struct Maker {
  const LinearFilter* filter = nullptr;
  double white_share = 0;
};

/// ln of the restricted likelihood of residuals as a function of their noise: the model is linear
/// around theta.
class Likelihood {
 public:
  Likelihood(std::vector<ObservedRun> runs, const Parameters& q, const std::vector<double>& theta)
      : runs_(std::move(runs)), linear_(runs_.size()) {
    linear_system_ =
        system_of(std::make_shared<const RollModel>(runs_, q), std::make_shared<const Noise>());
    linear_system_.evaluate(theta, [&](std::size_t r, std::span<double> f, std::span<double> J) {
      auto& [columns, done] = linear_[r];
      const std::size_t n = linear_system_.runs[r];
      columns.resize((1 + linear_system_.columns()) * n);
      std::copy(f.begin(), f.end(), columns.begin() + static_cast<std::ptrdiff_t>(done));
      for (std::size_t i = 0; i < J.size(); ++i)
        columns[(1 + i / f.size()) * n + done + i % f.size()] = J[i];
      done += f.size();
    });
    theta_ = theta;
  }
  double operator()(double white_share) const {
    const auto noise = noise_of(runs_, white_share);
    System system = linear_system_;
    system.evaluate = [&](const std::vector<double>&, const TakeRows& take) {
      for (std::size_t r = 0; r < linear_.size(); ++r) {
        auto columns = linear_[r].columns;
        noise->weight(r, columns);
        const std::size_t n = linear_system_.runs[r];
        take(r, std::span(columns).first(n), std::span(columns).subspan(n));
      }
    };
    return restricted_likelihood(system, theta_) - noise->log_size();
  }

 private:
  struct Linear {
    std::vector<double> columns;  // f of the whole run, then the columns of J
    std::size_t done = 0;         // the rows that are there
  };
  std::vector<ObservedRun> runs_;
  std::vector<Linear> linear_;
  System linear_system_;
  std::vector<double> theta_;
};

/// The filter and the share under which the residuals are most likely; no filter if white noise
/// alone is nearly as likely.
Maker most_likely(const std::vector<FitRun>& all, const std::vector<Rows>& rows,
                  const FitOptions& options, const Fitted& plain) {
  // A gain that white noise shows once in a hundred records.
  constexpr double decisive = 3;
  constexpr double least_share = -12, white = 4;  // ln of the share
  Maker best;
  double most = 0;
  for (const LinearFilter& filter : options.possible_filters) {
    const Likelihood likelihood(
        observe(Route::velocity, all, rows, making_by(filter, all), options),
        plain.rolls->parameters(), plain.minimum.theta);
    const Largest found = golden_section(
        least_share, white, 0.1, [&](double log_share) { return likelihood(std::exp(log_share)); });
    const double gain = found.value - likelihood(std::exp(white)) - decisive;
    if (gain <= most) continue;
    most = gain;
    best = {&filter, std::exp(found.at)};
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
    // Half a record more than is usual.
    const double most = *middle * (1 + 0.25 / static_cast<double>(reach));
    std::erase_if(rows[r], [&](std::size_t i) {
      return i < reach || i + reach >= t.size() || spans[i - reach] > most;
    });
  }
  return true;
}

/// The filter is looked for in so many records at the beginning of each run. A hundred are usually
/// enough for a factor e^3 in likelihood.
constexpr std::size_t searched = 2000;

}  // namespace

std::optional<Fitted> fit_differences(const std::vector<FitRun>& all, const FitOptions& options,
                                      const Fitted& plain) {
  std::size_t reach = 0;
  for (const auto& filter : options.possible_filters) reach = std::max(reach, filter.reach);
  std::vector<FitRun> heads;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const std::size_t n = std::min(all[r].t.size(), searched);
    const auto head = [n](const std::vector<double>& x) {
      return std::vector(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(n));
    };
    FitRun& run = heads.emplace_back();
    run.t = head(all[r].t);
    run.v = head(all[r].v);
    run.body = all[r].body;
  }
  std::vector<Rows> head_rows = usable(Route::velocity, heads);
  try {
    if (!leave_out_irregular(heads, head_rows, reach)) return {};
    const Maker maker = most_likely(heads, head_rows, options, plain);
    if (!maker.filter || maker.filter->from == "v") return {};
    std::vector<Rows> regular = usable(Route::velocity, all);
    if (!leave_out_irregular(all, regular, reach)) return {};
    Fitted fit = fit_rolls(Route::velocity, all, std::move(regular), making_by(*maker.filter, all),
                           options, maker.white_share);
    const Uncertainty found = uncertainty_of(fit);
    if (found.whiteness > not_white && found.kind != Errors::uneven) return fit;
  } catch (const Error&) {  // too few records, or no minimum
  }
  return {};
}

}  // namespace rolling
