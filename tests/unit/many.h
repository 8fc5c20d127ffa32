// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of random cases take a tenth of them, so that `make check` ends soon; all of them with
// LONG=1 in the environment, as `make check-long` sets it. How many of them may be off by chance
// follows from their number.
#pragma once

#include <gsl/gsl_cdf.h>

#include <cstdlib>

/// How many of `all` cases are taken.
inline unsigned of_many(unsigned all) { return std::getenv("LONG") ? all : (all + 9) / 10; }

/// Of cases that loops make, whether this one is taken: one of ten, in turn.
class InTurn {
 public:
  bool operator()() { return n_++ % 10 == 0 || std::getenv("LONG"); }

 private:
  unsigned n_ = 0;
};

/// Of n cases, each of this probability, no more are counted but by chance in one test of 500.
inline unsigned at_most(unsigned n, double probability) {
  unsigned most = 0;
  while (gsl_cdf_binomial_Q(most, probability, n) > 0.002) ++most;
  return most;
}

/// Of n cases, each of this probability, no fewer are counted but by chance in one test of 500.
inline unsigned at_least(unsigned n, double probability) { return n - at_most(n, 1 - probability); }
