#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "reports/text/cause_words.h"
#include "reports/text/record_text.h"
#include "reports/text/text.h"
#include "scenarios/text/printable.h"

namespace touchstone::reports {
namespace {

using namespace fuzz;

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

// Sentences, for the text and for the page. Empty when there is nothing to say.

std::string heading(const Plan& p) {
  return fmt::format("Plan for {}: {} bodies, {} steps, within {} (double proves {}).",
                     p.scene.empty() ? "a scene" : printable(p.scene), grouped(p.bodies), p.steps,
                     small(p.error), small(p.least_error));
}

std::string asked(const Plan& p) {
  if (p.margin == 0 && !p.verdict_only) return "";
  return fmt::format("Asked: {}{}.",
                     p.margin > 0 ? fmt::format("which pairs are within {}", small(p.margin))
                                  : std::string("which pairs overlap"),
                     p.verdict_only ? ", and nothing else" : ", how far apart, and their contacts");
}

std::string tighter(const Plan& p) {
  const double error = p.run.value("error", p.error);
  if (!(error < p.error)) return "";
  return fmt::format("The fastest candidate is one for an error of {}, which is what it proves.",
                     small(error));
}

std::string broad_phase(const Plan& p) {
  std::string others;
  for (const PlanPhase& x : p.phases)
    if (x.name != p.broad_phase)
      others.append(others.empty() ? "" : ", ").append(x.name).append(1, ' ').append(duration(x.ns_step));
  const auto chosen = std::find_if(p.phases.begin(), p.phases.end(),
                                   [&](const PlanPhase& x) { return x.name == p.broad_phase; });
  return fmt::format("Broad phase: {}, {} per step on boxes alone; others: {}.", p.broad_phase,
                     chosen == p.phases.end() ? "?" : duration(chosen->ns_step), others);
}

std::string simpler_shapes(const Plan& p) {
  if (p.shapes.empty()) return "Shapes: unchanged; no simpler shape stays within the error and saves time.";
  return fmt::format("Shapes: {} can be simpler.", grouped(p.shapes.size()));
}

std::string meshes(const Plan& p) {
  if (p.convex_meshes == 0) return "";
  return fmt::format("Closed convex meshes: {}. {}", p.convex_meshes,
                     p.solid_meshes ? "They are treated as solids; the fixed choices treat them as surfaces, "
                                      "so their errors refer to a different scene."
                                    : "If they are meant as solids, use --solid-meshes.");
}

std::string searches(const Plan& p) {
  return p.remember ? "Searches start from the result of the previous step." : "";
}

std::string because_of(std::uint64_t travel, std::uint64_t turning) {
  if (turning == 0) return "because of travel";
  if (travel == 0) return "because of rotation";
  return fmt::format("{} because of travel, {} because of rotation", grouped(travel), grouped(turning));
}

std::string sweeping(const Plan& p) {
  if (p.swept.empty())
    return fmt::format("Sweeping: not needed; nothing moves farther in a step than {:g} of its inner size.",
                       p.sweep_share);
  const auto travel =
      static_cast<std::uint64_t>(std::ranges::count(p.swept, std::string_view("travel"), &PlanSwept::reason));
  return fmt::format(
      "Sweeping: {} of {} bodies ({}) could pass something deeper than {:g} of their inner size between two "
      "steps; the others cannot.",
      grouped(p.swept.size()), grouped(p.bodies), because_of(travel, p.swept.size() - travel), p.sweep_share);
}

std::string saving(const Plan& p) {
  const PlanRow* plan = nullptr;
  const PlanRow* fixed = nullptr;
  for (const PlanRow& r : p.rows)
    if (r.is_plan)
      plan = &r;
    else if (r.sound() && !fixed)
      fixed = &r;
  if (!plan || !fixed) return "";
  return fmt::format("The plan takes {:.2f} times as long as the fastest sound fixed choice, {}.",
                     plan->ns_min / fixed->ns_min, fixed->name);
}

std::string proven(const Plan& p) {
  std::uint64_t sampled = 0;
  double worst = 0;
  for (const PlanPair& x : p.pairs) {
    sampled += x.sampled;
    worst = std::max(worst, x.certified_error);
  }
  if (sampled == 0) return "";
  return fmt::format(
      " The core's own error bounds on {} sampled pairs are at most {}.{}", grouped(sampled), small(worst),
      worst > p.error ? " That exceeds the error: for some of them the core cannot prove that the depth is "
                        "least (regret_bound)."
                      : "");
}

std::string evidence(const Plan& p) {
  const auto plan = std::ranges::find_if(p.rows, [](const PlanRow& r) { return r.is_plan; });
  return fmt::format(
      "Evidence: the referee judged {} pairs ({} undecided); {} exceed the error, the worst is off by "
      "{}.{}{}",
      p.judged, p.undecided, plan->outside, small(plan->error), proven(p),
      p.unsupported
          ? fmt::format(" {} pairs that the core does not support are left out.", grouped(p.unsupported))
          : "");
}

std::string why_unsound(const PlanRow& r) {
  if (r.outside) return grouped(r.outside) + " outside";
  if (r.unanswered) return grouped(r.unanswered) + " unanswered";
  if (r.unswept) return grouped(r.unswept) + " unswept";
  return "";
}

// Tables, for the text.

// A sentence on lines of its own.
std::string lines(const std::string& sentence, std::size_t indent = 2) {
  constexpr std::size_t columns = 79;
  return sentence.empty() ? "" : wrapped(sentence, columns, indent) + "\n";
}

std::string shape_table(const Plan& p) {
  struct Group {
    std::uint64_t shapes = 0, bodies = 0, vertices = 0, left = 0;
    double error = 0;
  };
  std::map<std::pair<std::string, std::string>, Group> groups;
  for (const PlanShape& s : p.shapes) {
    Group& g = groups[{s.was, s.becomes}];
    ++g.shapes;
    g.bodies += s.bodies;
    g.vertices += s.vertices;
    g.left += s.left;
    g.error = std::max(g.error, s.error);
  }
  std::string text;
  for (const auto& [kinds, g] : groups) {
    const auto& [was, becomes] = kinds;
    const std::string what = was == becomes
                                 ? fmt::format("keep {} of {} vertices", grouped(g.left), grouped(g.vertices))
                                 : fmt::format("are {}", becomes);
    text += fmt::format("  {:>5} {:<9} ({} bodies) {}; error at most {}\n", g.shapes, was, grouped(g.bodies),
                        what, small(g.error));
  }
  return text;
}

std::string method(const PlanPair& x) {
  return fmt::format("{}{}", x.balls_first ? "balls, " : "", x.arithmetic);
}

std::string pair_table(const Plan& p) {
  if (p.pairs.empty()) return "";
  std::string text = fmt::format("{:<21}{:>10} {:<19}{:>8}{:>8}{:>6}{:>7}\n", "Pairs, shapes as run",
                                 "candidates", "method", "time", "double", "balls", "cheap");
  constexpr std::size_t most = 12;
  for (std::size_t i = 0; i < std::min(most, p.pairs.size()); ++i) {
    const PlanPair& x = p.pairs[i];
    text +=
        fmt::format("  {:<19}{:>10} {:<19}{:>8}{:>8}{:>6}{:>7}\n", x.pair, grouped(x.candidates), method(x),
                    duration(x.ns), duration(x.ns_double), x.balls_first ? percent(x.balls_share) : "",
                    x.arithmetic == "double" ? "" : percent(x.cheap_share));
  }
  if (p.pairs.size() > most) text += fmt::format("  and {} cheaper ones\n", p.pairs.size() - most);
  return text +
         "  time of a pair; double: doubles backed by extended precision, nothing else\n  tried; balls: "
         "share decided by bounding balls; cheap: share of the rest that\n  float or double alone answers "
         "within "
         "the error\n";
}

std::string swept_bodies(const Plan& p) {
  std::string text;
  constexpr std::size_t most = 5;
  for (std::size_t i = 0; i < std::min(most, p.swept.size()); ++i) {
    const PlanSwept& s = p.swept[i];
    text += lines(
        fmt::format("  {:<7} {:>7} deep of {:>7} inner, {} steps: body {}{}{}", s.reason, small(s.pass_bound),
                    small(s.inner), s.steps, s.body, s.name.empty() ? "" : ", ", printable(s.name)),
        10);
  }
  if (p.swept.size() > most)
    text += fmt::format("  and {} more; --page lists all\n", grouped(p.swept.size() - most));
  return text;
}

std::string row_table(const Plan& p) {
  std::string text =
      fmt::format("{:<39}{:>9}{:>9}{:>9}  {}\n", "Time of a whole step", "least", "median", "error", "front");
  for (const PlanRow& r : p.rows)
    text += fmt::format("{} {:<37}{:>9}{:>9}{:>9}  {}\n", r.is_plan ? ">" : " ", r.name, duration(r.ns_min),
                        duration(r.ns_median), small(r.error),
                        r.sound() ? (r.front ? "yes" : "") : why_unsound(r));
  return text;
}

std::string terms(const Plan& p) {
  std::string text;
  for (const PlanTerms& t : p.terms) {
    text += fmt::format("\nThe same with {}\n", printable(t.library));
    for (const std::string& line : t.lines) text += lines("  " + line, 4);
  }
  return text;
}

}  // namespace

std::string plan_text(const Plan& p) {
  return lines(heading(p)) + lines(asked(p)) + lines(tighter(p)) + lines(broad_phase(p)) +
         lines(simpler_shapes(p)) + shape_table(p) + lines(meshes(p)) + lines(searches(p)) + pair_table(p) +
         lines(sweeping(p)) + swept_bodies(p) + "\n" + row_table(p) + lines(saving(p)) + lines(evidence(p)) +
         terms(p);
}

Json plan_page(const Plan& p, const std::string& command) {
  Json record = to_json(p), reasons = Json::array();
  for (const PlanRow& r : p.rows) reasons.push_back(why_unsound(r));
  Json summary = Json::array();
  for (const std::string& sentence : {saving(p), evidence(p), asked(p), tighter(p), searches(p), meshes(p)})
    if (!sentence.empty()) summary.push_back(sentence);
  return {{"page", "plan"},
          {"version", 1},
          {"title", "plan for " + (p.scene.empty() ? "a scene" : one_line(p.scene))},
          {"command", command},
          {"heading", one_line(heading(p))},
          {"summary", std::move(summary)},
          {"broad_phase", broad_phase(p)},
          {"shapes", simpler_shapes(p)},
          {"sweeping", sweeping(p)},
          {"reasons", std::move(reasons)},
          {"plan", std::move(record)}};
}

}  // namespace touchstone::reports
