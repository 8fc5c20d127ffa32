// SPDX-License-Identifier: GPL-3.0-or-later
// The properties of each method of smooth and differentiate, in one table. The construction of a
// filter, its description in a `##` line and the parsing of that line all use this table.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "signal/signal.h"

namespace rolling {

struct SignalOptions;

struct SignalMethod {
  std::string_view name;
  /// The number of samples on either side on which an output value depends; at the ends of a run,
  /// where windows are one-sided, it may be twice as many. 0 for a method that has a width.
  std::size_t reach;
  /// True if an output is a linear combination of readings with coefficients that depend on the
  /// times alone.
  bool linear;
  /// True if the coefficients are the same at all times, unless the width is in seconds.
  bool shift_invariant;
  bool has_order;  ///< the order of a polynomial
  std::unique_ptr<Signal> (*make)(const SignalOptions&);

  bool has_width() const { return reach == 0; }
};

/// A method with its parameters.
struct SignalOptions {
  const SignalMethod* method;
  Width width{};
  std::size_t order = 2;  ///< of the polynomial
};

/// The methods mean, median and savgol, which all have a width; and central, savgol (the only one
/// with a width), spline, vernier and pasco.
extern const std::span<const SignalMethod> smoothing_methods, derivative_methods;

/// Constructs the filter. Throws Error if width and order do not suit each other.
std::unique_ptr<Signal> make_signal(const SignalOptions&);

/// The words of a `##` line, which describe the filter completely: `central`, `mean width 11`,
/// `savgol seconds 0.4 order 2`.
std::string describe(const SignalOptions&);

/// The inverse of describe(). Empty if describe() does not write these words, or if the parameters
/// do not suit each other.
std::optional<SignalOptions> signal_options(std::span<const SignalMethod>, std::string_view words);

/// The reach for a run with these times; at most its number of samples.
std::size_t reach(const SignalOptions&, std::span<const double> t);

/// The methods by their names.
std::map<std::string, const SignalMethod*> by_name(std::span<const SignalMethod>);

}  // namespace rolling
