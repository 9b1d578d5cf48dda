#include "fuzz/reproduce/other_programs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/input_error.h"
#include "oracles/abi/height_field.h"
#include "oracles/reproducer/source_text.h"

namespace touchstone::fuzz {
namespace {

constexpr std::string_view program = R"(// @TITLE@
// @WORDS@
//
//   npm install @PACKAGE@ && node reproduce.mjs
//
// Exit code 0: the answer is right; 1: it is wrong (other findings are that the engine crashes or never returns). The
// expected result is certain: it was computed in exact arithmetic.
// A: @SHAPE_A@
// B: @SHAPE_B@
@INCLUDES@
const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
const bodies = {
  a: @BODY_A@,
  b: @BODY_B@,
};

// The engine's answer. Normals point from A to B.
@CODE@
@CHECK@
const right = check(await ask());
console.log(right ? "right" : "WRONG");
process.exit(right ? 0 : 1);
)";

constexpr std::string_view check_overlap = R"(function check(x) {
  console.log(`says: ${x.overlap ? "overlap" : "apart"}; expected: ${@VALUE@ ? "overlap" : "apart"}`);
  return x.overlap === @VALUE@;
}
)";

constexpr std::string_view check_distance =
    R"(// The signed distance is certainly within [@LO@, @HI@]; the check adds the engine's tolerance.
function check(x) {
  console.log(`says: distance ${x.distance}; expected: within [@LO@, @HI@], tolerance @TAU@`);
  return x.distance >= @LO@ - @TAU@ && x.distance <= @HI@ + @TAU@;
}
)";

constexpr std::string_view check_contact =
    R"(// A point of the body farthest along the direction d, in the frame of the world.
function support({ shape, rows, at }, d) {
  const [x, y, z] = [0, 1, 2].map((k) => rows[0][k] * d[0] + rows[1][k] * d[1] + rows[2][k] * d[2]);
  const along = (h, c) => (c < 0 ? -h : h);
  const ball = (r, v) => v.map((c) => (Math.hypot(...v) > 0 ? (r * c) / Math.hypot(...v) : 0));
  const p = {
    sphere: () => ball(shape.radius, [x, y, z]),
    box: () => [x, y, z].map((c, k) => along(shape.half_extents[k], c)),
    capsule: () => ball(shape.radius, [x, y, z]).map((c, k) => (k === 2 ? c + along(shape.half_height, z) : c)),
    cylinder: () => [...ball(shape.radius, [x, y]), along(shape.half_height, z)],
    cone: () => (shape.half_height * z * 2 > shape.radius * Math.hypot(x, y) ? [0, 0, shape.half_height]
      : [...ball(shape.radius, [x, y]), -shape.half_height]),
    ellipsoid: () => ball(1, [x, y, z].map((c, k) => c * shape.semi_axes[k])).map((c, k) => c * shape.semi_axes[k]),
    hull: () => shape.vertices.reduce((best, v) => (dot(v, [x, y, z]) > dot(best, [x, y, z]) ? v : best)),
  }[shape.type]();
  return rows.map((row, k) => dot(row, p) + at[k]);
}
// Moving B by width(n) along n separates the bodies; moving it by less does not. So a depth with normal n must equal
// width(n), and width(n) must be the minimum over n, which is certainly within [@LO@, @HI@].
const width = (n) => dot(n, support(bodies.a, n)) - dot(n, support(bodies.b, n.map((c) => -c)));
function check(x) {
  console.log(`says: ${x.overlap ? "overlap" : "apart"}, depth ${x.depth}, normal ${x.normal}`);
  console.log("expected: overlap, least depth within [@LO@, @HI@], tolerance @TAU@");
  if (!x.overlap) return false;
  const w = width(x.normal);
  console.log(`the reported normal needs a depth of ${w}`);
  return Math.abs(Math.hypot(...x.normal) - 1) <= 1e-4 && w <= @HI@ + @TAU@@DEPTH@;
}
)";

constexpr std::string_view check_impact =
    R"(// The first contact is certainly within [@LO@, @HI@] of the step.
function check(x) {
  console.log(`says: impact at ${x.impact} (null: none); expected: within [@LO@, @HI@], slack @SLACK@`);
  return x.impact !== null && x.impact >= @LO@ - @SLACK@ && x.impact <= @HI@ + @SLACK@;
}
)";
constexpr std::string_view check_no_impact = R"(function check(x) {
  console.log(`says: impact at ${x.impact} (null: none); expected: no impact in the step`);
  return x.impact === null;
}
)";

// Error assumed for an impact that was not reported; half of it is the slack of the check.
constexpr double error_of_missing_impact = 0.02;

[[noreturn]] std::string no_mesh() {
  throw InputError("reproduce", "no program with this mesh is written for this engine");
}

