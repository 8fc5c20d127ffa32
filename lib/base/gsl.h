// SPDX-License-Identifier: GPL-3.0-or-later
// GSL without its aborting error handler, and owners of its objects.
#pragma once

#include <gsl/gsl_errno.h>

#include <memory>
#include <new>

namespace rolling {

/// Replaces GSL's error handler, which aborts the program: a failed allocation throws
/// std::bad_alloc, any other error is a status that GSL returns. Call it before using GSL.
///
/// The exception passes through C code. A status would not do: GSL does not test all its
/// allocations (LU_decomp, the error control of a driver) and would go on with a null pointer. The
/// memory that GSL holds at that moment is not freed.
inline void silence_gsl() {
  gsl_set_error_handler([](const char*, const char*, int, int status) {
    if (status == GSL_ENOMEM) throw std::bad_alloc();
  });
}

/// Owns a GSL object: `auto x = own(gsl_vector_alloc(n), gsl_vector_free)`. A null pointer (no
/// memory) throws std::bad_alloc.
template <typename T>
auto own(T* object, void (*release)(T*)) {
  if (!object) throw std::bad_alloc();
  return std::unique_ptr<T, void (*)(T*)>(object, release);
}

}  // namespace rolling
