#include "reports/record/fingerprint.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/base/hash.h"
#include "core/base/input_error.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/value/candidate_pairs.h"

namespace touchstone::fuzz {
namespace {

constexpr std::size_t hex_digits = 8;  // of the hash of one answer

void add(Hasher& h, double x) { h.add(std::isnan(x) ? std::numeric_limits<double>::quiet_NaN() : x); }

void add(Hasher& h, const Vec3& v) {
  for (int k = 0; k < 3; ++k) add(h, v[k]);
}

template <class T>
void add(Hasher& h, const std::optional<T>& x) {
  h.add(x.has_value());
  if (x) add(h, *x);
}

void add_number_of(Hasher& h, const std::optional<bool>& x) { h.add(x ? 1 + *x : 0); }

void add_points(Hasher& h, const Observation& o) {
  h.add(o.witness.has_value());
  if (o.witness)
    for (const Vec3& p : *o.witness) add(h, p);
  h.add(o.manifold.size());
  for (const ManifoldPoint& p : o.manifold) {
    add(h, p.position);
    add(h, p.depth);
  }
}

void add_pairs(Hasher& h, const Observation& o) {
  h.add(o.candidate_pairs.size());
  for (std::vector<BodyPair> pairs : o.candidate_pairs) {
    for (BodyPair& p : pairs)
      if (p.first > p.second) std::swap(p.first, p.second);
    std::sort(pairs.begin(), pairs.end());
    h.add(pairs.size());
    for (const BodyPair& p : pairs) h.add(p.first).add(p.second);
  }
  std::vector<SceneContact> contacts = o.contacts;
  std::stable_sort(contacts.begin(), contacts.end(), [](const SceneContact& x, const SceneContact& y) {
    return std::pair(x.a, x.b) < std::pair(y.a, y.b);
  });
  h.add(contacts.size());
  for (const SceneContact& c : contacts) {
    h.add(c.a).add(c.b);
    add(h, c.normal);
    add(h, c.depth);
  }
}

bool is_given(const Observation& o) {
  return o.outcome != Outcome::unsupported && o.outcome != Outcome::not_asked;
}

std::string hex(std::uint64_t x, std::size_t digits) { return fmt::format("{:0{}x}", x, digits); }

std::uint64_t hex_number(const JsonReader& r, std::string_view digits) {
  std::uint64_t x = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), x, 16);
  if (digits.empty() || error != std::errc() || end != digits.data() + digits.size())
    r.fail("must be hexadecimal digits");
  return x;
}

Json group_json(const Fingerprint::Group& g) {
  std::string each;
  for (const std::uint32_t a : g.answers) each += hex(a, hex_digits);
  return {{"question", g.question},   {"shapes", g.shapes},        {"asked", g.answers.size()},
          {"answered", g.answered()}, {"hash", hex(g.hash(), 16)}, {"answers", each}};
}

Fingerprint::Group group_from_json(const JsonReader& j) {
  Fingerprint::Group g{j["question"].string(), j["shapes"].string(), {}};
  const JsonReader answers = j["answers"];
  const std::string each = answers.string();
  if (each.size() % hex_digits != 0) answers.fail("must have 8 digits an answer");
  for (std::size_t i = 0; i < each.size(); i += hex_digits)
    g.answers.push_back(
        static_cast<std::uint32_t>(hex_number(answers, std::string_view(each).substr(i, hex_digits))));
  if (count_of(j["asked"]) != g.answers.size()) j["asked"].fail("is not the number of answers");
  if (hex_number(j["hash"], j["hash"].string()) != g.hash()) j["hash"].fail("is not the hash of the answers");
  return g;
}

}  // namespace

std::uint64_t Fingerprint::Group::answered() const {
  return answers.size() - static_cast<std::uint64_t>(std::count(answers.begin(), answers.end(), 0U));
}

std::uint64_t Fingerprint::Group::hash() const {
  Hasher h;
  h.add(std::string_view(question)).add(std::string_view(shapes));
  for (const std::uint32_t a : answers) h.add(a);
  return h.value();
}

std::uint64_t Fingerprint::hash() const {
  Hasher h;
  h.add(set).add(cases).add(digest);
  for (const Group& g : groups) h.add(g.hash());
  return h.value();
}

