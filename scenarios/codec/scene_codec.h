// JSON form of a scene (schema: scenarios/codec/scene.schema.json). Doubles are written in the shortest form
// that reads back to the same bits. Unknown fields, unknown shapes, wrong types, non-finite numbers,
// truncated text, and files larger than max_scene_file_bytes are refused with an InputError "file:line or
// JSON path: reason".
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/scene/scene.h"

namespace touchstone {

inline constexpr std::uintmax_t max_scene_file_bytes = std::uintmax_t{256} << 20;

nlohmann::ordered_json to_json(const Shape& shape);
nlohmann::ordered_json to_json(const Scene& scene);

/// Also validates the scene. `place` prefixes the place of errors.
Scene scene_from_json(const nlohmann::ordered_json& j, const std::string& place = "");
Scene scene_from_text(const std::string& text, const std::string& place = "");

/// One body or step per line, so that diffs are readable.
std::string to_text(const Scene& scene);

/// Reads a whole file that may not be larger than max_bytes. Throws InputError naming the file.
std::string read_file(const std::filesystem::path& file, std::uintmax_t max_bytes = max_scene_file_bytes);
Scene load_scene(const std::filesystem::path& file);
void save_scene(const Scene& scene, const std::filesystem::path& file);

}  // namespace touchstone
