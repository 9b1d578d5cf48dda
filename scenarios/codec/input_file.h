// Whole files: read with a size limit, written completely or not at all. Every file that a command reads is
// opened by read_file (declared in scene_codec.h), which accepts only regular files.
#pragma once

#include <filesystem>
#include <string_view>

#include "scenarios/codec/scene_codec.h"

namespace touchstone {

/// Throws InputError with the file's name when it does not exist or is not a regular file: reading a pipe, a
/// socket or a device may block forever. Use it before libraries that open files themselves; read_file calls
/// it.
void require_regular_file(const std::filesystem::path& file);

/// Writes to FILE.part, then renames it, so that the old contents stay until everything is written. Devices
/// and pipes are written directly. Throws InputError with the system's reason.
void write_file(const std::filesystem::path& file, std::string_view text);

}  // namespace touchstone
