// Which pairs of a scene may meet during the step, by boxes around the bodies' ways: who is to be asked for a
// time of impact.
#pragma once

#include <vector>

#include "scenarios/value/case.h"

namespace touchstone {

bool moves(const Scene& scene);

/// Every pair of which a body moves and whose closed bodies share a point at some time of the step, and more;
/// not the filtered, nor those of two static bodies. Sorted.
std::vector<BodyPair> moving_pairs(const Scene& scene);

/// Of a scene without questions of its own, so many of moving_pairs at most are asked for a time of impact.
inline constexpr std::size_t most_impacts_asked = 64;

/// How many of moving_pairs the case does not ask for a time of impact.
std::size_t impacts_not_asked(const Case& c);
/// In one line for people; empty when there are none.
std::string words_on_impacts_not_asked(const Case& c);

}  // namespace touchstone
