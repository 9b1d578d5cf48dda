// Controls the content of uninitialised memory that an engine sees: normally always the same, so that the
// same question gets the same answer; or something else, so that answers that depend on it are detected.
#pragma once

#include <cstdint>

namespace touchstone::host {

/// From now on malloc returns memory filled with `byte`. Works with glibc without its thread caches, which is
/// how the harness starts this process; otherwise it has no effect.
void fill_new_memory(std::uint8_t byte);

/// Fills the part of the stack that the next call will use.
void fill_free_stack(std::uint8_t byte);

}  // namespace touchstone::host
