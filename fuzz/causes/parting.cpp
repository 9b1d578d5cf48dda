#include "fuzz/causes/parting.h"

#include <algorithm>
#include <cmath>

#include "fuzz/judge/truth.h"

namespace touchstone::fuzz {
namespace {

// Of the two bodies at the start.
struct Start {
  Vec3 velocity = Vec3::Zero();  // of B as seen by A
  double turning = 0;            // no point of them moves faster by their turning
};

Start start_of(const Scene& s, const Query& q) {
  Start start;
  for (const int body : {q.a, q.b}) {
    const auto& motion = s.bodies[static_cast<std::size_t>(body)].motion;
    if (!motion) continue;
    start.velocity += body == q.b ? motion->linear : Vec3(-motion->linear);
    if (!motion->angular.isZero(0))
      start.turning += motion->angular.norm() * bounding_radius(s.shape_of(body));
  }
  return start;
}

bool is_mesh(const Scene& s, int body) { return kind_of(s.shape_of(body)) == ShapeKind::mesh; }

}  // namespace

bool parts_from_start(const Case& c, const Query& q) {
  const Scene& s = c.scene;
  if (!is_pair_question(q.question) || !s.script.empty() || is_mesh(s, q.a) || is_mesh(s, q.b)) return false;
  const Start start = start_of(s, q);
  if (start.velocity.isZero(0) && start.turning == 0) return false;
  Truth truth(s);
  const referee::PairTruth& pair = truth.pair(0, q.a, q.b);
  const double length = pair.normal.norm();
  if (pair.verdict != referee::Verdict::overlap || !(length > 0)) return false;
  constexpr double rounding = 1e-12;  // of the speed: the normal's; sliding is at right angles to it
  const double apart = start.velocity.dot(pair.normal) / length;
  return apart + rounding * start.velocity.norm() >= start.turning;
}

bool parts_from_start(const Case& c) {
  return std::ranges::all_of(c.queries, [&](const Query& q) {
    return q.question != Question::time_of_impact || parts_from_start(c, q);
  });
}

bool is_of_parting_bodies(const Finding& f) {
  if (f.question != to_string(Question::time_of_impact) || f.fault != to_string(Fault::missed)) return false;
  std::size_t parting = 0;
  for (const Example& e : f.examples) {
    if (!e.c) continue;
    if (!parts_from_start(*e.c)) return false;
    ++parting;
  }
  return parting > 0;
}

}  // namespace touchstone::fuzz
