/// @file
/// The array of cells: large, and written by several threads.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

namespace delaunay {

/// Backs [data, data + bytes) with huge pages where the system has them; a
/// Delaunay construction reads cells all over memory, and address translation
/// is a fifth of its time otherwise. Has no other effect, and may have none.
void advise_huge_pages(void* data, std::size_t bytes);

/// Memory in huge pages, whose elements are left as they come unless they are
/// constructed from something: so a page costs nothing before it is used, and
/// is laid out by the thread that uses it first.
template <class T>
struct LazyAllocator {
  static_assert(std::is_trivially_copyable_v<T> &&
                std::is_trivially_destructible_v<T>);
  using value_type = T;

  LazyAllocator() = default;
  template <class U>
  explicit LazyAllocator(const LazyAllocator<U>&) {}

  T* allocate(std::size_t n) {
    T* const data = std::allocator<T>().allocate(n);
    advise_huge_pages(data, n * sizeof(T));
    return data;
  }
  void deallocate(T* data, std::size_t n) {
    std::allocator<T>().deallocate(data, n);
  }
  template <class U>
  void construct(U*) {}
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) U{std::forward<Arguments>(arguments)...};
  }
  friend bool operator==(const LazyAllocator&, const LazyAllocator&) = default;
};

template <class T>
using LazyVector = std::vector<T, LazyAllocator<T>>;

}  // namespace delaunay
