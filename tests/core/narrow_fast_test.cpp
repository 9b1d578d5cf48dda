// The fast paths against the extended-precision one, which proves its own slack: an answer that double or
// float gives without falling back must be within the bound that it states, with a correct verdict and
// witnesses on the bodies. By hand: TOUCHSTONE_NARROW_ROUNDS multiplies the number of cases,
// TOUCHSTONE_NARROW_SEED changes them.
#include <cstdlib>

#include "core/math/through_float.h"
#include "core/narrow/pair_table.h"
#include "core/tolerance.h"
#include "tests/core/least_width.h"
#include "tests/core/random_pair.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::test;
namespace filtered = touchstone::narrow::filtered;

namespace {

long rounds(long usual) {
  const char* text = std::getenv("TOUCHSTONE_NARROW_ROUNDS");
  return text ? usual * std::max(1L, std::atol(text)) : usual;
}

std::uint64_t seeded(std::uint64_t usual) {
  const char* text = std::getenv("TOUCHSTONE_NARROW_SEED");
  return text ? usual + 1000 * std::strtoull(text, nullptr, 10) : usual;
}

template <class R>
void round_shape(Shape& s) {
  if constexpr (sizeof(R) == sizeof(float))
    std::visit(
        [](auto& x) {
          for_each_field(x, [](std::string_view, auto& v, Domain) {
            using T = std::remove_reference_t<decltype(v)>;
            if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Vec3>) v = through_float(v);
            if constexpr (std::is_same_v<T, std::vector<Vec3>>)
              for (Vec3& p : v) p = through_float(p);
          });
        },
        s);
}

void enlarge(Shape& s, double by) {
  std::visit(
      [by](auto& x) {
        for_each_field(x, [by](std::string_view, auto& v, Domain) {
          using T = std::remove_reference_t<decltype(v)>;
          if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Vec3>) v *= by;
          if constexpr (std::is_same_v<T, std::vector<Vec3>>)
            for (Vec3& p : v) p *= by;
        });
      },
      s);
}

/// The pair as the arithmetic R receives it.
template <class R>
Pair received(Pair p) {
  round_shape<R>(p.a);
  round_shape<R>(p.b);
  for (Pose* q : {&p.pose_a, &p.pose_b}) {
    const auto s = filtered::rounded_pose<R>(*q);
    q->rotation = {s.x, s.y, s.z, s.w};
    if constexpr (sizeof(R) == sizeof(float)) {
      q->translation = through_float(q->translation);
      q->rotation = {through_float(s.x), through_float(s.y), through_float(s.z), through_float(s.w)};
    }
  }
  return p;
}

struct Count {
  long asked = 0, answered = 0, verdicts = 0, depths = 0, judged = 0;
};

struct Truth {
  double gap, slack, scale, tau;
};

// Checks a value queried in either order; n points from the pair's A to its B.
template <class R>
void check_value(const Width& width, const Truth& t, const filtered::Answer<R>& s, bool swapped) {
  const double bound = static_cast<double>(s.bound), gap = static_cast<double>(s.gap);
  CHECK(bound <= t.tau * (sizeof(R) == sizeof(float) ? 2.02 : 1.01));
  CHECK(std::abs(gap - t.gap) <= bound + t.slack);
  if (s.found == filtered::Found::apart) CHECK(t.gap > 0);
  if (s.found == filtered::Found::meeting) CHECK(t.gap <= 0);
  const V3<R> n = swapped ? V3<R>(-s.normal) : s.normal;
  CHECK(std::abs(static_cast<double>(n.norm()) - 1) <= 16 * filtered::u<R>);
  // w(n) is for the unit vector; the answer's own length is off by a few u.
  CHECK(std::abs(static_cast<double>(width(n.template cast<Wide>())) + gap) <=
        bound + t.slack + 8 * filtered::u<R> * t.scale);
}

// The three questions of (A, B), or of (B, A).
template <class R>
void check_answers(const Pair& p, const Width& width, const Truth& t, bool swapped, Count& count) {
  INFO((swapped ? "B, A" : "A, B"));
  const PlacedShape a = swapped ? p.placed_b() : p.placed_a(), b = swapped ? p.placed_a() : p.placed_b();
  const auto ask = [&](filtered::Asked asked) {
    narrow::FastAnswer<R> f;
    narrow::separate_fast<R>(a, b, asked, f);
    return f.answer;
  };
  const auto says_verdict = [](const filtered::Answer<R>& s) {
    return s.found == filtered::Found::apart || s.found == filtered::Found::meeting;
  };
  if (const auto verdict = ask(filtered::Asked::overlap); says_verdict(verdict)) {
    ++count.verdicts;
    ++count.judged;
    CHECK((verdict.found == filtered::Found::meeting) == (t.gap <= 0));
  }
  if (const auto contact = ask(filtered::Asked::contact); contact.found != filtered::Found::unsure) {
    ++count.judged;
    // Bodies that are apart need no value.
    if (contact.found == filtered::Found::apart)
      CHECK(t.gap > 0);
    else
      check_value<R>(width, t, contact, swapped);
  }
  const auto value = ask(filtered::Asked::distance);
  if (value.found == filtered::Found::unsure) return;
  ++count.answered;
  ++count.judged;
  count.depths += t.gap < 0;
  check_value<R>(width, t, value, swapped);
  CHECK(std::abs(static_cast<double>((value.b - value.a).norm()) -
                 std::abs(static_cast<double>(value.gap))) <= t.tau);
}

