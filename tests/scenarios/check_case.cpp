#include "tests/scenarios/check_case.h"

#include "oracles/referee/referee.h"
#include "tests/support/catch.h"

namespace touchstone::test {
namespace {

bool asks(const Case& c, Question q) {
  for (const Query& x : c.queries)
    if (x.question == q) return true;
  return false;
}

std::size_t query_steps(const Scene& s) {
  std::size_t n = 0;
  for (const Step& step : effective_script(s)) n += step.op == Step::Op::query;
  return n;
}

void check_pair_part(const Case& c, const Expectation& e) {
  if (!e.overlap && !e.gap && !e.normal && !e.impact) return;
  REQUIRE(c.scene.bodies.size() >= 2);
  const bool about_margin = asks(c, Question::within) || asks(c, Question::bounded_distance);
  const bool about_ray = asks(c, Question::ray);
  if (e.overlap) CHECK((asks(c, Question::overlap) || about_margin || about_ray));
  if (e.gap) CHECK((asks(c, Question::distance) || about_margin || about_ray));
  if (e.impact) CHECK((asks(c, Question::time_of_impact) || about_ray));
  if (e.gap) {
    CHECK(std::isfinite(e.gap->value));
    CHECK(e.gap->tolerance >= 0);
    // A tolerance of a millionth of the case would say little.
    CHECK(e.gap->tolerance <= 1e-6 * scale_of_pair(c.scene, 0, 1));
    if (e.overlap && *e.overlap) CHECK(e.gap->value <= e.gap->tolerance);
    if (e.overlap && !*e.overlap) CHECK(e.gap->value > -e.gap->tolerance);
  }
  if (e.normal) CHECK(std::abs(e.normal->norm() - 1) < 1e-15);
  if (e.impact && e.impact->hit) {
    CHECK(e.impact->time >= 0);
    CHECK(e.impact->time <= 1);
    CHECK(e.impact->tolerance >= 0);
    CHECK(e.impact->tolerance < 1e-9);
    if (e.impact->time == 0 && e.overlap) CHECK(*e.overlap);
  }
}

void check_crowd_part(const Case& c, const Expectation& e) {
  const auto n = static_cast<int>(c.scene.bodies.size());
  if (e.all_pairs) CHECK(*e.all_pairs == n * (n - 1) / 2);
  if (e.box_pairs && e.all_pairs) CHECK(*e.box_pairs <= *e.all_pairs);
  if (e.overlapping_pairs && e.box_pairs) CHECK(*e.overlapping_pairs <= *e.box_pairs);
  if (e.overlapping_pairs || !e.pairs_at_query.empty()) CHECK(asks(c, Question::candidates));
  if (e.pairs_at_query.empty()) return;
  CHECK(e.pairs_at_query.size() == query_steps(c.scene));
  for (const auto& list : e.pairs_at_query) {
    CHECK(std::is_sorted(list.begin(), list.end()));
    for (auto [a, b] : list) {
      CHECK((0 <= a && a < b && b < n));
      CHECK(!is_filtered(c.scene, a, b));
    }
  }
}

}  // namespace

void check_case(const Case& c, const Expectation& e) {
  CHECK_NOTHROW(validate(c.scene));
  CHECK(!c.id.empty());
  CHECK(!c.queries.empty());
  for (const Query& q : c.queries)
    if (is_pair_question(q.question)) {
      const auto n = static_cast<int>(c.scene.bodies.size());
      CHECK((q.a != q.b && q.a >= 0 && q.b >= 0 && q.a < n && q.b < n));
    }
  CHECK(!e.reason.empty());
  CHECK((e.overlap || e.gap || e.impact || e.overlapping_pairs || !e.pairs_at_query.empty()));
  check_pair_part(c, e);
  check_crowd_part(c, e);
}

std::vector<Pose> own_poses(const Scene& scene) {
  std::vector<Pose> poses;
  for (const Body& b : scene.bodies) poses.push_back(b.pose);
  return poses;
}

std::vector<BodyPair> overlapping_pairs(const Scene& scene, const std::vector<Pose>& poses,
                                        const std::vector<bool>& present) {
  const auto placed = [&](std::size_t i) {
    return Placed{&scene.shape_of(static_cast<int>(i)), poses[i]};
  };
  std::vector<Aabb> boxes;
  for (std::size_t i = 0; i < poses.size(); ++i) boxes.push_back(referee::outer_box(placed(i)));
  std::vector<BodyPair> pairs;
  for (std::size_t i = 0; i < poses.size(); ++i)
    for (std::size_t j = i + 1; j < poses.size(); ++j) {
      if (!present[i] || !present[j] || !overlaps(boxes[i], boxes[j])) continue;
      if (is_filtered(scene, static_cast<int>(i), static_cast<int>(j))) continue;
      const auto truth = referee::judge_pair(placed(i), placed(j));
      INFO("pair " << i << ", " << j);
      CHECK(truth.verdict != referee::Verdict::undecided);
      if (truth.verdict == referee::Verdict::overlap) pairs.emplace_back(i, j);
    }
  return pairs;
}

}  // namespace touchstone::test
