// What an engine finds in memory that nobody wrote: always the same, so that the same question gets the same
// answer, or something else, so that an answer made of it shows.
#pragma once

#include <cstdint>

namespace touchstone::host {

/// What malloc hands out from now on is filled with `byte`. It holds for glibc without its thread caches, as
/// the harness starts this process; elsewhere it does nothing.
void fill_new_memory(std::uint8_t byte);

/// Fills the part of the stack that the next call is going to use.
void fill_free_stack(std::uint8_t byte);

}  // namespace touchstone::host
