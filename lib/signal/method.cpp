// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/method.h"

#include <algorithm>
#include <locale>
#include <sstream>

#include "base/error.h"

namespace rolling {

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
  std::string name, key;
  in >> name;
  const auto method = std::find_if(methods.begin(), methods.end(),
                                   [&](const SignalMethod& m) { return m.name == name; });
  if (method == methods.end()) return {};
  SignalOptions options{&*method};
  while (in >> key)
    if (key == "width") in >> options.width.samples;
    else if (key == "seconds") in >> options.width.seconds;
    else if (key == "order") in >> options.order;
  // A word is unknown, or a parameter missing, superfluous or not in its shortest form.
  if (describe(options) != words) return {};
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
