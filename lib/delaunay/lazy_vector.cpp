#include "delaunay/lazy_vector.h"

#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

#include <memory>
#include <new>

namespace delaunay {

void advise_huge_pages([[maybe_unused]] void* data,
                       [[maybe_unused]] std::size_t bytes) {
#if defined(MADV_HUGEPAGE)
  constexpr std::size_t kPage = std::size_t{1} << 21U;
  if (std::align(kPage, kPage, data, bytes) != nullptr)
    madvise(data, bytes & ~(kPage - 1), MADV_HUGEPAGE);
#endif
}

#if defined(MAP_ANONYMOUS)

void* allocate_pages(std::size_t bytes) {
  void* const data = mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                          MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (data == MAP_FAILED) throw std::bad_alloc();
  advise_huge_pages(data, bytes);
  return data;
}

void free_pages(void* data, std::size_t bytes) { munmap(data, bytes); }

#else

constexpr std::align_val_t kCacheLine{64};

void* allocate_pages(std::size_t bytes) {
  return ::operator new(bytes, kCacheLine);
}

void free_pages(void* data, std::size_t) {
  ::operator delete(data, kCacheLine);
}

#endif

}  // namespace delaunay
