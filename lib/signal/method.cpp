// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/method.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/decimal.h"
#include "base/error.h"

namespace rolling {
namespace {

/// Removes the text up to the next blank from `words` and returns it.
std::string_view next_word(std::string_view& words) {
  const std::string_view word = words.substr(0, words.find(' '));
  words.remove_prefix(std::min(word.size() + 1, words.size()));
  return word;
}

bool read(std::string_view word, double& number) {
  const char* const end = word.data() + word.size();
  return !word.empty() && read_decimal(word.data(), end, number) == end && std::isfinite(number);
}
bool read(std::string_view word, std::size_t& number) {
  const char* const end = word.data() + word.size();
  const auto [behind, error] = std::from_chars(word.data(), end, number);
  return error == std::errc() && behind == end;
}

}  // namespace

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
  std::string_view rest = words;
  const std::string_view name = next_word(rest);
  const auto method = std::find_if(methods.begin(), methods.end(),
                                   [&](const SignalMethod& m) { return m.name == name; });
  if (method == methods.end()) return {};
  SignalOptions options{&*method};
  while (!rest.empty()) {
    const std::string_view key = next_word(rest), value = next_word(rest);
    if (!(key == "width"     ? read(value, options.width.samples)
          : key == "seconds" ? read(value, options.width.seconds)
          : key == "order"   ? read(value, options.order)
                             : false))
      return {};
  }
  if (describe(options) != words)
    return {};  // a parameter is missing, superfluous or not in its shortest form
  try {
    make_signal(options);
  } catch (const Error&) {
    return {};
  }
  return options;
}

Reach reach(const SignalOptions& options, std::span<const double> t) {
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
