#include "fuzz/shrink/defensible.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fuzz/ask/degeneracy.h"
#include "fuzz/judge/truth.h"
#include "oracles/referee/referee.h"
#include "scenarios/random/numbers.h"
#include "scenarios/value/candidate_pairs.h"

namespace touchstone::fuzz {
namespace {

constexpr double earliest_contact = 0.01;  // in steps
constexpr double latest_contact = 0.99;
constexpr std::size_t most_bodies = 64;  // of a scene
constexpr int most_near_pairs = 64;      // that the referee is asked about, over all steps of a script

bool is_plain(double x) {
  return x == 0 || (std::abs(x) >= least_plain_number && std::abs(x) <= largest_plain_number);
}

bool has_plain_numbers(Case c) {
  const auto all = numbers(c);
  return std::all_of(all.begin(), all.end(), [](const double* x) { return is_plain(*x); });
}

// Twice the area, as a share of the square of the longest edge, is at least clear_share.
bool has_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return longest > 0 && (b - a).cross(c - a).norm() >= clear_share * longest;
}

bool is_degenerate(const Shape& shape) {
  const TriangleMesh* mesh = triangles_if(shape);
  if (!mesh) return is_flat(shape);
  const auto vertex = [&](int i) -> const Vec3& { return mesh->vertices[static_cast<std::size_t>(i)]; };
  return std::any_of(mesh->triangles.begin(), mesh->triangles.end(), [&](const std::array<int, 3>& t) {
    return !has_area(vertex(t[0]), vertex(t[1]), vertex(t[2]));
  });
}

// Volume, or, for the triangles of a mesh, area.
bool have_volume(const Case& c) {
  for (const Query& q : c.queries) {
    if (!is_pair_question(q.question))
      return std::none_of(c.scene.bodies.begin(), c.scene.bodies.end(), [&](const Body& b) {
        return is_degenerate(c.scene.shapes[static_cast<std::size_t>(b.shape)]);
      });
    if (is_degenerate(c.scene.shape_of(q.a)) || is_degenerate(c.scene.shape_of(q.b))) return false;
  }
  return true;
}

bool is_mesh(const Scene& s, int body) { return touchstone::is_mesh(s.shape_of(body)); }

// Pairs at the bodies' own poses.
class PairClearance {
 public:
  explicit PairClearance(const Scene& s) : scene_(s), truth_(s) {}

  double margin(int a, int b) const { return clear_share * smaller_size(scene_, a, b); }

  bool is_clear(int a, int b) { return is_apart(a, b) || is_deep(a, b); }

  /// The gap is clearly not the scene's margin.
  bool is_clear_of_margin(int a, int b) {
    const referee::Bracket gap = truth_.pair(0, a, b).gap;
    return gap.lo > scene_.margin + margin(a, b) || gap.hi < scene_.margin - margin(a, b);
  }

  bool is_impact_clear(int a, int b) { return is_apart(a, b) && is_course_clear(a, b); }

  bool is_step_clear(int a, int b) { return is_deep(a, b) || is_impact_clear(a, b); }

 private:
  bool is_apart(int a, int b) { return truth_.pair(0, a, b).gap.lo > margin(a, b); }

  // The gap of a mesh that overlaps is not defined, but the depth in one of its triangles is.
  bool is_deep(int a, int b) {
    if (is_mesh(scene_, a) || is_mesh(scene_, b))
      return truth_.pair(0, a, b).verdict == referee::Verdict::overlap &&
             truth_.depth_in_mesh(0, a, b) > margin(a, b);
    return truth_.pair(0, a, b).gap.hi < -margin(a, b);
  }

  bool is_course_clear(int a, int b) {
    const referee::TimeTruth& t = truth_.motion(0, a, b);
    using enum referee::TimeTruth::Verdict;
    if (t.verdict == none) return t.least_gap.lo > margin(a, b);
    return t.verdict == hit && t.t_lo > earliest_contact && t.t_hi < latest_contact &&
           truth_.depth_in_step(0, a, b) > margin(a, b);
  }

