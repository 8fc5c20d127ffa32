// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/gsl.h"

#include <gsl/gsl_errno.h>

namespace rolling {

// The exception passes through C code. A status would not do: GSL does not test all its allocations
// (LU_decomp, the error control of a driver) and would go on with a null pointer. The memory that
// GSL holds at that moment is not freed.
void silence_gsl() {
  gsl_set_error_handler([](const char*, const char*, int, int status) {
    if (status == GSL_ENOMEM) throw std::bad_alloc();
  });
}

}  // namespace rolling
