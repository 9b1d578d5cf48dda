#include "tests/reports/cause_sample.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>

#include "scenarios/codec/scene_codec.h"

namespace touchstone::test {
namespace {

using fuzz::Cause;
using fuzz::CauseCase;
using fuzz::Json;
using fuzz::Response;
using fuzz::Severity;

CauseCase corpus_case(const std::string& name, const std::string& engine, const std::string& key,
                      const std::string& words, double error, CaseSize size) {
  const auto file = std::filesystem::path(TS_SOURCE_DIR) / "scenarios/corpus" / (name + ".json");
  return {engine, key, Json::parse(read_file(file)), words, error, size};
}

// A short program as the reproducers are.
std::string program_of(const std::string& header, const std::string& body) {
  return "// Exits with 1 while the answer is wrong.\n#include <" + header +
         ">\n#include <cstdio>\n\nint main() {\n" + body + "  return 1;\n}\n";
}

Cause missed_impact() {
  Cause c;
  c.id = "fcl-libccd-continuous-sphere-box-3f1c";
  c.path = "fcl-libccd";
  c.library = "FCL 0.7.0";
  c.route = "continuousCollide, CCDC_NAIVE";
  c.title = "misses an impact between two of its ten samples: vanishes when the plate is 16 times as thick";
  c.severity = Severity::missed;
  c.wrong = 1204;
  c.asked = 1880;
  c.worst_in_l = 0.47;
  c.first_index = 17;
  c.engines = {"fcl-libccd", "fcl-libccd-tuned"};
  c.questions = {"time_of_impact"};
  c.faults = {"missed"};
  c.shapes = {"box-box",         "box-capsule",  "box-cone",         "box-cylinder",
              "box-ellipsoid",   "box-hull",     "box-mesh",         "box-sphere",
              "capsule-capsule", "capsule-cone", "capsule-cylinder", "sphere-sphere"};
  c.families = {"motion", "thin"};
  c.response = {{"to_double", "the scene rounded to float first", Response::stays},
                {"scaled_up", "scaled by 1024", Response::stays},
                {"turned", "turned by 1e-3", Response::stays},
                {"thicker", "the plate 16 times as thick", Response::gone},
                {"fresh", "asked in a fresh process", Response::stays},
                {"other_solver", "asked of GST_INDEP", Response::stays},
                {"warm", "asked after other cases", Response::not_applicable}};
  c.keys = {"fcl-libccd.time_of_impact.missed.box-sphere.algorithm.solid.gross"};
  c.smallest = corpus_case("fcl-naive-thin-plate-tunnel", "fcl-libccd", c.keys[0],
                           "states no impact; the referee has one at t = 0.4725", 0.47, {2, 0, 19});
  c.defensible = c.smallest;
  c.certificate = Json::parse(R"({"kind": "impact", "clear_until": 0.4725, "contact": {"t": "189/400",
                                  "point": ["-1/200", "0", "0"]}})");
  c.program = program_of("fcl/fcl.h", "  // the ball and the plate\n  std::puts(\"no impact\");\n");
  return c;
}

