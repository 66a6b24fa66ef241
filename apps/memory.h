/// @file
/// How the command gets its memory.
#pragma once

#include <cstddef>

namespace command {

/// From now on keeps what is freed for what is asked for next. Where a page is
/// used for the first time the system has to find and clear it, which takes a
/// tenth of a reconstruction otherwise. Has no other effect, and may have none.
void keep_memory();

/// Makes room for so many bytes, in huge pages where the system has them. Costs
/// nothing before it is used. After keep_memory(); alone it has no effect.
void make_room(std::size_t bytes);

}  // namespace command
