// A crowd with a few bullets: the benchmark of "swept only where needed", and its test.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/rng.h"
#include "core/scene/scene.h"

namespace touchstone::bench {

/// Bodies 0 … bullets − 1 are balls of radius 0.01, then come `plates` static plates 0.004 thick and 2 wide,
/// then a crowd of boxes, balls, capsules, hulls and cylinders, 0.2 to 0.6 across, close together, each
/// moving slowly. Lengths are in metres, a step is 1/60 s: the crowd's speeds are exponentially distributed
/// about 1.2 m/s (0.02 a step) and 1.2 rad/s.
struct TunnelScene {
  Scene scene;
  int bullets = 3, plates = 57;
};

TunnelScene tunnel_scene(int bodies, std::uint64_t seed);

struct Shot {
  Pose start;
  Motion motion;
};

/// One shot per bullet: at 180 m/s (3 a step) at a plate chosen at random, from 0.2 to 2.5 in front of it,
/// aimed anywhere within it, up to 45° off its normal.
std::vector<Shot> shots(const TunnelScene& s, Rng& r);

}  // namespace touchstone::bench
