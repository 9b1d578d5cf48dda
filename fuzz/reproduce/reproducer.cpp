#include "fuzz/reproduce/reproducer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/input_error.h"
#include "fuzz/judge/relation.h"
#include "fuzz/judge/truth.h"
#include "fuzz/reproduce/other_programs.h"
#include "oracles/reproducer/engine_source.h"
#include "oracles/reproducer/source_text.h"

namespace touchstone::fuzz {
namespace {

constexpr std::string_view program = R"(// @TITLE@
// @WORDS@
//
//   g++ -std=c++17 reproduce.cpp -o reproduce @COMPILE@ && ./reproduce
//
// Exit code 0: the answer is right; 1: it is wrong (other findings are that the engine crashes or never returns). The
// expected result is certain: it was computed in exact arithmetic.
// A: @SHAPE_A@
// B: @SHAPE_B@
@INCLUDES@
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <utility>
#include <vector>

namespace {

using Vec = std::array<double, 3>;

[[maybe_unused]] double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
[[maybe_unused]] Vec scaled(double s, const Vec& a) { return {s * a[0], s * a[1], s * a[2]}; }

struct Placement {
  double rotation[9];  // by rows
  Vec translation;
};
[[maybe_unused]] Vec to_world(const Placement& t, const Vec& p) {
  const double* r = t.rotation;
  return {r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + t.translation[0],
          r[3] * p[0] + r[4] * p[1] + r[5] * p[2] + t.translation[1],
          r[6] * p[0] + r[7] * p[1] + r[8] * p[2] + t.translation[2]};
}
[[maybe_unused]] Vec to_local(const Placement& t, const Vec& d) {
  const double* r = t.rotation;
  return {r[0] * d[0] + r[3] * d[1] + r[6] * d[2], r[1] * d[0] + r[4] * d[1] + r[7] * d[2],
          r[2] * d[0] + r[5] * d[1] + r[8] * d[2]};
}

@SUPPORT@// The engine's answer. Normals point from A to B.
struct Answer {
  bool overlap = false, hit = false;  // hit: the engine reports an impact, at the time `impact`
  double distance = INFINITY, depth = -INFINITY, impact = NAN;
  Vec normal{}, on_a{}, on_b{};
  std::vector<Vec> points;
};

@CODE@
@CHECK@
}  // namespace

int main() {
  try {
    const bool right = check(ask());
    std::puts(right ? "right" : "WRONG");
    return right ? 0 : 1;
  } catch (const std::exception& e) {
    std::printf("WRONG: threw: %s\n", e.what());
    return 1;
  }
}
)";

constexpr std::string_view check_verdict = R"(bool check(const Answer& x) {
  std::printf("says: %s\nexpected: %s\n", x.overlap ? "@YES@" : "@NO@", "@EXPECTED@");
  return x.overlap == @VALUE@;
}
)";

constexpr std::string_view check_distance =
    R"(// The signed distance is certainly within [@LO@, @HI@]; the check adds the engine's tolerance.
bool check(const Answer& x) {
  std::printf("says: distance %.17g\nexpected: within [%.17g, %.17g], tolerance %g\n", x.distance, @LO@, @HI@,
              @TAU@);
  return x.distance >= @LO@ - @TAU@ && x.distance <= @HI@ + @TAU@;
}
)";

constexpr std::string_view check_contact =
    R"(// Moving B by width(n) along n separates the bodies; moving it by less does not. So a depth with normal n must
// equal width(n), and width(n) must be the minimum over n, which is certainly within [@LO@, @HI@].
double width(const Vec& n) { return dot(n, support_a(n)) - dot(n, support_b(scaled(-1, n))); }

bool check(const Answer& x) {
  std::printf("says: %s, depth %.17g, normal (%.17g, %.17g, %.17g)\n", x.overlap ? "overlap" : "apart", x.depth,
              x.normal[0], x.normal[1], x.normal[2]);
  std::printf("expected: overlap, depth within [%.17g, %.17g], tolerance %g\n", @LO@, @HI@, @TAU@);
  if (!x.overlap) return false;
  const double length = std::sqrt(dot(x.normal, x.normal));
  if (!(std::fabs(length - 1) <= 1e-6)) {
    std::printf("the normal has length %.17g\n", length);
    return false;
  }
  const double w = width(x.normal);
  std::printf("the reported normal needs a depth of %.17g\n", w);
@POINTS@  return std::fabs(x.depth - w) <= @TAU@ && w <= @HI@ + @TAU@;
}
)";