std::uint32_t hash_of_answer(const Observation& o) {
  if (!is_given(o)) return 0;
  Hasher h;
  h.add(static_cast<int>(o.outcome));
  add_number_of(h, o.overlap);
  add(h, o.distance);
  add(h, o.normal);
  add(h, o.depth);
  add(h, o.toi);
  if (o.lower_bound || o.upper_bound) {
    add(h, o.lower_bound);
    add(h, o.upper_bound);
  }
  if (o.moment) add(h, o.moment);
  if (o.unique_gradient) add_number_of(h, o.unique_gradient);
  add_points(h, o);
  add_pairs(h, o);
  const auto folded = static_cast<std::uint32_t>(h.value() ^ (h.value() >> 32));
  return folded == 0 ? 1 : folded;
}

std::string fingerprint_shapes(const Case& c, const Query& q) {
  if (!is_pair_question(q.question)) return "scene";
  const auto kind = [&](int body) { return type_name(c.scene.shape_of(body)); };
  return fmt::format("{}-{}", kind(q.a), kind(q.b));
}

FingerprintDifference difference_of(const Fingerprint& a, const Fingerprint& b) {
  const auto refuse = [&](const std::string& why) {
    throw InputError("--compare", fmt::format("{} {} and {} {} were not asked the same: {}", a.engine,
                                              a.version, b.engine, b.version, why));
  };
  if (a.set != b.set) refuse(fmt::format("versions {} and {} of the set of cases", a.set, b.set));
  if (a.cases != b.cases) refuse(fmt::format("{} and {} cases", a.cases, b.cases));
  if (a.digest != b.digest) refuse("their cases differ");
  if (a.groups.size() != b.groups.size()) refuse("their questions differ");
  FingerprintDifference d;
  for (std::size_t i = 0; i < a.groups.size(); ++i) {
    const Fingerprint::Group &x = a.groups[i], &y = b.groups[i];
    if (x.question != y.question || x.shapes != y.shapes || x.answers.size() != y.answers.size())
      refuse("their questions differ");
    FingerprintDifference::Group g{x.question, x.shapes};
    for (std::size_t k = 0; k < x.answers.size(); ++k) {
      const std::uint32_t p = x.answers[k], q = y.answers[k];
      if (p != q && g.same()) g.first = k;
      g.both += p != 0 && q != 0;
      g.differ += p != 0 && q != 0 && p != q;
      g.only_a += p != 0 && q == 0;
      g.only_b += p == 0 && q != 0;
    }
    d.groups.push_back(std::move(g));
  }
  return d;
}

std::uint64_t FingerprintDifference::both() const {
  std::uint64_t n = 0;
  for (const Group& g : groups) n += g.both;
  return n;
}

std::uint64_t FingerprintDifference::differ() const {
  std::uint64_t n = 0;
  for (const Group& g : groups) n += g.differ;
  return n;
}

std::uint64_t FingerprintDifference::only_one() const {
  std::uint64_t n = 0;
  for (const Group& g : groups) n += g.only_a + g.only_b;
  return n;
}

Json to_json(const Fingerprint& f) {
  Json j{{"touchstone_fingerprint", 1}, {"set", f.set},           {"cases", f.cases},
         {"digest", hex(f.digest, 16)}, {"engine", f.engine},     {"library", f.library},
         {"version", f.version},        {"settings", f.settings}, {"hash", hex(f.hash(), 16)}};
  j["groups"] = Json::array();
  for (const Fingerprint::Group& g : f.groups) j["groups"].push_back(group_json(g));
  return j;
}

Fingerprint fingerprint_from_json(const JsonReader& j) {
  if (count_of(j["touchstone_fingerprint"]) != 1) j["touchstone_fingerprint"].fail("must be 1");
  Fingerprint f;
  f.set = count_of(j["set"]);
  f.cases = count_of(j["cases"]);
  f.digest = hex_number(j["digest"], j["digest"].string());
  f.engine = j["engine"].string();
  f.library = j["library"].string();
  f.version = j["version"].string();
  f.settings = j["settings"].string();
  for (const JsonReader& g : j["groups"].items()) f.groups.push_back(group_from_json(g));
  if (hex_number(j["hash"], j["hash"].string()) != f.hash()) j["hash"].fail("is not the hash of the groups");
  return f;
}

Json to_json(const FingerprintDifference& d) {
  Json j{{"both_answer", d.both()}, {"differ", d.differ()}, {"only_one_answers", d.only_one()}};
  j["groups"] = Json::array();
  for (const FingerprintDifference::Group& g : d.groups)
    if (!g.same())
      j["groups"].push_back({{"question", g.question},
                             {"shapes", g.shapes},
                             {"both_answer", g.both},
                             {"differ", g.differ},
                             {"only_a", g.only_a},
                             {"only_b", g.only_b}});
  return j;
}

}  // namespace touchstone::fuzz
