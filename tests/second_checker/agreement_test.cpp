// The checker (oracles/checker) and the one in Python (check_certificates.py), which share no code, accept
// and refuse the same certificates: those of a campaign's cases, and the same ones tampered with.
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/base/input_error.h"
#include "fuzz/answer/pair_answer.h"
#include "oracles/checker/checker.h"
#include "scenarios/codec/scene_codec.h"
#include "scenarios/codec/value_codec.h"
#include "scenarios/random/family.h"
#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using namespace touchstone;
using Json = nlohmann::ordered_json;

namespace {

// Both programs take minutes for hundreds of triangles or vertices.
bool is_small(const Shape& s) {
  const auto* vertices = vertices_if(s);
  return vertices == nullptr || vertices->size() <= 12;
}

bool is_asked(const Case& c) {
  return c.scene.bodies.size() == 2 && !c.queries.empty() && is_pair_question(c.queries[0].question) &&
         is_small(c.scene.shape_of(0)) && is_small(c.scene.shape_of(1));
}

std::vector<Json> certificates_of(const Scene& s) {
  const Placed a{&s.shape_of(0), s.bodies[0].pose}, b{&s.shape_of(1), s.bodies[1].pose};
  std::vector<Json> all;
  const fuzz::PairAnswer pair = fuzz::answer_pair(a, b, {.certificates = true, .normals = false});
  for (const Certificate* c : {&pair.proof->verdict, &pair.proof->at_least, &pair.proof->at_most})
    if (c->kind != Certificate::Kind::none) all.push_back(to_json(*c));
  if (!s.bodies[0].motion && !s.bodies[1].motion) return all;
  const fuzz::ImpactAnswer impact =
      fuzz::answer_motion(a, s.bodies[0].motion.value_or(Motion{}), b, s.bodies[1].motion.value_or(Motion{}));
  // Python takes seconds for a hundred keys of a spinning body.
  constexpr std::size_t most_keys = 24;
  std::size_t keys = 0;
  for (const auto& track : impact.certificate->tracks) keys += track.size();
  if (keys <= most_keys && !impact.certificate->claims_nothing()) all.push_back(to_json(*impact.certificate));
  return all;
}

// Changes one number or text of the certificate at random, so that most are wrong by little.
void change_leaf(Json& leaf, Rng& rng) {
  if (leaf.is_string()) {
    const std::array<std::string, 5> texts{"1/3", "-" + leaf.get<std::string>(), "7", "1/0", "01"};
    leaf = leaf == "" ? Json("0") : Json(texts[rng.below(texts.size())]);
  } else if (leaf.is_number_float()) {
    const double x = leaf.get<double>(), step = std::max(std::abs(x), 0x1p-30);
    const std::array<double, 7> values{
        -x, x + step * 0x1p-50, x - step * 0x1p-50, x + step * 0x1p-20, x - step * 0x1p-20, x + 1, 0.0};
    leaf = values[rng.below(values.size())];
  } else if (leaf.is_number_integer()) {
    leaf = leaf.get<unsigned>() + 1;
  }
}

Json tampered(const Json& certificate, Rng& rng) {
  std::vector<std::string> leaves;
  const Json flat = certificate.flatten();
  for (const auto& [place, value] : flat.items())
    if (!place.ends_with("/kind") && !place.ends_with("/note")) leaves.push_back(place);
  Json changed = certificate;
  if (!leaves.empty()) change_leaf(changed[Json::json_pointer(leaves[rng.below(leaves.size())])], rng);
  if (changed.contains("facets") && !changed["facets"].empty() && rng.below(4) == 0)
    changed["facets"].erase(changed["facets"].size() - 1);
  return changed;
}

// Reads it from its text, as every reader does.
std::string ruling_of(const Json& certificate, const Scene& s) {
  const Json j = test::parsed<Json>(certificate.dump());
  const Placed a{&s.shape_of(0), s.bodies[0].pose}, b{&s.shape_of(1), s.bodies[1].pose};
  try {
    const bool good = j.at("kind") == "impact" ? checker::check(impact_certificate_from_json(j), a,
                                                                s.bodies[0].motion.value_or(Motion{}), b,
                                                                s.bodies[1].motion.value_or(Motion{}))
                                               : checker::check(certificate_from_json(j), a, b);
    return good ? "valid" : "not valid";
  } catch (const InputError&) {
    return "refused";
  }
}

struct Checked {
  Scene scene;
  Json certificate;
  std::string ruling;
};

// Certificates of at least `least` cases of the default mix, each also changed twice.
std::vector<Checked> questions(std::uint64_t seed, int least) {
  std::vector<Checked> all;
  Rng rng = Rng::stream(seed, 0);
  int cases = 0;
  for (std::uint64_t i = 0; cases < least; ++i) {
    const Case c = fuzz::make_case(seed, i);
    if (!is_asked(c)) continue;
    ++cases;
    for (const Json& j : certificates_of(c.scene)) {
      all.push_back({c.scene, j, ruling_of(j, c.scene)});
      for (int k = 0; k < 2; ++k) {
        const Json changed = tampered(j, rng);
        all.push_back({c.scene, changed, ruling_of(changed, c.scene)});
      }
    }
  }
  return all;
}

}  // namespace

