#include "delaunay/cell_vector.h"

#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

#include <memory>

namespace delaunay {

void advise_huge_pages([[maybe_unused]] void* data,
                       [[maybe_unused]] std::size_t bytes) {
#if defined(MADV_HUGEPAGE)
  constexpr std::size_t kPage = std::size_t{1} << 21U;
  if (std::align(kPage, kPage, data, bytes) != nullptr)
    madvise(data, bytes & ~(kPage - 1), MADV_HUGEPAGE);
#endif
}

}  // namespace delaunay
