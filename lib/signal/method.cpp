// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/method.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

#include "base/error.h"
#include "signal/derivative.h"
#include "signal/moving.h"
#include "signal/savitzky_golay.h"
#include "signal/smoothing_spline.h"

namespace rolling {
namespace {

using Options = const SignalOptions&;

constexpr std::size_t whole_run = std::numeric_limits<std::size_t>::max();

// The spline is not linear, because its parameter depends on the readings.
constexpr SignalMethod all[] = {
    // name, reach, linear, shift-invariant, has an order, make
    {"mean", 0, true, true, false, [](Options o) { return moving_mean(o.width); }},
    {"median", 0, false, false, false, [](Options o) { return moving_median(o.width); }},
    {"savgol", 0, true, false, true, [](Options o) { return savitzky_golay(o.width, o.order, 0); }},
    {"central", 1, true, false, false, [](Options) { return central_derivative(); }},
    {"savgol", 0, true, false, true, [](Options o) { return savitzky_golay(o.width, o.order, 1); }},
    {"spline", whole_run, false, false, false,
     [](Options) -> std::unique_ptr<Signal> { return std::make_unique<SplineDerivative>(); }},
    {"vernier", 3, true, false, false, [](Options) { return vernier_derivative(); }},
    {"pasco", 2, true, false, false, [](Options) { return pasco_derivative(); }},
};

}  // namespace

const std::span<const SignalMethod> smoothing_methods{all, 3}, derivative_methods{all + 3, 5};

std::unique_ptr<Signal> make_signal(const SignalOptions& options) {
  return options.method->make(options);
}

std::string describe(const SignalOptions& options) {
  const SignalMethod& method = *options.method;
  std::string words(method.name);
  if (method.has_width())
    words += options.width.seconds > 0 ? fmt::format(" seconds {}", options.width.seconds)
                                       : fmt::format(" width {}", options.width.samples);
  if (method.has_order) words += fmt::format(" order {}", options.order);
  return words;
}

std::optional<SignalOptions> signal_options(std::span<const SignalMethod> methods,
                                            std::string_view words) {
  std::istringstream in{std::string(words)};
  in.imbue(std::locale::classic());
  std::string name;
  std::string key;
  in >> name;
  const auto method = std::find_if(methods.begin(), methods.end(),
                                   [&](const SignalMethod& m) { return m.name == name; });
  if (method == methods.end()) return {};
  SignalOptions options{&*method};
  while (in >> key)
    if (key == "width") in >> options.width.samples;
    else if (key == "seconds") in >> options.width.seconds;
    else if (key == "order") in >> options.order;
  // A word is unknown, or a parameter missing, superfluous, not in its shortest form, or one that
  // libc++ reads as infinite.
  if (describe(options) != words || !std::isfinite(options.width.seconds)) return {};
  try {
    make_signal(options);
  } catch (const Error&) {
    return {};
  }
  return options;
}

std::size_t reach(const SignalOptions& options, std::span<const double> t) {
  const std::size_t samples =
      options.method->has_width() ? samples_within(options.width, t) : options.method->reach;
  return std::min(samples, t.size());
}

std::map<std::string, const SignalMethod*> by_name(std::span<const SignalMethod> methods) {
  std::map<std::string, const SignalMethod*> names;
  for (const SignalMethod& method : methods) names.emplace(method.name, &method);
  return names;
}

}  // namespace rolling
