// SPDX-License-Identifier: GPL-3.0-or-later
// The time derivative of a column, computed sample by sample. Every method throws Error for a run
// of one sample.
#pragma once

#include "signal/signal.h"

namespace rolling {

/// The derivative of the parabola through three neighbouring samples at any spacing: at the middle
/// sample inside the run (the central difference), at the outer one at the ends. Second order in
/// the spacing, exact on a parabola. For a run of two samples it is their slope.
std::unique_ptr<Signal> central_derivative();

/// The derivative of Vernier's programs: the slopes over one, two and three samples to either side,
/// with the weights 3, 2, 1; beyond the end of the run the last sample counts instead. With these
/// weights the 304 rows of an export of such a program are reproduced to the last bit
/// (tests/recordings.md).
std::unique_ptr<Signal> vernier_derivative();

/// The derivative of PASCO's programs: (y[i+1] + y[i+2] - y[i-1] - y[i-2]) / (6 dt), where 6 dt is
/// the same expression in the times. It reproduces the speeds of an export up to the rounding of
/// its positions (tests/recordings.md). The second and the last but one sample have the slope
/// between their neighbours, as in the export; the first and the last one, which are empty in the
/// export, have that of the parabola through three samples.
std::unique_ptr<Signal> pasco_derivative();

}  // namespace rolling
