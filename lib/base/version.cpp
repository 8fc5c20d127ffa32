// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/version.h"

#include <gsl/gsl_version.h>

#ifndef ROLLING_COMMIT  // the Makefile says it
#define ROLLING_COMMIT ""
#endif

namespace rolling {

std::string_view version() { return "1.1.0" ROLLING_COMMIT; }

std::string_view version_of_gsl() { return GSL_VERSION; }

}  // namespace rolling
