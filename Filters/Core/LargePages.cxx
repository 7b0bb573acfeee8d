// SPDX-License-Identifier: BSD-3-Clause
#include "LargePages.h"

#if defined(__linux__)
#include <cstdint>
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace silhouette
{

void adviseLargePages(void* memory, std::size_t bytes)
{
#if defined(__linux__)
  if (bytes >= LeastLargeBytes)
  {
    const auto page = std::uintptr_t(sysconf(_SC_PAGESIZE)), begin = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t first = (begin + page - 1) / page * page, last = (begin + bytes) / page * page;
    madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE); // what fails is as it was
  }
#else
  (void)memory;
  (void)bytes;
#endif
}

} // namespace silhouette