constexpr std::string_view check_depth_alone = R"(bool check(const Answer& x) {
  std::printf("says: %s, depth %.17g\nexpected: overlap, depth within [%.17g, %.17g], tolerance %g\n",
              x.overlap ? "overlap" : "apart", x.depth, @LO@, @HI@, @TAU@);
  return x.overlap && x.depth >= @LO@ - @TAU@ && x.depth <= @HI@ + @TAU@;
}
)";

constexpr std::string_view check_points =
    R"(  // No point of the manifold may be farther than the depth from either body. One was, along these directions.
  for (const Vec& p : x.points)
    for (const Vec& u : {@DIRECTIONS@}) {
      const double depth = std::fmax(0, x.depth);
      for (const double out : {dot(u, p) - dot(u, support_a(u)), dot(u, p) - dot(u, support_b(u))})
        if (!(out - depth <= @TAU@)) {
          std::printf("a point is %.17g farther out than the depth\n", out - depth);
          return false;
        }
    }
)";

constexpr std::string_view check_witness =
    R"(// The points must lie on the bodies, and their distance must be that of the bodies: within [@LO@, @HI@].
bool check(const Answer& x) {
  const Vec p = @P@, q = @Q@;
  const double apart = std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
  std::printf("says: (%.17g, %.17g, %.17g) and (%.17g, %.17g, %.17g), %.17g apart\n", p[0], p[1], p[2], q[0], q[1],
              q[2], apart);
  std::printf("expected: %.17g to %.17g apart, tolerance %g\n", @LO@, @HI@, @TAU@);
  for (const Vec& u : {@DIRECTIONS@})
    if (!(dot(u, p) - dot(u, support_a(u)) <= @TAU@) || !(dot(u, q) - dot(u, support_b(u)) <= @TAU@)) {
      std::puts("a point is off its body");
      return false;
    }
  return apart >= @LO@ - @TAU@ && apart <= @HI@ + @TAU@;
}
)";

// An impact at a time that is no number is an impact, and wrong.
constexpr std::string_view print_impact = R"(void print_impact(const Answer& x) {
  if (x.hit)
    std::printf("says: impact at %.17g\n", x.impact);
  else
    std::puts("says: no impact");
}
)";
constexpr std::string_view check_impact =
    R"(// The first contact is certainly within [@LO@, @HI@] of the step; the slack is half of the recorded error.
bool check(const Answer& x) {
  print_impact(x);
  std::printf("expected: impact within [%.17g, %.17g], slack %g\n", @LO@, @HI@, @SLACK@);
  return x.hit && x.impact >= @LO@ - @SLACK@ && x.impact <= @HI@ + @SLACK@;
}
)";
constexpr std::string_view check_no_impact = R"(bool check(const Answer& x) {
  print_impact(x);
  std::puts("expected: no impact in the step");
  return !x.hit;
}
)";

// Step of the difference quotient, relative to the distance: small, but far above rounding.
constexpr double difference_step = 1e-3;
// Error assumed for an impact that was not reported, or not as a number; half of it is the slack of the
// check.
constexpr double error_of_missing_impact = 0.02;

struct ExpectedAnswer {
  Truth& truth;
  const EngineQuestion& q;
  const Finding& finding;
  double tau;
  std::string_view point_a = "", point_b = "";  // of a distance, in the program
};

std::string verdict(std::string_view yes, std::string_view no, bool expected) {
  return filled(check_verdict, {{"YES", std::string(yes)},
                                {"NO", std::string(no)},
                                {"EXPECTED", std::string(expected ? yes : no)},
                                {"VALUE", expected ? "true" : "false"}});
}

// Appends the direction from the body to a point outside it: the gradient of the distance, by central
// differences.
void add_direction(std::string& list, Truth& truth, int body, const Vec3& p) {
  const double d = truth.distance_to(0, body, p).lo, h = d * difference_step;
  if (!(d > 0) || !std::isfinite(d)) return;
  Vec3 u = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    Vec3 e = Vec3::Zero();
    e[k] = h;
    u[k] = truth.distance_to(0, body, p + e).lo - truth.distance_to(0, body, p - e).lo;
  }
  if (u.norm() > 0)
    list += fmt::format("{}Vec{{{}}}", list.empty() ? "" : ", ", literals(Vec3(u.normalized())));
}

