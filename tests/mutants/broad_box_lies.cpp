// Lies about boxes: each keeps those of the core's pairs whose boxes overlap as the lie computes them.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/through_float.h"
#include "scenarios/random/random_shape.h"
#include "tests/mutants/replay.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

const Shape& shape_of(const Scene& s, int i) { return s.shape_of(i); }
Pose pose_of(const QueryState& q, int i) {
  return q.bodies[static_cast<std::size_t>(i)].pose.value_or(Pose{});
}
Aabb box_of(const Scene& s, const QueryState& q, int i) { return plain_box(shape_of(s, i), pose_of(q, i)); }

Aabb one_ulp_less(const Scene& s, const QueryState& q, int i) {
  Aabb b = box_of(s, q, i);
  for (double& e : b.lo) e = std::nextafter(e, inf);
  for (double& e : b.hi) e = std::nextafter(e, -inf);
  return b;
}
// Applied to both corners it would not be a lie, because rounding keeps their order.
Aabb as_float(const Scene& s, const QueryState& q, int i) {
  Aabb b = box_of(s, q, i);
  b.lo = through_float(b.lo);
  return b;
}
Aabb half_open(const Scene& s, const QueryState& q, int i) {
  Aabb b = box_of(s, q, i);
  for (double& e : b.hi) e = std::nextafter(e, -inf);
  return b;
}
Aabb unrotated(const Scene& s, const QueryState& q, int i) {
  return plain_box(shape_of(s, i), {pose_of(q, i).translation, Quat{}});
}
Aabb y_as_z(const Scene& s, const QueryState& q, int i) {
  const Aabb b = box_of(s, q, i);
  const Vec3 half = (b.hi - b.lo) / 2, mid = (b.hi + b.lo) / 2;
  const Vec3 mixed(half.x(), half.z(), half.y());
  Aabb m;
  m.lo = mid - mixed;
  m.hi = mid + mixed;
  return m.lo.allFinite() && m.hi.allFinite() ? m : b;
}
// Clamped to a world of ±4096: boxes outside become empty.
Aabb bounded_world(const Scene& s, const QueryState& q, int i) {
  Aabb b = box_of(s, q, i);
  b.lo = b.lo.cwiseMax(-4096.0);
  b.hi = b.hi.cwiseMin(4096.0);
  return b;
}
// Fixed point with 12 fractional bits, rounded the wrong way.
Aabb quantised_inward(const Scene& s, const QueryState& q, int i) {
  Aabb b = box_of(s, q, i);
  for (double& e : b.lo) e = std::ceil(e * 4096) / 4096;
  for (double& e : b.hi) e = std::floor(e * 4096) / 4096;
  return b;
}
Aabb bounded_half_space(const Scene& s, const QueryState& q, int i) {
  Aabb b = box_of(s, q, i);
  b.lo = b.lo.cwiseMax(pose_of(q, i).translation - Vec3::Constant(2));
  b.hi = b.hi.cwiseMin(pose_of(q, i).translation + Vec3::Constant(2));
  return b;
}
Aabb flat_is_empty(const Scene& s, const QueryState& q, int i) {
  const Aabb b = box_of(s, q, i);
  return ((b.hi - b.lo).array() > 0).all() ? b : Aabb{};
}
Aabb absolute_shrink(const Scene& s, const QueryState& q, int i) {
  Aabb b = box_of(s, q, i);
  b.lo.array() += 1e-9;
  b.hi.array() -= 1e-9;
  return b;
}

double volume_size(const Aabb& b) { return (b.hi - b.lo).maxCoeff(); }

