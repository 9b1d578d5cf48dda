// Hand-made answers against truths that can be computed mentally.
#include <cmath>

#include "core/math/rng.h"
#include "fuzz/judge/judge.h"
#include "fuzz/judge/truth.h"
#include "oracles/core/core_engine.h"
#include "oracles/referee/work.h"
#include "scenarios/codec/case_codec.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

// Two unit-radius spheres with centres `distance` apart on the x axis.
Case spheres(double distance, Question q) {
  Case c;
  c.scene.shapes = {Sphere{1}};
  c.scene.bodies.resize(2);
  c.scene.bodies[1].pose.translation.x() = distance;
  c.queries = {{q, 0, 1}};
  return c;
}

EngineCard double_card() { return {"test", "", "", "", 0x1p-53, 64, "a page"}; }

Observation answered() {
  Observation o;
  o.outcome = Outcome::answered;
  return o;
}

Judgement judge_one(const Case& c, const Observation& o, const EngineCard& card = double_card(),
                    const ReceivedScene& received = {}) {
  fuzz::Truth truth(c.scene);
  return fuzz::judge(c, card, {received, {o}}, truth).at(0);
}

bool has(const Judgement& j, Fault f) {
  for (const auto& r : j.faults)
    if (r.fault == f) return true;
  return false;
}

Observation contact(const Vec3& n, double depth) {
  Observation o = answered();
  o.overlap = true;
  o.normal = n;
  o.depth = depth;
  return o;
}

}  // namespace

TEST_CASE("touching is overlap, and either verdict within tolerance of touching is accepted", "[judge]") {
  for (bool says : {true, false}) {
    Observation o = answered();
    o.overlap = says;
    CHECK(judge_one(spheres(2, Question::overlap), o).right());
    CHECK(judge_one(spheres(2 + 1e-15, Question::overlap), o).right());
  }
  Observation o = answered();
  o.overlap = false;
  CHECK(has(judge_one(spheres(1.9, Question::overlap), o), Fault::missed));
  o.overlap = true;
  CHECK(has(judge_one(spheres(2.1, Question::overlap), o), Fault::ghost));
}

TEST_CASE("a contact must separate, and its depth must be minimal", "[judge]") {
  const Case c = spheres(1.5, Question::contact);
  CHECK(judge_one(c, contact({1, 0, 0}, 0.5)).right());
  CHECK(has(judge_one(c, contact({1, 0, 0}, 0.4)), Fault::infeasible));
  CHECK(has(judge_one(c, contact({1, 0, 0}, 0.6)), Fault::depth_excess));
  CHECK(has(judge_one(c, contact({-1, 0, 0}, 0.5)), Fault::infeasible));
  // Along y the spheres separate after moving by 2: valid but poor.
  const auto poor = judge_one(c, contact({0, 1, 0}, 2));
  CHECK(has(poor, Fault::not_minimal));
  CHECK_FALSE(has(poor, Fault::infeasible));
  CHECK(has(judge_one(c, contact({0, 0, 0}, 0.5)), Fault::normal_not_unit));
  CHECK(has(judge_one(c, contact({NAN, 0, 0}, 0.5)), Fault::normal_not_unit));
  CHECK(has(judge_one(c, contact({1, 0, 0}, NAN)), Fault::no_number));
}

TEST_CASE("a depth along a poor normal is infeasible only if the bodies still overlap after it", "[judge]") {
  const Case c = spheres(1.5, Question::contact);
  // Planes with this normal separate the spheres after 1.1; moved along it by 0.7, they touch.
  const Vec3 poor(0.6, 0.8, 0);
  const Judgement apart = judge_one(c, contact(poor, 0.8));
  CHECK(has(apart, Fault::not_minimal));
  CHECK_FALSE(has(apart, Fault::infeasible));
  const Judgement deep = judge_one(c, contact(poor, 0.6));
  CHECK(has(deep, Fault::not_minimal));
  REQUIRE(has(deep, Fault::infeasible));
  CHECK(std::ranges::any_of(deep.faults, [](const FaultReport& f) {
    return f.words == "moving by the stated depth 0.6 along the stated normal leaves 0.0790627 of overlap";
  }));
}

TEST_CASE("a normal and a depth that are each within the tolerance are right together", "[judge]") {
  // The depth is 0.04 less than the least, and 0.12 less than planes with this normal need.
  const double cosine = 1 - 0.08 / 1.5;
  Observation o = contact({cosine, std::sqrt(1 - cosine * cosine), 0}, 0.46);
  o.claimed_tolerance = 0.1;
  CHECK(judge_one(spheres(1.5, Question::contact), o).right());
  o.claimed_tolerance = 0.03;
  CHECK(has(judge_one(spheres(1.5, Question::contact), o), Fault::infeasible));
}

TEST_CASE("a normal whose length prints like 1 is told by its error", "[judge]") {
  const Judgement near = judge_one(spheres(1.5, Question::contact), contact({1 - 0x1p-36, 0, 0}, 0.5));
  REQUIRE(has(near, Fault::normal_not_unit));
  CHECK(near.faults.at(0).words == "the normal's length is 1.5e-11 off 1");
  CHECK(judge_one(spheres(1.5, Question::contact), contact({0.5, 0, 0}, 0.5)).faults.at(0).words ==
        "the normal has length 0.5");
}

