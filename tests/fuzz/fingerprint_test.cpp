// Fingerprints: what they depend on, and what they do not.
#include "fuzz/fingerprint/fingerprint.h"

#include <cmath>
#include <functional>
#include <limits>

#include "core/base/hash.h"
#include "core/base/input_error.h"
#include "oracles/core/core_engine.h"
#include "tests/support/catch.h"
#include "tests/support/parsed.h"

using namespace touchstone;
using namespace touchstone::fuzz;

namespace {

// The core, with its answers changed.
class Changed final : public Engine {
 public:
  using Change = std::function<void(const Query&, Observation&)>;
  explicit Changed(Change change) : change_(std::move(change)) {}
  const EngineCard& card() const override { return core_->card(); }
  std::vector<CaseObservations> run(std::span<const Case> cases) override {
    auto all = core_->run(cases);
    for (std::size_t i = 0; i < cases.size(); ++i)
      for (std::size_t q = 0; q < cases[i].queries.size(); ++q)
        change_(cases[i].queries[q], all[i].answers[q]);
    return all;
  }

 private:
  std::unique_ptr<NativeEngine> core_ = make_native_core("core");
  Change change_;
};

Fingerprint fingerprint(const Changed::Change& change, int jobs = 1, std::uint64_t cases = 400) {
  FingerprintConfig config;
  config.make = [&] { return std::make_unique<Changed>(change); };
  config.jobs = jobs;
  config.cases = cases;
  return fingerprint_of(config);
}

void unchanged(const Query&, Observation&) {}

std::string text_of(const Fingerprint& f) { return to_json(f).dump(); }

Fingerprint from_text(const std::string& text) {
  const Json j = test::parsed<Json>(text);
  return fingerprint_from_json(JsonReader(j, "f.json"));
}

}  // namespace

TEST_CASE("the fixed set of cases is what its version says", "[fingerprint]") {
  Hasher all;
  for (std::uint64_t i = 0; i < fingerprint_cases; ++i) {
    const Case c = fingerprint_case(i);
    all.add(hash(c.scene));
    for (const Query& q : c.queries) all.add(static_cast<int>(q.question)).add(q.a).add(q.b);
  }
  // A change of this number is a new fingerprint_set.
  CHECK(fingerprint_set == 1);
  CHECK(all.value() == 0x9f51a46ec67c3ddeULL);
}

TEST_CASE("a fingerprint is the same for any number of jobs, and is read as it was written",
          "[fingerprint]") {
  const Fingerprint one = fingerprint(unchanged, 1), three = fingerprint(unchanged, 3);
  CHECK(text_of(one) == text_of(three));
  CHECK(difference_of(one, three).same());
  CHECK(difference_of(one, three).both() > 800);
  CHECK(text_of(from_text(text_of(one))) == text_of(one));
  CHECK(fingerprint(unchanged).hash() != fingerprint(unchanged, 1, 399).hash());
}

TEST_CASE("a fingerprint shows which answers differ, to the last bit", "[fingerprint]") {
  const Fingerprint plain = fingerprint(unchanged);
  int calls = 0;
  const Fingerprint changed = fingerprint([&](const Query& q, Observation& o) {
    if (q.question == Question::distance && o.distance && ++calls == 7)
      o.distance = std::nextafter(*o.distance, 1e300);
  });
  const FingerprintDifference d = difference_of(plain, changed);
  CHECK(d.differ() == 1);
  CHECK(d.only_one() == 0);
  for (const auto& g : d.groups)
    if (!g.same()) {
      CHECK(g.question == "distance");
      const auto place = place_in_set(g.question, g.shapes, g.first, plain.cases);
      REQUIRE(place);
      const Case c = fingerprint_case(place->case_index);
      CHECK(c.queries[place->query].question == Question::distance);
      CHECK(fingerprint_shapes(c, c.queries[place->query]) == g.shapes);
    }
  const Fingerprint silent = fingerprint([](const Query& q, Observation& o) {
    if (q.question == Question::contact) o = no_answer(Outcome::unsupported, "");
  });
  const FingerprintDifference without = difference_of(plain, silent);
  CHECK(without.differ() == 0);
  CHECK(without.only_one() > 100);
}

TEST_CASE("what is not part of an answer does not change its hash", "[fingerprint]") {
  Observation o;
  o.outcome = Outcome::answered;
  o.distance = std::numeric_limits<double>::quiet_NaN();
  o.candidate_pairs = {{{0, 1}, {2, 3}}};
  Observation same = o;
  same.distance = -std::numeric_limits<double>::quiet_NaN();
  same.candidate_pairs = {{{3, 2}, {0, 1}}};
  same.elapsed_ns = 5;
  same.detail = "words";
  same.claimed_tolerance = 1;
  CHECK(hash_of_answer(o) == hash_of_answer(same));
  const std::vector<std::function<void(Observation&)>> changes = {
      [](Observation& x) { x.distance = 0.0; },
      [](Observation& x) { x.distance.reset(); },
      [](Observation& x) { x.overlap = false; },
      [](Observation& x) { x.overlap = true; },
      [](Observation& x) { x.normal = Vec3(1, 0, 0); },
      [](Observation& x) { x.depth = 0.0; },
      [](Observation& x) { x.toi = 0.0; },
      [](Observation& x) {
        x.witness = {Vec3(1, 0, 0), Vec3(0, 0, 0)};
      },
      [](Observation& x) {
        x.manifold = {{Vec3(1, 0, 0), 0}};
      },
      [](Observation& x) {
        x.candidate_pairs = {{{0, 1}}, {{2, 3}}};
      },
      [](Observation& x) {
        x.contacts = {{0, 1, Vec3(1, 0, 0), 0}};
      },
      [](Observation& x) { x.outcome = Outcome::crashed; }};
  std::vector<std::uint32_t> hashes{hash_of_answer(o)};
  for (const auto& change : changes) {
    Observation x = o;
    change(x);
    for (const std::uint32_t h : hashes) CHECK(hash_of_answer(x) != h);
    hashes.push_back(hash_of_answer(x));
  }
  CHECK(hash_of_answer(no_answer(Outcome::unsupported, "")) == 0);
}

TEST_CASE("damaged fingerprints are refused, with the place", "[fingerprint]") {
  const Fingerprint f = fingerprint(unchanged, 1, 40);
  const auto refused = [&](const std::string& at, const Json& value) {
    Json j = to_json(f);
    j[Json::json_pointer(at)] = value;
    try {
      from_text(j.dump());
    } catch (const InputError& e) {
      return std::string(e.what()).find("f.json") != std::string::npos;
    }
    return false;
  };
  CHECK(refused("/touchstone_fingerprint", 2));
  CHECK(refused("/hash", "0"));
  CHECK(refused("/digest", "xyz"));
  CHECK(refused("/groups/0/answers", "123"));
  CHECK(refused("/groups/0/answers", "0123456z"));
  CHECK(refused("/groups/0/asked", 1e6));
  CHECK(refused("/groups/0/hash", "12"));
  CHECK(refused("/groups", 3));
  Fingerprint other = f;
  other.set = 2;
  CHECK_THROWS_AS(difference_of(f, other), InputError);
  other = f;
  other.digest ^= 1;
  CHECK_THROWS_AS(difference_of(f, other), InputError);
  other = f;
  other.groups.pop_back();
  CHECK_THROWS_AS(difference_of(f, other), InputError);
}
