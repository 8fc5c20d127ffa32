// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/smoother.h"

#include "signal/moving_mean.h"
#include "signal/moving_median.h"
#include "signal/savitzky_golay.h"

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

}  // namespace rolling
