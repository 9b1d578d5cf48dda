#include "scenarios/value/moving_pairs.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/math/roundoff.h"
#include "core/shape/shape.h"
#include "scenarios/value/candidate_pairs.h"

namespace touchstone {
namespace {

bool moves(const Body& b) { return b.motion && !(b.motion->linear.isZero(0) && b.motion->angular.isZero(0)); }

// Height of the shape's highest point above its origin along d (body frame); infinite when there is none.
double height(const Shape& shape, const Vec3& d) {
  return std::visit(
      [&](const auto& s) {
        using S = std::decay_t<decltype(s)>;
        double most = infinity;
        if constexpr (requires { support(s, d); }) {
          most = d.dot(support(s, d));
        } else if constexpr (has_triangles<S>) {
          most = -infinity;
          for (const Vec3& v : s.vertices) most = std::max(most, d.dot(v));
        }
        return most;
      },
      shape);
}

// Margin of the boxes, relative to coordinates and size: far more than the rounding here.
constexpr double slack = 1e-12;

// The box of the start pose, or of the ball that contains the body in any orientation, swept along the path.
Aabb box_along(const Scene& s, int i) {
  const Body& b = s.bodies[static_cast<std::size_t>(i)];
  const Shape& shape = s.shape_of(i);
  const Motion m = b.motion.value_or(Motion{});
  const double radius = bounding_radius(shape);
  const Mat3 back = rotation_matrix(b.pose.rotation).transpose();
  Aabb box;
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = Vec3::Unit(k);
    const bool turns = !m.angular.isZero(0);
    const double up = turns ? radius : height(shape, back * axis),
                 down = turns ? radius : height(shape, -(back * axis));
    const double x = b.pose.translation[k], y = x + m.linear[k];
    const double margin = slack * (std::abs(x) + std::abs(y) + (std::isfinite(radius) ? radius : 0.0));
    box.lo[k] = std::min(x, y) - down - margin;
    box.hi[k] = std::max(x, y) + up + margin;
  }
  return box;
}

}  // namespace

bool moves(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const Body& b) { return moves(b); });
}

std::vector<BodyPair> moving_pairs(const Scene& scene) {
  const int n = static_cast<int>(scene.bodies.size());
  std::vector<BodyPair> pairs;
  if (!moves(scene)) return pairs;
  std::vector<BoxedBody> boxed;
  for (int i = 0; i < n; ++i) {
    const Aabb box = box_along(scene, i);
    // Skip bodies that are not sets (invalid_numbers.h).
    if (box.lo.x() <= box.hi.x()) boxed.push_back({box, i});
  }
  const auto moving = [&](int i) { return moves(scene.bodies[static_cast<std::size_t>(i)]); };
  for (const auto& [a, b] : overlapping_boxes(std::move(boxed)))
    if ((moving(a) || moving(b)) && is_reportable(scene, a, b)) pairs.emplace_back(a, b);
  return pairs;
}

std::size_t impacts_not_asked(const Case& c) {
  std::set<BodyPair> asked;
  for (const Query& q : c.queries)
    if (q.question == Question::time_of_impact) asked.insert(std::minmax(q.a, q.b));
  std::size_t n = 0;
  for (const BodyPair& p : moving_pairs(c.scene)) n += !asked.contains(p);
  return n;
}

std::string words_on_impacts_not_asked(const Case& c) {
  const std::size_t n = impacts_not_asked(c);
  if (n == 0) return "";
  return "no time-of-impact query for " + std::to_string(n) + (n == 1 ? " pair" : " pairs") +
         " that may meet during the step (a scene without queries gets them for the first " +
         std::to_string(most_impacts_asked) + " pairs)";
}

}  // namespace touchstone
