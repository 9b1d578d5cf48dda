// A body in one line of text, for command lines and interactive use:
//
//   SHAPE NUMBER... [at X Y Z] [rot X Y Z ANGLE] [quat X Y Z W] [move X Y Z] [spin X Y Z]
//
// SHAPE is a type of the scene format, and the numbers are its fields in the order of that format, so that
// `box 1 1 1` has half extents of 1 and `cylinder 0.5 2` has radius 0.5 and half height 2. The numbers of a
// hull are the coordinates of its points. `at` is the position, `rot` turns about an axis by an angle with
// its unit (`30deg`, `0.5rad`), `move` and `spin` are the velocities over a step of length 1.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace touchstone::fuzz {

/// {"shape": {...}, "pose": {...}, "motion": {...}} with the fields of the scene format; the last two only if
/// given. A turn by a multiple of 90 degrees is exact if the axis has a length that is a double. Throws
/// InputError, place = `place`, for unknown words and wrong counts of numbers; ranges are left to whoever
/// reads the scene. Not for meshes.
nlohmann::ordered_json body_from_text(std::string_view text, const std::string& place);

/// One line a shape: "box HALF_EXTENTS(3)", for help.
std::string describe_shape_texts();

}  // namespace touchstone::fuzz
