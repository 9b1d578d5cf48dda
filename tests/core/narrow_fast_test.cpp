// The fast paths against the extended-precision one, which proves its own slack: an answer that double or
// float gives without help must be within the bound that it states, its verdict must be true, its witnesses
// on the bodies. TOUCHSTONE_NARROW_ROUNDS multiplies the cases of a run by hand.
#include <cstdlib>

#include "core/narrow/pair_table.h"
#include "core/tolerance.h"
#include "tests/core/least_width.h"
#include "tests/core/random_pair.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::test;
namespace fast = touchstone::narrow::fast;

namespace {

long rounds(long usual) {
  const char* text = std::getenv("TOUCHSTONE_NARROW_ROUNDS");
  return text ? usual * std::max(1L, std::atol(text)) : usual;
}

template <class R>
void round_shape(Shape& s) {
  std::visit(
      [](auto& x) {
        for_each_field(x, [](std::string_view, auto& v, Domain) {
          using T = std::remove_reference_t<decltype(v)>;
          if constexpr (std::is_same_v<T, double>) v = static_cast<R>(v);
          if constexpr (std::is_same_v<T, Vec3>) v = v.template cast<R>().template cast<double>();
          if constexpr (std::is_same_v<T, std::vector<Vec3>>)
            for (Vec3& p : v) p = p.cast<R>().template cast<double>();
        });
      },
      s);
}

/// The pair as the arithmetic R receives it.
template <class R>
Pair received(Pair p) {
  round_shape<R>(p.a), round_shape<R>(p.b);
  for (Pose* q : {&p.pose_a, &p.pose_b}) {
    const auto s = fast::stand<R>(*q);
    q->translation = s.t.template cast<double>(), q->rotation = {s.x, s.y, s.z, s.w};
  }
  return p;
}

struct Count {
  long asked = 0, answered = 0, verdicts = 0, depths = 0;
};

template <class R>
void check_pair(const Pair& p, Count& count) {
  const Separation truth = separation(p.placed_a(), p.placed_b());
  if (truth.outcome != Outcome::answered || !(truth.slack <= tolerance::narrow_accept_factor * truth.size))
    return;
  const double gap = static_cast<double>(truth.gap), slack = static_cast<double>(truth.slack);
  const double scale = scale_of(p);
  ++count.asked;
  narrow::FastAnswer<R> verdict, value;
  narrow::separate_fast<R>(p.placed_a(), p.placed_b(), fast::Asked::overlap, verdict);
  if (verdict.answer.found == fast::Found::apart || verdict.answer.found == fast::Found::meeting) {
    ++count.verdicts;
    CHECK((verdict.answer.found == fast::Found::meeting) == (gap <= 0));
  }
  narrow::separate_fast<R>(p.placed_a(), p.placed_b(), fast::Asked::distance, value);
  const fast::Answer<R>& s = value.answer;
  if (s.found == fast::Found::unsure) return;
  ++count.answered;
  count.depths += gap < 0;
  const double bound = static_cast<double>(s.bound), tau = tolerance::core_tau_factor * fast::u<R> * scale;
  CHECK(bound <= tau * (sizeof(R) == sizeof(float) ? 2.02 : 1.01));
  CHECK(std::abs(static_cast<double>(s.gap) - gap) <= bound + slack);
  if (s.found == fast::Found::apart) CHECK(gap > 0);
  if (s.found == fast::Found::meeting) CHECK(gap <= 0);
  const Width width(p.a, p.pose_a, p.b, p.pose_b);
  const V3<R> n = s.normal;
  CHECK(std::abs(static_cast<double>(n.norm()) - 1) <= 16 * fast::u<R>);
  // w(n) is that of the unit vector; the answer's own length is off by a few u.
  CHECK(std::abs(static_cast<double>(width(n.template cast<Wide>())) + static_cast<double>(s.gap)) <=
        bound + slack + 8 * fast::u<R> * scale);
  CHECK(std::abs(static_cast<double>((s.b - s.a).norm()) - std::abs(static_cast<double>(s.gap))) <= tau);
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

// How many cases reached the assertions; said whether they hold or not.
void report(const Count& c) {
  WARN(c.asked << " asked, " << c.answered << " values, " << c.verdicts << " verdicts, " << c.depths
               << " depths");
}

}  // namespace

TEST_CASE("in double, a fast answer is within the bound that it states", "[narrow][fast]") {
  const Count c = sweep<double>(rounds(2), 21);
  report(c);
  CHECK(c.answered > c.asked * 9 / 10);
  CHECK(c.verdicts > c.asked / 2);
  CHECK(c.depths > c.answered / 4);
}

TEST_CASE("in float, an answer is within the bound that it states", "[narrow][fast][float]") {
  const Count c = sweep<float>(rounds(2), 22);
  report(c);
  CHECK(c.answered > c.asked * 9 / 10);
  CHECK(c.depths > c.answered / 4);
}

TEST_CASE("a sliver of support points that encloses nothing is no overlap", "[narrow][fast]") {
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

TEST_CASE("round bodies with parallel axes have their depth without help, rings of minima and all",
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
  report(in_double), report(in_float);
  CHECK(in_double.depths * 2 > cases);
  CHECK(in_double.answered * 100 > in_double.asked * 97);
  CHECK(in_float.answered * 100 > in_float.asked * 97);
}
