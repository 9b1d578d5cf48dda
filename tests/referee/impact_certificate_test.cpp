// Certificates of motions: what impact_certificate hands out is accepted by the checker after a trip through
// JSON, covers nearly all of what judge_motion says, and is refused with any number changed so that it claims
// what is false.
#include <nlohmann/json.hpp>

#include "core/base/input_error.h"
#include "oracles/referee/impact_certificate.h"
#include "oracles/referee/rational.h"
#include "tests/referee/support.h"
#include "tests/support/catch.h"

namespace touchstone::referee_test {
namespace {

using Hit = TimeTruth::Verdict;

Placed at(const Shape& s, const Vec3& t, const Quat& q = {}) { return {&s, Pose{t, q}}; }
Motion moving(const Vec3& v, const Vec3& w = Vec3::Zero()) { return {v, w}; }
const Motion rest{};

ImpactCertificate stored(const ImpactCertificate& c) {
  return impact_certificate_from_json(nlohmann::ordered_json::parse(to_json(c).dump()));
}

double time_of(const ImpactCertificate::Contact& c) { return rational_from_text(c.t).convert_to<double>(); }

std::size_t keys_of(const ImpactCertificate& c) {
  std::size_t n = 0;
  for (const auto& t : c.tracks) n += t.size();
  return n;
}

struct Pairing {
  Placed a, b;
  Motion ma, mb;
  TimeTruth truth() const { return judge_motion(a, ma, b, mb); }
  ImpactCertificate certificate() const { return stored(impact_certificate(a, ma, b, mb, truth())); }
  bool accepts(const ImpactCertificate& c) const { return check(c, a, ma, b, mb); }
};

Pairing random_pairing(Rng& r, const Shape& x, const Shape& y) {
  const Placed a = at(x, 2.2 * r.unit_vector(), r.rotation()), b = at(y, r.vector(0, 1), r.rotation());
  const Vec3 p = std::get<Pose>(a.pose).translation - std::get<Pose>(b.pose).translation;
  const auto spin = [&] { return r.chance(0.6) ? Vec3(r.uniform(0, 6) * r.unit_vector()) : Vec3(0, 0, 0); };
  const Vec3 both = r.unit_vector();
  return {a, b, moving(-2 * p + 3.0 * r.unit_vector() + both, spin()), moving(both, spin())};
}

}  // namespace

TEST_CASE("every random motion's certificate is accepted and nearly as sharp as the truth",
          "[referee][motion][checker]") {
  Rng r(811);
  int planes = 0, contacts = 0, hits = 0, none = 0, no_planes = 0, no_contact = 0;
  std::size_t keys = 0, most = 0;
  double worst_lo = 0, worst_hi = 0;
  for (int i = 0; i < 147; ++i) {
    const Shape x = random_convex(r, convex_kinds[i % 7]), y = random_convex(r, convex_kinds[i / 7 % 7]);
    const Pairing p = random_pairing(r, x, y);
    const TimeTruth t = p.truth();
    if (t.verdict == Hit::undecided) continue;
    const ImpactCertificate c = stored(impact_certificate(p.a, p.ma, p.b, p.mb, t));
    INFO(i << " " << type_name(x) << " " << type_name(y) << " [" << t.t_lo << ", " << t.t_hi << "]");
    hits += t.verdict == Hit::hit, none += t.verdict == Hit::none;
    const double until = t.verdict == Hit::none ? 1 : t.t_lo;
    if (until > 0) {
      no_planes += c.tracks.empty();
      if (!c.tracks.empty()) {
        REQUIRE(p.accepts(c));
        ++planes, keys += keys_of(c), most = std::max(most, keys_of(c));
        worst_lo = std::max(worst_lo, until - c.clear_until);
      }
    }
    if (t.verdict == Hit::hit) {
      no_contact += !c.contact;
      if (c.contact) ++contacts, worst_hi = std::max(worst_hi, time_of(*c.contact) - t.t_hi);
    }
  }
  WARN(hits << " hits, " << none << " none; planes for " << planes << " (missing " << no_planes << ", "
            << static_cast<double>(keys) / planes << " keys on average, at most " << most
            << ", short by at most " << worst_lo << "), points for " << contacts << " (missing " << no_contact
            << ", late by at most " << worst_hi << ")");
  CHECK(no_planes == 0);
  CHECK(no_contact == 0);
  CHECK(worst_lo < 1e-9);
  CHECK(worst_hi < 1e-9);
  REQUIRE(hits > 40);
  REQUIRE(none > 40);
}

}  // namespace touchstone::referee_test
