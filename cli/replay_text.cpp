#include "cli/replay_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/exact_text.h"
#include "fuzz/ask/evidence.h"
#include "reports/record/evidence.h"
#include "reports/text/text.h"
#include "scenarios/codec/value_codec.h"
#include "scenarios/text/printable.h"

namespace touchstone::reports {
namespace {

std::string vec(const Vec3& v) { return fmt::format("({:.6g} {:.6g} {:.6g})", v.x(), v.y(), v.z()); }

std::string bracket(const referee::Bracket& b) {
  if (b.lo == b.hi) return fmt::format("{:.12g} exactly", b.lo);
  return fmt::format("{:.12g}, known to {:.1e}", (b.lo + b.hi) / 2, b.hi - b.lo);
}

std::string body_line(const Scene& s, int i) {
  const Body& b = s.bodies[static_cast<std::size_t>(i)];
  const Shape& shape = s.shape_of(i);
  std::string t = fmt::format("  body {}: {}", i, type_name(shape));
  std::visit(
      [&](const auto& x) {
        for_each_field(x, [&](auto name, const auto& v, Domain) {
          using V = std::decay_t<decltype(v)>;
          if constexpr (std::is_same_v<V, double>)
            t += fmt::format(" {} {:.6g}", name, v);
          else if constexpr (std::is_same_v<V, Vec3>)
            t += fmt::format(" {} {}", name, vec(v));
          else
            t += fmt::format(", {} {}", v.size(), name);
        });
      },
      shape);
  static constexpr const char* flat[] = {" (flat: a point)", " (flat: a segment)", " (flat: a polygon)", ""};
  if (const auto* h = std::get_if<Hull>(&shape)) t += flat[h->dimension];
  t += fmt::format(", at {}", vec(b.pose.translation));
  const Quat& q = b.pose.rotation;
  if (q != Quat{}) t += fmt::format(", q ({:.6g} {:.6g} {:.6g} {:.6g})", q.x, q.y, q.z, q.w);
  if (b.motion) t += fmt::format(", moves {} turns {}", vec(b.motion->linear), vec(b.motion->angular));
  return wrapped(t, 78, 4) + "\n";
}

std::string certificate_lines(const Certificate& c) {
  using Kind = Certificate::Kind;
  switch (c.kind) {
    case Kind::none:
      return "";
    case Kind::separating_plane:
      return fmt::format(
          "    certificate: plane n·x = c, A on n·x <= c, B beyond;\n      n = ({}, {},\n           {}), c = "
          "{}\n",
          to_text(c.direction.x()), to_text(c.direction.y()), to_text(c.direction.z()), to_text(c.offset));
    case Kind::common_point:
      if (!c.rationals.empty())
        return "    certificate: a common point with rational coordinates (--json shows it)\n";
      return wrapped(fmt::format("    certificate: common point ({}, {}, {})", to_text(c.point.x()),
                                 to_text(c.point.y()), to_text(c.point.z())),
                     78, 6) +
             "\n";
    case Kind::depth_direction:
      return fmt::format("    certificate: moving B by {} along\n      {} separates it from A\n",
                         to_text(c.offset), vec(c.direction));
    case Kind::inner_polytope:
      return fmt::format("    certificate of the depth: polytope of {} support points, {} facets (--json)\n",
                         c.support_pairs.size(), c.facets.size());
    case Kind::closed_form:
      return c.note.empty() ? "" : wrapped("    certificate: " + c.note, 78, 6) + "\n";
  }
  return "";
}

std::string stated(const Query& q, const Observation& o) {
  if (o.outcome != Outcome::answered)
    return std::string(to_string(o.outcome)) + (o.detail.empty() ? "" : " (" + o.detail + ")");
  std::string s;
  switch (q.question) {
    case Question::overlap:
      return !o.overlap ? "-" : *o.overlap ? "overlap" : "apart";
    case Question::distance:
      if (o.distance) return fmt::format("{:.12g}", *o.distance);
      return !o.overlap ? "-" : *o.overlap ? "overlap, no distance" : "apart, no distance";
    case Question::contact:
      if (!o.overlap) return "-";
      if (!*o.overlap) return "apart";
      s = "overlap";
      if (o.depth) s += fmt::format(", depth {:.9g}", *o.depth);
      if (o.normal) s += fmt::format(", n {}", vec(*o.normal));
      return s + fmt::format(", {} points", o.manifold.size());
    case Question::time_of_impact:
      return o.toi ? fmt::format("t = {:.12g}", *o.toi) : "no impact";
    case Question::candidates: {
      std::size_t n = 0;
      for (const auto& set : o.candidate_pairs) n += set.size();
      return fmt::format("{} pairs over {} queries", n, o.candidate_pairs.size());
    }
    case Question::scene_contacts:
      return fmt::format("{} contacts", o.contacts.size());
    case Question::swept_candidates:
      return fmt::format("{} pairs", o.candidate_pairs.empty() ? 0 : o.candidate_pairs[0].size());
  }
  return s;
}

// As in the table of a campaign, but faults in capitals.
std::string mark(const Judgement& j) {
  switch (j.ruling()) {
    case Ruling::wrong:
      return "WRONG";
    case Ruling::failed:
      return "FAILED";
    default:
      return std::string(to_string(j.ruling()));
  }
}

// Qualifications of a verdict: wide claims, and claims that were not judged.
std::string small_print(const Judgement& j) {
  std::string s;
  if (j.wide_claim > 0)
    s += wrapped(
             fmt::format("      {} claimed tolerance of {:.3g} ({:.2g} L)",
                         j.right() ? "right within its" : "judged with its", j.wide_claim, j.wide_claim_in_l),
             79, 8) +
         "\n";
  for (const Unjudged& u : j.unjudged)
    s += wrapped(fmt::format("      not judged: {}{}", u.claim, u.by_definition ? " (of a surface)" : ""), 79,
                 8) +
         "\n";
  return s;
}

std::string engine_lines(const std::string& engine, const Query& q, const Observation& o,
                         const Judgement& j) {
  std::string s = wrapped(fmt::format("  {:<22} {:<7} {}", engine, mark(j), stated(q, o)), 79, 33) + "\n";
  if (o.outcome != Outcome::answered) return s;
  for (std::size_t i = 0; i < std::min<std::size_t>(j.faults.size(), 5); ++i)
    s += wrapped(fmt::format("      {}: {} ({} L)", to_string(j.faults[i].fault), j.faults[i].words,
                             small(j.faults[i].error_in_l)),
                 79, 8) +
         "\n";
  if (j.faults.size() > 5) s += fmt::format("      and {} more\n", j.faults.size() - 5);
  s += small_print(j);
  if (j.blame == Blame::representation)
    s += j.holds_other_shape ? "      right for the scene as the engine received it: it holds another shape\n"
                             : "      right for the scene as the engine received it: lost in its rounding\n";
  return s;
}

// Marks questions about bodies at rest in a scene whose bodies move.
std::string_view at_rest(const Scene& s, const Query& q) {
  const bool moves =
      std::any_of(s.bodies.begin(), s.bodies.end(), [](const Body& b) { return b.motion.has_value(); });
  return moves && q.question != Question::swept_candidates ? " (at t = 0; motions are ignored)" : "";
}

std::string_view time_verdict(const referee::TimeTruth& t) {
  using V = referee::TimeTruth::Verdict;
  return t.verdict == V::hit ? "impact" : t.verdict == V::none ? "no impact" : "undecided";
}

}  // namespace

void ReplayText::add(const std::string& engine, const CaseObservations& observations,
                     const std::vector<Judgement>& judgements) {
  rows_.push_back({engine, observations, judgements});
}

std::string ReplayText::referee_lines(const Query& q) const {
  switch (q.question) {
    case Question::time_of_impact: {
      const auto& t = truth_.motion(0, q.a, q.b);
      std::string s = fmt::format("  referee: {}", time_verdict(t));
      if (t.verdict == referee::TimeTruth::Verdict::hit)
        s += fmt::format(", t in [{:.12g}, {:.12g}]", t.t_lo, t.t_hi);
      return s + (t.note.empty() ? "\n" : "; " + t.note + "\n");
    }
    case Question::candidates: {
      std::size_t n = 0;
      for (const auto& set : truth_.true_pairs()) n += set.size();
      return fmt::format("  referee: {} pairs overlap over {} queries\n", n, truth_.true_pairs().size());
    }
    case Question::scene_contacts:
      return fmt::format("  referee: {} pairs overlap\n", truth_.scene_pairs(0).size());
    case Question::swept_candidates: {
      const auto n = truth_.meeting_pairs().size();
      const auto open = truth_.undecided_meetings();
      return fmt::format("  referee: {} pairs overlap at some time of the step{}\n", n,
                         open > 0 ? fmt::format(", {} undecided", open) : "");
    }
    default:
      break;
  }
  const referee::PairTruth& t = truth_.pair(0, q.a, q.b);
  std::string s = fmt::format("  referee: {}", referee::to_string(t.verdict));
  if (std::isfinite(t.gap.lo)) s += fmt::format(", signed distance {}", bracket(t.gap));
  if (t.verdict == referee::Verdict::undecided && !t.verdict_certificate.note.empty())
    s += "; " + t.verdict_certificate.note;
  s += "\n";
  if (q.question == Question::contact && t.verdict == referee::Verdict::overlap && std::isfinite(t.gap.lo))
    s += fmt::format("    depth is least along n = {}\n", vec(t.normal)) +
         certificate_lines(depth_certificate(q));
  else
    s += certificate_lines(t.verdict_certificate);
  return s;
}

std::string ReplayText::str() const {
  const Scene& s = case_.scene;
  std::string out = fmt::format("{}\n", printable(case_.id));
  const int n = static_cast<int>(s.bodies.size());
  for (int i = 0; i < std::min(n, 4); ++i) out += body_line(s, i);
  if (n > 4) out += fmt::format("  and {} more bodies\n", n - 4);
  for (std::size_t i = 0; i < case_.queries.size(); ++i) {
    const Query& q = case_.queries[i];
    out += is_pair_question(q.question) ? fmt::format("{} of {} and {}\n", to_string(q.question), q.a, q.b)
                                        : fmt::format("{}{}\n", to_string(q.question), at_rest(s, q));
    out += referee_lines(q);
    std::string cannot;
    for (const Row& r : rows_) {
      if (r.observations.answers[i].outcome == Outcome::unsupported)
        cannot += (cannot.empty() ? "  cannot: " : ", ") + r.engine;
      else
        out += engine_lines(r.engine, q, r.observations.answers[i], r.judgements[i]);
    }
    if (!cannot.empty()) out += wrapped(cannot, 78, 4) + "\n";
  }
  return out + "\n";
}

Certificate ReplayText::depth_certificate(const Query& q) const {
  return referee::depth_certificate(truth_.pair(0, q.a, q.b), truth_.placed(0, q.a), truth_.placed(0, q.b));
}

fuzz::Json ReplayText::referee_json(const Query& q, bool certificates) const {
  if (q.question == Question::time_of_impact) {
    const auto& t = truth_.motion(0, q.a, q.b);
    fuzz::Json j = {{"verdict", time_verdict(t)}, {"t_lo", t.t_lo}, {"t_hi", t.t_hi}, {"note", t.note}};
    if (certificates) j["certificate"] = fuzz::exact_certificate(case_.scene, q.question, q.a, q.b);
    return j;
  }
  if (!is_pair_question(q.question)) {
    fuzz::Json sets = fuzz::Json::array();
    const auto add = [&](const std::vector<fuzz::Truth::TruePair>& set) {
      fuzz::Json pairs = fuzz::Json::array();
      for (const auto& p : set) pairs.push_back({p.bodies.first, p.bodies.second});
      sets.push_back(std::move(pairs));
    };
    if (q.question == Question::swept_candidates)
      return {{"meeting_pairs", truth_.meeting_pairs()}, {"undecided_pairs", truth_.undecided_meetings()}};
    if (q.question == Question::scene_contacts)
      add(truth_.scene_pairs(0));
    else
      for (const auto& set : truth_.true_pairs()) add(set);
    return {{"overlapping_pairs", std::move(sets)}};
  }
  const referee::PairTruth& t = truth_.pair(0, q.a, q.b);
  // In the exact form that `touchstone check` accepts, if there is one; otherwise rounded.
  const fuzz::Json exact =
      certificates ? fuzz::exact_certificate(case_.scene, q.question, q.a, q.b) : fuzz::Json();
  return {{"verdict", referee::to_string(t.verdict)},
          {"gap", {fuzz::number(t.gap.lo), fuzz::number(t.gap.hi)}},
          {"normal", fuzz::vector(t.normal)},
          {"witness", {fuzz::vector(t.witness[0]), fuzz::vector(t.witness[1])}},
          {"verdict_certificate", exact.is_null() ? touchstone::to_json(t.verdict_certificate) : exact},
          {"depth_certificate", touchstone::to_json(depth_certificate(q))},
          {"filter_level", t.level}};
}

namespace {

fuzz::Json unjudged_json(const Judgement& j) {
  fuzz::Json all = fuzz::Json::array();
  for (const Unjudged& u : j.unjudged)
    all.push_back({{"claim", u.claim}, {"by_definition", u.by_definition}});
  return all;
}

}  // namespace

fuzz::Json ReplayText::json(bool certificates) const {
  fuzz::Json j = {{"case", case_.id}, {"queries", fuzz::Json::array()}};
  for (std::size_t i = 0; i < case_.queries.size(); ++i) {
    const Query& q = case_.queries[i];
    fuzz::Json item = {{"question", to_string(q.question)},
                       {"a", q.a},
                       {"b", q.b},
                       {"referee", referee_json(q, certificates)}};
    for (const Row& r : rows_) {
      const Judgement& g = r.judgements[i];
      fuzz::Json faults = fuzz::Json::array();
      for (const auto& f : g.faults)
        faults.push_back({{"fault", to_string(f.fault)},
                          {"words", f.words},
                          {"error", fuzz::number(f.error)},
                          {"error_in_l", fuzz::number(f.error_in_l)}});
      item["engines"][r.engine] = {
          {"answer", fuzz::to_json(r.observations.answers[i])},
          {"elapsed_ns", r.observations.answers[i].elapsed_ns},
          {"manifold_coverage", g.manifold_coverage ? fuzz::number(*g.manifold_coverage) : fuzz::Json()},
          {"ruling", to_string(g.ruling())},
          {"right", g.right()},
          {"undecided", g.undecided},
          {"not_judged", unjudged_json(g)},
          {"claimed_in_l", fuzz::number(g.wide_claim_in_l)},
          {"blame", to_string(g.blame)},
          {"faults", std::move(faults)}};
    }
    j["queries"].push_back(std::move(item));
  }
  return j;
}

}  // namespace touchstone::reports