TEST_CASE("a wrong distance that prints like the true one is told by its error", "[judge]") {
  Observation o = answered();
  o.distance = 1 + 0x1p-36;
  const Judgement close = judge_one(spheres(3, Question::distance), o);
  REQUIRE(has(close, Fault::distance_off));
  CHECK(close.faults[0].words == "says 1; the signed distance is 1.5e-11 off that");
  o.distance = 1.5;
  CHECK(judge_one(spheres(3, Question::distance), o).faults.at(0).words ==
        "says 1.5; the signed distance is 1");
}

TEST_CASE("a coarser unit roundoff of one kind widens what is accepted for its pairs alone",
          "[judge][card]") {
  EngineCard card = double_card();
  card.unit_roundoffs = {{ShapeKind::mesh, 0x1p-24}, {ShapeKind::hull, 0x1p-24}};
  Observation o = answered();
  o.distance = 1 + 1e-6;
  Case c = spheres(3, Question::distance);
  CHECK(has(judge_one(c, o, card), Fault::distance_off));
  c.scene.shapes.push_back(make_hull({{-1, 0, 0}, {1, 1, 0}, {1, -1, 0}, {1, 0, 1}}));
  c.scene.bodies[1].shape = 1;
  CHECK(judge_one(c, o, card).right());
  CHECK(has(judge_one(c, o), Fault::distance_off));
  // In a scene, each pair for itself.
  c.scene.bodies.push_back(c.scene.bodies[0]);
  c.scene.bodies[0].pose.translation.x() = 1.5;
  c.scene.bodies[1].pose.translation.x() = 20;
  c.queries = {{Question::scene_contacts, -1, -1}};
  Observation contacts = answered();
  contacts.contacts = {{0, 2, {-1, 0, 0}, 0.5 + 1e-6}};
  CHECK(has(judge_one(c, contacts, card), Fault::depth_excess));
  contacts.contacts[0].normal = {-1, 2e-8, 0};
  CHECK(has(judge_one(c, contacts, card), Fault::depth_excess));
}

TEST_CASE(
    "a contact offset lets an engine report contacts of bodies that are apart, with minus their distance",
    "[judge][card]") {
  EngineCard card = double_card();
  card.contact_offset = 0.02;
  Observation says = answered();
  says.overlap = true;
  const auto at = [](double gap, Question q) { return spheres(2 + gap, q); };
  CHECK(judge_one(at(0.015, Question::overlap), says, card).right());
  CHECK(has(judge_one(at(0.015, Question::overlap), says), Fault::ghost));
  CHECK(has(judge_one(at(0.021, Question::overlap), says, card), Fault::ghost));
  says.overlap = false;
  CHECK(has(judge_one(at(-0.015, Question::overlap), says, card), Fault::missed));
  CHECK(judge_one(at(0.015, Question::contact), contact({1, 0, 0}, -0.015), card).right());
  CHECK(has(judge_one(at(0.015, Question::contact), contact({1, 0, 0}, -0.015)), Fault::ghost));
  CHECK(has(judge_one(at(0.015, Question::contact), contact({1, 0, 0}, -0.005), card), Fault::depth_excess));
  CHECK(has(judge_one(at(0.015, Question::contact), contact({1, 0, 0}, -0.018), card), Fault::infeasible));
  CHECK(has(judge_one(at(0.015, Question::contact), contact({0, 1, 0}, 2), card), Fault::not_minimal));
  CHECK(has(judge_one(at(0.021, Question::contact), contact({1, 0, 0}, -0.021), card), Fault::ghost));
  // Bodies that overlap are judged as ever.
  CHECK(has(judge_one(at(-0.5, Question::contact), contact({1, 0, 0}, 0.49), card), Fault::infeasible));
  Observation with_point = contact({1, 0, 0}, -0.015);
  with_point.manifold = {{{1.0075, 0, 0}, -0.015}};
  CHECK(judge_one(at(0.015, Question::contact), with_point, card).right());
  with_point.manifold[0].position.x() = 1.04;
  CHECK(has(judge_one(at(0.015, Question::contact), with_point, card), Fault::point_off));
  Case scene = at(0.015, Question::scene_contacts);
  Observation contacts = answered();
  contacts.contacts = {{0, 1, {1, 0, 0}, -0.015}};
  CHECK(judge_one(scene, contacts, card).right());
  CHECK(has(judge_one(scene, contacts), Fault::ghost));
  // Believed only with a source, and not beside the user's own tolerance.
  for (const char* source : {"", "--error"}) {
    card.source = source;
    says.overlap = true;
    CHECK(has(judge_one(at(0.015, Question::overlap), says, card), Fault::ghost));
  }
  // Above 1e-2 L it is shown; as wide as the pair, nothing is judged.
  card = double_card();
  card.contact_offset = 0.1;
  CHECK(judge_one(at(0.015, Question::overlap), says, card).wide_claim == 0.1);
  card.contact_offset = 10;
  CHECK(judge_one(at(0.015, Question::overlap), says, card).ruling() == Ruling::not_judged);
}

TEST_CASE("a sweep may stop within its skin, and not later for it", "[judge][toi][card]") {
  Case c = spheres(4, Question::time_of_impact);
  c.scene.bodies[1].motion = Motion{{-4, 0, 0}, Vec3::Zero()};  // the gap is 2 - 4 t
  EngineCard card = double_card();
  card.sweep_skin = 0.1;
  Observation o = answered();
  for (const auto& [t, right] : {std::pair(0.5, true), {0.48, true}, {0.47, false}, {0.51, false}}) {
    o.toi = t;
    CHECK(judge_one(c, o, card).right() == right);
    CHECK(judge_one(c, o).right() == (t == 0.5));
  }
  // Passing within the skin may be a hit; passing farther away is none.
  c.scene.bodies[0].pose.translation.y() = 2.05;
  o.toi = 1;
  CHECK(judge_one(c, o, card).right());
  CHECK(has(judge_one(c, o), Fault::ghost));
  c.scene.bodies[0].pose.translation.y() = 2.2;
  CHECK(has(judge_one(c, o, card), Fault::ghost));
}

