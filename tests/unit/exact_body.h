// SPDX-License-Identifier: GPL-3.0-or-later
// A body in the exact geometry.
#pragma once

#include "contact/body.h"

/// The same body, in the exact geometry or, if it is not exact, with A = 1.
inline rolling::Body exact_body(rolling::Body body, bool is_exact = true) {
  body.exact = is_exact;
  return body;
}
