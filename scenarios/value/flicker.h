// What an engine's answers do from one frame of a motion to the next that the truth does not, as plain
// values (truth.md §7).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "scenarios/value/case.h"

namespace touchstone {

enum class Flicker : std::uint8_t {
  needless,  // the normal jumps to one that needs more than the one before would
  tied,      // it jumps between normals of which neither is proven to need more
  depth,     // the depth, or the distance, changes by more than the motion allows
  verdict,   // overlap is said of one frame and denied of the other; in truth both overlap, or neither
  count,     // the number of points changes, the contact region keeps its corners
  points,    // the points move farther than the corners of the contact region
  ids,       // a point stays on a body, its id changes
  order      // the points are the same, listed in another order
};
inline constexpr auto flicker_names = std::to_array<std::string_view>(
    {"needless", "tied", "depth", "verdict", "count", "points", "ids", "order"});
static_assert(flicker_names.size() == static_cast<std::size_t>(Flicker::order) + 1);
inline constexpr std::size_t flicker_count = flicker_names.size();
constexpr std::string_view to_string(Flicker f) { return flicker_names[static_cast<std::size_t>(f)]; }

struct FlickerReport {
  Flicker flicker = Flicker::needless;
  int frame = 0;  // the later of the two, from 1
  Question question = Question::contact;
  int a = 0, b = 1;
  Vec3 before = Vec3::Zero(), after = Vec3::Zero();  // the normals stated, if any
  double amount = 0;                                 // by how much: a length, an angle, or a number of points
  std::string words;                                 // one sentence with the numbers that the referee proved
};

}  // namespace touchstone
