// A case of two bodies and one question about them, as text.
#pragma once

#include <string>

namespace touchstone::test {

/// Both bodies are at the origin; `of_a` is further JSON of body A, as in `, "pose": {…}`.
inline std::string pair_case(const std::string& a, const std::string& b, const std::string& question,
                             const std::string& of_a = "") {
  return R"({"touchstone_case": 1, "scene": {"touchstone_scene": 1, "shapes": [)" + a + ", " + b +
         R"(], "bodies": [{"shape": 0)" + of_a + R"(}, {"shape": 1}]}, "queries": [{"question": ")" +
         question + R"(", "a": 0, "b": 1}]})";
}

}  // namespace touchstone::test
