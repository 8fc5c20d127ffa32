// GSL without its aborting error handler: handles that free themselves, and every status an Error.
#pragma once

#include <gsl/gsl_errno.h>

#include <memory>

namespace rolling {

/// In place of GSL's default handler, which aborts: an allocation that fails is std::bad_alloc, all
/// else a status. Call it before the first use of GSL in a room.
void silence_gsl();

/// Throws Error("what: reason") when a GSL status is not GSL_SUCCESS.
void check_gsl(int status, const char* what);

/// Owns a GSL object: `auto x = own(gsl_vector_alloc(n), gsl_vector_free)`. A null pointer (no
/// memory) throws std::bad_alloc.
template <typename T>
auto own(T* object, void (*release)(T*)) {
  if (!object) throw std::bad_alloc();
  return std::unique_ptr<T, void (*)(T*)>(object, release);
}

}  // namespace rolling