TEST_CASE("a biased routine may choose a direction that needs that much more, and states its depth right",
          "[judge][card]") {
  Case c;  // two cubes of side 2; A's faces need 1 along x and 1.04 along y
  c.scene.shapes = {Box{{1, 1, 1}}};
  c.scene.bodies.resize(2);
  c.scene.bodies[1].pose.translation = {1, 0.96, 0};
  c.queries = {{Question::contact, 0, 1}};
  EngineCard card = double_card();
  card.depth_biases = {{ShapeKind::box, ShapeKind::box, 0.05}};
  CHECK(judge_one(c, contact({0, 1, 0}, 1.04), card).right());
  CHECK(has(judge_one(c, contact({0, 1, 0}, 1.04)), Fault::not_minimal));
  CHECK(has(judge_one(c, contact({0, 1, 0}, 1), card), Fault::infeasible));
  c.scene.bodies[1].pose.translation = {1, 0.94, 0};
  CHECK(has(judge_one(c, contact({0, 1, 0}, 1.06), card), Fault::not_minimal));
  c.scene.bodies[1].pose.translation = {1, 0.96, 0};
  card.depth_biases = {{ShapeKind::box, ShapeKind::hull, 0.05}};
  CHECK(has(judge_one(c, contact({0, 1, 0}, 1.04), card), Fault::not_minimal));
}

TEST_CASE("every best normal of concentric spheres is right", "[judge]") {
  const Case c = spheres(0, Question::contact);
  for (const Vec3& n : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0.6, 0, 0.8)})
    CHECK(judge_one(c, contact(n, 2)).right());
}

TEST_CASE("only a claimed tolerance widens what is accepted", "[judge]") {
  Observation o = answered();
  o.distance = 0.5 + 1e-4;
  CHECK(has(judge_one(spheres(2.5, Question::distance), o), Fault::distance_off));
  o.claimed_tolerance = 1e-3;
  CHECK(judge_one(spheres(2.5, Question::distance), o).right());
}

TEST_CASE("an engine's margin is rounded as its other lengths are, though it is larger than the bodies",
          "[judge]") {
  // Spheres that touch, of a size at which one unit in the last place of the margin is more than 64 roundings
  // of L.
  const double tiny = 0x1p-20, margin = 0.04;
  Case c = spheres(2 * tiny, Question::contact);
  for (auto& s : c.scene.shapes) std::get<Sphere>(s).radius = tiny;
  Observation o = contact(Vec3(1, 0, 0), std::nextafter(margin, 1));
  o.claimed_tolerance = margin;
  CHECK(judge_one(c, o).faults.empty());
  o.depth = margin * (1 + 0x1p-40);
  CHECK(has(judge_one(c, o), Fault::depth_excess));
}

TEST_CASE("an error that is right for the scene received is blamed on representation", "[judge]") {
  const Case c = spheres(2.1, Question::overlap);
  Observation o = answered();
  o.overlap = true;
  ReceivedScene received;
  received.bodies.resize(2);
  received.bodies[1] = Placement{Mat3::Identity(), Vec3(1.99, 0, 0)};
  CHECK(judge_one(c, o, double_card(), received).blame == Blame::representation);
  CHECK(judge_one(c, o).blame == Blame::algorithm);
}

TEST_CASE("an engine that holds another hull is also judged for that one", "[judge]") {
  // A flat triangle, cooked to a prism of 0.01 about it, and a ball 0.005 above it.
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  std::vector<Vec3> cooked;
  for (const Vec3& v : corners)
    for (const double z : {-0.01, 0.01}) cooked.emplace_back(v.x(), v.y(), z);
  Case c = spheres(0, Question::overlap);
  c.scene.shapes.push_back(make_hull(corners));
  c.scene.bodies[0].shape = 1;
  c.scene.bodies[1].pose.translation = Vec3(0.2, 0.2, 1.005);
  Observation o = answered();
  o.overlap = true;
  ReceivedScene received;
  received.shapes.resize(2);
  received.shapes[1] = make_hull(cooked);
  const auto told = judge_one(c, o, double_card(), received);
  CHECK(has(told, Fault::ghost));
  CHECK(told.blame == Blame::representation);
  CHECK(told.holds_other_shape);
  // The same for another kind. An answer that is wrong for the shape held is the algorithm's fault.
  received.shapes[1] = Box{Vec3(1, 1, 0.01)};
  CHECK(judge_one(c, o, double_card(), received).holds_other_shape);
  received.shapes[1] = Box{Vec3(1, 1, 0.001)};
  const auto wrong = judge_one(c, o, double_card(), received);
  CHECK(wrong.blame == Blame::algorithm);
  CHECK_FALSE(wrong.holds_other_shape);
}

