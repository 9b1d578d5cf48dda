// A question about two bodies as one JSON object, and somebody's answer to it: a line of JSON lines, or what
// the capture header (touchstone_capture.h) logs.
//
//   {"a": BODY, "b": BODY, "answer": {...}, "engine": "name"}
//
// BODY is {"shape": {...}, "pose": {...}, "motion": {...}} in the fields of the scene format, or its text
// form (body_text.h). "answer" and "engine" are optional.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/scene/scene.h"
#include "fuzz/answer/stated_answer.h"

namespace touchstone::fuzz {

struct QueryLine {
  Scene scene;  // bodies 0 (A) and 1 (B)
  std::optional<StatedAnswer> answer;
  std::string engine;  // as recorded, for display
};

/// Throws InputError, place = `place` and the JSON path.
QueryLine query_line_from_json(const nlohmann::ordered_json& j, const std::string& place);
/// The scene of two bodies in either form. Throws InputError as above.
Scene scene_of_bodies(nlohmann::ordered_json a, nlohmann::ordered_json b, const std::string& place);

}  // namespace touchstone::fuzz