template <class R>
void check_pair(const Pair& p, Count& count) {
  const Separation truth = separation(p.placed_a(), p.placed_b());
  if (truth.outcome != Outcome::answered || !(truth.slack <= tolerance::narrow_accept_factor * truth.size))
    return;
  const double scale = scale_of(p);
  const Truth t{static_cast<double>(truth.gap), static_cast<double>(truth.slack), scale,
                tolerance::core_tau_factor * filtered::u<R> * scale};
  const Width width(p.a, p.pose_a, p.b, p.pose_b);
  for (const bool swapped : {false, true}) {
    ++count.asked;
    check_answers<R>(p, width, t, swapped, count);
  }
}

template <class R>
Count sweep(long rounds_a_kind, std::uint64_t seed) {
  Count count;
  for (long i = 0; i < rounds_a_kind; ++i)
    for (int a = 0; a < 7; ++a)
      for (int b = 0; b < 7; ++b)
        for (int regime = 0; regime < regime_count; ++regime) {
          Rng r =
              Rng::stream(seed, static_cast<std::uint64_t>(((i * 7 + a) * 7 + b) * regime_count + regime));
          const Pair p = random_pair(r, static_cast<ShapeKind>(a), static_cast<ShapeKind>(b),
                                     static_cast<Regime>(regime));
          INFO(type_name(p.a) << " " << type_name(p.b) << " "
                              << regime_names[static_cast<std::size_t>(regime)] << " round " << i);
          check_pair<R>(received<R>(p), count);
        }
  return count;
}

// How many cases reached the assertions, printed whether they hold or not.
void report(const Count& c) {
  WARN(c.asked << " asked, " << c.answered << " values, " << c.verdicts << " verdicts, " << c.depths
               << " depths, " << c.judged << " answers judged");
}

}  // namespace

TEST_CASE("in double, a fast answer is within the bound that it states", "[narrow][fast]") {
  const Count c = sweep<double>(rounds(2), seeded(21));
  report(c);
  CHECK(c.answered > c.asked * 9 / 10);
  CHECK(c.verdicts > c.asked / 2);
  CHECK(c.depths > c.answered / 4);
}

TEST_CASE("in float, an answer is within the bound that it states", "[narrow][fast][float]") {
  const Count c = sweep<float>(rounds(2), seeded(22));
  report(c);
  CHECK(c.answered > c.asked * 9 / 10);
  CHECK(c.depths > c.answered / 4);
}

TEST_CASE("a sliver of support points that encloses nothing is not an overlap", "[narrow][fast]") {
  // Found by a run of 90,000 cases: the signs of a tetrahedron 5e-14 thin were noise, and its planes 0.9
  // away.
  Count count;
  for (long round = 60; round < 70; ++round)
    for (const auto& [a, b] : {std::pair{3, 2}, std::pair{2, 3}}) {
      Rng r = Rng::stream(21, static_cast<std::uint64_t>(((round * 7 + a) * 7 + b) * regime_count + 1));
      check_pair<double>(received<double>(random_pair(r, static_cast<ShapeKind>(a), static_cast<ShapeKind>(b),
                                                      Regime::near)),
                         count);
    }
  CHECK(count.verdicts > 10);
}

