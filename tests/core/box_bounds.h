// The box of a placed body beside the referee's.
#pragma once

#include "core/broad/body_box.h"
#include "core/math/rng.h"
#include "oracles/referee/referee.h"
#include "tests/support/catch.h"

namespace touchstone::testing {

/// In `count` random poses: the box holds the shape, and is no larger than rounding makes it.
inline void check_boxes(Rng& r, const Shape& s, int count) {
  for (int i = 0; i < count; ++i) {
    const Pose p{r.unit_vector() * 10, r.rotation()};
    const Aabb box = broad::body_box(s, p), truth = referee::outer_box({&s, p});
    for (int k = 0; k < 3; ++k) {
      CHECK(box.lo[k] <= truth.lo[k] + 1e-15);
      CHECK(box.hi[k] >= truth.hi[k] - 1e-15);
      CHECK(box.hi[k] - box.lo[k] <= truth.hi[k] - truth.lo[k] + 1e-13);
    }
  }
}

}  // namespace touchstone::testing
