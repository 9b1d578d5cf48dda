// The referee must agree with the recorded truth of every entry of the public collection of known failures.
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "oracles/checker/checker.h"
#include "tests/referee/support.h"
#include "tests/support/catch.h"
#include "tests/support/shared_data.h"
#include "tests/support/skip.h"

using namespace touchstone;
using namespace touchstone::referee_test;
using Json = nlohmann::json;

namespace {

Vec3 vector_of(const Json& j) { return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()}; }

Shape shape_of(const Json& j) {
  const std::string type = j["type"];
  const auto number = [&](const char* name) { return j[name].get<double>(); };
  if (type == "sphere") return Sphere{number("radius")};
  if (type == "box") return Box{vector_of(j["half_extents"])};
  if (type == "capsule") return Capsule{number("radius"), number("half_height")};
  if (type == "cylinder") return Cylinder{number("radius"), number("half_height")};
  if (type == "cone") return Cone{number("radius"), number("half_height")};
  REQUIRE((type == "convex" || type == "triangle"));
  Hull h;
  for (const Json& v : j["vertices"]) h.vertices.push_back(vector_of(v));
  return h;
}

Quat quaternion_of(const Json& j) {
  const Json& q = j["quaternion"];
  return {q[0].get<double>(), q[1].get<double>(), q[2].get<double>(), q[3].get<double>()};
}

Placed placed(const Shape& s, const Json& j) {
  const Vec3 t = vector_of(j["translation"]);
  if (j.value("exact", "quaternion") == "quaternion") return {&s, Pose{t, quaternion_of(j)}};
  Placement p;
  for (int i = 0; i < 3; ++i) p.matrix.row(i) = vector_of(j["rotation_matrix"][static_cast<std::size_t>(i)]);
  p.translation = t;
  return {&s, p};
}

// Constant velocities that lead from one pose to the other by the shortest arc.
Motion motion_between(const Json& from, const Json& to) {
  Motion m;
  m.linear = vector_of(to["translation"]) - vector_of(from["translation"]);
  Quat p = quaternion_of(from), q = normalized(quaternion_of(to));
  p = normalized(p);
  Quat d = q * Quat{-p.x, -p.y, -p.z, p.w};
  if (d.w < 0) d = {-d.x, -d.y, -d.z, -d.w};
  const Vec3 axis(d.x, d.y, d.z);
  if (axis.norm() > 1e-15) m.angular = 2 * std::atan2(axis.norm(), d.w) * axis.normalized();
  return m;
}

double size_of(const Json& e, const Shape& a, const Shape& b) {
  return scale_of(a, vector_of(e["pose_a"]["translation"]), b, vector_of(e["pose_b"]["translation"])) +
         bounding_radius(a) + bounding_radius(b);
}

}  // namespace

TEST_CASE("known failures: the recorded truth lies in the referee's brackets", "[referee][known][data]") {
  const std::filesystem::path file = test::shared_data() / "../known-failures.json";
  if (!std::filesystem::exists(file))
    return test::skip("there is no collection of known failures beside this checkout");
  std::ifstream in(file);
  const Json all = Json::parse(in);
  int discrete = 0, moving = 0, verdicts = 0;
  for (const Json& e : all) {
    if (!e.contains("shape_a") || e["shape_a"].is_null()) continue;
    const Shape sa = shape_of(e["shape_a"]), sb = shape_of(e["shape_b"]);
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