TEST_CASE("boxes and capsules need no fallback at any angle or depth", "[narrow][fast]") {
  Count in_double, in_float;
  for (int i = 0; i < 400; ++i)
    for (const ShapeKind other : {ShapeKind::box, ShapeKind::capsule}) {
      Rng r = Rng::stream(94, static_cast<std::uint64_t>(2 * i) + (other == ShapeKind::box));
      Pair p{random_shape(r, other, i % 4 == 0), random_shape(r, ShapeKind::capsule, i % 4 == 0), {}, {}};
      p.pose_a.rotation = r.rotation();
      // Parallel to a face, to an edge, or nearly so, half of the time.
      const double tilt = r.chance(0.5) ? 0 : std::ldexp(1.0, -static_cast<int>(r.below(50)));
      const Quat lean{tilt * r.uniform(-1, 1), tilt * r.uniform(-1, 1), 0, 1};
      p.pose_b.rotation =
          r.chance(0.5) ? r.rotation()
                        : p.pose_a.rotation *
                              (r.chance(0.5) ? axis_rotation(r) : Quat{0, r.uniform(-1, 1), 0, 1}) * lean;
      p.pose_b.translation = rotation_matrix(p.pose_a.rotation) *
                             Vec3(r.chance(0.3) ? 0 : r.uniform(-1.2, 1.2), r.uniform(-1.2, 1.2),
                                  r.chance(0.3) ? 0 : r.uniform(-1.2, 1.2));
      INFO(type_name(p.a) << " round " << i);
      check_pair<double>(received<double>(p), in_double);
      check_pair<float>(received<float>(p), in_float);
    }
  report(in_double);
  report(in_float);
  CHECK(in_double.depths * 4 > in_double.asked);
  CHECK(in_double.answered * 100 > in_double.asked * 99);
  CHECK(in_float.answered * 100 > in_float.asked * 99);
}

TEST_CASE("capsules on each other's axis have unit normals and feet that agree with the gap",
          "[narrow][fast][float]") {
  // Found by a run of 300 rounds: feet that coincide within rounding, axes that differ by less.
  Count count;
  for (const long round : {46L, 112L}) {
    Rng r = Rng::stream(22, static_cast<std::uint64_t>(((round * 7 + 2) * 7 + 2) * regime_count + 5));
    check_pair<float>(
        received<float>(random_pair(r, ShapeKind::capsule, ShapeKind::capsule, Regime::coaxial)), count);
  }
  CHECK(count.verdicts > 0);
}

TEST_CASE("spheres whose centres nearly coincide have a unit normal", "[narrow][fast][float]") {
  // Found by a run of 1,000 rounds: the square of their distance underflows.
  Count count;
  Rng r = Rng::stream(22, std::uint64_t{941 * 49} * regime_count + 5);
  check_pair<float>(received<float>(random_pair(r, ShapeKind::sphere, ShapeKind::sphere, Regime::coaxial)),
                    count);
  CHECK(count.verdicts > 0);
}

TEST_CASE("cases that a long run in float found stay correct", "[narrow][fast][float]") {
  // The generator of a cone of slope 0.012 and an edge (kinds 4, 3: a direction to six digits only); discs of
  // radius 3e-13 (kinds 3, 1: squares of areas underflow).
  Count count;
  for (const auto& [round, a, b, regime] : {std::array{1199, 4, 3, 2}, std::array{1411, 3, 1, 5}}) {
    INFO("round " << round);
    Rng r = Rng::stream(22, static_cast<std::uint64_t>(((round * 7 + a) * 7 + b) * regime_count + regime));
    check_pair<float>(received<float>(random_pair(r, static_cast<ShapeKind>(a), static_cast<ShapeKind>(b),
                                                  static_cast<Regime>(regime))),
                      count);
  }
  CHECK(count.asked == 4);
  CHECK(count.judged >= 8);
}

TEST_CASE("a rim that is 1e-14 deep in a box is answered from either side", "[narrow]") {
  const Shape cylinder = Cylinder{0.5335119698586661, 1.1713497465331093};
  const Shape box = Box{Vec3(0.5018618568409898, 1.0446832487049202, 0.32099408757356696)};
  const PlacedShape a{&cylinder,
                      {Vec3(0.0, 0.0, 0.0),
                       {0.4855254900126458, 0.4393965269059434, 0.21392102530980292, 0.7248679090850811}}};
  const PlacedShape b{&box,
                      {Vec3(-1.2849060214318535, 1.784703230124429, 0.658116422118532),
                       {-0.15372466296880344, 0.48699470979105347, 0.2403449542217629, -0.8254932971325654}}};
  for (const ContactAnswer& r : {contact(a, b), contact(b, a)}) {
    REQUIRE(r.outcome == Outcome::answered);
    CHECK(r.overlap);
    CHECK(r.depth == Approx(1.079e-14).epsilon(1e-3).margin(0));
  }
  CHECK(distance(a, b).distance < 0);
  CHECK(overlap(a, b).overlap);
}

