// Times of impact against the referee: hits and misses, the gap at the time, the depth before it. Published
// hulls too, when they are present.
#include <filesystem>

#include "core/impact/impact.h"
#include "core/tolerance.h"
#include "oracles/referee/referee.h"
#include "scenarios/import/hull_zoo.h"
#include "tests/core/random_course.h"
#include "tests/support/catch.h"
#include "tests/support/shared_data.h"
#include "tests/support/skip.h"

using namespace touchstone;
using namespace touchstone::test;

namespace {

struct Tally {
  int cases = 0, hits = 0, decided = 0;
};

// Checks against the referee: the verdict, the gap at the time, the depth before it.
void check_course(const CoursePair& c, Tally& n) {
  using Verdict = referee::TimeTruth::Verdict;
  const ImpactAnswer x = time_of_impact({&c.p.a, c.p.pose_a, c.ma}, {&c.p.b, c.p.pose_b, c.mb});
  const Placed a{&c.p.a, c.p.pose_a}, b{&c.p.b, c.p.pose_b};
  const referee::TimeTruth truth = referee::judge_motion(a, c.ma, b, c.mb);
  const double tau = tolerance::core_tau_factor * 0x1p-53 * scale_of(c);
  REQUIRE(x.outcome == Outcome::answered);
  ++n.cases;
  n.hits += x.toi.has_value();
  n.decided += truth.verdict != Verdict::undecided;
  if (!x.toi) {
    CHECK(referee::certified_depth_before(a, c.ma, b, c.mb, 1) <= tau);
    return;
  }
  if (truth.verdict == Verdict::none) CHECK(truth.least_gap.lo <= tau);
  CHECK(referee::gap_at(a, c.ma, b, c.mb, *x.toi).lo <= tau);
  if (*x.toi == 0) return;
  CHECK(referee::certified_depth_before(a, c.ma, b, c.mb, *x.toi) <= tau);
  // Times that are proven clear are clear.
  if (truth.verdict == Verdict::hit) CHECK(x.clear_until <= truth.t_hi);
}

}  // namespace

TEST_CASE("impact: the referee finds no hit missed, late, early or a ghost", "[impact][referee]") {
  Tally n;
  for (std::uint64_t i = 0; i < 360; ++i) {
    Rng r = Rng::stream(4242, i);
    INFO("case " << i);
    check_course(random_course(r, static_cast<CourseKind>(i % course_count)), n);
  }
  INFO(n.cases << " motions, " << n.hits << " hits, " << n.decided << " decided");
  CHECK(n.hits > 0.3 * n.cases);
  CHECK(n.hits < 0.7 * n.cases);
  CHECK(n.decided > 0.9 * n.cases);
}

TEST_CASE("a needle of points does not meet an ellipsoid early", "[impact][referee]") {
  // Fuzzing case zero/556/389104: the last simplex is a needle, whose plane is nearer than its points.
  std::vector<Vec3> line;
  for (const double z :
       {-0.26159518946033916, 0.0650536795823392,   0.03261345712791967,  -0.04446790373509788,
        -0.11820637120178014, -0.4612189653635376,  0.18759970334338072,  -0.24970597046714363,
        0.2677149392364285,   -0.1346398787928015,  -0.3037078542120063,  -0.42043326847872176,
        0.34415652025493254,  -0.30822597466199914, 0.020369340271192478, -0.02833249845714714,
        -0.24850624483261913, -0.34176005874098686, 0.07235700288235505,  0.20834788926551376,
        -0.38485768786967245})
    line.push_back({0, 0, z});
  const CoursePair c{
      {Ellipsoid{{0.48286665117148564, 1.0120584460355186, 1.103845213257237}},
       make_hull(line),
       {{0, 0, 0}, {-0.9505035185617576, -0.06887295587405409, -0.22040861090029015, -0.2078932932826195}},
       {{-0.2721422044165023, 0.5481311124992021, 1.0896379646157912},
        {-0.3226048291226202, -0.30117837712500933, 0.34309564409454707, -0.8291580599514538}}},
      {},
      {{0.3443794674089703, -0.44905093399117646, -1.2133882847614665}, Vec3::Zero()}};
  Tally n;
  check_course(c, n);
  CHECK(n.hits == 1);
}

TEST_CASE("impact: published hulls in motion, including sheets and needles",
          "[impact][referee][real][data]") {
  const std::filesystem::path zoo = shared_data() / "hulls";
  if (!std::filesystem::exists(zoo)) return skip(zoo.string() + " is absent");
  const std::vector<ZooHull> hulls = load_hull_zoo(zoo);
  Tally n;
  for (std::uint64_t i = 0; i < 260; ++i) {
    Rng r = Rng::stream(99, i);
    CoursePair c;
    // Scaled to equal size about their middles, at the same place as before.
    const auto take = [&](Shape& s, Pose& pose) {
      std::vector<Vec3> v = hulls[r.below(hulls.size())].vertices;
      Vec3 lo = v[0], hi = v[0];
      for (const Vec3& x : v) {
        lo = lo.cwiseMin(x);
        hi = hi.cwiseMax(x);
      }
      for (Vec3& x : v) x = (x - (lo + hi) / 2) / ((hi - lo).maxCoeff() / 2);
      s = make_hull(std::move(v));
      pose.rotation = r.rotation();
    };
    take(c.p.a, c.p.pose_a);
    take(c.p.b, c.p.pose_b);
    c.p.pose_b.translation = r.unit_vector() * r.uniform(3, 5);
    c.mb.linear = -c.p.pose_b.translation * r.uniform(0.4, 1.6) + r.unit_vector() * 0.8;
    if (i % 3 > 0) c.mb.angular = r.vector(0.1, i % 3 == 1 ? 1 : 15);
    if (i % 6 > 3) c.ma.angular = r.vector(0.1, 3);
    INFO("case " << i);
    check_course(c, n);
  }
  INFO(n.cases << " motions, " << n.hits << " hits, " << n.decided << " decided");
  CHECK(n.hits > 0.3 * n.cases);
  CHECK(n.hits < 0.8 * n.cases);
}
