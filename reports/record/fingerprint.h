// A fingerprint of an engine: a hash of each of its answers to a fixed set of cases, to find out which
// answers differ between two builds or releases. Plain values, with their JSON.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reports/record/observation_json.h"
#include "scenarios/codec/json_reader.h"
#include "scenarios/value/case.h"
#include "scenarios/value/engine_card.h"

namespace touchstone::fuzz {

struct Fingerprint {
  /// The set of cases (fuzz/fingerprint): its version, how many of its cases were asked, and a hash of these.
  std::uint64_t set = 0, cases = 0, digest = 0;
  std::string engine, library, version, settings;  // of the card
  struct Group {
    std::string question, shapes;  // "contact", "box-sphere"; shapes are "scene" for questions about a scene
    /// A hash of each answer, in the order of the set; 0: the engine does not answer the question.
    std::vector<std::uint32_t> answers;
    std::uint64_t answered() const;
    std::uint64_t hash() const;
  };
  std::vector<Group> groups;  // by question (in their order), then by shapes
  std::uint64_t hash() const;
};

/// Of everything that an answer states, but not of the tolerance that it claims, of words and of times.
/// Numbers count to the bit, except that every NaN is the same, and pairs of bodies in any order are.
std::uint32_t hash_of_answer(const Observation& o);

/// "box-sphere", in the order asked, or "scene".
std::string fingerprint_shapes(const Case& c, const Query& q);

struct FingerprintDifference {
  struct Group {
    std::string question, shapes;
    std::uint64_t both = 0, differ = 0;    // answers that both give, and those of them that differ
    std::uint64_t only_a = 0, only_b = 0;  // answers that only one gives
    std::size_t first = 0;                 // index in the group of the first that is not the same
    bool same() const { return differ + only_a + only_b == 0; }
  };
  std::vector<Group> groups;
  std::uint64_t both() const;
  std::uint64_t differ() const;
  std::uint64_t only_one() const;
  bool same() const { return differ() + only_one() == 0; }
};
/// Throws InputError when they are not of the same cases.
FingerprintDifference difference_of(const Fingerprint& a, const Fingerprint& b);

Json to_json(const Fingerprint& f);
/// Throws InputError, naming file and place.
Fingerprint fingerprint_from_json(const JsonReader& j);
Json to_json(const FingerprintDifference& d);

}  // namespace touchstone::fuzz
