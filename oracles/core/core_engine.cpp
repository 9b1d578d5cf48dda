#include "oracles/core/core_engine.h"

#include "core/base/input_error.h"
#include "core/broad/catalog.h"
#include "core/impact/impact.h"
#include "core/math/roundoff.h"
#include "core/math/through_float.h"
#include "core/narrow/filtered/query.h"
#include "core/narrow/narrow_phase.h"
#include "core/world/world.h"
#include "oracles/core/core_answers.h"

namespace touchstone {
namespace {

constexpr std::string_view broad_phase_name = "automatic";

const Body& body_of(const Scene& s, int i) { return s.bodies[static_cast<std::size_t>(i)]; }
PlacedShape placed(const Scene& s, int i) { return {&s.shape_of(i), body_of(s, i).pose}; }
MovingShape moving(const Scene& s, int i) {
  return {&s.shape_of(i), body_of(s, i).pose, body_of(s, i).motion.value_or(Motion{})};
}

void require_bodies(const Scene& s, const Query& q) {
  if (!is_pair_question(q.question)) return;
  const int n = static_cast<int>(s.bodies.size());
  for (int i : {q.a, q.b})
    if (i < 0 || i >= n) throw InputError("query", "body " + std::to_string(i) + " is not in the scene");
}

// One case as the core answers it, in the given arithmetic.
struct Asked {
  const Scene& s;
  Arithmetic arithmetic;

  void overlap(const Query& q, Observation& o) const {
    store(touchstone::overlap(placed(s, q.a), placed(s, q.b), arithmetic), o);
  }
  void distance(const Query& q, Observation& o) const {
    const PlacedShape a = placed(s, q.a), b = placed(s, q.b);
    store(touchstone::distance(a, b, arithmetic), a, b, o);
  }
  void contact(const Query& q, Observation& o) const {
    const ContactAnswer r = touchstone::contact(placed(s, q.a), placed(s, q.b), arithmetic);
    store(r, r.manifold, o);
  }
  void time_of_impact(const Query& q, Observation& o) const {
    const ImpactAnswer r = touchstone::time_of_impact(moving(s, q.a), moving(s, q.b), ImpactDetail::time);
    o.outcome = r.outcome;
    if (r.outcome == Outcome::answered) o.toi = r.toi;
    if (r.outcome == Outcome::not_converged)
      o.detail = "no contact before t = " + std::to_string(r.clear_until);
  }
  void candidates(Observation& o) const {
    o.candidate_pairs = candidate_pairs(s, *broad::make_broad_phase(broad_phase_name));
    o.outcome = Outcome::answered;
  }
  void swept_candidates(Observation& o) const {
    o.candidate_pairs = {swept_candidate_pairs(s, *broad::make_broad_phase(broad_phase_name))};
    o.outcome = Outcome::answered;
  }
  void within(const Query& q, Observation& o) const {
    store(touchstone::within(placed(s, q.a), placed(s, q.b), s.margin, arithmetic), o);
  }
  void contact_within(const Query& q, Observation& o) const {
    const ContactAnswer r = touchstone::contact_within(placed(s, q.a), placed(s, q.b), s.margin, arithmetic);
    store(r, r.manifold, o);
  }
  void bounded_distance(const Query& q, Observation& o) const {
    store(touchstone::distance(placed(s, q.a), placed(s, q.b), s.margin, arithmetic), o);
  }
  void candidates_within(Observation& o) const {
    o.candidate_pairs = candidate_pairs_within(s, *broad::make_broad_phase(broad_phase_name));
    o.outcome = Outcome::answered;
  }
  void ray(const Query& q, Observation& o) const {
    store_ray(touchstone::time_of_impact(moving(s, q.a), moving(s, q.b), ImpactDetail::contact), o);
  }
  void scene_contacts(Observation& o) const {
    const SceneContacts r = touchstone::scene_contacts(s, *broad::make_broad_phase(broad_phase_name));
    o.outcome = r.outcome;
    store(r.contacts, r.unsupported, o);
  }
};

void ask(const Scene& s, const Query& q, Arithmetic arithmetic, Observation& o) {
  require_bodies(s, q);
  const bool narrow = is_pair_question(q.question) && !is_motion_question(q.question);
  if (arithmetic == Arithmetic::float32 && !narrow) {
    o = no_answer(Outcome::unsupported, "the float core has a narrow phase only");
    return;
  }
  Asked asked{s, arithmetic};
  answer_by_question(asked, q, o);
}

Observation observe(const Scene& s, const Query& q, Arithmetic arithmetic) {
  const auto answer = [&](Observation& o) { ask(s, q, arithmetic, o); };
  return is_pair_question(q.question) ? measured_answer(measure_ns(), answer) : timed_answer(answer);
}

// The scene as the float path sees it: every number is rounded, and the rounded quaternion defines the
// rotation.
void round_to_float(const Scene& s, ReceivedScene& r) {
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    const auto stand = narrow::filtered::rounded_pose<float>(s.bodies[i].pose);
    const Quat q{through_float(stand.x), through_float(stand.y), through_float(stand.z),
                 through_float(stand.w)};
    r.bodies[i] = Placement{rotation_matrix(q), through_float(s.bodies[i].pose.translation)};
  }
  for (std::size_t i = 0; i < s.shapes.size(); ++i) {
    Shape shape = s.shapes[i];
    std::visit(
        [&](auto& x) {
          for_each_field(x, [&](std::string_view, auto& v, Domain) {
            using T = std::remove_reference_t<decltype(v)>;
            if constexpr (std::is_same_v<T, double>) v = through_float(v);
            if constexpr (std::is_same_v<T, Vec3>) v = through_float(v);
            if constexpr (std::is_same_v<T, std::vector<Vec3>>)
              for (Vec3& p : v) p = through_float(p);
          });
        },
        shape);
    r.shapes[i] = std::move(shape);
  }
}

}  // namespace

CoreEngine::CoreEngine(Arithmetic arithmetic) : arithmetic_(arithmetic) {
  const bool narrow_only = arithmetic == Arithmetic::float32;
  card_ = narrow_only
              ? core_card("core-f32",
                          "closed forms, GJK and EPA in float from pose to answer; no broad phase, no motion")
              : core_card("core",
                          "closed forms, GJK and EPA in double, in extended precision where the error bound "
                          "requires it; conservative advancement; broad phase " +
                              std::string(broad_phase_name));
  if (narrow_only) card_.unit_roundoff = float_roundoff;
  card_.complete_manifolds = !narrow_only;
}

ReceivedScene CoreEngine::received(const Scene& scene) const {
  ReceivedScene r = NativeEngine::received(scene);
  if (arithmetic_ == Arithmetic::float32) round_to_float(scene, r);
  return r;
}

void CoreEngine::answer(const Case& c, const Tell& tell) {
  for (const Query& q : c.queries) tell(observe(c.scene, q, arithmetic_));
}

EnginePtr make_core_engine() { return std::make_unique<CoreEngine>(); }

}  // namespace touchstone
