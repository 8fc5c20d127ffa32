// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/smoother.h"

#include <algorithm>
#include <limits>

#include "signal/moving_mean.h"
#include "signal/moving_median.h"
#include "signal/savitzky_golay.h"
#include "signal/units.h"

namespace rolling {

namespace {

template <typename Smoother>
std::unique_ptr<Signal> make(const SignalOptions& options) {
  return std::make_unique<Smoother>(options.width);
}

std::unique_ptr<Signal> make_savgol(const SignalOptions& options) {
  return std::make_unique<SavitzkyGolay>(options.width, options.order, SavitzkyGolay::What::value);
}

constexpr SignalMethod methods[] = {
    // name, reach, linear, shift-invariant, has an order, make
    {"mean", half_width, true, true, false, make<MovingMean>},
    {"median", half_width, false, false, false, make<MovingMedian>},
    {"savgol", half_width, true, false, true, make_savgol},
};

}  // namespace

const std::span<const SignalMethod> smoothing_methods = methods;

std::size_t best_width(std::span<const Sample> run, const SignalOptions& options) {
  constexpr std::size_t apart = 2;
  const std::size_t order = options.method->has_order ? options.order : 1;
  // Half of the narrowest window: 2 (least - apart) > order samples remain in it.
  const std::size_t least = apart + 1 + order / 2;
  // 2000 prediction errors determine their mean square to 3 % (sqrt(2 / 2000)), and all widths are
  // compared on the same rows. The mean of 2001 readings leaves 2 % of their noise, which is
  // sufficient.
  constexpr std::size_t rows = 2000, widest = 1000;
  const std::size_t n = run.size(), most = std::max(least, std::min(n / 4, widest)),
                    every = std::max<std::size_t>(1, n / rows);
  if (n < 2 * least + 1) return 2 * least + 1;
  // A mean shrinks at the ends, where it has too few samples for a prediction; savgol keeps its
  // first and its last whole window.
  const bool whole = options.method->has_order;
  const std::size_t first = whole ? 0 : least;
  LocalPolynomial polynomial;
  const Units units(run);
  std::vector<Sample> others;
  double least_sum = std::numeric_limits<double>::infinity();
  std::size_t best = least;
  // The widths differ by an eighth, so that the chosen one is at most a sixteenth off, at a cost of
  // 1 % in the squared error. For a mean that error is w^4 / 4 + 1 / w in units of the best width:
  // the squared bias grows as w^4, and the noise falls as 1 / w.
  for (std::size_t half = least; half <= most; half += 1 + half / 8) {
    double sum = 0;
    for (std::size_t i = first; i + first < n; i += every) {
      const std::size_t k = whole ? half : std::min({half, i, n - 1 - i}),
                        middle = std::clamp(i, k, n - 1 - k);
      others.clear();
      for (std::size_t j = middle - k; j <= middle + k; ++j)
        if (j + apart < i || j > i + apart) others.push_back(run[j]);
      const double distance = std::ldexp(
          run[i].y - polynomial(others, {run[i].t, others.front().y}, order).value, -units.y);
      sum += distance * distance;
    }
    if (sum < least_sum) least_sum = sum, best = half;
  }
  return 2 * best + 1;
}

std::span<const double> AutoSmoother::finish() {
  options_.width = {best_width(run_, options_), 0};
  return smooth_ = output_of(*make_signal(options_), run_.size(),
                             [this](std::size_t i) { return run_[i]; });
}

}  // namespace rolling
