// Files whole: read with a limit on size, written completely or not at all. (read_file is declared in codec.h.)
#pragma once

#include <filesystem>
#include <string_view>

#include "core/scene/codec.h"

namespace touchstone {

/// Beside the file, as FILE.part, and then put in its place: what was there stays until all is written. Devices
/// and pipes are written to. Throws InputError, with the system's reason.
void write_file(const std::filesystem::path& file, std::string_view text);

}  // namespace touchstone