std::string contact_check(const ExpectedAnswer& e) {
  const auto& t = e.truth.pair(0, e.q.a, e.q.b);
  const std::string lo = literal(-t.gap.hi), hi = literal(-t.gap.lo), tau = literal(e.tau);
  if (!has_support(e.q.scene.shape_of(e.q.a)) || !has_support(e.q.scene.shape_of(e.q.b)))
    return filled(check_depth_alone, {{"LO", lo}, {"HI", hi}, {"TAU", tau}});
  std::string directions;
  if (e.finding.fault == to_string(Fault::point_off))
    for (const ManifoldPoint& p : e.finding.evidence->observation.manifold) {
      add_direction(directions, e.truth, e.q.a, p.position);
      add_direction(directions, e.truth, e.q.b, p.position);
    }
  const std::string points =
      directions.empty() ? "" : filled(check_points, {{"DIRECTIONS", directions}, {"TAU", tau}});
  return filled(check_contact, {{"POINTS", points}, {"LO", lo}, {"HI", hi}, {"TAU", tau}});
}

std::string witness_check(const ExpectedAnswer& e) {
  const auto& t = e.truth.pair(0, e.q.a, e.q.b);
  const auto& w = *e.finding.evidence->observation.witness;
  std::string directions;
  add_direction(directions, e.truth, e.q.a, w[0]);
  add_direction(directions, e.truth, e.q.b, w[1]);
  if (directions.empty()) directions = "Vec{1, 0, 0}";
  const bool inside = t.gap.hi < 0;
  return filled(check_witness, {{"LO", literal(inside ? -t.gap.hi : std::max(0.0, t.gap.lo))},
                                {"HI", literal(inside ? -t.gap.lo : std::max(0.0, t.gap.hi))},
                                {"TAU", literal(e.tau)},
                                {"P", std::string(e.point_a)},
                                {"Q", std::string(e.point_b)},
                                {"DIRECTIONS", directions}});
}

std::string impact_check(const ExpectedAnswer& e) {
  using V = referee::TimeTruth::Verdict;
  const auto& t = e.truth.motion(0, e.q.a, e.q.b);
  if (t.verdict == V::none) return std::string(print_impact) + std::string(check_no_impact);
  const auto& toi = e.finding.evidence->observation.toi;
  const double off = !toi || !std::isfinite(*toi) ? error_of_missing_impact
                     : *toi < t.t_lo              ? t.t_lo - *toi
                                                  : *toi - t.t_hi;
  return filled(
      std::string(print_impact) + std::string(check_impact),
      {{"LO", literal(t.t_lo)}, {"HI", literal(t.t_hi)}, {"SLACK", literal(std::max(off, 0.0) / 2)}});
}

std::string pair_check(const ExpectedAnswer& e) {
  const auto& t = e.truth.pair(0, e.q.a, e.q.b);
  const bool overlaps = t.verdict == referee::Verdict::overlap;
  const bool has_depth = overlaps && std::isfinite(t.gap.lo);
  const bool contact = e.q.question == Question::contact || e.q.question == Question::scene_contacts;
  const std::string& fault = e.finding.fault;
  const bool verdict_alone = fault == to_string(Fault::missed) || fault == to_string(Fault::ghost);
  if (contact && (fault == to_string(Fault::point_depth) || (!has_depth && !verdict_alone)))
    throw InputError("reproduce",
                     "there is no program that checks this fault for this pair: " + e.finding.key());
  if (contact && has_depth) return contact_check(e);
  if (e.q.question == Question::distance && e.finding.fault == to_string(Fault::witness_off) &&
      e.finding.evidence->observation.witness && has_support(e.q.scene.shape_of(e.q.a)) &&
      has_support(e.q.scene.shape_of(e.q.b)))
    return witness_check(e);
  if (e.q.question == Question::distance)
    return filled(check_distance,
                  {{"LO", literal(t.gap.lo)}, {"HI", literal(t.gap.hi)}, {"TAU", literal(e.tau)}});
  return verdict("overlap", "apart", overlaps);
}

std::string check_of(const ExpectedAnswer& e) {
  if (e.q.question == Question::candidates)
    return verdict("the pair is reported", "the pair is not reported",
                   e.finding.fault == to_string(Fault::missed));
  if (e.q.question == Question::time_of_impact) return impact_check(e);
  return pair_check(e);
}

std::string expected_words(const ExpectedAnswer& e) {
  using V = referee::TimeTruth::Verdict;
  if (e.q.question == Question::candidates)
    return fmt::format("at query {} the pair ({}, {}) {}", e.q.step, e.q.a, e.q.b,
                       e.finding.fault == to_string(Fault::missed) ? "is reported" : "is not reported");
  if (e.q.question == Question::time_of_impact) {
    const auto& t = e.truth.motion(0, e.q.a, e.q.b);
    if (t.verdict == V::none) return "no impact";
    return fmt::format("an impact within [{}, {}] of the step; the gap there is at most {}", t.t_lo, t.t_hi,
                       e.tau);
  }
  const auto& t = e.truth.pair(0, e.q.a, e.q.b);
  const std::string verdict = t.verdict == referee::Verdict::overlap ? "overlap" : "apart";
  if (e.q.question == Question::overlap || !std::isfinite(t.gap.lo)) return verdict;
  return fmt::format("{}, signed distance within [{}, {}], tolerance {}", verdict, t.gap.lo, t.gap.hi, e.tau);
}