TEST_CASE("the bound on the distance between the received and the given hull holds", "[judge]") {
  Rng rng(3);
  int other_counts = 0;
  const auto points = [&](std::uint64_t n) {
    std::vector<Vec3> p;
    for (std::uint64_t i = 0; i < n; ++i)
      p.emplace_back(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
    return p;
  };
  const auto reach = [](const Shape& s, const Vec3& n) {
    double most = -HUGE_VAL;
    for (const Vec3& v : std::get<Hull>(s).vertices) most = std::max(most, n.dot(v));
    return most;
  };
  for (int i = 0; i < 300; ++i) {
    Case c = spheres(5, Question::overlap);
    c.scene.shapes[0] = make_hull(points(4 + rng.below(5)));
    ReceivedScene received;
    received.shapes = {make_hull(points(4 + rng.below(5)))};
    other_counts += fuzz::is_other_shape(c.scene.shapes[0], *received.shapes[0]);
    fuzz::Truth truth(c.scene);
    const double bound = truth.displacement(truth.frame_of(received));
    for (const Vec3& n : points(50)) {
      const Vec3 u = n.normalized();
      REQUIRE(std::abs(reach(c.scene.shapes[0], u) - reach(*received.shapes[0], u)) <= bound);
    }
  }
  CHECK(other_counts > 100);
  // There is no bound between two kinds. A received shape that is not finite counts as the given one.
  Case c = spheres(5, Question::overlap);
  fuzz::Truth truth(c.scene);
  ReceivedScene box, nan;
  box.shapes = {Box{Vec3(1, 1, 1)}};
  nan.shapes = {Sphere{std::nan("")}};
  CHECK(std::isinf(truth.displacement(truth.frame_of(box))));
  CHECK(truth.frame_of(nan) == 0);
}

TEST_CASE("witness points of bodies with unknown depth are checked only as far as known", "[judge]") {
  const Case c = load_case(TS_SOURCE_DIR "/tests/referee/cases/wide_depth_bracket.json");
  fuzz::Truth truth(c.scene);
  REQUIRE(truth.pair(0, 0, 1).gap.lo < -1);
  REQUIRE(truth.pair(0, 0, 1).gap.hi > -1);
  CoreEngine core;
  const auto answers = core.run({&c, 1});
  for (const Judgement& j : fuzz::judge(c, core.card(), answers[0], truth)) CHECK(j.faults.empty());
}

TEST_CASE("time of impact is judged by gaps", "[judge][toi]") {
  Case c = spheres(4, Question::time_of_impact);
  c.scene.bodies[1].motion = Motion{Vec3(-4, 0, 0), Vec3::Zero()};  // touches at t = 0.5
  Observation o = answered();
  o.toi = 0.5;
  CHECK(judge_one(c, o).right());
  o.toi = 0.45;
  CHECK(has(judge_one(c, o), Fault::early));
  o.toi = 0.55;
  CHECK(has(judge_one(c, o), Fault::late));
  o.toi.reset();
  CHECK(has(judge_one(c, o), Fault::missed));
  c.scene.bodies[1].motion->linear = Vec3(4, 0, 0);
  CHECK(judge_one(c, o).right());
  o.toi = 0.5;
  CHECK(has(judge_one(c, o), Fault::ghost));
}

namespace {

// A ball of radius 1/4 that falls onto a floor of two triangles: touches at t = 0.7 / speed.
Case ball_on_floor(double speed, double x = 0.5) {
  TriangleMesh floor;
  floor.vertices = {{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}};
  floor.triangles = {{0, 1, 2}, {0, 2, 3}};
  Case c;
  c.scene.shapes = {floor, Sphere{0.25}};
  c.scene.bodies.resize(2);
  c.scene.bodies[1].shape = 1;
  c.scene.bodies[1].pose.translation = {x, 0.25, 0.95};
  c.scene.bodies[1].motion = Motion{Vec3(0, 0, -speed), Vec3::Zero()};
  c.queries = {{Question::time_of_impact, 0, 1}};
  return c;
}

Observation impact_at(std::optional<double> t) {
  Observation o = answered();
  o.toi = t;
  return o;
}

}  // namespace

TEST_CASE("late and missed impacts with a mesh are wrong by the depth in one triangle", "[judge][toi]") {
  const double speed = 7.0 / 3, t = 0.3;  // touches at 0.3
  for (const bool swap : {false, true}) {
    Case c = ball_on_floor(speed);
    if (swap) std::swap(c.scene.bodies[0], c.scene.bodies[1]);
    CHECK(judge_one(c, impact_at(t)).right());
    CHECK(judge_one(c, impact_at(t + 1e-15)).right());
    const Judgement late = judge_one(c, impact_at(t + 1.0 / 30));
    REQUIRE(has(late, Fault::late));
    CHECK(std::abs(late.faults.front().error - speed / 30) < 1e-12);
    CHECK(has(judge_one(c, impact_at(t + 1e-12)), Fault::late));
    // Long past the floor and clear of it again.
    CHECK_FALSE(judge_one(c, impact_at(0.99)).right());
    const Judgement none = judge_one(c, impact_at(std::nullopt));
    REQUIRE(has(none, Fault::missed));
    CHECK(std::abs(none.faults.front().error - 0.25) < 1e-9);
    CHECK(has(judge_one(c, impact_at(0.2)), Fault::early));
    // A claimed tolerance is a gap, not a time.
    Observation within = impact_at(t + 0.02 / speed);
    within.claimed_tolerance = 0.0201;
    CHECK(judge_one(c, within).right());
    within.claimed_tolerance = 0.0199;
    CHECK(has(judge_one(c, within), Fault::late));
  }
}

TEST_CASE("a graze of a mesh may be denied, and so may a touch at the very end", "[judge][toi]") {
  Case graze = ball_on_floor(0);
  graze.scene.bodies[1].pose.translation = {0.5, 0.25, 0.25};
  graze.scene.bodies[1].motion = Motion{Vec3(0, 0, 0), Vec3(1, 2, 3)};
  for (const auto t : {std::optional<double>(), std::optional(0.5), std::optional(0.0)})
    CHECK(judge_one(graze, impact_at(t)).right());
  graze.scene.bodies[1].motion->linear = Vec3(1, 0.5, 0);
  for (const auto t : {std::optional<double>(), std::optional(0.5), std::optional(0.0)})
    CHECK(judge_one(graze, impact_at(t)).right());
  CHECK(judge_one(ball_on_floor(0.7), impact_at(std::nullopt)).right());
  CHECK(judge_one(ball_on_floor(0.7), impact_at(1)).right());
  // Beside the floor's edge, by more than the radius.
  CHECK(judge_one(ball_on_floor(2, 5.26), impact_at(std::nullopt)).right());
  CHECK(has(judge_one(ball_on_floor(2, 5.26), impact_at(0.5)), Fault::ghost));
}

TEST_CASE("a miss is wrong for a box that rotates through a mesh while translating", "[judge][toi]") {
  Case c = ball_on_floor(2);
  c.scene.shapes[1] = Box{{0.25, 0.25, 0.25}};
  c.scene.bodies[1].motion->angular = Vec3(3, -1, 2);
  fuzz::Truth truth(c.scene);
  const referee::TimeTruth hit = truth.motion(0, 0, 1);
  REQUIRE(hit.verdict == referee::TimeTruth::Verdict::hit);
  CHECK(judge_one(c, impact_at(hit.t_lo)).right());
  CHECK(has(judge_one(c, impact_at(hit.t_hi + 1e-6)), Fault::late));
  CHECK(has(judge_one(c, impact_at(std::nullopt)), Fault::missed));
}

TEST_CASE("candidates of a step: every pair that meets on the way, not only those at the start",
          "[judge][pairs]") {
  Case c = ball_on_floor(2);
  c.scene.bodies.push_back(c.scene.bodies[1]);
  c.scene.bodies[2].pose.translation.z() = 3;  // follows, but meets nothing
  c.scene.bodies.push_back(c.scene.bodies[1]);
  c.scene.bodies[3].pose.translation = {9, 9, 0};
  c.scene.bodies[3].motion = Motion{Vec3::Zero(), Vec3(0, 9, 0)};
  c.queries = {{Question::swept_candidates, -1, -1}};
  const auto answer = [](std::vector<BodyPair> pairs) {
    Observation o = answered();
    o.candidate_pairs = {std::move(pairs)};
    return o;
  };
  CHECK(judge_one(c, answer({{1, 0}})).right());
  const Judgement more = judge_one(c, answer({{0, 1}, {0, 2}, {2, 1}}));
  CHECK(more.right());
  CHECK(more.pairs_true == 1);
  CHECK(more.pairs_reported == 3);
  const Judgement none = judge_one(c, answer({{0, 2}}));
  REQUIRE(has(none, Fault::missed));
  CHECK(std::abs(none.faults.front().error - 0.25) < 1e-9);
  Observation nothing = answered();
  CHECK(has(judge_one(c, nothing), Fault::missed));
  CHECK(has(judge_one(c, answer({{0, 1}, {1, 4}})), Fault::stale));
  // At the start, no bodies overlap.
  c.queries = {{Question::candidates, -1, -1}};
  CHECK(judge_one(c, answer({})).right());
  // A touch in passing counts too.
  c.queries = {{Question::swept_candidates, -1, -1}};
  c.scene.bodies[1].motion->linear = Vec3(0, 0, -0.7);
  c.scene.bodies[1].pose.translation.z() = 0.75;
  c.scene.bodies[1].motion->linear.z() = -0.5;
  CHECK(has(judge_one(c, answer({})), Fault::missed));
}

TEST_CASE("candidate pairs: no tolerance for a missed touching pair; stale pairs are distinguished",
          "[judge][pairs]") {
  const Case c = spheres(2, Question::candidates);
  Observation o = answered();
  o.candidate_pairs = {{{1, 0}}};
  CHECK(judge_one(c, o).right());
  o.candidate_pairs = {{}};
  CHECK(has(judge_one(c, o), Fault::missed));
  o.candidate_pairs = {{{0, 1}, {0, 7}}};
  CHECK(has(judge_one(c, o), Fault::stale));
  o.candidate_pairs = {{{0, 1}, {0, 1}}};
  CHECK(judge_one(c, o).pairs_duplicate == 1);
}

TEST_CASE("each pair of a chain of bodies is missed when it is not a candidate", "[judge][pairs]") {
  Case c = spheres(1.5, Question::candidates);
  c.scene.bodies.resize(6);
  for (std::size_t i = 0; i < 6; ++i) c.scene.bodies[i].pose.translation.x() = 1.5 * static_cast<double>(i);
  const std::vector<BodyPair> all{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}};
  Observation o = answered();
  o.candidate_pairs = {all};
  CHECK(judge_one(c, o).right());
  for (std::size_t missing = 0; missing < all.size(); ++missing) {
    o.candidate_pairs = {all};
    o.candidate_pairs[0].erase(o.candidate_pairs[0].begin() + static_cast<std::ptrdiff_t>(missing));
    const Judgement j = judge_one(c, o);
    REQUIRE(j.faults.size() == 1);
    CHECK(j.faults[0].fault == Fault::missed);
    CHECK(BodyPair(j.faults[0].a, j.faults[0].b) == all[missing]);
  }
}

