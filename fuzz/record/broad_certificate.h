// What `touchstone certify` found out about a broad phase, as a plain value with a JSON form: enough to make
// all of it again (truth.md §6). Times are kept beside and are part of no comparison.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "oracles/api/engine.h"

namespace touchstone::fuzz {

/// What candidates must contain. boxes: every pair of the boxes given, which the subject's arithmetic holds
/// exactly, that overlap; bodies: every pair of bodies that truly overlap, whatever box the subject makes.
enum class Level : std::uint8_t { boxes, bodies };
inline constexpr std::array<std::string_view, 2> level_names{"boxes", "bodies"};
constexpr std::string_view to_string(Level l) { return level_names[static_cast<std::size_t>(l)]; }

enum class EvidenceKind : std::uint8_t { exhaustive, adversarial, temporal, random };
inline constexpr std::array<std::string_view, 4> evidence_kind_names{"exhaustive", "adversarial", "temporal",
                                                                     "random"};
constexpr std::string_view to_string(EvidenceKind k) {
  return evidence_kind_names[static_cast<std::size_t>(k)];
}

struct EvidenceCount {
  std::string name, line;
  EvidenceKind kind = EvidenceKind::random;
  Level level = Level::boxes;
  std::uint64_t planned = 0;     // cases
  std::uint64_t population = 0;  // exhaustive: how many there are; planned < population is a sample
  std::uint64_t cases = 0;       // done; fewer than planned after a refutation
  std::uint64_t answered = 0, refused = 0;  // cases; refused: unsupported or invalid input, with a reason
  std::uint64_t steps = 0, queries = 0;
  std::uint64_t pairs_true = 0, pairs_reported = 0;  // the price is reported / true - 1
  std::uint64_t undecided = 0;                       // pairs that the referee left open
  std::uint64_t digest = 0;                          // of cases and answers
  std::string refusal;                               // the first reason for one
  double seconds = 0;                                // not compared
};

struct Refutation {
  Level level = Level::boxes;
  std::string evidence;
  std::uint64_t index = 0;            // case of that evidence
  std::string fault;                  // missed, stale, no_number, crashed, timed_out, threw, not_converged
  std::string words;                  // of the smallest script
  std::string shrink;                 // how the shrinking ended
  std::size_t bodies = 0, steps = 0;  // that the script uses
  std::optional<Case> script;         // empty: its numbers have no JSON form (NaN, infinite)
};

struct BroadCertificate {
  std::string subject;
  EngineCard card;
  std::string plugin_hash;  // FNV-1a of the file, empty in process
  std::string program;      // "touchstone 0.1.0"
  std::string scope;        // "quick", "full"
  std::uint64_t seed = 1;
  std::uint64_t limit = 0;  // cases of an evidence at most; 0: as the scope says
  std::vector<Level> levels;
  bool sweeps = false;               // asked about bodies that move within the step
  std::vector<std::string> without;  // evidence left out by request
  std::vector<EvidenceCount> evidence;
  std::vector<Refutation> refutations;  // one a level at most
};

enum class LevelVerdict : std::uint8_t { certified, refuted, nothing_proved, not_asked };
std::string_view to_string(LevelVerdict v);
LevelVerdict verdict(const BroadCertificate& c, Level level);
/// 0 certified at every level asked, 1 refuted at one, 3 nothing proved.
int exit_code(const BroadCertificate& c);

/// What the certificate does not say, a sentence each.
std::vector<std::string> not_proved(const BroadCertificate& c);

/// Over everything that is compared; also stored in the JSON as "digest".
std::uint64_t digest(const BroadCertificate& c);
nlohmann::ordered_json to_json(const BroadCertificate& c);
/// Throws InputError. `digest_holds`: the stored digest is that of the rest.
BroadCertificate broad_certificate_from_json(const nlohmann::ordered_json& j, bool& digest_holds);

}  // namespace touchstone::fuzz
