#include "oracles/referee/exact/exact_point.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <vector>

#include "oracles/checker/checker.h"
#include "oracles/referee/exact/rational.h"
#include "oracles/referee/filter/convex.h"
#include "oracles/referee/filter/real3.h"
#include "oracles/referee/limits.h"

namespace touchstone::referee {
namespace {

// Whether the exact point is the one in doubles.
bool is_representable(const Certificate& c) {
  for (int k = 0; k < 3; ++k)
    if (exact(c.point[k]) != rational_from_text(c.rationals[static_cast<std::size_t>(k)])) return false;
  return true;
}

// Whether the exact point, of which `rounded` is the rounding, is certainly not in the body: cheaper to show
// than in exact arithmetic, and true of most guesses.
bool is_outside(const Placed& body, const Vec3& rounded) {
  constexpr double any_bracket = std::numeric_limits<double>::infinity();
  return distance_to(body, rounded, any_bracket).lo > value_rounding_of<double> * rounded.stableNorm();
}

}  // namespace

Holder::Holder(const Placed& p) : whole_(p) {
  const auto* mesh = std::get_if<TriangleMesh>(p.shape);
  if (!mesh) return;
  const Frame frame = frame_of(p, Vec3::Zero());
  for (const auto& t : mesh->triangles) {
    std::vector<Vec3> corners;
    for (const int k : t) corners.push_back(mesh->vertices[static_cast<std::size_t>(k)]);
    boxes_.push_back(box_of(make_body(corners, 0, frame)));
  }
}

std::optional<Placed> Holder::part_at(const Vec3& rounded) {
  if (boxes_.empty()) return whole_;
  Aabb about;
  for (const double side : {-1.0, 1.0}) {
    Vec3 x = rounded;
    for (double& e : x) e = std::nextafter(e, side * std::numeric_limits<double>::infinity());
    about.extend(x);
  }
  const auto& mesh = std::get<TriangleMesh>(*whole_.shape);
  TriangleMesh near;
  for (std::size_t i = 0; i < boxes_.size(); ++i)
    if (overlaps(about, boxes_[i])) near.triangles.push_back(mesh.triangles[i]);
  if (near.triangles.empty()) return std::nullopt;
  near.vertices = mesh.vertices;
  part_ = std::move(near);
  return Placed{&part_, whole_.pose};
}

bool is_common_point(const Certificate& c, Holder& a, Holder& b) {
  const auto x = a.part_at(c.point);
  const auto y = x ? b.part_at(c.point) : std::nullopt;
  return y && checker::check(c, *x, *y);
}

Certificate guess_common_point(const std::array<Vec3, 2>& witness, const Placed& a, const Placed& b,
                               int& level) {
  const Vec3 middle = witness[0] + 0.5 * (witness[1] - witness[0]);
  double size = 0;
  for (const Vec3& w : witness) size = std::max(size, w.cwiseAbs().maxCoeff());
  if (!std::isfinite(size)) return {};
  for (const Placed& p : {a, b})
    if (const double r = bounding_radius(*p.shape); std::isfinite(r)) size = std::max(size, r);
  Certificate c;
  c.kind = Certificate::Kind::common_point;
  Holder holds_a(a), holds_b(b);
  std::vector<double> steps{0};  // the unchanged witness comes first
  steps.insert(steps.end(), std::begin(limits::guess_factors), std::end(limits::guess_factors));
  for (const double step : steps)
    for (const Vec3& w : {middle, witness[0], witness[1]}) {
      const Rational e = exact(step * size);
      c.rationals.clear();
      for (int k = 0; k < 3; ++k) {
        const Rational x = exact(w[k]), guess = e > 0 ? simplest_between(x - e, x + e) : x;
        c.rationals.push_back(text_of(guess));
        c.point[k] = guess.convert_to<double>();
      }
      // Most guesses are doubles of a few bits, and most are wrong: short integers tell at once.
      if (is_representable(c)) {
        const auto in_a = contains_short(a, c.point);
        const auto in_b = in_a && !*in_a ? in_a : contains_short(b, c.point);
        if (in_a && in_b) {
          if (!*in_a || !*in_b) continue;
          level = 1;
          return c;
        }
      }
      if (!is_outside(a, c.point) && !is_outside(b, c.point) && is_common_point(c, holds_a, holds_b)) {
        level = 2;
        return c;
      }
    }
  return {};
}

}  // namespace touchstone::referee