namespace {

// A unit ball and the one triangle below its centre; `below` 1: they touch.
Case ball_on_triangle(double below, Question q) {
  Case c;
  c.scene.shapes = {Sphere{1}, TriangleMesh{{{-4, -4, 0}, {4, -4, 0}, {0, 4, 0}}, {{0, 1, 2}}}};
  c.scene.bodies.resize(2);
  c.scene.bodies[1].shape = 1;
  c.scene.bodies[1].pose.translation.z() = -below;
  c.queries = {{q, 0, 1}};
  return c;
}

}  // namespace

TEST_CASE("an invalid normal is wrong even when the bodies are apart by less than the tolerance", "[judge]") {
  const Case apart = spheres(2 + 1e-15, Question::contact);
  CHECK(judge_one(apart, contact({1, 0, 0}, 0)).right());
  CHECK(has(judge_one(apart, contact({0, 0, 0}, 0)), Fault::normal_not_unit));
  CHECK(has(judge_one(apart, contact({NAN, 0, 0}, 0)), Fault::normal_not_unit));
  CHECK(has(judge_one(apart, contact({2, 0, 0}, 0)), Fault::normal_not_unit));
  CHECK(has(judge_one(apart, contact({1, 0, 0}, NAN)), Fault::no_number));
  CHECK(has(judge_one(apart, contact({1, 0, 0}, 0.5)), Fault::depth_excess));
  CHECK(has(judge_one(apart, contact({-1, 0, 0}, 0)), Fault::not_minimal));
  Observation wide = contact({0, 0, 0}, 0);
  wide.claimed_tolerance = 0.5;
  CHECK(has(judge_one(spheres(2.25, Question::contact), wide), Fault::normal_not_unit));
  wide.normal = Vec3(1, 0, 0);
  CHECK(judge_one(spheres(2.25, Question::contact), wide).right());
  wide.manifold = {{{40, 0, 0}, 0}};
  CHECK(has(judge_one(spheres(2.25, Question::contact), wide), Fault::point_off));
}

