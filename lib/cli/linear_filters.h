// SPDX-License-Identifier: GPL-3.0-or-later
// The filters of the tools, and of the software of sensors, as functions of whole columns.
#pragma once

#include <string>
#include <vector>

#include "noise/response.h"
#include "signal/method.h"

namespace rolling {

/// A streaming filter as one of whole columns.
LinearFilter linear(const std::string& from, const std::string& to, const SignalOptions&,
                    std::size_t reach);

/// The filters that the software of sensors may apply to speeds: the differences of positions to
/// the row before and to the row after (of spreadsheets, gates and encoders; where times are even,
/// those in the middle between them differ in the clock alone), the central one, and those of
/// Vernier's and PASCO's programs; and means of 2, 3 or 5 speeds,
/// whose noise is similar to some of these.
std::vector<LinearFilter> filters_of_sensors();

}  // namespace rolling
