// The fields of each object of the JSON form beside the shapes, which have tables of their own
// (core/shape/*.h). The codec refuses what is not listed here; the tests hold core/scene/scene.schema.json
// against the same lists.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "core/scene/scene.h"

namespace touchstone::scene_fields {

inline constexpr std::string_view version_field = "touchstone_scene";
inline constexpr int version = 1;

inline constexpr std::array<std::string_view, 6> scene{version_field, "name",    "shapes",
                                                       "bodies",      "ignored", "script"};
inline constexpr std::array<std::string_view, 6> body{"name", "shape", "pose", "motion", "static", "group"};
inline constexpr std::array<std::string_view, 2> pose{"translation", "rotation"};
inline constexpr std::array<std::string_view, 2> motion{"linear", "angular"};
inline constexpr std::array<std::string_view, 3> insert{"op", "body", "pose"};
inline constexpr std::array<std::string_view, 3> move{"op", "body", "pose"};
inline constexpr std::array<std::string_view, 2> remove{"op", "body"};
inline constexpr std::array<std::string_view, 1> query{"op"};

inline constexpr std::array<std::string_view, 4> op_names{"insert", "move", "remove",
                                                          "query"};  // order of Step::Op
inline constexpr std::array<std::span<const std::string_view>, 4> of_op{insert, move, remove, query};

}  // namespace touchstone::scene_fields