TEST_CASE("a contact with a surface is judged as far as possible; the rest is not judged", "[judge][mesh]") {
  const Case c = ball_on_triangle(0.75, Question::contact);
  const auto stated = judge_one(c, contact({0, 0, -1}, 0.25));
  CHECK(stated.ruling() == Ruling::not_judged);
  CHECK(stated.unjudged_by_definition());
  CHECK_FALSE(stated.right());
  CHECK(has(judge_one(c, contact({0, 0, 0}, 0.25)), Fault::normal_not_unit));
  CHECK(has(judge_one(c, contact({0, 0, -1}, NAN)), Fault::no_number));
  CHECK(has(judge_one(c, contact({0.6, 0, 0.8}, -0.107)), Fault::infeasible));
  CHECK(has(judge_one(c, contact({0, 0, -1}, 2)), Fault::depth_excess));
  Observation o = contact({0, 0, -1}, 0.25);
  o.manifold = {{{0, 0, -3}, 0.25}};
  CHECK(has(judge_one(c, o), Fault::point_off));
  Observation verdict = answered();
  verdict.overlap = true;  // reports only the verdict
  CHECK(judge_one(c, verdict).right());

  Observation d = answered();
  d.distance = 0;
  CHECK(judge_one(ball_on_triangle(0.75, Question::distance), d).right());
  d.distance = -7;
  CHECK(judge_one(ball_on_triangle(0.75, Question::distance), d).ruling() == Ruling::not_judged);
  CHECK(has(judge_one(ball_on_triangle(2, Question::distance), d), Fault::ghost));
}

namespace {

// A floor of 8 x 8 tiles of two triangles over [-4, 4]², and a ball that reaches `depth` below it.
Case ball_on_tiles(double depth, double slope = 0) {
  TriangleMesh m;
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; j <= 8; ++j) m.vertices.push_back({i - 4.0, j - 4.0, slope * std::max(0, i - 4)});
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) {
      const int a = 9 * i + j, b = a + 9;
      m.triangles.push_back({a, b, b + 1});
      m.triangles.push_back({a, b + 1, a + 1});
    }
  Case c;
  c.scene.shapes = {m, Sphere{1}};
  c.scene.bodies.resize(2);
  c.scene.bodies[0].is_static = true;
  c.scene.bodies[1].shape = 1;
  c.scene.bodies[1].pose.translation = {0.125, 0.5, 1 - depth};
  c.queries = {{Question::contact, 0, 1}};
  return c;
}

}  // namespace

