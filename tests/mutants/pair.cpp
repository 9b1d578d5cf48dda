#include "tests/mutants/pair.h"

#include <algorithm>

#include "scenarios/random/random_shape.h"
#include "tests/mutants/replay.h"

namespace touchstone::mutants {

double small_size(const Case& c, const Query& q) {
  const double a = extent(c.scene.shape_of(q.a)), b = extent(c.scene.shape_of(q.b));
  return a == 0 ? b : (b == 0 ? a : std::min(a, b));
}

double width(const Case& c, const Query& q, const Vec3& n) {
  const auto support_along = [&](int i, const Vec3& d) {
    return d.dot(body(c, i).pose.translation) +
           fuzz::support_value(c.scene.shape_of(i),
                               rotation_matrix(body(c, i).pose.rotation).transpose() * d);
  };
  return support_along(q.a, n) + support_along(q.b, -n);
}

double gap(const Case& c, const Query& q) { return distance(placed(c, q.a), placed(c, q.b)).distance; }

bool contained(const Case& c, const Query& q) {
  const Aabb x = plain_box(c.scene.shape_of(q.a), body(c, q.a).pose),
             y = plain_box(c.scene.shape_of(q.b), body(c, q.b).pose);
  const auto inside = [](const Aabb& in, const Aabb& out) {
    return (in.lo.array() > out.lo.array()).all() && (in.hi.array() < out.hi.array()).all();
  };
  return inside(x, y) || inside(y, x);
}

ImpactAnswer impact_of(const SeenPair& p, const Case& c, const Query& q) {
  const auto moving = [&](const PlacedShape& s, int i) {
    return MovingShape(s.shape, s.pose, body(c, i).motion.value_or(Motion{}));
  };
  return time_of_impact(moving(p.first(), q.a), moving(p.second(), q.b));
}

Lie on_scene(SceneLie lie) {
  return [lie](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::scene_contacts)) lie(c, o.contacts);
  };
}

Lie on_contact(ContactLie lie) {
  return [lie](const Case& c, const Query& q, Observation& o) {
    if (asks(q, Question::contact) && o.normal && o.depth) lie(c, q, o);
  };
}

}  // namespace touchstone::mutants
