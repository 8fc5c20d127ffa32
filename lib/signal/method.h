// What each method of smooth and differentiate declares of itself, in one table a tool: whoever
// makes a filter, writes it in a `##` line or reads it back from there asks here.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "signal/signal.h"

namespace rolling {

struct SignalOptions;

/// Samples to either side of its own on which a number depends; at the ends of a run, where windows
/// are one-sided, it may be twice as many.
using Reach = std::size_t;
inline constexpr Reach half_width = static_cast<Reach>(-1), whole_run = half_width - 1;

struct SignalMethod {
  std::string_view name;
  Reach reach;  ///< half_width: the method has a width
  /// Numbers are sums of readings times coefficients that the times alone give.
  bool linear;
  /// The coefficients do not depend on the times, but for a width in seconds.
  bool shift_invariant;
  bool has_order;  ///< that of a polynomial
  std::unique_ptr<Signal> (*make)(const SignalOptions&);

  bool has_width() const { return reach == half_width; }
};

/// A method and its numbers.
struct SignalOptions {
  const SignalMethod* method;
  Width width{};
  std::size_t order = 2;  ///< of a polynomial
};

/// Throws Error for a width and an order that do not go together.
std::unique_ptr<Signal> make_signal(const SignalOptions&);

/// As a `##` line says it, with all that is needed to make the filter again: `central`,
/// `mean width 11`, `savgol seconds 0.4 order 2`.
std::string describe(const SignalOptions&);

/// The options that describe() writes so; nothing if it writes no such words, or for numbers that
/// do not go together.
std::optional<SignalOptions> signal_options(std::span<const SignalMethod>, std::string_view words);

/// For a run with these times; at most its number of samples.
Reach reach(const SignalOptions&, std::span<const double> t);

/// The methods by their names.
std::map<std::string, const SignalMethod*> by_name(std::span<const SignalMethod>);

}  // namespace rolling
