// The shrinker keeps what it must keep, terminates, and gives small cases.
#include "fuzz/shrink/shrink.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/scene/scene.h"
#include "fuzz/campaign/campaign.h"
#include "fuzz/shrink/keeps_finding.h"
#include "fuzz/shrink/reductions.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/random/family.h"
#include "scenarios/random/numbers.h"
#include "tests/mutants/lying_engine.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

fuzz::StillShows when(std::function<bool(const Case&)> shows) {
  return [shows = std::move(shows)](std::span<const Case> cases) {
    std::vector<bool> r;
    for (const Case& c : cases) r.push_back(shows(c));
    return r;
  };
}

bool has_far_vertex(const Case& c) {
  for (std::size_t i = 0; i < c.scene.bodies.size(); ++i)
    if (const auto* h = std::get_if<Hull>(&c.scene.shape_of(static_cast<int>(i))))
      for (const Vec3& v : h->vertices)
        if (v.x() > 0.4) return true;
  return false;
}

}  // namespace

TEST_CASE("the size in bits counts what must be written down", "[shrink]") {
  CHECK(fuzz::bits_of(0.0) == 0);
  CHECK(fuzz::bits_of(-0.0) == 1);
  CHECK(fuzz::bits_of(1.0) == 1);
  CHECK(fuzz::bits_of(-1.0) == 2);
  CHECK(fuzz::bits_of(3.0) == 3);
  CHECK(fuzz::bits_of(1024.0) == 5);
  CHECK(fuzz::bits_of(0.1) > 50);
  CHECK(fuzz::rounded_to(0.1, 1) == 0.125);
  CHECK(fuzz::rounded_to(-0.3, 53) == -0.3);
}

TEST_CASE("a finding about a vertex keeps only one vertex of one hull", "[shrink]") {
  std::size_t shrunk_cases = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const Case c = fuzz::make_case(5, i, "crowd");
    const auto r = fuzz::shrink(c, when(has_far_vertex));
    if (!has_far_vertex(c)) {
      CHECK(r.exit == fuzz::ShrinkExit::not_shown);
      CHECK(r.smallest == c);
      continue;
    }
    ++shrunk_cases;
    CHECK(r.exit == fuzz::ShrinkExit::smallest);
    CHECK(has_far_vertex(r.smallest));
    CHECK(r.after < r.before);
    // 0.5 is the roundest number above 0.4: a shape, a query, a vertex and two bits.
    CHECK(r.after.bodies == 1);
    CHECK(r.after.steps == 0);
    CHECK(r.after.bits <= 8);
    if (shrunk_cases == 5) break;
  }
  CHECK(shrunk_cases == 5);
}

TEST_CASE("the result keeps the required property, is valid and not larger", "[shrink]") {
  std::size_t checked = 0, smaller = 0;
  for (const fuzz::Family& f : fuzz::families())
    for (std::uint64_t i = 0; i < 8; ++i) {
      const Case c = fuzz::make_case(11, i, f.name);
      const auto shows = [](const Case& x) {
        double sum = 0;
        for (const Body& b : x.scene.bodies) sum += b.pose.translation.sum();
        return std::abs(sum) > 1e-3;
      };
      const auto r = fuzz::shrink(c, when(shows), 3000);
      if (!shows(c)) continue;
      ++checked;
      smaller += r.after < r.before;
      CHECK(shows(r.smallest));
      CHECK_FALSE(r.before < r.after);
      CHECK_NOTHROW(validate(r.smallest.scene));
      INFO(case_to_json(r.smallest).dump());
      CHECK(case_from_json(case_to_json(r.smallest)).scene == r.smallest.scene);
    }
  CHECK(checked > 50);
  CHECK(smaller == checked);
}

TEST_CASE("an engine whose answers vary is distinguished from a shrunk case", "[shrink]") {
  const Case c = fuzz::make_case(1, 0, "near");
  CHECK(fuzz::shrink(c, when([](const Case&) { return false; })).exit == fuzz::ShrinkExit::not_shown);
  const auto r = fuzz::shrink(c, when([](const Case&) { return true; }), 3);
  CHECK(r.exit == fuzz::ShrinkExit::out_of_tries);
}

TEST_CASE("findings about lying engines shrink to two bodies and keep their key", "[shrink][mutants]") {
  // One or two per check; faults of list capacities and orders need many bodies.
  const std::set<std::string_view> chosen{"last_pair_dropped",    "boxes_one_ulp_small",
                                          "static_first_dropped", "stale_after_move",
                                          "lost_on_reinsert",     "pair_of_no_body",
                                          "overlap_always",       "overlap_flat_hull_denied",
                                          "distance_absolute",    "contact_shallow_denied",
                                          "witness_swapped",      "witness_centre",
                                          "normal_flipped",       "normal_zero",
                                          "normal_local",         "normal_of_centres",
                                          "depth_halved",         "depth_doubled",
                                          "point_far_off",        "impact_late",
                                          "impact_early",         "impact_denied",
                                          "impact_invented",      "impact_grazing_lost",
                                          "not_a_number",         "cap_as_failure",
                                          "contact_dropped"};
  std::size_t shrunk_findings = 0;
  for (const mutants::Mutant& m : mutants::mutants()) {
    if (!chosen.contains(m.name)) continue;
    const EnginePtr engine = mutants::make_lying_engine(m);
    for (std::uint64_t i = 0; i < 512; ++i) {
      const Case c = fuzz::make_case(1, i, m.family);
      const auto found = fuzz::findings_of({&c, 1}, engine)[0];
      const auto hit =
          std::find_if(found.begin(), found.end(), [&](const auto& f) { return f.second.fault == m.fault; });
      if (hit == found.end()) continue;
      INFO(m.name << " " << hit->first << " in " << c.id);
      const auto r = fuzz::shrink(c, fuzz::keeps_finding(engine, hit->first), 4000);
      CHECK(fuzz::findings_of({&r.smallest, 1}, engine)[0].contains(hit->first));
      CHECK(r.after.bodies <= 2);
      CHECK(r.after.steps <= 6);
      CHECK(r.after < r.before);
      ++shrunk_findings;
      break;
    }
  }
  CHECK(shrunk_findings == chosen.size());
}

TEST_CASE("numbers at the limits of double are rounded or kept, never lost", "[shrink]") {
  Case c;
  const double far = 0x1.fffffffffffffp1023;
  c.scene.shapes = {make_hull({{far, 0, 0}, {0, far, 0}, {0, 0, far}, {-far, -1, -2}})};
  c.scene.bodies.resize(2);
  c.queries = {{Question::overlap, 0, 1}};
  for (std::size_t i = 0; i < fuzz::numbers(c).size(); ++i) fuzz::round_one(c, i);
  fuzz::round_all(c);
  const auto shrunk =
      fuzz::shrink(c, [](std::span<const Case> cases) { return std::vector<bool>(cases.size(), true); });
  CHECK(shrunk.exit == fuzz::ShrinkExit::smallest);
  validate(shrunk.smallest.scene);
}
