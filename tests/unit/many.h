// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of random cases take a fifth of them, so that `make check` ends soon; all of them with
// LONG=1 in the environment, as `make check-long` sets it.
#pragma once

#include <cstdlib>

/// How many of `all` cases are taken.
inline unsigned of_many(unsigned all) { return std::getenv("LONG") ? all : all / 5; }
