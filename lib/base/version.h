// SPDX-License-Identifier: GPL-3.0-or-later
// The version of the tools and of GSL.
#pragma once

#include <string_view>

namespace rolling {

/// "1.1.0", followed by "+" and the commit where the source is a checkout, and ".modified" where it
/// differs from the commit.
std::string_view version();

/// Of the GSL with which the tools were built.
std::string_view version_of_gsl();

}  // namespace rolling
