// Checks of output files: one that cannot be written is refused before the work, not after it.
#pragma once

#include <string>

namespace touchstone::cli {

/// Throws InputError if the file cannot be written. An empty name means no file.
void require_writable(const std::string& file);

}  // namespace touchstone::cli
