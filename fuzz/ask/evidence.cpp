#include "fuzz/ask/evidence.h"

#include "fuzz/judge/truth.h"
#include "oracles/referee/referee.h"
#include "reports/record/stored.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/codec/scene_codec.h"
#include "scenarios/codec/value_codec.h"

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

Json exact_certificate_of(const Evidence& e, std::uint64_t index, CaseCertificates& found) {
  const auto [it, is_new] = found.try_emplace({index, is_of_motion(e.question), e.a, e.b, e.step}, nullptr);
  if (is_new) it->second = exact_certificate(e.c.scene, e.question, e.a, e.b, e.step);
  return it->second;
}

// For a missing or late impact: how deep the bodies are in each other at some time before it.
Json with_depth(Json certificate, const Evidence& e) {
  const double t = e.observation.toi.value_or(1);
  const auto a = placed_at(e.c.scene, e.a, e.step), b = placed_at(e.c.scene, e.b, e.step);
  const double clear = certificate.is_null() ? 0 : certificate.value("clear_until", 0.0);
  if (e.observation.outcome != Outcome::answered || !a || !b || e.a == e.b) return certificate;
  if (!(t > clear && t <= 1)) return certificate;
  const Motion ma = motion_of(e.c.scene, e.a), mb = motion_of(e.c.scene, e.b);
  const referee::TimeTruth truth = referee::judge_motion(*a, ma, *b, mb);
  const bool hit = truth.verdict == referee::TimeTruth::Verdict::hit;
  ImpactCertificate depth;
  add_overlap(depth, *a, ma, *b, mb, referee::deepest_before(*a, ma, *b, mb, t, hit ? truth.t_hi : 0));
  if (!depth.overlap) return certificate;
  if (certificate.is_null()) return named(touchstone::to_json(depth), e.a, e.b, e.step);
  certificate["overlap"] = touchstone::to_json(depth).at("overlap");
  return certificate;
}

constexpr const char* deferred_kind = "deferred";

// Depths and distances are certified by what the judge found already.
bool needs_exact_arithmetic(const Evidence& e) {
  using Kind = Certificate::Kind;
  const Kind k = e.certificate.kind;
  return is_of_motion(e.question) || k == Kind::separating_plane || k == Kind::common_point;
}

Json deferred(const Evidence& e) {
  return named({{"kind", deferred_kind},
                {"question", std::string(to_string(e.question))},
                {"found", touchstone::to_json(e.certificate)}},
               e.a, e.b, e.step);
}

// In a form that the checker accepts; null when there is none.
Json exact_form(const Evidence& e, std::uint64_t index, CaseCertificates& found) {
  if (is_of_motion(e.question)) return with_depth(exact_certificate_of(e, index, found), e);
  return needs_exact_arithmetic(e) ? exact_certificate_of(e, index, found) : Json();
}

Json with_names(const Json& certificate, const Evidence& e) {
  const int n = static_cast<int>(e.c.scene.bodies.size());
  const bool names = e.a >= 0 && e.b >= 0 && e.a < n && e.b < n;
  return names ? named(certificate, e.a, e.b, e.step) : certificate;
}

Json certificate_of(const Evidence& e, std::uint64_t index, CaseCertificates& found) {
  if (Json exact = exact_form(e, index, found); !exact.is_null()) return exact;
  return with_names(touchstone::to_json(e.certificate), e);
}

// Shapes that differ only by rounding are left out.
Json received_json(const Evidence& e) {
  Json j = to_json(e.received);
  const std::vector<Shape>& asked = e.c.scene.shapes;
  for (std::size_t i = 0; i < asked.size() && i < e.received.shapes.size(); ++i)
    if (const auto& held = e.received.shapes[i]; held && is_other_shape(asked[i], *held))
      j["shapes"].push_back({{"shape", i}, {"as", touchstone::to_json(*held)}});
  return j;
}

}  // namespace

std::optional<Placed> placed_at(const Scene& s, int body, int step) {
  if (body < 0 || body >= static_cast<int>(s.bodies.size())) return std::nullopt;
  const Body& b = s.bodies[static_cast<std::size_t>(body)];
  if (step < 0) return Placed{&s.shape_of(body), b.pose};
  Truth truth(s);
  const auto& steps = truth.steps();
  if (step >= static_cast<int>(steps.size())) return std::nullopt;
  const auto& pose = steps[static_cast<std::size_t>(step)].pose[static_cast<std::size_t>(body)];
  return pose ? std::optional(Placed{&s.shape_of(body), *pose}) : std::nullopt;
}

Json exact_certificate(const Scene& s, Question q, int a, int b, int step) {
  const auto x = placed_at(s, a, step), y = placed_at(s, b, step);
  if (!x || !y || a == b) return nullptr;
  if (is_of_motion(q)) {
    const Motion ma = motion_of(s, a), mb = motion_of(s, b);
    const auto c = referee::impact_certificate(*x, ma, *y, mb, referee::judge_motion(*x, ma, *y, mb));
    return c.claims_nothing() ? Json() : named(touchstone::to_json(c), a, b, step);
  }
  const auto c = referee::checkable_certificate(referee::judge_pair(*x, *y), *x, *y);
  return c.kind == Certificate::Kind::none ? Json() : named(touchstone::to_json(c), a, b, step);
}

void write_evidence(Finding& f, CaseCertificates& found, ExactCertificates when) {
  if (!f.evidence || !f.evidence_json.is_null()) return;
  const Evidence& e = *f.evidence;
  const bool later = when == ExactCertificates::later && needs_exact_arithmetic(e);
  f.evidence_json = {{"case", case_to_json(e.c)},
                     {"observation", to_json(e.observation)},
                     {"certificate", later ? deferred(e) : certificate_of(e, f.first_index, found)},
                     {"received", received_json(e)}};
}

void write_evidence(Finding& f) {
  CaseCertificates found;
  write_evidence(f, found);
}

bool is_deferred(const Json& certificate) {
  return certificate.is_object() && certificate.contains("kind") && certificate["kind"] == deferred_kind;
}

Json deferred_certificate(const Case& c, const Json& observation, const Json& deferred,
                          const std::string& file) {
  const JsonReader j(deferred, file, "certificate"), seen(observation, file, "observation");
  Evidence e{c, {}, {}, certificate_from_json(j["found"].json()), -1, -1, -1, Question::overlap};
  const auto question = question_from_string(j["question"].string());
  if (!question) j["question"].fail("is not a question");
  e.question = *question;
  if (j.has("bodies")) {
    const auto bodies = j["bodies"].items(2);
    e.a = bodies[0].integer();
    e.b = bodies[1].integer();
  }
  if (j.has("step")) e.step = j["step"].integer();
  const auto outcome = outcome_from_string(seen["outcome"].string());
  if (!outcome) seen["outcome"].fail("is not an outcome");
  e.observation.outcome = *outcome;
  if (seen.has("toi")) e.observation.toi = number_from(seen["toi"]);
  CaseCertificates found;
  if (Json exact = exact_form(e, 0, found); !exact.is_null()) return exact;
  return with_names(j["found"].json(), e);
}

void write_evidence(CampaignResult& r) {
  CaseCertificates found;
  for (auto& [key, f] : r.findings) write_evidence(f, found);
}

}  // namespace touchstone::fuzz
