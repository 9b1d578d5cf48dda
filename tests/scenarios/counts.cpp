// Pair counts of crowds by brute force, and the pairs of scripts step by step.
#include <algorithm>

#include "core/math/rng.h"
#include "oracles/referee/referee.h"
#include "scenarios/handmade/scenario.h"
#include "tests/scenarios/check_case.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

// Tight for the crowds, whose poses are translations: support points along the axes are exact.
Aabb tight_box(const Shape& shape, const Pose& pose) {
  Aabb b;
  std::visit(
      [&](const auto& s) {
        using S = std::decay_t<decltype(s)>;
        if constexpr (has_triangles<S>) {
          for (const Vec3& v : s.vertices) b.extend(Vec3(v + pose.translation));
        } else if constexpr (!std::is_same_v<S, HalfSpace>) {
          for (int i = 0; i < 3; ++i)
            for (double sign : {-1.0, 1.0})
              b.extend(Vec3(support(s, sign * Vec3::Unit(i)) + pose.translation));
        }
      },
      shape);
  if (const auto* h = std::get_if<HalfSpace>(&shape)) {
    b.lo.setConstant(-std::numeric_limits<double>::infinity());
    b.hi.setConstant(std::numeric_limits<double>::infinity());
    for (int i = 0; i < 3; ++i)
      if (h->normal.cwiseAbs().sum() == h->normal[i])
        b.hi[i] = h->offset / h->normal[i] + pose.translation[i];
  }
  return b;
}

int box_pairs(const Scene& s) {
  std::vector<Aabb> boxes;
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    REQUIRE(s.bodies[i].pose.rotation == Quat{});
    boxes.push_back(tight_box(s.shape_of(static_cast<int>(i)), s.bodies[i].pose));
  }
  int n = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size(); ++j) n += overlaps(boxes[i], boxes[j]);
  return n;
}

}  // namespace

TEST_CASE("the stated pair counts of crowds are those of brute force and referee", "[scenarios][crowd]") {
  int checked = 0;
  for (const auto& s : scenarios::catalog()) {
    if (!s.expect.overlapping_pairs) continue;
    INFO(s.name);
    const Scene scene = s.make().scene;
    if (s.expect.box_pairs) CHECK(box_pairs(scene) == *s.expect.box_pairs);
    const auto pairs =
        test::overlapping_pairs(scene, test::own_poses(scene), std::vector<bool>(scene.bodies.size(), true));
    CHECK(static_cast<int>(pairs.size()) == *s.expect.overlapping_pairs);
    ++checked;
  }
  CHECK(checked >= 12);
}

TEST_CASE("the stated pairs at each query of a script are those of the referee", "[scenarios][lifecycle]") {
  int scripts = 0, queries = 0, with_pairs = 0;
  for (const auto& s : scenarios::catalog()) {
    if (s.expect.pairs_at_query.empty()) continue;
    INFO(s.name);
    const Scene scene = s.make().scene;
    std::vector<Pose> poses = test::own_poses(scene);
    std::vector<bool> present(poses.size(), false);
    std::size_t query = 0;
    for (const Step& step : effective_script(scene)) {
      const auto b = static_cast<std::size_t>(std::max(step.body, 0));
      if (step.op == Step::Op::insert) {
        present[b] = true;
        poses[b] = step.pose.value_or(scene.bodies[b].pose);
      }
      if (step.op == Step::Op::move) poses[b] = *step.pose;
      if (step.op == Step::Op::remove) present[b] = false;
      if (step.op != Step::Op::query) continue;
      INFO("query " << query);
      REQUIRE(query < s.expect.pairs_at_query.size());
      const auto pairs = test::overlapping_pairs(scene, poses, present);
      CHECK(pairs == s.expect.pairs_at_query[query]);
      with_pairs += !pairs.empty();
      ++query;
      ++queries;
    }
    ++scripts;
  }
  CHECK(scripts >= 10);
  CHECK(with_pairs * 10 >=
        queries * 3);  // not trivial: at least 30 % of the queries have pairs, and 30 % have none
  CHECK(with_pairs * 10 <= queries * 7);
}