bool unlike_sizes_missed(const Scene& s, const QueryState& q, int a, int b) {
  const double x = volume_size(box_of(s, q, a)), y = volume_size(box_of(s, q, b));
  return std::max(x, y) < 32 * std::min(x, y);
}
bool contained_missed(const Scene& s, const QueryState& q, int a, int b) {
  const Aabb x = box_of(s, q, a), y = box_of(s, q, b);
  const auto inside = [](const Aabb& in, const Aabb& out) {
    return (in.lo.array() > out.lo.array()).all() && (in.hi.array() < out.hi.array()).all();
  };
  return !inside(x, y) && !inside(y, x);
}
bool equal_keys_missed(const Scene& s, const QueryState& q, int a, int b) {
  return box_of(s, q, a).lo.x() != box_of(s, q, b).lo.x();
}
Vec3 common_corner(const Scene& s, const QueryState& q, int a, int b) {
  return box_of(s, q, a).lo.cwiseMax(box_of(s, q, b).lo);
}
// Cells of side 2 by truncation instead of floor: one in eight in the negative octant is looked up in the
// wrong cell.
bool negative_cells(const Scene& s, const QueryState& q, int a, int b) {
  const Vec3 cell = (common_corner(s, q, a, b) / 2).array().floor();
  if (!((cell.array() < 0).all())) return true;
  return std::fmod(-cell.sum(), 4.0) != 0;
}
// A pair is reported by the cell that contains the common corner; a corner on a border is in neither cell.
bool on_border(const Scene& s, const QueryState& q, int a, int b) {
  const Vec3 corner = common_corner(s, q, a, b) / 2;
  return corner.x() != std::floor(corner.x());
}
// A sweep along x that stops at a body's first neighbour that is separated in y.
void stops_at_y(const Scene& s, const QueryState& q, std::vector<BodyPair>& pairs) {
  std::vector<std::pair<Aabb, int>> sorted;
  for (int i = 0; i < static_cast<int>(q.bodies.size()); ++i)
    if (q.bodies[static_cast<std::size_t>(i)].pose) sorted.emplace_back(box_of(s, q, i), i);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& x, const auto& y) { return x.first.lo.x() < y.first.lo.x(); });
  std::vector<BodyPair> met;
  for (std::size_t i = 0; i < sorted.size(); ++i)
    for (std::size_t j = i + 1; j < sorted.size(); ++j) {
      const Aabb &x = sorted[i].first, &y = sorted[j].first;
      if (x.lo.y() > y.hi.y() || y.lo.y() > x.hi.y()) break;
      met.push_back(std::minmax(sorted[i].second, sorted[j].second));
    }
  std::sort(met.begin(), met.end());
  std::erase_if(pairs, [&](const BodyPair& p) { return !std::binary_search(met.begin(), met.end(), p); });
}

}  // namespace

std::vector<Mutant> broad_box_lies() {
  return {
      {"boxes_to_nearest", "missed", "errands", "boxes rounded to nearest instead of outward",
       keep_overlapping(box_of)},
      {"boxes_one_ulp_small", "missed", "tiles", "boxes an ulp too small", keep_overlapping(one_ulp_less)},
      {"boxes_half_open", "missed", "tiles", "boxes without their upper faces: touching is apart",
       keep_overlapping(half_open)},
      {"boxes_float", "missed", "tiles", "lower corners rounded to the nearest float",
       keep_overlapping(as_float)},
      {"boxes_absolute_epsilon", "missed", "tiles", "boxes smaller by 1e-9",
       keep_overlapping(absolute_shrink)},
      {"boxes_fixed_point", "missed", "tiles", "corners rounded inward to 1/4096",
       keep_overlapping(quantised_inward)},
      {"boxes_unrotated", "missed", "crowd", "boxes of the shapes, not of the bodies",
       keep_overlapping(unrotated)},
      {"boxes_wrong_axis", "missed", "crowd", "the extents in y and z are swapped", keep_overlapping(y_as_z)},
      {"world_bounds", "missed", "tiles", "nothing is found beyond ±4096", keep_overlapping(bounded_world)},
      {"half_space_bounded", "missed", "tiles", "an unbounded box ends 2 from its body's origin",
       keep_overlapping(bounded_half_space)},
      {"flat_box_empty", "missed", "crowd", "a box of no thickness counts as empty",
       keep_overlapping(flat_is_empty)},
      {"unlike_sizes", "missed", "tiles", "pairs of sizes 32 to 1 are lost", keep_pairs(unlike_sizes_missed)},
      {"box_in_box", "missed", "crowd", "a box strictly inside another is missed",
       keep_pairs(contained_missed)},
      {"equal_keys", "missed", "tiles", "boxes that start at the same x count as one box",
       keep_pairs(equal_keys_missed)},
      {"negative_cells", "missed", "tiles", "some cells with three negative indices are skipped",
       keep_pairs(negative_cells)},
      {"cell_border", "missed", "tiles", "pairs whose common corner is on a border of cells in x are lost",
       keep_pairs(on_border)},
      {"sweep_stops_early", "missed", "crowd", "the sweep along x ends at the first box apart in y",
       change_list(stops_at_y)},
  };
}

}  // namespace touchstone::mutants
