// The order in which bodies and vertices are given.
#include <algorithm>
#include <utility>

#include "fuzz/causes/intervention.h"

namespace touchstone::fuzz {
namespace {

// Unit spheres far from everything, one after the other at half their diameter, so that two of them overlap.
std::optional<Case> with_distant_bodies(const Case& c, int count, bool first) {
  if (asks_about_pair(c)) return std::nullopt;
  constexpr double far = 4096;
  Case r = c;
  const int n = static_cast<int>(c.scene.bodies.size());
  r.scene.shapes.emplace_back(Sphere{1});
  std::vector<Body> added(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    Body& b = added[static_cast<std::size_t>(i)];
    b.shape = static_cast<int>(r.scene.shapes.size()) - 1;
    b.pose.translation = Vec3(far + i, far, far);
  }
  r.scene.bodies.insert(first ? r.scene.bodies.begin() : r.scene.bodies.end(), added.begin(), added.end());
  const int shift = first ? count : 0;
  for (Step& s : r.scene.script)
    if (s.op != Step::Op::query) s.body += shift;
  for (BodyPair& p : r.scene.ignored) p = {p.first + shift, p.second + shift};
  if (r.scene.script.empty()) return r;
  const auto place = first ? r.scene.script.begin()
                           : std::find_if(r.scene.script.begin(), r.scene.script.end(),
                                          [](const Step& s) { return s.op == Step::Op::query; });
  std::vector<Step> inserts;
  for (int i = 0; i < count; ++i) inserts.push_back({Step::Op::insert, first ? i : n + i, std::nullopt});
  r.scene.script.insert(place, inserts.begin(), inserts.end());
  return r;
}

}  // namespace

std::optional<Case> add_body_first(const Case& c) { return with_distant_bodies(c, 1, true); }
std::optional<Case> add_pair_first(const Case& c) { return with_distant_bodies(c, 2, true); }
std::optional<Case> add_pair_last(const Case& c) { return with_distant_bodies(c, 2, false); }

std::optional<Case> add_body_between(const Case& c) {
  if (asks_about_pair(c) || c.scene.bodies.size() < 2) return std::nullopt;
  const auto with = with_distant_bodies(c, 1, true);
  if (!with) return std::nullopt;
  // The new body changes places with the one after it, which is the first of the case.
  Case r = *with;
  std::swap(r.scene.bodies[0], r.scene.bodies[1]);
  const auto swapped = [](int i) { return i > 1 ? i : 1 - i; };
  for (Step& s : r.scene.script)
    if (s.op != Step::Op::query) s.body = swapped(s.body);
  for (BodyPair& p : r.scene.ignored) p = std::minmax(swapped(p.first), swapped(p.second));
  std::sort(r.scene.ignored.begin(), r.scene.ignored.end());
  return r;
}

std::optional<Case> exchange(const Case& c) {
  if (!asks_about_pair(c)) return std::nullopt;
  Case r = c;
  for (Query& q : r.queries) std::swap(q.a, q.b);
  return r;
}

std::optional<Case> insert_in_reverse(const Case& c) {
  if (asks_about_pair(c) || c.scene.bodies.size() < 2) return std::nullopt;
  const int last = static_cast<int>(c.scene.bodies.size()) - 1;
  Case r = c;
  std::reverse(r.scene.bodies.begin(), r.scene.bodies.end());
  for (Step& s : r.scene.script)
    if (s.op != Step::Op::query) s.body = last - s.body;
  for (BodyPair& p : r.scene.ignored) p = {last - p.second, last - p.first};
  std::sort(r.scene.ignored.begin(), r.scene.ignored.end());
  return r;
}

std::optional<Case> reorder_hull(const Case& c) {
  Case r = c;
  bool any = false;
  for (Shape& shape : r.scene.shapes)
    if (auto* hull = hull_if(shape)) {
      std::vector<Vec3> vertices = hull->vertices;
      std::reverse(vertices.begin(), vertices.end());
      *hull = make_hull(std::move(vertices));
      any = true;
    }
  if (!any) return std::nullopt;
  return r;
}

}  // namespace touchstone::fuzz