TEST_CASE("two checkers agree on every certificate of a campaign, and on every one tampered with",
          "[second_checker][optional]") {
  if (!test::has_command("python3")) return test::skip("python3 is not installed");
  const std::vector<Checked> asked = questions(24, 200);
  const test::Workspace w("second-checker");
  {
    std::ofstream file(w.dir / "certificates.jsonl");
    for (const Checked& q : asked)
      file << Json{{"scene", to_json(q.scene)}, {"certificate", q.certificate}}.dump() << "\n";
  }
  const test::Run r =
      w.run("python3 -B " TS_SOURCE_DIR "/tests/second_checker/check_certificates.py certificates.jsonl");
  INFO(r.err);
  CHECK(r.code == 1);
  std::istringstream out(r.out);
  std::map<std::string, int> kinds, rulings;
  std::size_t answered = 0;
  for (std::string line; std::getline(out, line); ++answered) {
    REQUIRE(answered < asked.size());
    const Checked& q = asked[answered];
    ++rulings[q.ruling];
    ++kinds[q.certificate["kind"].get<std::string>() + (q.ruling == "valid" ? "" : " refused")];
    INFO(q.scene.name << q.certificate.dump() << "\n" << to_json(q.scene).dump());
    CHECK(line.substr(0, line.find(':')) == q.ruling);
  }
  CHECK(answered == asked.size());
  CHECK(rulings["valid"] > 400);
  CHECK(rulings["not valid"] > 400);
  CHECK(rulings["refused"] > 10);
  for (const std::string kind :
       {"separating_plane", "common_point", "depth_direction", "inner_polytope", "impact"}) {
    INFO(kind);
    CHECK(kinds[kind] > 5);
    CHECK(kinds[kind + " refused"] > 5);
  }
}

TEST_CASE("the checker in Python reads the answers of the program, and refuses what is none",
          "[second_checker][optional]") {
  if (!test::has_command("python3")) return test::skip("python3 is not installed");
  const test::Workspace w("second-checker-answers");
  const std::string python = "python3 -B " TS_SOURCE_DIR "/tests/second_checker/check_certificates.py";
  const test::Run asked = w.touchstone(
      "answer --json 'box 1 1 1 move 0 0 1' 'cylinder 0.5 2 at 0 0 3.2 rot 1 0 0 30deg' >answer.jsonl");
  REQUIRE(asked.code == 0);
  const test::Run good = w.run(python + " answer.jsonl");
  INFO(good.out << good.err);
  CHECK(good.code == 0);
  CHECK(good.out == "valid\nvalid\nvalid\nvalid\n");
  w.write("none.jsonl", "{\"scene\": 1}\n");
  CHECK(w.run(python + " none.jsonl").code == 2);
  w.write("broken.jsonl", "{\n");
  CHECK(w.run(python + " broken.jsonl").code == 2);
}
