// Where results go: what cannot be written is refused before the work, not after it.
#pragma once

#include <string>

namespace touchstone::cli {

/// Throws InputError when the file cannot be written; an empty name is none.
void require_writable(const std::string& file);

}  // namespace touchstone::cli