bool stands_for(std::string_view name, std::string_view engine) {
  return name.ends_with('-') ? engine.starts_with(name) : engine == name;
}

const SourceWriter* writer_of(std::string_view engine) {
  static const std::vector<SourceWriter> all = source_writers();
  const auto writes = [&](const SourceWriter& w) {
    return std::ranges::any_of(w.engines, [&](std::string_view name) { return stands_for(name, engine); });
  };
  const auto found = std::ranges::find_if(all, writes);
  return found == all.end() ? nullptr : &*found;
}

EngineSource source_of(const EngineQuestion& q) {
  if (const SourceWriter* writer = writer_of(q.engine)) return writer->write(q);
  std::string names;
  for (const SourceWriter& w : source_writers())
    for (const std::string_view name : w.engines)
      names += fmt::format("{}{}{}", names.empty() ? "" : ", ", name, name.ends_with('-') ? "*" : "");
  throw InputError("reproduce", fmt::format("is not available for {}, only for {}", q.engine, names));
}

}  // namespace

bool has_reproducer(std::string_view engine) { return writer_of(engine) != nullptr; }

namespace {

/// The question that the finding is about. Throws InputError if no program can ask it.
EngineQuestion question_of(const Finding& finding) {
  const Evidence& v = *finding.evidence;
  if (is_relation(finding.fault))
    throw InputError("reproduce",
                     "a relation compares two scenes; use `touchstone replay` instead: " + finding.key());
  if (v.question >= Question::swept_candidates)
    throw InputError("reproduce", fmt::format("does not support {}; use `touchstone replay` instead: {}",
                                              to_string(v.question), finding.key()));
  const int n = static_cast<int>(v.c.scene.bodies.size());
  if (v.a < 0 || v.b < 0 || v.a >= n || v.b >= n)
    throw InputError("reproduce", "the finding is not about a pair of bodies: " + finding.key());
  return {v.c.scene, v.question, v.a, v.b, v.step, finding.engine};
}

std::string program_of(const Finding& finding, const EngineCard& card, const EngineQuestion& q,
                       const EngineSource& source) {
  const Evidence& v = *finding.evidence;
  Truth truth(v.c.scene);
  const double tau = tau_of(card, v.observation, v.c.scene, v.a, v.b, truth.scale(v.a, v.b));
  if (!source.npm_package.empty()) return javascript_program(finding, card, q, source, truth, tau);
  const ExpectedAnswer expected{truth, q, finding, tau, source.point_a, source.point_b};
  const std::string check = check_of(expected);
  const auto support_of = [&](std::string_view who, int body) {
    const std::string call = fmt::format("support_{}(", who);
    const bool used = source.code.find(call) != std::string::npos || check.find(call) != std::string::npos;
    return used ? support_function(who, v.c.scene.shape_of(body),
                                   v.c.scene.bodies[static_cast<std::size_t>(body)].pose)
                : std::string();
  };
  return filled(
      program,
      {{"TITLE", fmt::format("{} {} ({}): {}", card.library, card.version, finding.engine, finding.key())},
       {"WORDS", finding.words},
       {"COMPILE", source.compile},
       {"SHAPE_A", describe(v.c.scene.shape_of(v.a))},
       {"SHAPE_B", describe(v.c.scene.shape_of(v.b))},
       {"INCLUDES", source.includes},
       {"SUPPORT", support_of("a", v.a) + support_of("b", v.b)},
       {"CODE", source.code},
       {"CHECK", check}});
}

}  // namespace

std::string reproducer(const Finding& finding, const EngineCard& card) {
  const EngineQuestion q = question_of(finding);
  return program_of(finding, card, q, source_of(q));
}

std::string plugin_reproducer(const Finding& finding, const EngineCard& card, const PluginFile& plugin) {
  const EngineQuestion q = question_of(finding);
  return program_of(finding, card, q, plugin_source(q, plugin));
}

std::string pipe_reproducer(const Finding& finding, const EngineCard& card) {
  const EngineQuestion q = question_of(finding);
  Truth truth(q.scene);
  const double tau = tau_of(card, finding.evidence->observation, q.scene, q.a, q.b, truth.scale(q.a, q.b));
  return pipe_lines(q, expected_words({truth, q, finding, tau}));
}

}  // namespace touchstone::fuzz