Cause infeasible_depth() {
  Cause c;
  c.id = "bullet-query-convex-9ab0";
  c.path = "bullet-query";
  c.library = "Bullet 3.24";
  c.route = "convex";
  c.title = "wrong only where faces are parallel: vanishes when turned by 1e-6";
  c.severity = Severity::infeasible;
  c.wrong = 31;
  c.asked = 11360;
  c.worst_in_l = 0.61;
  c.first_index = 125;
  c.engines = {"bullet-f32-query", "bullet-f32-query-tuned", "bullet-f64-query", "bullet-f64-query-tuned"};
  c.questions = {"contact", "scene_contacts"};
  c.faults = {"depth_excess", "infeasible"};
  c.shapes = {"box-box", "box-hull", "hull-hull"};
  c.families = {"lattice", "parallel"};
  const char* changes[] = {"built in double",
                           "the scene rounded to float first",
                           "scaled by 1024",
                           "scaled by 1/1024",
                           "moved to the origin",
                           "A and B exchanged",
                           "turned by 1e-9",
                           "turned by 1e-6",
                           "turned by 1e-3",
                           "A given as a hull",
                           "B given as a hull",
                           "margin 0",
                           "margin 0.04",
                           "asked through the simulation",
                           "the depth halved",
                           "asked in a fresh process",
                           "the scene in other order",
                           "Bullet 2.89"};
  const Response answers[] = {Response::stays,   Response::stays,         Response::stays, Response::stays,
                              Response::stays,   Response::differs,       Response::stays, Response::gone,
                              Response::gone,    Response::stays,         Response::stays, Response::gone,
                              Response::stays,   Response::gone,          Response::open,  Response::stays,
                              Response::differs, Response::not_applicable};
  for (std::size_t i = 0; i < std::size(changes); ++i)
    c.response.push_back({"change_" + std::to_string(i), changes[i], answers[i]});
  c.keys = {"bullet-f32-query-tuned.contact.infeasible.box-box.algorithm.solid.gross",
            "bullet-f64-query-tuned.contact.depth_excess.box-hull.algorithm.solid.small"};
  c.consequences = {"contact not_minimal (212)", "distance points_off_body (31)"};
  c.smallest = corpus_case(
      "drake-21673-box-box-axis-swapped", "bullet-f32-query-tuned", c.keys[0],
      "moving by the stated depth 2.4575624e-07 along the stated normal leaves 0.101324 of overlap", 0.61,
      {2, 0, 131});
  c.defensible = corpus_case("drake-1668-cubes-corner-overlap", "bullet-f32-query-tuned", c.keys[0],
                             "moving by the stated depth 0.5 along the stated normal leaves 0.5 of overlap",
                             0.05, {2, 0, 52});
  c.worst = c.smallest;
  c.worst.engine = "bullet-f64-query-tuned";
  c.worst.words = "moving by the stated depth 0.2 along the stated normal leaves 0.61 of overlap";
  c.certificate = Json::parse(R"({"kind": "separating_plane", "direction": [0.29, 0.002, 0.95],
                                  "offset": 1.16, "bodies": [0, 1]})");
  c.program = program_of("btBulletCollisionCommon.h", "  // two boxes\n");
  return c;
}

Cause not_least_depth() {
  Cause c;
  c.id = "libccd-mpr-convex-77e2";
  c.path = "libccd-mpr";
  c.library = "libccd 2.1";
  c.route = "convex";
  c.title = "states a depth that is not the least one, for every convex pair";
  c.severity = Severity::not_minimal;
  c.wrong = 5260;
  c.asked = 9120;
  c.worst_in_l = 1.5;
  c.engines = {"libccd-mpr"};
  c.questions = {"contact"};
  c.faults = {"not_minimal"};
  c.shapes = {"box-box"};
  c.documented = "ccdMPRPenetration: the depth is that along the portal's normal";
  c.response = {{"scaled_up", "scaled by 1024", Response::stays}};
  c.keys = {"libccd-mpr.contact.not_minimal.box-box.algorithm.solid.gross"};
  c.smallest = corpus_case("drake-21673-box-box-axis-swapped", "libccd-mpr", c.keys[0],
                           "the stated normal needs 0.46; the least depth is 0.15", 1.5, {2, 0, 88});
  return c;
}

Cause wrong_distance() {
  Cause c;
  c.id = "ode-box-cylinder-0c0c";
  c.path = "ode";
  c.library = "ODE 0.16.2";
  c.route = "box-cylinder";
  c.title = "routine box-cylinder: vanishes when the box is given as a hull";
  c.severity = Severity::distance;
  c.wrong = 44;
  c.asked = 600;
  c.engines = {"ode"};
  c.questions = {"contact"};
  c.faults = {"distance"};
  c.shapes = {"box-cylinder"};
  c.response = {{"box_as_hull", "the box given as a hull", Response::gone}};
  c.keys = {"ode.contact.distance.box-cylinder.algorithm.solid.small"};
  c.smallest = corpus_case("drake-21234-cylinder-box-tilted", "ode", c.keys[0],
                           "states depth 0.2; its own normal needs 0.25", 0.02, {2, 0, 240});
  c.no_program = "ODE's API has no question for a signed distance";
  return c;
}

