#include "reports/text/record_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "reports/text/text.h"
#include "scenarios/text/printable.h"

namespace touchstone::reports {
namespace {

using namespace fuzz;

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

std::string phases(const Plan& p) {
  std::string others;
  for (const PlanPhase& x : p.phases)
    if (x.name != p.broad_phase)
      others.append(others.empty() ? "" : ", ").append(x.name).append(1, ' ').append(nanoseconds(x.ns_step));
  const auto chosen = std::find_if(p.phases.begin(), p.phases.end(),
                                   [&](const PlanPhase& x) { return x.name == p.broad_phase; });
  return wrapped(fmt::format("Broad phase: {}, {} ns per step on boxes alone; others: {}", p.broad_phase,
                             chosen == p.phases.end() ? "?" : nanoseconds(chosen->ns_step), others),
                 79, 2) +
         "\n";
}

std::string shapes(const Plan& p) {
  if (p.shapes.empty()) return "Shapes: unchanged; no simpler shape stays within the error and saves time.\n";
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
  std::string text = fmt::format("Shapes: {} can be simpler.\n", grouped(p.shapes.size()));
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

std::string meshes(const Plan& p) {
  if (p.convex_meshes == 0) return "";
  return wrapped(
             p.solid_meshes
                 ? fmt::format(
                       "Closed convex meshes: {}. They are treated as solids; the fixed choices below "
                       "treat them as surfaces, so their errors refer to a different scene.",
                       p.convex_meshes)
                 : fmt::format("Closed convex meshes: {}. If they are meant as solids, use --solid-meshes.",
                               p.convex_meshes),
             79, 2) +
         "\n";
}

std::string method(const PlanPair& x) {
  return fmt::format("{}{}", x.balls_first ? "balls, " : "", x.arithmetic);
}

std::string pairs(const Plan& p) {
  if (p.pairs.empty()) return "";
  std::string text = fmt::format("{:<21}{:>10} {:<19}{:>7}{:>8}{:>6}{:>7}\n", "Pairs, shapes as run",
                                 "candidates", "method", "ns", "double", "balls", "cheap");
  constexpr std::size_t most = 12;
  for (std::size_t i = 0; i < std::min(most, p.pairs.size()); ++i) {
    const PlanPair& x = p.pairs[i];
    text +=
        fmt::format("  {:<19}{:>10} {:<19}{:>7}{:>8}{:>6}{:>7}\n", x.pair, grouped(x.candidates), method(x),
                    nanoseconds(x.ns), nanoseconds(x.ns_double), x.balls_first ? percent(x.balls_share) : "",
                    x.arithmetic == "double" ? "" : percent(x.cheap_share));
  }
  if (p.pairs.size() > most) text += fmt::format("  and {} cheaper ones\n", p.pairs.size() - most);
  return text +
         "  ns per pair; double: doubles backed by extended precision, nothing else tried;\n  balls: share "
         "decided by bounding balls; cheap: share of the rest that float or\n  double alone answers within "
         "the error\n";
}

std::string sweeps(const Plan& p) {
  if (p.swept.empty())
    return wrapped(fmt::format(
                       "Sweeping: not needed; nothing moves farther in a step than {:g} of its inner size.",
                       p.sweep_share),
                   79, 2) +
           "\n";
  std::uint64_t travel = 0;
  for (const PlanSwept& s : p.swept) travel += s.reason == "travel";
  std::string text = wrapped(
      fmt::format(
          "Sweeping: {} of {} bodies ({} because of their travel, {} because of their rotation) could pass "
          "something deeper than {:g} of their inner size between two steps; the others cannot.",
          p.swept.size(), grouped(p.bodies), travel, p.swept.size() - travel, p.sweep_share),
      79, 2);
  text += "\n";
  constexpr std::size_t most = 5;
  for (std::size_t i = 0; i < std::min(most, p.swept.size()); ++i) {
    const PlanSwept& s = p.swept[i];
    text += wrapped(fmt::format("  {:<7} {:>7} deep of {:>7} inner, {} steps: body {}{}{}", s.reason,
                                small(s.pass_bound), small(s.inner), s.steps, s.body,
                                s.name.empty() ? "" : ", ", printable(s.name)),
                    79, 10) +
            "\n";
  }
  if (p.swept.size() > most) text += fmt::format("  and {} more\n", p.swept.size() - most);
  return text;
}

std::string why_unsound(const PlanRow& r) {
  if (r.outside) return fmt::format("{} outside", r.outside);
  if (r.unanswered) return fmt::format("{} unanswered", r.unanswered);
  if (r.unswept) return fmt::format("{} unswept", r.unswept);
  return "";
}

std::string rows(const Plan& p) {
  std::string text = fmt::format("{:<39}{:>8}{:>8}{:>10}  {}\n", "Time of a whole step (ns)", "least",
                                 "median", "error", "front");
  for (const PlanRow& r : p.rows)
    text += fmt::format("{} {:<37}{:>8}{:>8}{:>10}  {}\n", r.is_plan ? ">" : " ", r.name,
                        nanoseconds(r.ns_min), nanoseconds(r.ns_median), small(r.error),
                        r.sound() ? (r.front ? "yes" : "") : why_unsound(r));
  return text;
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
  return wrapped(fmt::format("The plan takes {:.2f} times as long as the fastest sound fixed choice, {}.",
                             plan->ns_min / fixed->ns_min, fixed->name),
                 79, 2) +
         "\n";
}

std::string asked(const Plan& p) {
  if (p.margin == 0 && !p.verdict_only) return "";
  return wrapped(fmt::format("Asked: {}{}.",
                             p.margin > 0 ? fmt::format("which pairs are within {}", small(p.margin))
                                          : std::string("which pairs overlap"),
                             p.verdict_only ? ", and nothing else" : ", how far apart, and their contacts"),
                 79, 2) +
         "\n";
}

std::string tighter(const Plan& p) {
  const double error = p.run.value("error", p.error);
  if (!(error < p.error)) return "";
  return wrapped(fmt::format("The fastest candidate is one for an error of {}, which is what it proves.",
                             small(error)),
                 79, 2) +
         "\n";
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
      "The core's own error bounds on {} sampled pairs are at most {}.{}", grouped(sampled), small(worst),
      worst > p.error ? " That exceeds the error: for some of them the core cannot prove that the depth is "
                        "least (regret_bound)."
                      : "");
}

}  // namespace

std::string plan_text(const Plan& p) {
  std::string text = wrapped(fmt::format("Plan for {}: {} bodies, {} steps, within {} (double proves {}).",
                                         p.scene.empty() ? "a scene" : printable(p.scene), grouped(p.bodies),
                                         p.steps, small(p.error), small(p.least_error)),
                             79, 2) +
                     "\n";
  text += asked(p) + tighter(p) + phases(p) + shapes(p) + meshes(p);
  text += p.remember ? "Searches start from the result of the previous step.\n" : "";
  text += pairs(p) + sweeps(p) + "\n" + rows(p) + saving(p);
  const auto plan = std::find_if(p.rows.begin(), p.rows.end(), [](const PlanRow& r) { return r.is_plan; });
  text += wrapped(
      fmt::format(
          "Evidence: the referee judged {} pairs ({} undecided); {} exceed the error, the worst is off "
          "by {}. {}{}",
          p.judged, p.undecided, plan->outside, small(plan->error), proven(p),
          p.unsupported
              ? fmt::format(" {} pairs that the core does not support are left out.", grouped(p.unsupported))
              : ""),
      79, 2);
  return text + "\n";
}

}  // namespace touchstone::reports
