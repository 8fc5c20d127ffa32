// SPDX-License-Identifier: GPL-3.0-or-later
// Normal numbers that are the same with every C++ library, as those of std::normal_distribution are
// not: a test with a seed has the same noise everywhere.
#pragma once

#include <cmath>
#include <random>
#include <utility>

/// By the polar method of Marsaglia and Bray (1964), in the order of libstdc++.
class Normal {
 public:
  template <class Random>
  double operator()(Random& random) {
    if (std::exchange(has_second_, !has_second_)) return second_;
    const auto any = [&] { return 2 * std::generate_canonical<double, 53>(random) - 1; };
    double x, y, square;
    do {
      x = any(), y = any(), square = x * x + y * y;
    } while (square > 1 || square == 0);
    const double scale = std::sqrt(-2 * std::log(square) / square);
    second_ = x * scale;
    return y * scale;
  }

 private:
  double second_ = 0;
  bool has_second_ = false;
};