Cause crash() {
  Cause c;
  c.id = "fcl-libccd-assertion-51";
  c.path = "fcl-libccd";
  c.library = "FCL 0.7.0";
  c.route = "distance";
  c.title = "throws from validateNearestFeatureOfPolytopeBeingEdge: vanishes when turned by 1e-9";
  c.severity = Severity::crash;
  c.wrong = 7;
  c.asked = 9000;
  c.engines = {"fcl-libccd"};
  c.questions = {"distance"};
  c.faults = {"threw"};
  c.shapes = {"hull-hull"};
  c.response = {{"turned", "turned by 1e-9", Response::gone}};
  c.keys = {"fcl-libccd.distance.threw.hull-hull.none.solid.none"};
  c.smallest = corpus_case("drake-21673-hexagonal-prism-vs-triangular-prism", "fcl-libccd", c.keys[0],
                           "threw: validateNearestFeatureOfPolytopeBeingEdge: the edge has no nearest face",
                           0, {2, 0, 410});
  return c;
}

void spoil(std::vector<std::string>& texts, const std::string& by) {
  for (std::string& t : texts) t += by;
  texts.push_back(by);
}

}  // namespace

fuzz::Causes sample_causes() {
  fuzz::Causes c;
  c.campaign = "out/nightly";
  c.digest = "00c0ffee00c0ffee";
  c.seed = 3;
  c.cases = 1500;
  c.causes = {crash(), missed_impact(), infeasible_depth(), wrong_distance(), not_least_depth()};
  for (const Cause& cause : c.causes) {
    c.answers += cause.wrong;
    c.keys += cause.keys.size();
  }
  c.unseen = 0.0012;
  c.notes = {"bullet-f64-sim is not installed: its causes are grouped without interventions"};
  return c;
}

fuzz::Causes many_causes(std::size_t count) {
  const fuzz::Causes few = sample_causes();
  fuzz::Causes c = few;
  c.causes.clear();
  std::mt19937_64 random(5);
  for (std::size_t i = 0; i < count; ++i) {
    Cause cause = few.causes[i % few.causes.size()];
    cause.id += "-" + std::to_string(i);
    cause.wrong = 1 + random() % cause.asked;
    // As hard to compress as the numbers and programs of real causes: 4 kB each.
    if (!cause.program.empty())
      for (int line = 0; line < 60; ++line)
        cause.program += "const double x" + std::to_string(line) + " = " + std::to_string(random()) + ".0;\n";
    for (CauseCase* one : {&cause.smallest, &cause.defensible})
      if (!one->c.is_null())
        for (Json& body : one->c.at("scene").at("bodies"))
          body["pose"]["rotation"] = {0.1, 0.2, 0.3, static_cast<double>(random() >> 11) * 0x1p-53};
    c.causes.push_back(std::move(cause));
  }
  return c;
}

fuzz::Causes hostile_causes() {
  const std::string by =
      " ```\n</script></details><img src=x onerror=alert(1)> | @everyone `x` \x1b[2J "
      "\xe2\x80\xae $(touch owned) '; touch owned; ' \xff " +
      std::string(300, 'w');
  fuzz::Causes c = sample_causes();
  c.campaign += by;
  spoil(c.notes, by);
  for (Cause& cause : c.causes) {
    for (std::string* text : {&cause.path, &cause.library, &cause.route, &cause.title, &cause.documented,
                              &cause.program, &cause.no_program})
      *text += by;
    for (auto* texts : {&cause.engines, &cause.questions, &cause.faults, &cause.shapes, &cause.families,
                        &cause.keys, &cause.consequences})
      spoil(*texts, by);
    for (fuzz::Responded& r : cause.response) r.change += by;
    for (CauseCase* one : {&cause.smallest, &cause.defensible, &cause.worst}) {
      one->engine += by;
      one->key += by;
      one->words += by;
      if (!one->c.is_null()) one->c["description"] = by;
    }
    cause.certificate = {{"note", by}};
  }
  // No scenes at all.
  c.causes.at(0).smallest.c =
      Json::parse(R"({"scene": {"shapes": [{"type": "teapot"}], "bodies": [{"shape": 0}]}})");
  c.causes.at(3).smallest.c = Json::parse(R"({"scene": 7})");
  return c;
}

}  // namespace touchstone::test
