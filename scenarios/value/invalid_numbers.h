// Numbers for which a body is not a closed set: non-finite coordinates, negative sides. A valid scene has
// none, and JSON cannot represent all of them. A broad-phase case may still have them, to test whether a bad
// box makes other boxes lose their pairs; its file lists them next to the scene, by place.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace touchstone {

struct InvalidNumber {
  std::string place;  // JSON pointer into the scene: /bodies/i/pose/translation/k, /shapes/i/half_extents/k,
                      // /script/i/pose/translation/k
  double value = 0;
};

/// In the order of shapes, bodies, steps. Among shapes, only boxes are examined.
std::vector<InvalidNumber> invalid_numbers(const Scene& s);
/// Whether the body is a closed set: its position is finite and, if it is a box, so are its sides, and none
/// is negative.
bool is_closed_set(const Shape& shape, const Pose& pose);
/// The same scene with 0 in place of each of them.
Scene without_invalid_numbers(Scene s);
/// Throws InputError with the number's place when the place does not exist or the number is an ordinary one.
void insert_invalid_numbers(Scene& s, const std::vector<InvalidNumber>& all);

}  // namespace touchstone
