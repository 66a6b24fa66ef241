/// @file
/// Asks the system to back large arrays with large pages.
#pragma once

#include <cstddef>

namespace delaunay {

/// Backs [data, data + bytes) with huge pages where the system has them; a
/// Delaunay construction reads cells all over memory, and address translation
/// is a fifth of its time otherwise. Has no other effect, and may have none.
void advise_huge_pages(void* data, std::size_t bytes);

}  // namespace delaunay
