// touchstone check CERT: is a stored certificate a proof of what it says about its scene? The scene is the
// case.json beside it, unless --case names another.
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/input_error.h"
#include "core/scene/input_file.h"
#include "fuzz/cli/command.h"
#include "oracles/referee/checker.h"
#include "scenarios/case_codec.h"

namespace touchstone::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string path, scene;
  std::vector<int> pair;
};

// A finding holds its certificate under that name; a bare certificate is one itself.
Json certificate_in(const std::string& path) {
  try {
    const Json j = Json::parse(read_file(path, std::uintmax_t{1} << 28));
    return j.is_object() && j.contains("certificate") ? j.at("certificate") : j;
  } catch (const Json::exception& e) {
    throw InputError(path, std::string("is not JSON: ") + e.what());
  }
}

std::string claim(const referee::Certificate& c) {
  using Kind = referee::Certificate::Kind;
  switch (c.kind) {
    case Kind::separating_plane:
      return "apart";
    case Kind::common_point:
      return "overlapping";
    case Kind::depth_direction:
      return fmt::format("at most {} deep", c.offset);
    case Kind::inner_polytope:
      return fmt::format("at least {} deep", c.offset);
    default:
      return "";
  }
}

referee::Placed placed(const Scene& s, int body) {
  return {&s.shape_of(body), s.bodies[static_cast<std::size_t>(body)].pose};
}

// The pairs that the certificate may be about, in the order A, B: as asked for, else both orders of the only
// two.
std::vector<std::pair<int, int>> pairs_of(const Options& o, const Scene& s) {
  const int n = static_cast<int>(s.bodies.size());
  if (o.pair.empty()) {
    if (n != 2) throw InputError("--pair", fmt::format("which two of the {} bodies? (--pair A B)", n));
    return {{0, 1}, {1, 0}};
  }
  for (int k : o.pair)
    if (k < 0 || k >= n) throw InputError("--pair", fmt::format("there is no body {}", k));
  if (o.pair[0] == o.pair[1]) throw InputError("--pair", "names one body twice");
  return {{o.pair[0], o.pair[1]}};
}

int run(const Options& o) {
  const referee::Certificate c = referee::certificate_from_json(certificate_in(o.path));
  const std::string scene =
      o.scene.empty() ? (std::filesystem::path(o.path).parent_path() / "case.json").string() : o.scene;
  const Case stored = load_case(scene);
  for (const auto& [a, b] : pairs_of(o, stored.scene)) {
    if (!referee::check(c, placed(stored.scene, a), placed(stored.scene, b))) continue;
    fmt::print("valid: bodies {} and {} are {}\n", a, b, claim(c));
    return exit_clean;
  }
  fmt::print("not valid: {}\n", claim(c).empty() ? "this kind of certificate proves nothing by itself"
                                                 : "it does not prove that the bodies are " + claim(c));
  return exit_wrong;
}

}  // namespace

Run declare_check(CLI::App& app) {
  auto o = std::make_shared<Options>();
  app.add_option("certificate", o->path, "a finding.json, or a certificate by itself")->required();
  app.add_option("--case", o->scene, "the case or scene (default: case.json beside the certificate)");
  app.add_option("--pair", o->pair, "bodies A and B, when the scene has more than two")->expected(2);
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
