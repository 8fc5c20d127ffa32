#include "base/gsl.h"

#include "base/error.h"

namespace rolling {

// An exception, through C: GSL does not look whether all its allocations succeed (that of
// LU_decomp, that of a driver's error control), and would go on with a null pointer. What it holds
// at that moment is lost.
void silence_gsl() {
  gsl_set_error_handler([](const char*, const char*, int, int status) {
    if (status == GSL_ENOMEM) throw std::bad_alloc();
  });
}

void check_gsl(int status, const char* what) {
  if (status != GSL_SUCCESS) fail("{}: {}", what, gsl_strerror(status));
}

}  // namespace rolling
