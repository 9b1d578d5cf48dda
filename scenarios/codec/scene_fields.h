// The fields of each object of the JSON form except shapes, which have their own tables (core/shape/*.h). The
// codec refuses fields that are not listed here; the tests compare scenarios/codec/scene.schema.json with the
// same lists.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "core/scene/scene.h"

namespace touchstone::scene_fields {

inline constexpr std::string_view version_field = "touchstone_scene";
inline constexpr int version = 1;

inline constexpr auto scene = std::to_array<std::string_view>(
    {version_field, "name", "shapes", "bodies", "ignored", "script", "margin"});
inline constexpr auto body =
    std::to_array<std::string_view>({"name", "shape", "pose", "motion", "static", "group"});
inline constexpr auto pose = std::to_array<std::string_view>({"translation", "rotation"});
inline constexpr auto motion = std::to_array<std::string_view>({"linear", "angular"});
inline constexpr auto insert = std::to_array<std::string_view>({"op", "body", "pose"});
inline constexpr auto move = std::to_array<std::string_view>({"op", "body", "pose"});
inline constexpr auto remove = std::to_array<std::string_view>({"op", "body"});
inline constexpr auto query = std::to_array<std::string_view>({"op"});

inline constexpr auto op_names =
    std::to_array<std::string_view>({"insert", "move", "remove", "query"});  // order of Step::Op
inline constexpr auto of_op = std::to_array<std::span<const std::string_view>>({insert, move, remove, query});
static_assert(op_names.size() == static_cast<std::size_t>(Step::Op::query) + 1);
static_assert(of_op.size() == op_names.size());

}  // namespace touchstone::scene_fields
