#include "apps/memory.h"

#include <cstdlib>
#include <limits>

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include "delaunay/lazy_vector.h"

namespace command {

void keep_memory() {
#if defined(__GLIBC__)
  // Large blocks would go back to the system one by one, and the end of the
  // heap as soon as it is free.
  constexpr int kNever = std::numeric_limits<int>::max();
  mallopt(M_MMAP_THRESHOLD, kNever);
  mallopt(M_TRIM_THRESHOLD, kNever);
#endif
}

void make_room(std::size_t bytes) {
  void* const room = std::malloc(bytes);
  if (room != nullptr) delaunay::advise_huge_pages(room, bytes);
  std::free(room);
}

}  // namespace command
