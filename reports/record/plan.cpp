#include "reports/record/plan.h"

namespace touchstone::fuzz {
Json to_json(const Plan& p) {
  Json phases = Json::array(), pairs = Json::array(), shapes = Json::array(), swept = Json::array(),
       rows = Json::array(), terms = Json::array();
  for (const PlanPhase& x : p.phases) phases.push_back({{"name", x.name}, {"ns_step", number(x.ns_step)}});
  for (const PlanPair& x : p.pairs)
    pairs.push_back({{"pair", x.pair},
                     {"balls_first", x.balls_first},
                     {"arithmetic", x.arithmetic},
                     {"candidates", x.candidates},
                     {"sampled", x.sampled},
                     {"ns_double", number(x.ns_double)},
                     {"ns", number(x.ns)},
                     {"balls_share", x.balls_share},
                     {"cheap_share", x.cheap_share},
                     {"certified_error", number(x.certified_error)}});
  for (const PlanShape& x : p.shapes)
    shapes.push_back({{"shape", x.shape},
                      {"was", x.was},
                      {"becomes", x.becomes},
                      {"vertices", x.vertices},
                      {"left", x.left},
                      {"bodies", x.bodies},
                      {"error", x.error}});
  for (const PlanSwept& x : p.swept)
    swept.push_back({{"body", x.body},
                     {"name", x.name},
                     {"reason", x.reason},
                     {"steps", x.steps},
                     {"pass_bound", number(x.pass_bound)},
                     {"inner", number(x.inner)}});
  for (const PlanRow& x : p.rows)
    rows.push_back({{"name", x.name},
                    {"plan", x.is_plan},
                    {"ns_min", number(x.ns_min)},
                    {"ns_median", number(x.ns_median)},
                    {"error", number(x.error)},
                    {"outside", x.outside},
                    {"unanswered", x.unanswered},
                    {"unswept", x.unswept},
                    {"front", x.front}});
  for (const PlanTerms& x : p.terms) terms.push_back({{"library", x.library}, {"lines", x.lines}});
  return {{"touchstone_plan", 1},
          {"machine", to_json(p.machine)},
          {"scene", p.scene},
          {"seed", p.seed},
          {"bodies", p.bodies},
          {"steps", p.steps},
          {"rounds", p.rounds},
          {"least_error", p.least_error},
          {"margin", p.margin},
          {"verdict_only", p.verdict_only},
          {"convex_meshes", p.convex_meshes},
          {"run", p.run},
          {"phases", std::move(phases)},
          {"pairs", std::move(pairs)},
          {"shapes", std::move(shapes)},
          {"swept", std::move(swept)},
          {"evidence", {{"judged", p.judged}, {"undecided", p.undecided}, {"unsupported", p.unsupported}}},
          {"rows", std::move(rows)},
          {"terms", std::move(terms)}};
}

}  // namespace touchstone::fuzz
