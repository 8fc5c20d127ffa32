// SPDX-License-Identifier: GPL-3.0-or-later
// A signal over whole columns, for tests.
#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "signal/signal.h"
#include "unit/normal.h"

using Series = std::vector<double>;

inline Series through(rolling::Signal& signal, const Series& t, const Series& y) {
  return rolling::output_of(signal, t, y);
}
inline Series through(rolling::Signal&& signal, const Series& t, const Series& y) {
  return through(signal, t, y);
}

inline Series even_times(std::size_t n, double step = 0.04) {
  Series t;
  for (std::size_t i = 0; i < n; ++i) t.push_back(step * static_cast<double>(i));
  return t;
}

/// Steps between 0.5 and 1.5 times `step`.
inline Series uneven_times(std::size_t n, double step = 0.04) {
  std::mt19937_64 random(n);
  std::uniform_real_distribution<double> any(0.5, 1.5);
  Series t = {0.3};
  while (t.size() < n) t.push_back(t.back() + step * any(random));
  return t;
}

inline Series noise(std::size_t n, unsigned seed) {
  std::mt19937_64 random(seed);
  Normal any;
  Series y;
  while (y.size() < n) y.push_back(any(random));
  return y;
}

/// The same run seen backwards: times negated, order turned.
inline Series backwards(Series values, double sign = 1) {
  std::reverse(values.begin(), values.end());
  for (double& value : values) value *= sign;
  return values;
}
