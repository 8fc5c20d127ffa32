#include "base/gsl.h"

#include "base/error.h"

namespace rolling {

void silence_gsl() { gsl_set_error_handler_off(); }

void check_gsl(int status, const char* what) {
  if (status != GSL_SUCCESS) fail("{}: {}", what, gsl_strerror(status));
}

}  // namespace rolling
