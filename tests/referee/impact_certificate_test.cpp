// Certificates of motions: the checker accepts those of impact_certificate after a round trip through JSON,
// they cover nearly everything that judge_motion reports, and are refused with any number changed so that the
// claim is false.
#include <nlohmann/json.hpp>

#include "core/base/input_error.h"
#include "oracles/checker/checker.h"
#include "oracles/referee/exact/rational.h"
#include "oracles/referee/referee.h"
#include "scenarios/codec/value_codec.h"
#include "tests/referee/support.h"
#include "tests/support/catch.h"
#include "tests/support/parsed.h"

namespace touchstone::referee_test {
namespace {

using Hit = TimeTruth::Verdict;

Placed at(const Shape& s, const Vec3& t, const Quat& q = {}) { return {&s, Pose{t, q}}; }
Motion moving(const Vec3& v, const Vec3& w = Vec3::Zero()) { return {v, w}; }
const Motion rest{};

ImpactCertificate stored(const ImpactCertificate& c) {
  return impact_certificate_from_json(test::parsed<nlohmann::ordered_json>(to_json(c).dump()));
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
  bool accepts(const ImpactCertificate& c) const { return checker::check(c, a, ma, b, mb); }
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
    const Shape x = random_convex(r, tested_kinds[i % 7]), y = random_convex(r, tested_kinds[i / 7 % 7]);
    const Pairing p = random_pairing(r, x, y);
    const TimeTruth t = p.truth();
    if (t.verdict == Hit::undecided) continue;
    const ImpactCertificate c = stored(impact_certificate(p.a, p.ma, p.b, p.mb, t));
    INFO(i << " " << type_name(x) << " " << type_name(y) << " [" << t.t_lo << ", " << t.t_hi << "]");
    hits += t.verdict == Hit::hit;
    none += t.verdict == Hit::none;
    const double until = t.verdict == Hit::none ? 1 : t.t_lo;
    if (until > 0) {
      no_planes += c.tracks.empty();
      if (!c.tracks.empty()) {
        REQUIRE(p.accepts(c));
        ++planes;
        keys += keys_of(c);
        most = std::max(most, keys_of(c));
        worst_lo = std::max(worst_lo, until - c.clear_until);
      }
    }
    if (t.verdict == Hit::hit) {
      no_contact += !c.contact;
      if (c.contact) {
        ++contacts;
        worst_hi = std::max(worst_hi, time_of(*c.contact) - t.t_hi);
      }
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
  REQUIRE(hits > 30);  // the sample depends on the order in which a compiler evaluates arguments
  REQUIRE(none > 40);
}

TEST_CASE("translating polytopes and rounded shapes: one plane and the exact time, far away or grazing",
          "[referee][motion][checker]") {
  const Shape cube = Box{{0.5, 0.5, 0.5}}, ball = Sphere{1};
  const double far = 1e6;
  const Pairing pairs[] = {
      {at(cube, {-5, 0, 0}), at(cube, {0, 0, 0}), moving({10, 0, 0}), rest},
      {at(cube, {-5, 1, 0}), at(cube, {0, 0, 0}), moving({10, 0, 0}), rest},  // grazes a face
      {at(cube, {-5, 1 + 0x1p-52, 0}), at(cube, {0, 0, 0}), moving({10, 0, 0}), rest},
      {at(ball, {-10, 2, 0}), at(ball, {0, 0, 0}), moving({20, 0, 0}), rest},  // touches at t = 1/2 only
      {at(ball, {-10, 2 + 0x1p-51, 0}), at(ball, {0, 0, 0}), moving({20, 0, 0}), rest},
      {at(cube, {far - 3, far, far}), at(ball, {far, far, far}), moving({far + 4, 0, 0}),
       moving({far, 0, 0})},
      {at(cube, {1, 0, 0}), at(cube, {0, 0, 0}), moving({1, 0, 0}), rest}};  // touches from the start
  int hits = 0;
  for (const Pairing& p : pairs) {
    const TimeTruth t = p.truth();
    const ImpactCertificate c = p.certificate();
    INFO(t.t_lo << " " << t.t_hi);
    REQUIRE(p.accepts(c));
    REQUIRE(t.verdict != Hit::undecided);
    if (t.verdict == Hit::hit) {
      REQUIRE(c.contact);
      REQUIRE(time_of(*c.contact) == t.t_hi);
      ++hits;
    }
    REQUIRE(c.tracks.empty() == (t.t_lo == 0));
    if (!c.tracks.empty()) REQUIRE(c.clear_until == t.t_lo);
    for (const auto& track : c.tracks) REQUIRE(track.size() == 2);
  }
  REQUIRE(hits == 5);
}

TEST_CASE("half-spaces and meshes have certificates of their motions", "[referee][motion][checker]") {
  const Shape ground = HalfSpace{{0.1, 0.2, 1}, 0}, ball = Sphere{0.25}, stick = Capsule{0.1, 1},
              die = Box{{1, 2, 3}};
  TriangleMesh m;
  m.vertices = {{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}, {9, 9, 9}};
  m.triangles = {{0, 1, 2}, {0, 2, 3}, {2, 3, 4}};
  const Shape floor = m;
  const Pairing pairs[] = {
      {at(ball, {0, 0, 2}), at(ground, {0, 0, 0}), moving({1, 0, -3}, {9, 9, 9}), rest},
      {at(ground, {0, 0, 0}, {0.1, 0.2, 0.3, 1}), at(die, {0, 0, 6}), rest, moving({1, 0, -3}, {1, 2, 3})},
      {at(ground, {0, 0, 0}), at(die, {0, 0, 4}), moving({0, 0, 1}), moving({1, 0, 1.5})},
      {at(stick, {0, 0, 0.9}, {0, 1, 0, 1}), at(ground, {0, 0, 0}), moving({0, 0, 0}, {0, 1, 0}), rest},
      {at(ball, {0.1, 0.2, 2}), at(floor, {0, 0, 0}), moving({0, 0, -3}), rest},
      {at(ball, {0.1, 0.2, 2}), at(floor, {0, 0, 0}), moving({0, 0, -1}), rest},
      {at(floor, {0, 0, 0}), at(die, {0.1, 0.2, 6}), rest, moving({0, 0, -4}, {3, 0, 0})}};
  for (const Pairing& p : pairs) {
    const TimeTruth t = p.truth();
    const ImpactCertificate c = p.certificate();
    INFO(type_name(*p.a.shape) << " " << type_name(*p.b.shape) << " " << t.t_lo << " " << t.t_hi);
    REQUIRE(t.verdict != Hit::undecided);
    REQUIRE(p.accepts(c));
    REQUIRE(c.contact.has_value() == (t.verdict == Hit::hit));
    if (c.contact) REQUIRE(time_of(*c.contact) <= t.t_hi + 1e-13);
    REQUIRE_FALSE(c.tracks.empty());
    REQUIRE(c.clear_until >= (t.verdict == Hit::none ? 1 : t.t_lo) - 1e-13);
  }
}

TEST_CASE("the depth of bodies during a motion is certified, for triangles and for rotating bodies",
          "[referee][motion][checker]") {
  TriangleMesh m;
  m.vertices = {{-3, -3, 0}, {3, -3, 0.5}, {3, 3, 0}, {-3, 3, -0.5}, {0.125, 0.25, 0.5}};
  m.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  const Shape field = m;
  Rng r(77);
  int shown = 0, deep = 0;
  for (int i = 0; i < 56; ++i) {
    const Shape x = random_convex(r, tested_kinds[i % 7]), y = random_convex(r, tested_kinds[i / 7 % 7]);
    Pairing p = random_pairing(r, x, y);
    if (i % 4 != 0) {
      p.a = at(x, {0.25, -0.5, 2.5}, r.rotation());
      p.b = at(field, {0, 0, 0});
      p.ma.linear = {0, 0, -4};
      p.mb = i % 2 == 0 ? moving({0, 0, 0.5}, p.mb.angular) : rest;
    }
    if (i % 8 == 3) {
      std::swap(p.a, p.b);
      std::swap(p.ma, p.mb);
    }
    const DepthInTime d = deepest_before(p.a, p.ma, p.b, p.mb, 1);
    INFO(i << " " << type_name(*p.a.shape) << " " << type_name(*p.b.shape) << " " << d.depth << " at "
           << d.t);
    if (!(d.depth > 1e-3)) continue;
    ++deep;
    ImpactCertificate c;
    add_overlap(c, p.a, p.ma, p.b, p.mb, d);
    if (!c.overlap) continue;
    ++shown;
    REQUIRE(p.accepts(stored(c)));
    REQUIRE(c.overlap->inner.offset > d.depth * (1 - 1e-6));
    const auto refused = [&](auto change) {
      ImpactCertificate e = c;
      change(*e.overlap);
      REQUIRE_FALSE(p.accepts(stored(e)));
    };
    refused([&](auto& o) { o.inner.offset *= 1.001; });
    refused([&](auto& o) { o.part_a = 99; });
    refused([&](auto& o) { o.t = 1.5; });
    refused([&](auto& o) { o.t = d.t > 0.5 ? 0 : 1; });
    refused([&](auto& o) { o.inner.support_pairs[0][0].x() += 9; });
  }
  CAPTURE(deep, shown);
  REQUIRE(deep > 30);
  REQUIRE(shown >= deep - 2);  // an inner polytope of curved bodies may stall
}

// The checker knows the body's position only up to rounding, and the body contains no ball of that size.
// Exact tests of points that cannot be accepted once took 40 s for one pair.
TEST_CASE("a rotating flat body has planes and no common point; one that does not rotate has both",
          "[referee][motion][checker]") {
  const Shape leaf = Hull{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.25, 1, 0}}, {}, 2}, die = Box{{1, 1, 1}};
  for (const bool turns : {true, false}) {
    const Pairing p{at(die, {0, 0, 0}), at(leaf, {4, 0.25, 0.5}), rest,
                    moving({-4, 0, 0}, turns ? Vec3(0.5, 0.25, 0.125) : Vec3(0, 0, 0))};
    REQUIRE(p.truth().verdict == Hit::hit);
    const ImpactCertificate c = p.certificate();
    REQUIRE(p.accepts(c));
    REQUIRE_FALSE(c.tracks.empty());
    REQUIRE(c.clear_until >= p.truth().t_lo - 1e-13);
    REQUIRE(c.contact.has_value() == !turns);
  }
}

TEST_CASE("a bar that swings through a wall between two keys is caught by the bound on its arc",
          "[referee][motion][checker]") {
  // A unit bar about its middle; the plane x = 0.99 is clear of its ends at both keys but not in between.
  const Shape bar = Capsule{0, 1}, wall = Box{{0.005, 9, 9}};
  for (const double turn : {1.0, 0.1, 0.01, 1e-3}) {
    // The upper end points straight up at the middle of the step; the wall begins at height `at`.
    const double top = std::cos(turn / 2) + 0.25 * (1 - std::cos(turn / 2));
    const Pairing p{at(bar, {0, 0, 0}, {0, -std::sin(turn / 4), 0, std::cos(turn / 4)}),
                    at(wall, {0, 0, top + 0.005}, {0, std::sqrt(0.5), 0, std::sqrt(0.5)}),
                    moving({0, 0, 0}, {0, turn, 0}), rest};
    INFO(turn << " " << p.truth().note << " " << p.truth().t_lo << " " << p.truth().t_hi);
    REQUIRE(p.truth().verdict == Hit::hit);
    const auto claim = [&](double offset) {
      ImpactCertificate c;
      const std::string at_offset = text_of(exact(offset) - exact(top + 0.005));
      c.tracks = {{{0, {"0", "0", "1"}, at_offset}, {1, {"0", "0", "1"}, at_offset}}};
      c.clear_until = 1;
      return c;
    };
    for (double part : {0.05, 0.1, 0.2, 0.24, 0.2499})
      REQUIRE_FALSE(p.accepts(claim(std::cos(turn / 2) + part * (1 - std::cos(turn / 2)))));
  }
  // The bound is nearly sharp: a wall beyond the swing, by a quarter of its height, is clear in one piece.
  const double turn = 0.01, rise = 1 - std::cos(turn / 2);
  const Pairing clear{at(bar, {0, 0, 0}, {0, -std::sin(turn / 4), 0, std::cos(turn / 4)}),
                      at(wall, {0, 0, 1 + 0.5 * rise + 0.005}, {0, std::sqrt(0.5), 0, std::sqrt(0.5)}),
                      moving({0, 0, 0}, {0, turn, 0}), rest};
  ImpactCertificate c;
  const std::string offset = text_of(exact(1 + 0.25 * rise) - exact(1 + 0.5 * rise + 0.005));
  c.tracks = {{{0, {"0", "0", "1"}, offset}, {1, {"0", "0", "1"}, offset}}};
  c.clear_until = 1;
  REQUIRE(clear.accepts(c));
}

TEST_CASE("planes that clear smaller bodies beyond the contact of the true ones are refused",
          "[referee][motion][checker]") {
  Rng r(907);
  int refused = 0, kept = 0;
  for (int i = 0; i < 160; ++i) {
    const Shape x = random_convex(r, tested_kinds[i % 7]), y = random_convex(r, tested_kinds[i / 7 % 7]);
    const Pairing p = random_pairing(r, x, y);
    const TimeTruth t = p.truth();
    if (t.verdict != Hit::hit || t.t_lo == 0) continue;
    // The same bodies shrunk about their origins, so slightly that only the true contact shows it.
    for (const double by : {0.9, 0.999, 1 - 1e-6}) {
      const auto shrunk = [&](const Shape& s) {
        Shape q = s;
        std::visit(
            [&](auto& shape) {
              if constexpr (requires { shape.fields(); })
                for_each_field(shape, [&](auto, auto& v, Domain) {
                  using F = std::decay_t<decltype(v)>;
                  if constexpr (std::is_same_v<F, double> || std::is_same_v<F, Vec3>) v *= by;
                  if constexpr (std::is_same_v<F, std::vector<Vec3>>)
                    for (Vec3& w : v) w *= by;
                });
            },
            q);
        return q;
      };
      const Shape u = shrunk(x), w = shrunk(y);
      const Pairing small{{&u, p.a.pose}, {&w, p.b.pose}, p.ma, p.mb};
      const ImpactCertificate c = small.certificate();
      if (c.tracks.empty()) continue;
      ImpactCertificate planes = c;
      planes.contact.reset();
      REQUIRE(small.accepts(planes));
      if (planes.clear_until >= t.t_hi) {
        REQUIRE_FALSE(p.accepts(planes));
        ++refused;
      } else {
        ++kept;
      }
    }
  }
  CAPTURE(kept);
  REQUIRE(refused > 60);
}

TEST_CASE("a motion's certificate is refused with its times, planes or point changed",
          "[referee][motion][checker]") {
  Rng r(31);
  int changed = 0, motions = 0;
  for (int i = 0; i < 120 && motions < 24; ++i) {
    const Shape x = random_convex(r, tested_kinds[i % 7]), y = random_convex(r, tested_kinds[i / 7 % 7]);
    const Pairing p = random_pairing(r, x, y);
    const TimeTruth t = p.truth();
    if (t.verdict != Hit::hit || t.t_lo == 0) continue;
    const ImpactCertificate c = p.certificate();
    REQUIRE(p.accepts(c));
    ++motions;
    const auto refused = [&](auto change) {
      ImpactCertificate d = c;
      change(d);
      REQUIRE_FALSE(p.accepts(stored(d)));
      ++changed;
    };
    refused([&](auto& d) { d.clear_until = d.tracks[0].back().t = std::min(1.0, t.t_hi + 1e-9); });
    refused([](auto& d) { d.clear_until = 1; });
    refused([](auto& d) { d.tracks[0].front().t = 0x1p-1000; });
    refused([](auto& d) { std::erase_if(d.tracks[0], [](const auto& k) { return k.t == 0; }); });
    refused([](auto& d) { std::swap(d.tracks[0].front().t, d.tracks[0].back().t); });
    refused([](auto& d) { d.tracks[0].clear(); });
    refused([](auto& d) { d.contact->t = std::string("2"); });
    refused([](auto& d) { d.contact->t = std::string("-1/1000000000000"); });
    refused([&](auto& d) { d.contact->t = text_of(exact(t.t_lo / 2)); });
    for (std::size_t k = 0; k < c.tracks[0].size(); ++k) {
      refused(
          [&](auto& d) { d.tracks[0][k].offset = text_of(rational_from_text(c.tracks[0][k].offset) + 9); });
      refused(
          [&](auto& d) { d.tracks[0][k].offset = text_of(rational_from_text(c.tracks[0][k].offset) - 9); });
      refused([&](auto& d) { d.tracks[0][k].direction = {"0", "0", "0"}; });
      refused([&](auto& d) {
        for (auto& n : d.tracks[0][k].direction) n = text_of(-rational_from_text(n));
        d.tracks[0][k].offset = text_of(-rational_from_text(d.tracks[0][k].offset));
      });
    }
    for (std::size_t k = 0; k < 3; ++k)
      refused([&](auto& d) { d.contact->point[k] = text_of(rational_from_text(c.contact->point[k]) + 9); });
    // In the other order or at other speeds the certificate does not apply.
    REQUIRE_FALSE(checker::check(c, p.b, p.mb, p.a, p.ma));
    REQUIRE_FALSE(checker::check(c, p.a, p.mb, p.b, p.ma));
  }
  REQUIRE(motions == 24);
  REQUIRE(changed > 400);
  ImpactCertificate nothing;
  const Shape ball = Sphere{1};
  REQUIRE_FALSE(checker::check(nothing, at(ball, {0, 0, 0}), rest, at(ball, {9, 0, 0}), rest));
}

}  // namespace touchstone::referee_test
