#include "scenarios/value/candidate_pairs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/math/roundoff.h"

namespace touchstone {
namespace {

// 0: identity; 1 and 2: about (1,1,1) by one and two thirds; 3: none of these.
unsigned thirds_of(const Quat& q) {
  if (q.x == 0 && q.y == 0 && q.z == 0) return 0;
  if (q.x != q.y || q.y != q.z || std::abs(q.w) != std::abs(q.x)) return 3;
  return q.w == q.x ? 1 : 2;
}

Vec3 turned(const Vec3& h, unsigned thirds) {
  if (thirds == 1) return {h.z(), h.x(), h.y()};
  if (thirds == 2) return {h.y(), h.z(), h.x()};
  return h;
}

std::optional<Aabb> half_space_box(const HalfSpace& s, const Pose& pose) {
  if (thirds_of(pose.rotation) != 0) return std::nullopt;
  Aabb box{Vec3::Constant(-infinity), Vec3::Constant(infinity)};
  for (int k = 0; k < 3; ++k) {
    if (s.normal[k] == 0) continue;
    if (std::abs(s.normal[k]) != 1 || std::abs(s.normal.sum()) != 1) return std::nullopt;
    const double at = pose.translation[k] + s.normal[k] * s.offset;
    (s.normal[k] > 0 ? box.hi : box.lo)[k] = at;
  }
  return box;
}

}  // namespace

bool is_reportable(const Scene& scene, int a, int b) {
  const auto fixed = [&](int i) { return scene.bodies[static_cast<std::size_t>(i)].is_static; };
  return !(fixed(a) && fixed(b)) && !is_filtered(scene, a, b);
}

// Sweep and prune along x.
std::vector<BodyPair> overlapping_boxes(std::vector<BoxedBody> bodies) {
  std::sort(bodies.begin(), bodies.end(), [](const BoxedBody& x, const BoxedBody& y) {
    return std::pair{x.box.lo.x(), x.body} < std::pair{y.box.lo.x(), y.body};
  });
  std::vector<BodyPair> pairs;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = i + 1; j < bodies.size() && bodies[j].box.lo.x() <= bodies[i].box.hi.x(); ++j)
      if (overlaps(bodies[i].box, bodies[j].box))
        pairs.push_back(std::minmax(bodies[i].body, bodies[j].body));
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<BodyPair> sorted_unique(std::vector<BodyPair> pairs) {
  for (BodyPair& p : pairs)
    if (p.first > p.second) std::swap(p.first, p.second);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

std::optional<Aabb> exact_box(const Shape& shape, const Pose& pose) {
  if (const auto* s = std::get_if<HalfSpace>(&shape)) return half_space_box(*s, pose);
  const auto* b = std::get_if<Box>(&shape);
  const unsigned thirds = thirds_of(pose.rotation);
  if (!b || thirds == 3) return std::nullopt;
  const Vec3 h = turned(b->half_extents, thirds);
  return Aabb{pose.translation - h, pose.translation + h};
}

Quat turn_by_thirds(unsigned thirds) {
  if (thirds == 1) return {1, 1, 1, 1};
  if (thirds == 2) return {1, 1, 1, -1};
  return {};
}

}  // namespace touchstone
