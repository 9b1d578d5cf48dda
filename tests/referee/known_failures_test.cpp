// The referee must agree with the recorded truth of every entry of the public collection of known failures.
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "oracles/checker/checker.h"
#include "tests/referee/support.h"
#include "tests/support/catch.h"
#include "tests/support/known_failures.h"
#include "tests/support/skip.h"

using namespace touchstone;
using namespace touchstone::referee_test;
using Json = nlohmann::json;
using test::motion_between;
using test::quaternion_of;
using test::vector_of;

namespace {

Placed placed(const Shape& s, const Json& j) {
  const Vec3 t = vector_of(j["translation"]);
  if (j.value("exact", "quaternion") == "quaternion") return {&s, Pose{t, quaternion_of(j)}};
  Placement p;
  for (int i = 0; i < 3; ++i) p.matrix.row(i) = vector_of(j["rotation_matrix"][static_cast<std::size_t>(i)]);
  p.translation = t;
  return {&s, p};
}

double size_of(const Json& e, const Shape& a, const Shape& b) {
  return scale_of(a, vector_of(e["pose_a"]["translation"]), b, vector_of(e["pose_b"]["translation"])) +
         bounding_radius(a) + bounding_radius(b);
}

}  // namespace

TEST_CASE("known failures: the recorded truth lies in the referee's brackets", "[referee][known][data]") {
  const std::filesystem::path file = test::known_failures_file();
  if (!std::filesystem::exists(file))
    return test::skip("there is no collection of known failures beside this checkout");
  std::ifstream in(file);
  const Json all = Json::parse(in);
  int discrete = 0, moving = 0, verdicts = 0;
  for (const Json& e : all) {
    if (!test::has_shapes(e)) continue;
    const Shape sa = test::shape_of(e["shape_a"]), sb = test::shape_of(e["shape_b"]);
    const Placed a = placed(sa, e["pose_a"]), b = placed(sb, e["pose_b"]);
    const Json& want = e["expected"];
    const double length = size_of(e, sa, sb);
    INFO(e["id"].get<std::string>());
    if (want.contains("reference_signed_distance")) {
      const PairTruth t = judge_pair(a, b);
      const double g = want["reference_signed_distance"], tolerance = 1e-15 * length;
      INFO("expected " << g << " bracket " << t.gap.lo << " " << t.gap.hi << " " << to_string(t.verdict));
      CHECK(t.gap.lo <= g + tolerance);
      CHECK(t.gap.hi >= g - tolerance);
      CHECK(t.gap.hi - t.gap.lo <= 1e-14 * length);
      ++discrete;
      if (std::abs(g) > tolerance) {
        CHECK(t.verdict == (want["overlap"].get<bool>() ? Verdict::overlap : Verdict::disjoint));
        ++verdicts;
      }
    }
    if (!want.contains("toi")) continue;
    const Motion ma = motion_between(e["pose_a"], e["motion"]["pose_a_end"]),
                 mb = motion_between(e["pose_b"], e["motion"]["pose_b_end"]);
    const TimeTruth t = judge_motion(a, ma, b, mb);
    INFO("[" << t.t_lo << ", " << t.t_hi << "] " << t.note << " least gap " << t.least_gap.lo << " "
             << t.least_gap.hi);
    ++moving;
    if (want["toi"].is_null()) {
      CHECK(t.verdict == TimeTruth::Verdict::none);
      const double least = want.value("reference_min_signed_distance", t.least_gap.hi);
      CHECK(t.least_gap.lo <= least + 1e-9);
    } else {
      CHECK(t.verdict == TimeTruth::Verdict::hit);
      const double toi = want["reference_toi"];
      CHECK(t.t_lo <= toi + 1e-12);
      CHECK(t.t_hi >= toi - 1e-12);
      CHECK(t.t_hi - t.t_lo <= 1e-9);
    }
  }
  WARN(discrete << " discrete entries, " << verdicts << " with a verdict clear of rounding, " << moving
                << " motions");
  REQUIRE(discrete > 50);
  REQUIRE(moving > 10);
}
