/// @file
/// Arrays of the size of the input and larger, some written by several threads.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace delaunay {

/// Memory straight from the system where it can be had, to which it returns
/// when it is freed: a heap keeps what lies below something still in use. In
/// huge pages if there are any; a Delaunay construction reads cells all over
/// memory, and address translation is a fifth of its time otherwise.
/// @throws std::bad_alloc
void* allocate_pages(std::size_t bytes);
void free_pages(void* data, std::size_t bytes);

/// Asks for huge pages where memory is used from now on; nothing elsewhere.
void advise_huge_pages(void* data, std::size_t bytes);

/// Elements are left as they come unless they are constructed from something:
/// so a page costs nothing before it is used, and is laid out by the thread
/// that uses it first.
template <class T>
struct UnsetAllocator : std::allocator<T> {
  static_assert(std::is_trivially_destructible_v<T>);

  UnsetAllocator() = default;
  template <class U>
  explicit UnsetAllocator(const UnsetAllocator<U>&) {}

  template <class U>
  void construct(U*) {}
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) U{std::forward<Arguments>(arguments)...};
  }
};

/// The same, and large arrays straight from the system.
template <class T>
struct LazyAllocator : UnsetAllocator<T> {
  /// Large enough for the time it takes the system not to matter.
  static constexpr std::size_t kWorthPages = std::size_t{1} << 22U;

  LazyAllocator() = default;
  template <class U>
  explicit LazyAllocator(const LazyAllocator<U>&) {}

  T* allocate(std::size_t n) {
    if (n < kWorthPages / sizeof(T)) return std::allocator<T>::allocate(n);
    if (n > static_cast<std::size_t>(-1) / sizeof(T))
      throw std::bad_array_new_length();
    return static_cast<T*>(allocate_pages(n * sizeof(T)));
  }
  void deallocate(T* data, std::size_t n) {
    if (n < kWorthPages / sizeof(T))
      std::allocator<T>::deallocate(data, n);
    else
      free_pages(data, n * sizeof(T));
  }
};

/// Short-lived: what it takes from the heap goes back there, for the next one.
template <class T>
using UnsetVector = std::vector<T, UnsetAllocator<T>>;

/// Long-lived, or read all over.
template <class T>
using LazyVector = std::vector<T, LazyAllocator<T>>;

}  // namespace delaunay
