#pragma once

namespace JPH {

constexpr float cDefaultCollisionTolerance = 1e-4F, cDefaultPenetrationTolerance = 1e-4F,
                cDefaultConvexRadius = 0.05F;

}  // namespace JPH
