// Files whole: read with a limit on size, written completely or reported. (read_file is declared in codec.h.)
#pragma once

#include <filesystem>
#include <string_view>

#include "core/scene/codec.h"

namespace touchstone {

/// Throws InputError when the file cannot be written to the end.
void write_file(const std::filesystem::path& file, std::string_view text);

}  // namespace touchstone
