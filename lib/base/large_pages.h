// Room for columns of many records.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rolling {

/// column.reserve(n). From 4 MiB on the system is asked for pages of 2 MiB, where it has them:
/// loglog spends a sixth of its time with a million records on the first touch of pages of 4 KiB.
template <typename T>
void reserve_large(std::vector<T>& column, std::size_t n) {
  column.reserve(n);
#ifdef MADV_HUGEPAGE
  const std::size_t bytes = n * sizeof(T);
  if (bytes < std::size_t{4} << 20) return;
  char* const begin = reinterpret_cast<char*>(column.data());
  const std::size_t within = reinterpret_cast<std::uintptr_t>(begin) % 4096;
  ::madvise(begin - within, bytes + within,
            MADV_HUGEPAGE);  // where it is refused, or pages are of another size, no matter
#endif
}

}  // namespace rolling
