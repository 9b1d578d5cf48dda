#include "oracles/core/core_engine.h"

#include "core/base/input_error.h"
#include "core/broad/catalog.h"
#include "core/impact/impact.h"
#include "core/math/roundoff.h"
#include "core/math/through_float.h"
#include "core/narrow/filtered/query.h"
#include "core/narrow/narrow_phase.h"
#include "core/tolerance.h"
#include "core/world/world.h"
#include "oracles/core/timed_answer.h"

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

void ask_overlap(const Scene& s, const Query& q, Arithmetic arithmetic, Observation& o) {
  const OverlapAnswer r = overlap(placed(s, q.a), placed(s, q.b), arithmetic);
  o.outcome = r.outcome;
  if (r.outcome == Outcome::answered) o.overlap = r.overlap;
}

void ask_distance(const Scene& s, const Query& q, Arithmetic arithmetic, Observation& o) {
  const DistanceAnswer r = distance(placed(s, q.a), placed(s, q.b), arithmetic);
  o.outcome = r.outcome;
  if (r.outcome != Outcome::answered) return;
  o.distance = r.distance;
  o.witness = r.witness;
  o.normal = r.normal;
}

void ask_contact(const Scene& s, const Query& q, Arithmetic arithmetic, Observation& o) {
  const ContactAnswer r = contact(placed(s, q.a), placed(s, q.b), arithmetic);
  o.outcome = r.outcome;
  if (r.outcome != Outcome::answered) return;
  o.overlap = r.overlap;
  if (!r.overlap) return;
  o.normal = r.normal;
  o.depth = r.depth;
  for (const ContactPoint& p : r.manifold) o.manifold.push_back({p.position, p.depth});
}

void ask_impact(const Scene& s, const Query& q, Observation& o) {
  const ImpactAnswer r = time_of_impact(moving(s, q.a), moving(s, q.b), ImpactDetail::time);
  o.outcome = r.outcome;
  if (r.outcome == Outcome::answered) o.toi = r.toi;
  if (r.outcome == Outcome::not_converged)
    o.detail = "no contact before t = " + std::to_string(r.clear_until);
}

void ask_candidates(const Scene& s, Observation& o) {
  const auto phase = broad::make_broad_phase(broad_phase_name);
  o.candidate_pairs = candidate_pairs(s, *phase);
  o.outcome = Outcome::answered;
}

void ask_swept_candidates(const Scene& s, Observation& o) {
  const auto phase = broad::make_broad_phase(broad_phase_name);
  o.candidate_pairs = {swept_candidate_pairs(s, *phase)};
  o.outcome = Outcome::answered;
}

void ask_scene_contacts(const Scene& s, Observation& o) {
  const auto phase = broad::make_broad_phase(broad_phase_name);
  const SceneContacts r = scene_contacts(s, *phase);
  o.outcome = r.outcome;
  for (const PairContact& c : r.contacts) o.contacts.push_back({c.a, c.b, c.contact.normal, c.contact.depth});
  if (r.unsupported > 0) o.detail = std::to_string(r.unsupported) + " pairs of unsupported shapes left out";
}

void ask(const Scene& s, const Query& q, Arithmetic arithmetic, Observation& o) {
  require_bodies(s, q);
  const bool narrow =
      q.question == Question::overlap || q.question == Question::distance || q.question == Question::contact;
  if (arithmetic == Arithmetic::float32 && !narrow) {
    o.outcome = Outcome::unsupported;
    o.detail = "the float core has a narrow phase only";
    return;
  }
  switch (q.question) {
    case Question::overlap:
      return ask_overlap(s, q, arithmetic, o);
    case Question::distance:
      return ask_distance(s, q, arithmetic, o);
    case Question::contact:
      return ask_contact(s, q, arithmetic, o);
    case Question::time_of_impact:
      return ask_impact(s, q, o);
    case Question::candidates:
      return ask_candidates(s, o);
    case Question::scene_contacts:
      return ask_scene_contacts(s, o);
    case Question::swept_candidates:
      return ask_swept_candidates(s, o);
  }
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
  card_.name = narrow_only ? "core-f32" : "core";
  card_.library = "Touchstone core";
  card_.version = "0.1.0";
  card_.settings =
      narrow_only
          ? "closed forms, GJK and EPA in float from pose to answer; no broad phase, no motion"
          : "closed forms, GJK and EPA in double, in extended precision where the error bound requires it; "
            "conservative advancement; broad phase " +
                std::string(broad_phase_name);
  card_.unit_roundoff = narrow_only ? float_roundoff : double_roundoff;
  card_.tau_factor = tolerance::core_tau_factor;
  card_.source = "core/tolerance.h: arithmetic alone, no margin";
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