  const Scene& scene_;
  Truth truth_;
};

bool are_boxes_apart(const Aabb& x, const Aabb& y, double margin) {
  return ((x.lo - y.hi).array() > margin).any() || ((y.lo - x.hi).array() > margin).any();
}

// Whether `is_clear` holds for all pairs of the bodies, except where their boxes show that they are apart.
// An empty box stands for a body that is not present. `near_pairs` counts those examined.
template <class IsClear>
bool are_all_clear(const Scene& scene, const std::vector<std::optional<Aabb>>& boxes,
                   const PairClearance& pairs, int& near_pairs, IsClear&& is_clear) {
  const int n = static_cast<int>(boxes.size());
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b) {
      const auto &x = boxes[static_cast<std::size_t>(a)], &y = boxes[static_cast<std::size_t>(b)];
      if (!x || !y || !is_reportable(scene, a, b) || are_boxes_apart(*x, *y, pairs.margin(a, b))) continue;
      if (++near_pairs > most_near_pairs || !is_clear(a, b)) return false;
    }
  return true;
}

bool is_scene_clear(const Scene& scene, const std::vector<std::optional<Pose>>& poses, int& near_pairs) {
  Scene placed = scene;
  std::vector<std::optional<Aabb>> boxes(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (poses[i]) {
      placed.bodies[i].pose = *poses[i];
      boxes[i] = referee::outer_box({&scene.shape_of(static_cast<int>(i)), *poses[i]});
    }
  PairClearance pairs(placed);
  return are_all_clear(placed, boxes, pairs, near_pairs, [&](int a, int b) { return pairs.is_clear(a, b); });
}

bool are_candidates_clear(const Scene& scene) {
  Truth truth(scene);
  const auto& steps = truth.steps();
  int near_pairs = 0;
  return std::all_of(steps.begin(), steps.end(),
                     [&](const Truth::StepState& s) { return is_scene_clear(scene, s.pose, near_pairs); });
}

bool are_contacts_clear(const Scene& scene) {
  std::vector<std::optional<Pose>> poses;
  for (const Body& b : scene.bodies) poses.emplace_back(b.pose);
  int near_pairs = 0;
  return is_scene_clear(scene, poses, near_pairs);
}

bool are_sweeps_clear(const Scene& scene) {
  std::vector<std::optional<Aabb>> boxes;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    boxes.emplace_back(referee::outer_box({&scene.shape_of(static_cast<int>(i)), scene.bodies[i].pose},
                                          scene.bodies[i].motion.value_or(Motion{})));
  PairClearance pairs(scene);
  int near_pairs = 0;
  return are_all_clear(scene, boxes, pairs, near_pairs,
                       [&](int a, int b) { return pairs.is_step_clear(a, b); });
}

bool is_question_clear(const Scene& scene, const Query& q, PairClearance& pairs) {
  switch (q.question) {
    case Question::overlap:
    case Question::distance:
    case Question::contact:
      return pairs.is_clear(q.a, q.b);
    case Question::within:
    case Question::bounded_distance:
    case Question::contact_within:
      return pairs.is_clear(q.a, q.b) && pairs.is_clear_of_margin(q.a, q.b);
    case Question::ray:
    case Question::time_of_impact:
      return pairs.is_impact_clear(q.a, q.b);
    case Question::candidates:
      return are_candidates_clear(scene);
    case Question::candidates_within:
      return false;  // no form is known in which every pair is clear of the margin
    case Question::scene_contacts:
      return are_contacts_clear(scene);
    case Question::swept_candidates:
      return are_sweeps_clear(scene);
  }
  return false;
}

}  // namespace

double smaller_size(const Scene& scene, int a, int b) {
  const double x = 2 * extent(scene.shape_of(a)), y = 2 * extent(scene.shape_of(b));
  if (!is_bounded(kind_of(scene.shape_of(a)))) return is_bounded(kind_of(scene.shape_of(b))) ? y : 0;
  return is_bounded(kind_of(scene.shape_of(b))) ? std::min(x, y) : x;
}

bool is_solid(const Case& c) { return has_plain_numbers(c) && have_volume(c); }

bool is_defensible(const Case& c) {
  if (c.scene.bodies.size() > most_bodies || !is_solid(c)) return false;
  PairClearance pairs(c.scene);
  return std::all_of(c.queries.begin(), c.queries.end(),
                     [&](const Query& q) { return is_question_clear(c.scene, q, pairs); });
}

}  // namespace touchstone::fuzz
