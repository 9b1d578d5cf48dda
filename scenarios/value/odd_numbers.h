// Numbers that make a body no closed set: coordinates that are not finite, sides that are negative. A valid
// scene has none, and JSON could not say them. A case about a broad phase may still have them, to see whether
// a bad box costs other boxes their pairs; its file names them beside the scene, by place.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace touchstone {

struct OddNumber {
  std::string place;  // JSON pointer into the scene: /bodies/i/pose/translation/k, /shapes/i/half_extents/k,
                      // /script/i/pose/translation/k
  double value = 0;
};

/// In the order of shapes, bodies, steps. Of shapes only boxes are looked at.
std::vector<OddNumber> odd_numbers(const Scene& s);
/// The same scene with 0 in their places.
Scene without_odd_numbers(Scene s);
/// Throws InputError, whose place is the number's, when there is no such place, or the number is an ordinary one.
void put_in(Scene& s, const std::vector<OddNumber>& all);

}  // namespace touchstone