TEST_CASE("on a flat part of a mesh the normal is judged: that of an inner edge is wrong", "[judge][mesh]") {
  const Case c = ball_on_tiles(0.0625);
  // From the edge x = 0 to the ball's centre.
  const Vec3 of_edge = Vec3(0.125, 0, 0.9375).normalized();
  const Judgement wrong = judge_one(c, contact(of_edge, 0.05));
  REQUIRE(has(wrong, Fault::inner_edge));
  CHECK(wrong.ruling() == Ruling::wrong);
  CHECK(wrong.blame == Blame::algorithm);
  CHECK(wrong.faults[0].error > 0.0625 * (1 / of_edge.z() - 1) - 1e-12);
  CHECK(wrong.faults[0].error < 0.0625 * (1 / of_edge.z() - 1) + 1e-12);
  CHECK(wrong.faults[0].certificate.offset > 0.0625 - 1e-12);
  for (const Vec3& n : {Vec3(0, 0, 1), Vec3(0, 0, -1)}) {
    const Judgement right = judge_one(c, contact(n, 0.0625));
    CHECK(right.faults.empty());
    REQUIRE(right.unjudged.size() == 1);
    CHECK(right.unjudged[0].claim == "depth");
  }
  Observation normal_alone = contact({0, 0, 1}, 0);
  normal_alone.depth.reset();
  CHECK(judge_one(c, normal_alone).right());

  // Where the floor bends within reach, edges have normals of their own.
  const Judgement bent = judge_one(ball_on_tiles(0.0625, 0.01), contact(of_edge, 0.05));
  CHECK(bent.ruling() == Ruling::not_judged);
  CHECK(bent.unjudged[0].claim == "normal and depth");

  // An engine that says so takes the triangles apart, if its card names the page.
  EngineCard apart = double_card();
  apart.separate_triangles = true;
  const Judgement documented = judge_one(c, contact(of_edge, 0.05), apart);
  CHECK(documented.faults.empty());
  CHECK(documented.ruling() == Ruling::not_judged);
  CHECK(documented.unjudged_by_definition());
  CHECK(documented.unjudged[0].claim.find("normal at an inner edge") == 0);
  apart.source.clear();
  CHECK(has(judge_one(c, contact(of_edge, 0.05), apart), Fault::inner_edge));

  Case scene = c;
  scene.queries = {{Question::scene_contacts, -1, -1}};
  Observation o = answered();
  o.contacts = {{0, 1, of_edge, 0.05}};
  CHECK(has(judge_one(scene, o), Fault::inner_edge));
}

TEST_CASE("each contact of a scene is judged by its numbers; one with a surface can be missed too",
          "[judge][mesh]") {
  const Case c = ball_on_triangle(0.75, Question::scene_contacts);
  Observation o = answered();
  CHECK(has(judge_one(c, o), Fault::missed));
  o.contacts = {{0, 1, {0, 0, -1}, 0.25}};
  CHECK(judge_one(c, o).ruling() == Ruling::not_judged);
  o.contacts.push_back({0, 1, {0, 0, 0}, 0.1});  // not the deepest
  CHECK(has(judge_one(c, o), Fault::normal_not_unit));
  o.contacts.back() = {0, 1, {0, 0, -1}, NAN};
  CHECK(has(judge_one(c, o), Fault::no_number));
}

TEST_CASE("questions too expensive for the referee are undecided: neither wrong nor right", "[judge]") {
  const referee::WorkLimit nothing(0);
  Observation o = answered();
  o.overlap = true;
  o.distance = 7;
  o.normal = Vec3(0, 1, 0);
  o.depth = 3;
  o.toi = 0.5;
  for (const Question q :
       {Question::overlap, Question::distance, Question::contact, Question::time_of_impact}) {
    Case c = spheres(2.5, q);
    c.scene.bodies[1].motion = Motion{Vec3(-1, 0, 0), Vec3::Zero()};
    const auto j = judge_one(c, o);
    CAPTURE(to_string(q));
    CHECK(j.ruling() == Ruling::undecided);
  }
}

TEST_CASE("every part of a contact that an engine states is judged", "[judge]") {
  Observation o = answered();
  o.overlap = true;
  o.normal = Vec3(0, 1, 0);
  CHECK(has(judge_one(spheres(1.5, Question::contact), o), Fault::not_minimal));
  o.normal.reset();
  o.depth = 0.4;
  CHECK(has(judge_one(spheres(1.5, Question::contact), o), Fault::infeasible));
  o.depth = 0.6;
  CHECK(has(judge_one(spheres(1.5, Question::contact), o), Fault::depth_excess));
  o.depth = 0.5;
  CHECK(judge_one(spheres(1.5, Question::contact), o).right());
  Observation d = answered();
  d.distance = 0.5;
  d.overlap = true;
  CHECK(has(judge_one(spheres(2.5, Question::distance), d), Fault::ghost));
  Observation points = answered();
  points.overlap = false;
  points.witness = {Vec3(1, 0, 0), Vec3(7, 0, 0)};
  CHECK(has(judge_one(spheres(2.5, Question::distance), points), Fault::witness_off));
}

TEST_CASE("a claimed tolerance is accepted within limits, and shown when it is wide", "[judge]") {
  Observation o = answered();
  o.distance = 0.5;
  const Case c = spheres(2.5, Question::distance);  // L = 2.5
  const auto with = [&](double claim) {
    o.claimed_tolerance = claim;
    return judge_one(c, o);
  };
  CHECK(with(0.02).wide_claim == 0);
  CHECK(with(0.05).right());
  CHECK(with(0.05).wide_claim == 0.05);
  CHECK(with(0.05).wide_claim_in_l == 0.02);
  for (const double claim : {2.5, 1e300}) {
    CHECK(with(claim).ruling() == Ruling::not_judged);
    CHECK_FALSE(with(claim).unjudged_by_definition());
  }
  for (const double claim : {-1.0, double(NAN), double(INFINITY)}) CHECK(has(with(claim), Fault::no_number));
  o.distance = 0.6;
  o.claimed_tolerance = 0.5;
  CHECK(judge_one(c, o).right());
  EngineCard nameless = double_card();
  nameless.source.clear();
  CHECK(has(judge_one(c, o, nameless), Fault::distance_off));
}