struct ShapeText {
  std::string operator()(const Hull& s) const {
    std::string list;
    for (const Vec3& v : s.vertices) list += (list.empty() ? "" : ", ") + js_array(v);
    return fmt::format("{{ type: \"hull\", vertices: [{}] }}", list);
  }
  std::string operator()(const Padded<Hull>& s) const { return (*this)(s.inner); }
  std::string operator()(const TriangleMesh& m) const {
    const auto field = kit::height_field_of(m);
    std::string list, triangles;
    for (const Vec3& v : m.vertices)
      list += (list.empty() ? "" : ", ") + (field ? fmt::format("{}", v.z()) : js_array(v));
    if (field)
      return fmt::format("{{ type: \"field\", rows: {}, columns: {}, cell: [{}, {}], heights: [{}] }}",
                         field->rows, field->columns, field->cell[0], field->cell[1], list);
    for (const auto& t : m.triangles)
      triangles += fmt::format("{}[{}, {}, {}]", triangles.empty() ? "" : ", ", t[0], t[1], t[2]);
    return fmt::format("{{ type: \"mesh\", vertices: [{}], triangles: [{}] }}", list, triangles);
  }
  std::string operator()(const SolidMesh&) const { return no_mesh(); }
  template <class S>
  std::string operator()(const S& s) const {
    std::string out = fmt::format("{{ type: \"{}\"", S::type);
    for_each_field(s, [&](std::string_view name, const auto& v, Domain) {
      if constexpr (std::is_same_v<std::decay_t<decltype(v)>, double>)
        out += fmt::format(", {}: {}", name, v);
      else
        out += fmt::format(", {}: {}", name, js_array(v));
    });
    return out + " }";
  }
};

std::string body_text(const EngineQuestion& q, int i) {
  const Pose& p = q.body(i).pose;
  const Mat3 r = rotation_matrix(p.rotation);
  return fmt::format(
      "{{ shape: {},\n    at: {}, quaternion: [{}, {}, {}, {}],  // x, y, z, w\n    rows: [{}, {}, {}] }}",
      std::visit(ShapeText{}, q.scene.shape_of(i)), js_array(p.translation), p.rotation.x, p.rotation.y,
      p.rotation.z, p.rotation.w, js_array(r.row(0)), js_array(r.row(1)), js_array(r.row(2)));
}

bool is_about_a_point(const std::string& fault) {
  return fault == to_string(Fault::point_off) || fault == to_string(Fault::point_depth) ||
         fault == to_string(Fault::witness_off);
}

std::string contact_check(const Finding& finding, const EngineQuestion& q, const referee::PairTruth& t,
                          double tau) {
  if (!std::isfinite(t.gap.lo) || !has_support(q.scene.shape_of(q.a)) || !has_support(q.scene.shape_of(q.b)))
    throw InputError("reproduce", "no program checks this fault for this pair: " + finding.key());
  const std::string tolerance = fmt::format("{}", tau);
  return filled(check_contact, {{"LO", fmt::format("{}", -t.gap.hi)},
                                {"HI", fmt::format("{}", -t.gap.lo)},
                                {"DEPTH", finding.evidence->observation.depth
                                              ? fmt::format(" && Math.abs(x.depth - w) <= {}", tolerance)
                                              : ""},
                                {"TAU", tolerance}});
}

std::string impact_check(const Finding& finding, const EngineQuestion& q, Truth& truth) {
  const auto& t = truth.motion(0, q.a, q.b);
  if (t.verdict == referee::TimeTruth::Verdict::none) return std::string(check_no_impact);
  const auto& toi = finding.evidence->observation.toi;
  const double off = !toi ? error_of_missing_impact : std::max(t.t_lo - *toi, *toi - t.t_hi);
  return filled(check_impact, {{"LO", fmt::format("{}", t.t_lo)},
                               {"HI", fmt::format("{}", t.t_hi)},
                               {"SLACK", fmt::format("{}", std::max(off, 0.0) / 2)}});
}

// Engines from npm cast shapes along a line.
void require_straight(const EngineQuestion& q) {
  for (const int i : {q.a, q.b})
    if (q.body(i).motion && !q.body(i).motion->angular.isZero(0))
      throw InputError("reproduce", "no program in JavaScript is written for bodies that turn");
}

std::string check_of(const Finding& finding, const EngineQuestion& q, Truth& truth, double tau) {
  if (is_about_a_point(finding.fault))
    throw InputError("reproduce", "no program in JavaScript checks this fault: " + finding.key());
  if (q.question == Question::candidates)
    throw InputError("reproduce", "no program in JavaScript is written for broad phases");
  if (q.question == Question::time_of_impact) {
    require_straight(q);
    return impact_check(finding, q, truth);
  }
  const auto& t = truth.pair(0, q.a, q.b);
  if (q.question == Question::distance)
    return filled(check_distance, {{"LO", fmt::format("{}", t.gap.lo)},
                                   {"HI", fmt::format("{}", t.gap.hi)},
                                   {"TAU", fmt::format("{}", tau)}});
  const bool overlaps = t.verdict == referee::Verdict::overlap;
  const bool verdict_alone =
      finding.fault == to_string(Fault::missed) || finding.fault == to_string(Fault::ghost);
  if (q.question == Question::overlap || verdict_alone || !overlaps)
    return filled(check_overlap, {{"VALUE", overlaps ? "true" : "false"}});
  return contact_check(finding, q, t, tau);
}

}  // namespace

std::string javascript_program(const Finding& finding, const EngineCard& card, const EngineQuestion& q,
                               const EngineSource& source, Truth& truth, double tau) {
  for (const int i : {q.a, q.b})
    if (is_mesh(q.scene.shape_of(i)) && !source.makes_meshes) no_mesh();
  return filled(
      program,
      {{"TITLE", fmt::format("{} {} ({}): {}", card.library, card.version, finding.engine, finding.key())},
       {"WORDS", finding.words},
       {"PACKAGE", fmt::format("{}@{}", source.npm_package, card.version)},
       {"SHAPE_A", describe(q.scene.shape_of(q.a))},
       {"SHAPE_B", describe(q.scene.shape_of(q.b))},
       {"INCLUDES", source.includes},
       {"BODY_A", body_text(q, q.a)},
       {"BODY_B", body_text(q, q.b)},
       {"CODE", source.code},
       {"CHECK", check_of(finding, q, truth, tau)}});
}

}  // namespace touchstone::fuzz
