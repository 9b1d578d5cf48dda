// touchstone check CERT: does a stored certificate prove its claim about its scene? The scene is the
// case.json beside it, unless --case names another. A finding may have left its certificate to be made now.
#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/import_options.h"
#include "cli/output.h"
#include "core/base/input_error.h"
#include "fuzz/ask/evidence.h"
#include "oracles/checker/checker.h"
#include "reports/record/result.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/codec/value_codec.h"

namespace touchstone::cli {
namespace {

using Json = nlohmann::ordered_json;

struct CheckOptions {
  std::string path, scene, out;
  std::vector<int> pair;
};

// A finding stores its certificate in the field "certificate"; other files are certificates themselves.
Json certificate_in(const Json& file) {
  return file.is_object() && file.contains("certificate") ? file.at("certificate") : file;
}

std::string scene_file(const CheckOptions& o) {
  if (!o.scene.empty()) return o.scene;
  return (std::filesystem::path(o.path).parent_path() / "case.json").string();
}

Json certificate_made_now(const CheckOptions& o, const Json& finding, const Json& deferred) {
  const JsonReader j(finding, o.path);
  if (!j.has("observation")) j.fail("has a deferred certificate, but no observation to make it from");
  return fuzz::deferred_certificate(load_case(scene_file(o)), j["observation"].json(), deferred, o.path);
}

std::string claim(const Certificate& c) {
  using Kind = Certificate::Kind;
  switch (c.kind) {
    case Kind::separating_plane:
      return "are apart";
    case Kind::common_point:
      return "are overlapping";
    case Kind::depth_direction:
      return fmt::format("are at most {} deep", c.offset);
    case Kind::inner_polytope:
      return fmt::format("are at least {} deep", c.offset);
    default:
      return "";
  }
}

std::string claim(const ImpactCertificate& c) {
  std::string s;
  if (!c.tracks.empty()) s = fmt::format("are apart up to t = {}", c.clear_until);
  if (c.contact) s += fmt::format("{}meet at t = {}", s.empty() ? "" : " and ", c.contact->t);
  if (c.overlap)
    s += fmt::format("{}are at least {} deep at t = {}", s.empty() ? "" : " and ", c.overlap->inner.offset,
                     c.overlap->t);
  return s;
}

struct Bodies {
  int a = 0, b = 1;
};

// The pairs (A, B) that the certificate may be about: as requested or as recorded in it, else both orders of
// the only two bodies.
std::vector<Bodies> pairs_of(const CheckOptions& o, const Json& certificate, const Scene& s) {
  const int n = static_cast<int>(s.bodies.size());
  std::vector<int> named = o.pair;
  if (const JsonReader j(certificate, o.path); named.empty() && j.has("bodies"))
    for (const JsonReader& body : j["bodies"].items()) named.push_back(body.integer());
  if (named.empty()) {
    if (n != 2) throw InputError("--pair", fmt::format("which two of the {} bodies? (--pair A B)", n));
    return {{0, 1}, {1, 0}};
  }
  const std::string place = o.pair.empty() ? o.path + ": bodies" : "--pair";
  if (named.size() != 2) throw InputError(place, "must name two bodies, A and B");
  for (int k : named)
    if (k < 0 || k >= n) throw InputError(place, fmt::format("there is no body {}", k));
  if (named[0] == named[1]) throw InputError(place, "names one body twice");
  return {{named[0], named[1]}};
}

Placed placed(const Scene& s, int body, int step) {
  if (const auto p = fuzz::placed_at(s, body, step)) return *p;
  throw InputError("step", fmt::format("body {} is not in the scene at query {}", body, step));
}

// What the certificate claims about A and B, and whether it holds.
struct Claim {
  std::string words;
  std::function<bool(const Scene&, Bodies, int step)> holds;
};

Claim claim_of(const Json& j) {
  if (j.is_object() && j.contains("kind") && j["kind"] == "impact") {
    const auto c = impact_certificate_from_json(j);
    return {claim(c), [c](const Scene& s, Bodies p, int step) {
              const auto motion = [&](int i) {
                return s.bodies[static_cast<std::size_t>(i)].motion.value_or(Motion{});
              };
              return checker::check(c, placed(s, p.a, step), motion(p.a), placed(s, p.b, step), motion(p.b));
            }};
  }
  const auto c = certificate_from_json(j);
  return {claim(c), [c](const Scene& s, Bodies p, int step) {
            return checker::check(c, placed(s, p.a, step), placed(s, p.b, step));
          }};
}

// The fault, if the file is a finding without a certificate: a crash is observed, not proved.
std::string failure_in(const Json& j) {
  const bool is_finding = j.is_object() && j.contains("fault") && j.contains("certificate");
  return is_finding && j["fault"].is_string() ? j["fault"].get<std::string>() : "";
}

// The query of the script that gives the bodies' poses; -1 (their own poses) if the certificate names none.
int step_of(const Json& j, const std::string& file) {
  if (!j.contains("step")) return -1;
  const Json& step = j["step"];
  const auto query = step.is_number_integer() ? step.get<std::int64_t>() : -1;
  if (query < 0 || query > std::numeric_limits<int>::max())
    throw InputError(file, "step: is not the number of a query (0 or more)");
  return static_cast<int>(query);
}

Claim claim_in(const Json& j, const std::string& file) try {
  return claim_of(j);
} catch (const InputError& e) {
  throw InputError(e.place().empty() ? file : file + ": " + e.place(), e.reason());
} catch (const Json::exception& e) {
  throw InputError(file, "is not a certificate: " + reason_of(e));
}

int run(const CheckOptions& o) {
  prepare_output(o.out);
  const Json file = load_json(o.path);
  Json j = certificate_in(file);
  const bool made_now = fuzz::is_deferred(j);
  if (made_now) j = certificate_made_now(o, file, j);
  if (!o.out.empty()) write_file(o.out, json_text(j, 1) + "\n");
  const Claim c = claim_in(j, o.path);
  if (const std::string fault = c.words.empty() ? failure_in(file) : ""; !fault.empty()) {
    fmt::print("nothing to check: {} has no certificate\n",
               fault == "crashed" ? "a crash" : "`" + fault + "`");
    return exit_failed;
  }
  const std::string scene = scene_file(o);
  const Case stored = is_importable(scene) ? imported_case(scene, {}).c : load_case(scene);
  const int step = step_of(j, o.path);
  for (const Bodies& p : pairs_of(o, j, stored.scene)) {
    if (!c.holds(stored.scene, p, step)) continue;
    fmt::print("valid: bodies {} and {} {}{}\n", p.a, p.b, c.words, made_now ? " (made now)" : "");
    return exit_clean;
  }
  fmt::print("not valid: {}\n", c.words.empty() ? "this kind of certificate proves nothing by itself"
                                                : "it does not prove that the bodies " + c.words);
  return exit_wrong;
}

}  // namespace

Run declare_check(CLI::App& app) {
  auto o = std::make_shared<CheckOptions>();
  app.add_option("certificate", o->path, "a finding.json, or a certificate by itself")->required();
  app.add_option("--case", o->scene, "the case or scene (default: case.json beside the certificate)");
  app.add_option("-o,--out", o->out, "also write the certificate by itself to this file");
  app.add_option("--pair", o->pair, "bodies A and B, when the scene has more than two")->expected(2);
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
