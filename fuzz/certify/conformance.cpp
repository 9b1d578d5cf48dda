#include "fuzz/certify/conformance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "scenarios/exhaustive/box_scene.h"
#include "scenarios/value/height_surface.h"

namespace touchstone::fuzz {
namespace {

// Far above float rounding errors at this scale, and above usual collision margins.
constexpr double slack = 0.1;
constexpr double least_normal_x = 0.9;  // accepts a normal within 26° of x

struct Probe {
  std::string name;
  Case c;
  /// Describes the wrong answer; empty if it is right.
  std::function<std::string(const Observation&)> complaint;
  std::string hint;
};

struct Placed {
  Shape shape;
  Vec3 t;
  Quat q = {};
};

Case pair_case(Question q, const Placed& a, const Placed& b) {
  Case c;
  for (const Placed* p : {&a, &b}) {
    Body body;
    body.shape = static_cast<int>(c.scene.shapes.size());
    body.pose = {p->t, p->q};
    c.scene.shapes.push_back(p->shape);
    c.scene.bodies.push_back(std::move(body));
  }
  c.queries = {{q, 0, 1}};
  return c;
}

std::string yes_or_no(bool b) { return b ? "overlapping" : "apart"; }

Probe overlap_probe(std::string name, const Placed& a, const Placed& b, bool truth, std::string hint) {
  return {std::move(name), pair_case(Question::overlap, a, b),
          [truth](const Observation& o) -> std::string {
            if (!o.overlap) return "answers without stating whether the bodies overlap";
            return *o.overlap == truth ? ""
                                       : fmt::format("reports {}, but the bodies are {}",
                                                     yes_or_no(*o.overlap), yes_or_no(truth));
          },
          std::move(hint)};
}

std::string expect(const char* what, const std::optional<double>& x, double truth) {
  if (!x) return fmt::format("does not state the {}", what);
  if (std::abs(*x - truth) <= slack) return "";
  return fmt::format("reports a {} of {:.6g} instead of {:.6g}", what, *x, truth);
}

void overlap_probes(std::vector<Probe>& all) {
  const Placed ball{Sphere{1}, Vec3::Zero()}, box{Box{Vec3(1, 2, 3)}, Vec3::Zero()};
  const Placed rod{Capsule{0.5, 2}, Vec3::Zero()}, small{Sphere{0.25}, Vec3::Zero()};
  const auto at = [](Placed p, double x, double y, double z) {
    p.t = {x, y, z};
    return p;
  };
  all.push_back(
      overlap_probe("two spheres apart", ball, at(ball, 2.5, 0, 0), false, "size[0] is the radius"));
  all.push_back(
      overlap_probe("two spheres that overlap", ball, at(ball, 1.5, 0, 0), true, "size[0] is the radius"));
  all.push_back(overlap_probe("boxes take half extents", box, at(small, 0.8, 1.8, 2.8), true,
                              "size[0..2] are half extents, not whole sides"));
  all.push_back(overlap_probe("boxes take no more than half extents", box, at(small, 1.5, 0, 0), false,
                              "size[0..2] are half extents: a box of half extents 1, 2, 3 ends at x = 1"));
  all.push_back(overlap_probe("capsules stand along z", rod, at(small, 0, 0, 2.5), true,
                              "the axis is z; size[1] is half the height of the segment, without the caps"));
  all.push_back(
      overlap_probe("capsules do not lie along y", rod, at(small, 0, 2.5, 0), false, "the axis is z"));
  const Placed can{Cylinder{0.5, 2}, Vec3::Zero()}, hat{Cone{1, 1}, Vec3::Zero()};
  all.push_back(overlap_probe("cylinders stand along z", can, at(small, 0.6, 0, 1.9), true,
                              "the axis is z; size[1] is half the height"));
  all.push_back(overlap_probe("cones have their apex up", hat, at(small, 0.8, 0, 0.9), false,
                              "the axis is z, the apex at +size[1], the base at -size[1]"));
  all.push_back(overlap_probe("cones have their base down", hat, at(small, 0.9, 0, -0.9), true,
                              "the axis is z, the apex at +size[1], the base at -size[1]"));
  const Placed corner{make_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), Vec3(1, 0, 0)};
  all.push_back(overlap_probe("hulls are where their vertices are", corner, at(small, 1.9, 0, 0), true,
                              "vertices are relative to the body's origin, which may be anywhere"));
  all.push_back(overlap_probe("hulls are not recentred", corner, at(small, 0.5, 0.1, 0.1), false,
                              "vertices are relative to the body's origin, which may be anywhere"));
  const Placed ground{HalfSpace{Vec3(0, 0, 2), 1}, Vec3::Zero()};
  all.push_back(overlap_probe("half-spaces are solid below", ground, at(small, 3, 4, 0.65), true,
                              "solid where n.x <= d: size[0..2] is n of any length, size[3] is d"));
  all.push_back(overlap_probe("half-spaces end where n.x = d", ground, at(small, 3, 4, 0.9), false,
                              "solid where n.x <= d: here n is (0, 0, 2) and d is 1"));
  // Flat but for one point, at (-0.5, 2, 1.5).
  const Placed field{centred_height_surface(3, 4, 1, 2,
                                            [](std::size_t row, std::size_t column) {
                                              return row == 2 && column == 1 ? 1.5 : 0.0;
                                            }),
                     Vec3::Zero()};
  all.push_back(overlap_probe("meshes that are height fields", field, at(small, -0.5, 2, 1.4), true,
                              "vertices row by row, columns along +x, rows along +y, heights along z"));
  all.push_back(overlap_probe("height fields are not mirrored", field, at(small, -0.5, -2, 1), false,
                              "vertices row by row, columns along +x, rows along +y"));
  all.push_back(
      overlap_probe("cells of height fields are divided as their triangles say", field, at(small, 0, 1, 0.75),
                    false, "the diagonal leads from a cell's corner of least x and y to the opposite one"));
  Placed turned = box;
  turned.shape = Box{Vec3(3, 0.1, 0.1)};
  turned.q = {0, 0, 1, 1};
  all.push_back(
      overlap_probe("quaternions are x, y, z, w, of any length", turned, at(small, 0, 2.8, 0), true,
                    "rotation[3] is w; normalise it: here it is (0, 0, 1, 1), a quarter turn about z"));
}

void number_probes(std::vector<Probe>& all) {
  const Placed a{Sphere{1}, Vec3::Zero()}, apart{Sphere{1}, Vec3(3, 0, 0)}, deep{Sphere{1}, Vec3(1.5, 0, 0)};
  all.push_back({"distance of two spheres apart", pair_case(Question::distance, a, apart),
                 [](const Observation& o) { return expect("distance", o.distance, 1); },
                 "between the surfaces"});
  all.push_back({"distance of two spheres that overlap", pair_case(Question::distance, a, deep),
                 [](const Observation& o) {
                   if (!o.distance && o.overlap.value_or(false)) return std::string();
                   return o.distance && *o.distance <= slack ? "" : expect("distance", o.distance, -0.5);
                 },
                 "negative: minus the depth; or the overlap alone; or unsupported"});
  all.push_back({"normal from A to B", pair_case(Question::contact, a, deep),
                 [](const Observation& o) -> std::string {
                   if (!o.normal) return "does not state the normal of an overlap";
                   if (std::abs(o.normal->norm() - 1) > slack) return "states a normal whose length is not 1";
                   return o.normal->x() > least_normal_x
                              ? ""
                              : fmt::format(
                                    "reports a normal of ({:.3g}, {:.3g}, {:.3g}) instead of (1, 0, 0)",
                                    o.normal->x(), o.normal->y(), o.normal->z());
                 },
                 "B moves along +normal to separate; engines often give the opposite"});
  all.push_back({"depth of an overlap", pair_case(Question::contact, a, deep),
                 [](const Observation& o) { return expect("depth", o.depth, 0.5); }, "positive"});
  Case moving = pair_case(Question::time_of_impact, a, Placed{Sphere{1}, Vec3(4, 0, 0)});
  moving.scene.bodies[1].motion = Motion{Vec3(-4, 0, 0), Vec3::Zero()};
  all.push_back({"time of impact", moving,
                 [](const Observation& o) { return expect("time of impact", o.toi, 0.5); },
                 "linear is the displacement over the whole step; t runs from 0 to 1"});
}

std::string list_text(const std::vector<BodyPair>& pairs) {
  std::string s = "{";
  for (const auto& [a, b] : pairs) s += fmt::format("{}({}, {})", s.size() > 1 ? ", " : "", a, b);
  return s + "}";
}

// Each query must report its true pairs; the last must not name a body in `absent_at_last`.
std::function<std::string(const Observation&)> lists(std::vector<std::vector<BodyPair>> truth,
                                                     std::vector<int> absent_at_last) {
  return [truth, absent_at_last](const Observation& o) -> std::string {
    if (o.candidate_pairs.size() > truth.size())
      return fmt::format("reports {} lists for {} queries", o.candidate_pairs.size(), truth.size());
    for (std::size_t k = 0; k < truth.size(); ++k) {
      auto got = k < o.candidate_pairs.size() ? o.candidate_pairs[k] : std::vector<BodyPair>{};
      for (BodyPair& p : got)
        if (p.first > p.second) std::swap(p.first, p.second);
      for (const BodyPair& p : truth[k])
        if (std::find(got.begin(), got.end(), p) == got.end())
          return fmt::format("query {}: reports {}, which lacks the pair ({}, {})", k, list_text(got),
                             p.first, p.second);
      if (k + 1 < truth.size()) continue;
      for (const BodyPair& p : got)
        for (int gone : absent_at_last)
          if (p.first == gone || p.second == gone)
            return fmt::format("query {}: names body {}, which was removed", k, gone);
    }
    return "";
  };
}

void candidate_probes(std::vector<Probe>& all) {
  Case c;
  for (const double x : {0.0, 1.5, 10.0}) add_box(c.scene, {Vec3(x, 0, 0), Vec3::Ones()});
  c.queries = {{Question::candidates, -1, -1}};
  Case script = c;
  insert_all(c.scene);
  step_query(c.scene);
  all.push_back(
      {"candidate pairs of three boxes", c, lists({{{0, 1}}}, {}),
       "run the scene's steps and report the pairs of each TS_QUERY with sink->pair(ctx, k, a, b)"});
  Scene& s = script.scene;
  insert_all(s);
  step_query(s);
  step_move(s, 2, {Vec3(3, 0, 0), {}});
  step_query(s);
  step_remove(s, 1);
  step_query(s);
  step_insert(s, 1, {Vec3(4, 0, 0), {}});
  step_query(s);
  step_remove(s, 0);
  step_query(s);
  all.push_back(
      {"a script of insert, move, remove", script,
       lists({{{0, 1}}, {{0, 1}, {1, 2}}, {}, {{1, 2}}, {{1, 2}}}, {0}),
       "the k-th query sees the bodies as the steps before it left them; touching counts as overlap"});
}

// NaN: the depth at the point is not stated.
bool same_point(const ManifoldPoint& p, const ManifoldPoint& q) {
  return p.position == q.position && (p.depth == q.depth || (std::isnan(p.depth) && std::isnan(q.depth)));
}

bool same_answer(Observation one, Observation two) {
  if (!std::ranges::equal(one.manifold, two.manifold, same_point)) return false;
  one.manifold.clear();
  two.manifold.clear();
  return one == two;
}

Remark remark(Engine& engine, const Probe& p) {
  const auto one = engine.run({&p.c, 1})[0].answers[0], two = engine.run({&p.c, 1})[0].answers[0];
  if (one.outcome == Outcome::unsupported) return {p.name, "unsupported", one.detail};
  if (one.outcome != Outcome::answered)
    return {p.name, "wrong",
            fmt::format("{}{}{}", to_string(one.outcome), one.detail.empty() ? "" : ": ", one.detail)};
  const std::string what = p.complaint(one);
  if (!what.empty()) return {p.name, "wrong", what + ". " + p.hint};
  if (!same_answer(one, two))
    return {p.name, "wrong", "answers differently when asked the same question twice"};
  return {p.name, "right", ""};
}

}  // namespace

std::vector<Remark> conformance(Engine& engine) {
  std::vector<Probe> all;
  overlap_probes(all);
  number_probes(all);
  candidate_probes(all);
  std::vector<Remark> out;
  for (const Probe& p : all) out.push_back(remark(engine, p));
  return out;
}

}  // namespace touchstone::fuzz
