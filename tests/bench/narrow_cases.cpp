#include "tests/bench/narrow_cases.h"

#include "core/narrow/narrow_phase.h"
#include "tests/bench/bench_shape.h"

namespace touchstone::bench {
std::vector<PairCase> make_cases(const PairKind& kind, Task task, int count, std::uint64_t seed) {
  std::vector<PairCase> all;
  for (int i = 0; i < count; ++i) {
    Rng r = Rng::stream(seed, static_cast<std::uint64_t>(i));
    PairCase c{make_shape(r, kind.a, kind.vertices), make_shape(r, kind.b, kind.vertices), {}, {}};
    c.pose_a.rotation = r.rotation();
    c.pose_b.rotation = r.rotation();
    c.pose_a.translation = r.unit_vector();
    c.pose_b.translation = c.pose_a.translation + 3 * r.unit_vector();
    const bool deep = task == Task::contact || i % 2 == 0;
    const double gap = 0.05 * r.uniform(0.02, 1) * (deep ? -1 : 1);
    // From far away the nearest points slide; a second step reaches the requested gap.
    for (int step = 0; step < 3; ++step) {
      const Separation s = separation({&c.a, c.pose_a}, {&c.b, c.pose_b});
      c.pose_b.translation += (s.normal * (static_cast<Wide>(gap) - s.gap)).cast<double>();
    }
    all.push_back(std::move(c));
  }
  return all;
}

}  // namespace touchstone::bench
