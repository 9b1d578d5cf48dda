// Pairs of a scene that may meet during the step, found by boxes around the bodies' paths: the candidates for
// time-of-impact queries.
#pragma once

#include <vector>

#include "scenarios/value/case.h"

namespace touchstone {

bool moves(const Scene& scene);

/// A superset of the pairs in which a body moves and the closed bodies share a point at some time of the
/// step. Excludes filtered pairs and pairs of two static bodies. Sorted.
std::vector<BodyPair> moving_pairs(const Scene& scene);

/// A scene without its own queries gets time-of-impact queries for at most this many of moving_pairs.
inline constexpr std::size_t most_impacts_asked = 64;

/// The number of moving_pairs for which the case has no time-of-impact query.
std::size_t impacts_not_asked(const Case& c);
/// The same as a message; empty when there are none.
std::string words_on_impacts_not_asked(const Case& c);

}  // namespace touchstone