TEST_CASE("boxes that touch with an edge have their contact point where they touch",
          "[narrow][fast][float]") {
  // Touching within 2e-12 of 4e-3; in float the patch is empty, and the point was at A's origin.
  const Shape a = Box{Vec3(0.0008378817558754865, 0.0010415040637389214, 0.0009899889049220735)};
  const Shape b = Box{Vec3(0.00045869123321934824, 0.00034670013758641516, 0.0010688537889161842)};
  const Pose at_a{Vec3::Zero(),
                  {-0.5149730109038431, 0.777176754703347, -0.35682440033216756, -0.05895283977038766}};
  const Pose at_b{Vec3(0.0014595390615086033, -0.002460040307083016, 0.00023641745641491782),
                  {-0.6206150032866496, 0.06275553905063276, 0.7043539745934816, 0.3387982268081422}};
  const ContactAnswer r = contact({&a, at_a}, {&b, at_b}, Arithmetic::float32);
  REQUIRE(r.outcome == Outcome::answered);
  REQUIRE(r.overlap);
  REQUIRE(r.manifold.size() == 1);
  const Vec3 where(0.00076295435, -0.00146850060, 0.00016811070);
  CHECK((r.manifold.begin()->position - where).norm() < 1e-9);
}

TEST_CASE("pairs at the ends of float's range are answered like those in its middle",
          "[narrow][fast][float]") {
  Count count;
  for (const double unit : {0x1p-60, 0x1p-30, 0x1p-24, 0x1p-20, 0x1p+28, 0x1p+32, 0x1p+60})
    for (int i = 0; i < 12; ++i)
      for (const auto& [a, b] : {std::pair{3, 3}, std::pair{4, 5}, std::pair{1, 2}, std::pair{6, 6},
                                 std::pair{6, 1}, std::pair{1, 1}, std::pair{2, 4}}) {
        Rng r = Rng::stream(96, static_cast<std::uint64_t>(i * 64 + a * 8 + b));
        Pair p{random_shape(r, static_cast<ShapeKind>(a), false),
               random_shape(r, static_cast<ShapeKind>(b), false),
               {},
               {}};
        p.pose_a.rotation = r.rotation();
        p.pose_b.rotation = r.rotation();
        p.pose_b.translation = r.unit_vector() * r.uniform(0, 3);
        enlarge(p.a, unit);
        enlarge(p.b, unit);
        p.pose_b.translation *= unit;
        INFO(type_name(p.a) << " " << type_name(p.b) << " unit " << unit << " round " << i);
        check_pair<float>(received<float>(p), count);
      }
  report(count);
  CHECK(count.answered > count.asked * 9 / 10);
  CHECK(count.depths > count.answered / 5);
}

TEST_CASE("round bodies with parallel axes need no fallback for their depth, even with rings of minima",
          "[narrow][fast]") {
  // Kinds: sphere 0, capsule 2, cylinder 3, cone 4.
  Count in_double, in_float;
  long cases = 0;
  for (int i = 0; i < 400; ++i)
    for (const auto& [a, b] : {std::pair{3, 3}, std::pair{3, 4}, std::pair{4, 4}, std::pair{2, 3},
                               std::pair{4, 2}, std::pair{0, 3}, std::pair{0, 4}}) {
      Rng r = Rng::stream(93, static_cast<std::uint64_t>(i * 64 + a * 8 + b));
      Pair p{random_shape(r, static_cast<ShapeKind>(a), false),
             random_shape(r, static_cast<ShapeKind>(b), false),
             {},
             {}};
      p.pose_a.rotation = p.pose_b.rotation = r.rotation();
      const Vec3 along = rotation_matrix(p.pose_a.rotation) * Vec3(0, 0, r.uniform(-0.4, 0.4));
      p.pose_b.translation = along + r.unit_vector() * (r.chance(0.5) ? 0 : r.uniform(0, 0.3));
      INFO(type_name(p.a) << " " << type_name(p.b) << " round " << i);
      ++cases;
      check_pair<double>(received<double>(p), in_double);
      check_pair<float>(received<float>(p), in_float);
    }
  report(in_double);
  report(in_float);
  CHECK(in_double.depths * 2 > cases);
  CHECK(in_double.answered * 100 > in_double.asked * 97);
  CHECK(in_float.answered * 100 > in_float.asked * 97);
}

TEST_CASE("a flat box has no face where its corners coincide", "[narrow][manifold]") {
  // A segment, 0.1 deep in the top of a cube; its end is the only contact.
  const Shape segment = Box{{0, 0, 0.5}}, cube = Box{{1, 1, 1}};
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.push_back({i & 1 ? 1. : -1., i & 2 ? 1. : -1., i & 4 ? 1. : -1.});
  const Shape hull = make_hull(corners);
  const Pose above{{0.25, 0, 1.4}, {}};
  for (const Shape* other : {&cube, &hull})
    for (const bool first : {true, false}) {
      const PlacedShape a{&segment, above}, b{other, {}};
      const ContactAnswer c = first ? contact(a, b) : contact(b, a);
      REQUIRE(c.overlap);
      CHECK(c.depth == Approx(0.1));
      REQUIRE_FALSE(c.manifold.empty());
      for (const ContactPoint& p : c.manifold) CHECK((p.position - Vec3(0.25, 0, 0.95)).norm() < 0.06);
    }
}
