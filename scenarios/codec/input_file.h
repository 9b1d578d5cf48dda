// Files whole: read with a limit on size, written completely or not at all. Every file that a command reads
// is opened by read_file (declared in codec.h), which takes regular files alone.
#pragma once

#include <filesystem>
#include <string_view>

#include "scenarios/codec/scene_codec.h"

namespace touchstone {

/// Throws InputError, naming the file, for what is not there and for what is no regular file: a pipe, a
/// socket or a device may keep who reads it waiting for ever. For libraries that open files themselves;
/// read_file does it.
void require_regular_file(const std::filesystem::path& file);

/// Beside the file, as FILE.part, and then put in its place: what was there stays until all is written. Devices
/// and pipes are written to. Throws InputError, with the system's reason.
void write_file(const std::filesystem::path& file, std::string_view text);

}  // namespace touchstone
