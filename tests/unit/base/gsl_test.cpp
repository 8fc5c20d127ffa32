#include "base/gsl.h"

#include <new>

#include "base/error.h"
#include "unit/catch.h"

using namespace rolling;

TEST_CASE("gsl: no memory is std::bad_alloc, all else a status, and that an Error", "[base]") {
  silence_gsl();
  CHECK_THROWS_AS(gsl_error("no room", __FILE__, __LINE__, GSL_ENOMEM), std::bad_alloc);
  CHECK_NOTHROW(gsl_error("no such number", __FILE__, __LINE__, GSL_EDOM));
  CHECK_NOTHROW(check_gsl(GSL_SUCCESS, "a thing"));
  CHECK_THROWS_AS(check_gsl(GSL_EDOM, "a thing"), Error);
}
