/// @file
/// How the command gets its memory.
#pragma once

#include <cstddef>

namespace command {

/// Makes room for so many bytes, in huge pages where the system has them, and
/// from now on keeps what is freed for what is asked for next. Where a page is
/// used for the first time the system has to find and clear it, which takes a
/// tenth of a reconstruction otherwise. Costs nothing before it is used; has no
/// other effect, and may have none.
void make_room(std::size_t bytes);

}  // namespace command
