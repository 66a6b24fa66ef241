#include "delaunay/huge_pages_internal.h"

#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

#include <cstdint>

namespace delaunay {

void advise_huge_pages([[maybe_unused]] void* data,
                       [[maybe_unused]] std::size_t bytes) {
#if defined(MADV_HUGEPAGE)
  static constexpr std::uintptr_t kPage = std::uintptr_t{1} << 21U;
  const auto begin = reinterpret_cast<std::uintptr_t>(data);
  const std::uintptr_t first = (begin + kPage - 1) & ~(kPage - 1);
  const std::uintptr_t last = (begin + bytes) & ~(kPage - 1);
  if (first < last)
    madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
#endif
}

}  // namespace delaunay
