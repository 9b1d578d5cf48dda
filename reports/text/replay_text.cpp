#include "reports/text/record_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/exact_text.h"
#include "reports/text/text.h"
#include "scenarios/text/printable.h"

namespace touchstone::reports {
namespace {

// All digits, without the sign of a zero.
std::string exactly(double x) { return to_text(x == 0 ? 0.0 : x); }
std::string exactly(const Vec3& v) {
  return fmt::format("({}, {}, {})", exactly(v.x()), exactly(v.y()), exactly(v.z()));
}

// Adding zero takes the sign from a zero.
std::string vec(const Vec3& v) {
  return fmt::format("({:.6g} {:.6g} {:.6g})", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
}

std::string bracket(const std::array<double, 2>& b) {
  if (b[0] == b[1]) return fmt::format("{:.12g} exactly", b[0]);
  return fmt::format("{:.12g}, known to {:.1e}", (b[0] + b[1]) / 2, b[1] - b[0]);
}

std::string body_line(const Scene& s, int i) {
  const Body& b = s.bodies[static_cast<std::size_t>(i)];
  const Shape& shape = s.shape_of(i);
  std::string t =
      fmt::format("  body {}{}: {}", i, b.name.empty() ? "" : " " + printable(b.name), type_name(shape));
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
  if (const auto* h = hull_if(shape)) t += flat[h->dimension];
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
      return "    certificate: plane n·x = c, A on n·x <= c, B beyond;\n" +
             wrapped(fmt::format("      n = {}, c = {}", exactly(c.direction), exactly(c.offset)), 78, 11) +
             "\n";
    case Kind::common_point:
      if (!c.rationals.empty())
        return "    certificate: a common point with rational coordinates (--json shows it)\n";
      return wrapped("    certificate: common point " + exactly(c.point), 78, 6) + "\n";
    case Kind::depth_direction:
      return fmt::format("    certificate: moving B by {} along\n      {} separates it from A\n",
                         exactly(c.offset), vec(c.direction));
    case Kind::inner_polytope:
      return fmt::format("    certificate of the depth: polytope of {} support points, {} facets (--json)\n",
                         c.support_pairs.size(), c.facets.size());
    case Kind::closed_form:
      return c.note.empty() ? "" : wrapped("    certificate: " + c.note, 78, 6) + "\n";
  }
  return "";
}

std::string bounds_text(const Observation& o) {
  std::string s;
  if (o.lower_bound) s = fmt::format("at least {:.12g}", *o.lower_bound);
  if (o.upper_bound) s += fmt::format("{}at most {:.12g}", s.empty() ? "" : ", ", *o.upper_bound);
  return s;
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
      if (o.lower_bound || o.upper_bound) return bounds_text(o);
      return !o.overlap ? "-" : *o.overlap ? "overlap, no distance" : "apart, no distance";
    case Question::contact:
    case Question::contact_within:
      if (!o.overlap) return "-";
      if (!*o.overlap) return q.question == Question::contact ? "apart" : "beyond";
      s = q.question == Question::contact ? "overlap" : "within";
      if (o.depth)
        s += *o.depth < 0 && q.question == Question::contact_within ? fmt::format(", {:.9g} apart", -*o.depth)
                                                                    : fmt::format(", depth {:.9g}", *o.depth);
      if (o.normal) s += fmt::format(", n {}", vec(*o.normal));
      return s + fmt::format(", {} points", o.manifold.size());
    case Question::within:
      return !o.overlap ? "-" : *o.overlap ? "within" : "beyond";
    case Question::bounded_distance:
      if (o.distance) return fmt::format("{:.12g}", *o.distance);
      return o.lower_bound ? fmt::format("at least {:.12g}", *o.lower_bound) : "-";
    case Question::ray:
      s = o.toi ? fmt::format("t = {:.12g}", *o.toi) : "no hit";
      return o.toi && o.normal ? s + fmt::format(", n {}", vec(*o.normal)) : s;
    case Question::time_of_impact:
      return o.toi ? fmt::format("t = {:.12g}", *o.toi) : "no impact";
    case Question::candidates_within:
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
  return moves && !is_motion_question(q.question) ? " (at t = 0; motions are ignored)" : "";
}

std::string margin_text(const Scene& s, const Query& q) {
  return is_margin_question(q.question) ? fmt::format(", margin {:.12g}", s.margin) : "";
}

std::string referee_lines(const Query& q, const fuzz::RefereeAnswer& r) {
  switch (q.question) {
    case Question::ray:
    case Question::time_of_impact: {
      std::string s = fmt::format("  referee: {}", r.verdict);
      if (r.verdict == "impact") s += fmt::format(", t in [{:.12g}, {:.12g}]", r.time[0], r.time[1]);
      return s + (r.note.empty() ? "\n" : "; " + r.note + "\n");
    }
    case Question::candidates: {
      std::size_t n = 0;
      for (const auto& set : r.pairs) n += set.size();
      return fmt::format("  referee: {} pairs overlap over {} queries\n", n, r.pairs.size());
    }
    case Question::candidates_within: {
      std::size_t n = 0;
      for (const auto& set : r.pairs) n += set.size();
      return fmt::format("  referee: {} pairs are within the margin over {} queries{}\n", n, r.pairs.size(),
                         r.undecided_pairs > 0 ? fmt::format(", {} undecided", r.undecided_pairs) : "");
    }
    case Question::scene_contacts:
      return fmt::format("  referee: {} pairs overlap\n", r.pairs.at(0).size());
    case Question::swept_candidates:
      return fmt::format("  referee: {} pairs overlap at some time of the step{}\n", r.pairs.at(0).size(),
                         r.undecided_pairs > 0 ? fmt::format(", {} undecided", r.undecided_pairs) : "");
    case Question::overlap:
    case Question::distance:
    case Question::contact:
    case Question::within:
    case Question::bounded_distance:
    case Question::contact_within:
      break;
  }
  const bool has_gap = std::isfinite(r.gap[0]);
  std::string s =
      fmt::format("  referee: {}", r.within.empty() ? r.verdict : r.within + " the margin, " + r.verdict);
  if (has_gap) s += fmt::format(", signed distance {}", bracket(r.gap));
  if (r.verdict == "undecided" && !r.note.empty()) s += "; " + r.note;
  s += "\n";
  if (is_contact_question(q.question) && r.verdict == "overlap" && has_gap)
    return s + fmt::format("    depth is least along n = {}\n", vec(r.normal)) +
           certificate_lines(r.depth_certificate);
  return s + certificate_lines(r.verdict_certificate);
}

}  // namespace

std::string replay_text(const fuzz::JudgedCase& judged) {
  const Scene& s = judged.c.scene;
  std::string out = fmt::format("{}\n", printable(judged.c.id));
  const int n = static_cast<int>(s.bodies.size());
  for (int i = 0; i < std::min(n, 4); ++i) out += body_line(s, i);
  if (n > 4) out += fmt::format("  and {} more bodies\n", n - 4);
  for (std::size_t i = 0; i < judged.c.queries.size(); ++i) {
    const Query& q = judged.c.queries[i];
    out += is_pair_question(q.question)
               ? fmt::format("{} of {} and {}{}\n", to_string(q.question), q.a, q.b, margin_text(s, q))
               : fmt::format("{}{}{}\n", to_string(q.question), margin_text(s, q), at_rest(s, q));
    out += referee_lines(q, judged.referee[i]);
    std::string cannot;
    for (const fuzz::JudgedCase::OfEngine& e : judged.engines) {
      if (e.answers[i].outcome == Outcome::unsupported)
        cannot += (cannot.empty() ? "  cannot: " : ", ") + e.engine;
      else
        out += engine_lines(e.engine, q, e.answers[i], e.judgements[i]);
    }
    if (!cannot.empty()) out += wrapped(cannot, 78, 4) + "\n";
  }
  return out + "\n";
}

}  // namespace touchstone::reports