TEST_CASE("L is the largest of lengths, coordinates and separation", "[judge][scale]") {
  const auto scale = [](const Case& c) { return scale_of_pair(c.scene, 0, 1); };
  CHECK(scale(spheres(0.5, Question::overlap)) == 2);  // a diameter
  CHECK(scale(spheres(7, Question::overlap)) == 7);
  Case c = spheres(5, Question::overlap);
  c.scene.bodies[0].pose.translation.x() = -5;
  CHECK(scale(c) == 10);
  c.scene.shapes = {Box{{1, 8, 2}}};
  CHECK(scale(c) == 16);
  c.scene.bodies[1].motion = Motion{Vec3(30, 0, 0), Vec3::Zero()};
  CHECK(scale(c) == 40);
}

TEST_CASE("an answer without a number, and every kind of failure, is a finding", "[judge]") {
  CHECK(has(judge_one(spheres(2.5, Question::overlap), answered()), Fault::no_number));
  for (Outcome out : {Outcome::crashed, Outcome::timed_out, Outcome::threw, Outcome::not_converged}) {
    Observation o;
    o.outcome = out;
    CHECK(has(judge_one(spheres(2.5, Question::overlap), o), Fault::failed));
  }
  Observation cannot;
  CHECK(judge_one(spheres(2.5, Question::overlap), cannot).faults.empty());
}

TEST_CASE("coverage is the part of the true contact region that a manifold spans", "[judge]") {
  Case c = spheres(0, Question::contact);
  c.scene.shapes = {Box{{1, 1, 1}}};
  c.scene.bodies[1].pose.translation = {0.5, 0, 1.75};  // the faces share 1.5 × 2
  Observation o = contact({0, 0, 1}, 0.25);
  const auto coverage = [&] { return judge_one(c, o).manifold_coverage; };
  CHECK_FALSE(coverage());
  const auto with = [&](std::vector<Vec3> points) {
    o.manifold.clear();
    for (const Vec3& p : points) o.manifold.push_back({p, 0.25});
    return coverage().value_or(-1);
  };
  CHECK(with({{-0.5, -1, 1}, {1, -1, 1}, {1, 1, 0.75}, {-0.5, 1, 1}}) == Approx(1));
  CHECK(with({{-0.5, -1, 1}, {1, -1, 1}, {1, 1, 1}}) == Approx(0.5));
  CHECK(with({{0, 0, 1}}) == 0);
  o.normal = Vec3(1, 0, 0);  // another question
  CHECK(with({{0, 0, 1}}) == -1);
}

TEST_CASE("an invalid received scene is blamed on representation and never crashes the judge", "[judge]") {
  const double nan = std::nan(""), inf = HUGE_VAL;
  const auto placed = [](const Vec3& t, double m = 1) { return Placement{m * Mat3::Identity(), t}; };
  const auto at = [&](const Placement& p) { return ReceivedScene{{std::nullopt, p}, {}}; };
  const Vec3 there(1.5, 0, 0);
  const ReceivedScene none[] = {at(placed({nan, 0, 0})), at(placed({inf, 0, 0})),   at(placed(there, nan)),
                                at(placed(there, -inf)), at(placed({1e300, 0, 0})), at(placed(there, 1e300)),
                                {{}, {Sphere{1e300}}},   {{}, {Sphere{inf}}},       {{}, {Sphere{nan}}},
                                {{}, {Sphere{-1}}}};
  Observation missed = answered();
  missed.overlap = false;
  Observation crashed;
  crashed.outcome = Outcome::crashed;
  for (const ReceivedScene& received : none) {
    for (const auto& [q, o] : {std::pair{Question::overlap, missed}, std::pair{Question::overlap, crashed},
                               std::pair{Question::contact, contact({0, 1, 0}, 0.1)}}) {
      const auto j = judge_one(spheres(1.5, q), o, double_card(), received);
      CHECK_FALSE(j.faults.empty());
      CHECK(j.blame == Blame::representation);
      CHECK(j.received_faults.empty());
    }
    CHECK(
        judge_one(spheres(1.5, Question::contact), contact({1, 0, 0}, 0.5), double_card(), received).right());
  }
  // A body outside the question does not change the blame.
  Case three = spheres(1.5, Question::overlap);
  three.scene.bodies.resize(3);
  const ReceivedScene third{{std::nullopt, std::nullopt, placed({nan, 0, 0})}, {}};
  CHECK(judge_one(three, missed, double_card(), third).blame == Blame::algorithm);
}

TEST_CASE("an invalid received mesh or half-space does not reach the referee", "[judge]") {
  Case c = spheres(0.5, Question::overlap);
  c.scene.shapes.push_back(TriangleMesh{{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, {{0, 1, 2}}});
  c.scene.bodies[1].shape = 1;
  Observation missed = answered();
  missed.overlap = false;
  TriangleMesh broken = std::get<TriangleMesh>(c.scene.shapes[1]);
  broken.vertices[1].y() = std::nan("");
  CHECK(judge_one(c, missed, double_card(), {{}, {std::nullopt, broken}}).blame == Blame::representation);
  c.scene.shapes[1] = HalfSpace{};
  CHECK(judge_one(c, missed, double_card(), {{}, {std::nullopt, HalfSpace{Vec3::Zero(), 1}}}).blame ==
        Blame::representation);
}
