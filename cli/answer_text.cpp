#include "cli/answer_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/exact_text.h"
#include "reports/text/text.h"

namespace touchstone::cli {
namespace {

using fuzz::GapProof;
using fuzz::ImpactAnswer;
using fuzz::PairAnswer;

std::string row(const std::string& label, const std::string& value) {
  constexpr std::size_t label_width = 12;
  return reports::labelled(label, label_width, value);
}

// Shortest text without the sign of a zero.
std::string number(double x) { return to_text(x == 0 ? 0.0 : x); }
// Nine digits; all are in the JSON.
std::string vector(const Vec3& v) {
  // Adding 0 turns -0 into 0.
  return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
}
std::string bracket(double lo, double hi) { return fmt::format("[{}, {}]", number(lo), number(hi)); }
std::string short_vector(const Vec3& v) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
}

std::string verdict_words(const referee::PairTruth& t) {
  constexpr std::string_view levels[] = {"doubles with error bounds", "extended precision",
                                         "exact arithmetic"};
  return fmt::format("{} (decided in {})", to_string(t.verdict), levels[t.level]);
}

std::string normal_words(const PairAnswer& a) {
  std::string s = vector(a.truth.normal) + " from A to B";
  if (!a.normals || a.normals->normals.size() < 2) return s;
  if (a.normals->continuum) return s + ", one of a continuum";
  s += fmt::format("; one of {}{} that are as good:", a.normals->normals.size(),
                   a.normals->capped ? " or more" : "");
  constexpr std::size_t most_shown = 6;
  for (std::size_t i = 0; i < std::min(a.normals->normals.size(), most_shown); ++i)
    s += " " + short_vector(a.normals->normals[i]);
  return s + (a.normals->normals.size() > most_shown ? " ..." : "");
}

std::string within_words(const fuzz::WithinAnswer& w) {
  using enum referee::Verdict;
  const std::string margin = number(w.margin);
  if (w.verdict == undecided) return fmt::format("undecided whether the gap is at most {}", margin);
  return fmt::format("{}, the gap is {} {}{}", w.verdict == overlap ? "yes" : "no",
                     w.verdict == overlap ? "at most" : "more than", margin,
                     w.certified ? "" : " (no certificate)");
}

std::string plane_words(const Certificate& c) {
  if (!c.rationals.empty())
    return fmt::format("a separating plane in rational numbers ({} planes)", c.rationals.size() / 4);
  return fmt::format("plane d.x = {:.9g} with d = {}: A below, B above", c.offset + 0.0, vector(c.direction));
}

std::string point_words(const Certificate& c) {
  return c.rationals.empty() ? fmt::format("point {} of both", vector(c.point))
                             : "a point of both in rational numbers, near " + short_vector(c.point);
}

std::string proof_rows(const GapProof& p) {
  std::string s;
  using Kind = Certificate::Kind;
  if (p.verdict.kind == Kind::separating_plane) s += row("proof", plane_words(p.verdict));
  if (p.verdict.kind == Kind::common_point) s += row("proof", point_words(p.verdict));
  if (p.at_least.kind != Kind::none)
    s += row("", fmt::format("gap >= {} along {}", number(p.gap.lo), short_vector(p.at_least.direction)));
  if (p.at_most.kind == Kind::none) return s + row("", "all digits: --json");
  const auto& [a, b] = p.at_most.support_pairs[0];
  s += row("", p.at_most.facets.empty()
                   ? fmt::format("gap <= {} by {} and {}{}", number(p.gap.hi), short_vector(a),
                                 short_vector(b), p.rounded ? ", less the radii" : "")
                   : fmt::format("gap <= {} by an inner polytope of {} facets", number(p.gap.hi),
                                 p.at_most.facets.size()));
  return s + row("", "all digits: --json");
}

// Without what is rounding of the point's coordinates.
Vec3 without_noise(const referee::Gradient& g) {
  constexpr double noise = 0x1p-40;  // of the largest coordinate
  const double least = noise * std::max(g.point.cwiseAbs().maxCoeff(), g.moment.cwiseAbs().maxCoeff());
  return g.moment.unaryExpr([least](double x) { return std::abs(x) < least ? 0.0 : x; });
}

// Rotations are about the origin of B's frame.
std::string gradient_rows(const referee::GradientSet& g) {
  constexpr std::size_t shown = 4;
  const std::size_t count = g.corners.size();
  const std::string which = count > 1  ? fmt::format("one of {} corners", count)
                            : g.unique ? "unique"
                                       : "there may be others";
  std::string s = row("gradient", which + "; by translations, by rotations of B:");
  for (std::size_t i = 0; i < std::min(shown, count); ++i)
    s += row("", short_vector(g.corners[i].normal) + " " + short_vector(without_noise(g.corners[i])));
  return count > shown ? s + row("", "all: --json") : s;
}

std::string certified_row(bool certified, const std::string& why_not) {
  return row("certified", certified ? "yes" : "no: " + why_not);
}

}  // namespace

std::string answer_text(const fuzz::PairAnswer& answer) {
  const referee::PairTruth& t = answer.truth;
  std::string s = row("verdict", verdict_words(t));
  s += row("signed gap", bracket(t.gap.lo, t.gap.hi));
  if (t.verdict == referee::Verdict::overlap && std::isfinite(t.gap.lo))
    s += row("depth", bracket(-t.gap.hi, -t.gap.lo));
  if (t.verdict == referee::Verdict::overlap && !std::isfinite(t.gap.lo)) s += row("depth", "not defined");
  const bool has_normal = std::isfinite(t.gap.lo) && t.normal.allFinite() && !t.normal.isZero(0);
  if (has_normal) {
    s += row("normal", normal_words(answer));
    s += row("witness A", vector(t.witness[0]));
    s += row("witness B", vector(t.witness[1]));
  }
  if (answer.gradients) s += gradient_rows(*answer.gradients);
  if (answer.within) s += row("within", within_words(*answer.within));
  if (!answer.proof) return s;
  return s + proof_rows(*answer.proof) + certified_row(answer.certified, answer.not_certified);
}

std::string answer_text(const fuzz::ImpactAnswer& answer) {
  using Verdict = referee::TimeTruth::Verdict;
  const referee::TimeTruth& t = answer.truth;
  std::string s;
  if (t.verdict == Verdict::hit) s += row("impact", "first contact at t in " + bracket(t.t_lo, t.t_hi));
  if (t.verdict == Verdict::none) s += row("impact", "none for t in [0, 1]");
  if (t.verdict == Verdict::undecided)
    s += row("impact", "undecided" + (t.note.empty() ? "" : ": " + t.note));
  s += row("least gap", bracket(t.least_gap.lo, t.least_gap.hi));
  if (!answer.certificate) return s;
  const ImpactCertificate& c = *answer.certificate;
  std::size_t keys = 0;
  for (const auto& track : c.tracks) keys += track.size();
  if (!c.tracks.empty())
    s += row("proof", fmt::format("{} separating planes up to t = {}", keys, number(c.clear_until)));
  if (c.contact) s += row(c.tracks.empty() ? "proof" : "", "a point of both at the contact");
  return s + certified_row(answer.certified, answer.not_certified);
}

std::string ruling_text(const Judgement& j) {
  std::string s = row("stated", std::string(to_string(j.ruling())));
  for (const FaultReport& f : j.faults) s += row("", fmt::format("{}: {}", to_string(f.fault), f.words));
  for (const Unjudged& u : j.unjudged) s += row("", "not judged: " + u.claim);
  return s;
}

}  // namespace touchstone::cli
