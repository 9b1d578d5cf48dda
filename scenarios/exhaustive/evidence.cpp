#include "scenarios/exhaustive/evidence.h"

#include <algorithm>

#include "scenarios/exhaustive/suites.h"

namespace touchstone::fuzz {
namespace {

constexpr auto exhaustive = SuiteKind::exhaustive, adversarial = SuiteKind::adversarial,
               temporal = SuiteKind::temporal, random_kind = SuiteKind::random;
constexpr auto boxes = BroadLevel::boxes, bodies = BroadLevel::bodies;
constexpr std::uint64_t every = ~std::uint64_t{0};

// Cheap and revealing evidence first, so that a refutation starts from a small case.
constexpr EvidenceRow table[] = {
    {"orders_of_two", exhaustive, boxes,
     "all orders of the ends of two boxes in three axes, ties included, at two scales", every, every,
     count_orders_of_two, orders_of_two},
    {"orders_on_an_axis", exhaustive, boxes,
     "all orders of the ends of three boxes on one axis, ties included", every, every,
     count_orders_on_an_axis, orders_on_an_axis},
    {"histories_of_two", exhaustive, boxes,
     "all sequences of 6 operations on two boxes and two places, 2 or 32 apart", every, every,
     count_histories_of_two, histories_of_two},
    {"histories_of_three", exhaustive, boxes,
     "all sequences of 5 operations (6 in full scope) on three boxes and three touching places", every, every,
     count_histories_of_three, histories_of_three},
    {"orders_of_three", exhaustive, boxes,
     "all orders of the ends of three boxes in three axes, ties included, up to symmetry", 40000, every,
     count_orders_of_three, orders_of_three},
    {"cell_borders", adversarial, boxes,
     "ends at or next to multiples of powers of two, on both sides of the origin", 10000, 300000, nullptr,
     cell_borders},
    {"touching_by_an_ulp", adversarial, boxes, "ends that differ in the last places of the subject's scalar",
     10000, 300000, nullptr, touching_by_an_ulp},
    {"sizes_far_apart", adversarial, boxes, "sizes and positions from 2^-10 to 2^10", 5000, 100000, nullptr,
     sizes_far_apart},
    {"zeros_and_denormals", adversarial, boxes, "zeros of both signs, denormals, the smallest normal numbers",
     5000, 100000, nullptr, zeros_and_denormals},
    {"far_from_the_origin", adversarial, boxes,
     "boxes of a few units, 2^20 to 2^44 from the origin (float: 2^8 to 2^17)", 5000, 100000, nullptr,
     far_from_the_origin},
    {"huge_coordinates", adversarial, boxes, "coordinates of 2^980 (float: 2^100)", 2000, 50000, nullptr,
     huge_coordinates},
    {"long_scripts", temporal, boxes,
     "500 steps of insert, drift, teleport, turn, remove, refit, on up to 24 boxes", 250, 4000, nullptr,
     long_scripts, false, false, 4},
    {"longest_script", temporal, boxes, "one script of 20,000 steps (100,000 in full scope)", 1, 4, nullptr,
     longest_script, false, false, 1},
    {"moving_crowds", temporal, boxes, "100 to 1,500 boxes over five frames", 12, 300, nullptr, moving_crowds,
     false, false, 2},
    {"uniform_boxes", random_kind, boxes,
     "2 to 33 boxes, centres uniform in a cube with 2 units of volume per box, sides in [1/4, 7/4]", 15000,
     1000000, nullptr, uniform_boxes},
    {"unbounded", adversarial, boxes, "half-spaces: boxes infinite on five sides", 2000, 50000, nullptr,
     unbounded},
    {"no_boxes", adversarial, boxes,
     "a NaN, infinite or inverted box among others, which must not lose pairs because of it", 2000, 50000,
     nullptr, no_boxes, true},
    {"tiles", adversarial, bodies,
     "2 to 25 bodies, turned or not, whose boxes touch exactly or to within the last place", 1200, 40000,
     nullptr, family_tiles, false, false, 32},
    {"errands", temporal, bodies, "scripts that move such bodies by a last place or far away", 1000, 30000,
     nullptr, family_errands, false, false, 32},
    {"script", temporal, bodies, "scripts over bodies of all shapes", 300, 10000, nullptr, family_script,
     false, false, 16},
    {"throng", adversarial, bodies, "40 to 400 such bodies", 16, 400, nullptr, family_throng, false, false,
     2},
    {"crowd", random_kind, bodies, "crowds of bodies of all shapes, turned at random", 300, 20000, nullptr,
     family_crowd, false, false, 16},
    {"drifting_on_an_axis", adversarial, bodies,
     "two bodies, turned or not, one of which moves along a world axis without turning", 450, 12000, nullptr,
     drifting_on_an_axis, false, true, 32},
    {"drifting", random_kind, bodies, "two bodies, one of which moves in any direction without turning", 300,
     12000, nullptr, drifting, false, true, 32},
    {"turning_in_place", random_kind, bodies, "two bodies, one of which turns and does not move", 400, 12000,
     nullptr, turning_in_place, false, true, 32},
    {"turning", random_kind, bodies, "two bodies, one of which moves and turns within the step", 600, 40000,
     nullptr, turning_pairs, false, true, 32},
    {"fast_and_far", adversarial, bodies,
     "two bodies, one of which comes from far away or moves thousands of its lengths; a third also turn", 300,
     12000, nullptr, fast_and_far, false, true, 32},
    {"grounded", adversarial, bodies, "such bodies on and in a half-space, which is unbounded", 300, 5000,
     nullptr, grounded, false, false, 32},
};

}  // namespace

std::span<const EvidenceRow> all_evidence() { return table; }

std::uint64_t planned_cases(const EvidenceRow& e, const Draw& d) {
  const std::uint64_t asked = d.scope == Scope::quick ? e.quick : e.full;
  return e.population ? std::min(asked, e.population(d)) : asked;
}

Case evidence_case(const EvidenceRow& e, const Draw& d, std::uint64_t i, std::uint64_t planned) {
  std::uint64_t index = i;
  if (e.population && planned < e.population(d)) {
    __extension__ using u128 = unsigned __int128;
    index = static_cast<std::uint64_t>(static_cast<u128>(i) * e.population(d) / planned);
  }
  Case c;
  c.id = std::string(e.name) + "/" + std::to_string(index);
  c.family = e.name;
  e.make(d, index, c);
  return c;
}

}  // namespace touchstone::fuzz
