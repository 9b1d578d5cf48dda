// Run by hand: `ts_core_primitive_stress [queries] [first]`. Random deforming primitives, each decided twice:
// the usual way (double with proven bounds, integers for the rest) and in integers from the start. Different
// verdicts, or a time after the first contact, are printed and set exit code 1.
#include <cstdio>
#include <cstdlib>

#include "core/impact/primitive_impact.h"
#include "core/impact/primitive_volume.h"
#include "scenarios/random/primitive_motions.h"

int main(int argc, char** argv) {
  using namespace touchstone;
  const std::uint64_t n = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 100000,
                      first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 0;
  long hits = 0, wrong = 0, late = 0, open = 0, in_double = 0;
  for (std::uint64_t i = first; i < first + n; ++i) {
    Rng r = Rng::stream(977, i);
    const primitives::PrimitiveMotion m = primitives::random_motion(r, i);
    const PrimitiveKind kind = r.chance(0.5) ? PrimitiveKind::vertex_face : PrimitiveKind::edge_edge;
    const PrimitiveImpact x = primitive_impact(kind, m.a, m.b);
    const impact::ExactImpact exact = impact::decide_exactly(kind, m.a, m.b, 0, true);
    hits += exact.collides;
    open += x.outcome != Outcome::answered;
    in_double += x.exit != PrimitiveExit::exact;
    const bool differs = x.toi.has_value() != exact.collides;
    // The first contact lies within 2^-49 after t_below.
    const bool is_late = x.toi && exact.collides && *x.toi > exact.t_below + 0x1p-49;
    wrong += differs;
    late += is_late;
    if (differs || is_late)
      std::printf("query %llu: %s, toi %.17g, exactly %d at %.17g, exit %d\n",
                  static_cast<unsigned long long>(i), kind == PrimitiveKind::vertex_face ? "vf" : "ee",
                  x.toi.value_or(-1), exact.collides, exact.t_below, static_cast<int>(x.exit));
  }
  std::printf("%llu queries, %ld hits, %ld decided in double, %ld wrong, %ld late, %ld not answered\n",
              static_cast<unsigned long long>(n), hits, in_double, wrong, late, open);
  return wrong + late + open == 0 ? 0 : 1;
}
