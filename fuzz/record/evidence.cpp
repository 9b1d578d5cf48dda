#include "fuzz/record/evidence.h"

#include "fuzz/judge/truth.h"
#include "oracles/referee/impact_certificate.h"
#include "scenarios/case_codec.h"

namespace touchstone::fuzz {
namespace {

Motion motion_of(const Scene& s, int body) {
  return s.bodies[static_cast<std::size_t>(body)].motion.value_or(Motion{});
}

Json named(Json certificate, int a, int b, int step) {
  if (certificate.at("kind") == "none") return certificate;
  certificate["bodies"] = {a, b};
  if (step >= 0) certificate["step"] = step;
  return certificate;
}

Json exact_certificate_of(const Evidence& e) {
  const auto make = [&] { return exact_certificate(e.c.scene, e.question, e.a, e.b, e.step); };
  if (!e.shared) return make();
  const auto [it, is_new] =
      e.shared->try_emplace({e.question == Question::time_of_impact, e.a, e.b, e.step}, nullptr);
  if (is_new) it->second = make();
  return it->second;
}

Json certificate_of(const Evidence& e) {
  using Kind = referee::Certificate::Kind;
  const Kind k = e.certificate.kind;
  const bool verdict = k == Kind::separating_plane || k == Kind::common_point;
  if (verdict || e.question == Question::time_of_impact)
    if (Json j = exact_certificate_of(e); !j.is_null()) return j;
  const int n = static_cast<int>(e.c.scene.bodies.size());
  const bool names = e.a >= 0 && e.b >= 0 && e.a < n && e.b < n;
  return names ? named(referee::to_json(e.certificate), e.a, e.b, e.step) : referee::to_json(e.certificate);
}

}  // namespace

std::optional<referee::Placed> placed_at(const Scene& s, int body, int step) {
  if (body < 0 || body >= static_cast<int>(s.bodies.size())) return std::nullopt;
  const Body& b = s.bodies[static_cast<std::size_t>(body)];
  if (step < 0) return referee::Placed{&s.shape_of(body), b.pose};
  Truth truth(s);
  const auto& steps = truth.steps();
  if (step >= static_cast<int>(steps.size())) return std::nullopt;
  const auto& pose = steps[static_cast<std::size_t>(step)].pose[static_cast<std::size_t>(body)];
  return pose ? std::optional(referee::Placed{&s.shape_of(body), *pose}) : std::nullopt;
}

Json exact_certificate(const Scene& s, Question q, int a, int b, int step) {
  const auto x = placed_at(s, a, step), y = placed_at(s, b, step);
  if (!x || !y || a == b) return nullptr;
  if (q == Question::time_of_impact) {
    const Motion ma = motion_of(s, a), mb = motion_of(s, b);
    const auto c = referee::impact_certificate(*x, ma, *y, mb, referee::judge_motion(*x, ma, *y, mb));
    return c.claims_nothing() ? Json() : named(referee::to_json(c), a, b, step);
  }
  const auto c = referee::checkable_certificate(referee::judge_pair(*x, *y), *x, *y);
  return c.kind == referee::Certificate::Kind::none ? Json() : named(referee::to_json(c), a, b, step);
}

const Json& Evidence::json() const {
  if (made.is_null())
    made = {{"case", case_to_json(c)},
            {"observation", to_json(observation)},
            {"certificate", certificate_of(*this)},
            {"received", to_json(received)}};
  return made;
}

}  // namespace touchstone::fuzz
