// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/gsl.h"

#include <gsl/gsl_errno.h>

#include <new>

#include "unit/catch.h"

using namespace rolling;

TEST_CASE("gsl: no memory throws std::bad_alloc, any other error is a status", "[base]") {
  silence_gsl();
  CHECK_THROWS_AS(gsl_error("no room", __FILE__, __LINE__, GSL_ENOMEM), std::bad_alloc);
  CHECK_NOTHROW(gsl_error("no such number", __FILE__, __LINE__, GSL_EDOM));
}
