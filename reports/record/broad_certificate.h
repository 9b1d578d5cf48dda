// The result of `touchstone certify` for a broad phase, as a plain value with a JSON form that suffices to
// reproduce it (truth.md §6). Times are stored separately and never compared.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/value/certificate.h"
#include "scenarios/value/engine_card.h"
#include "scenarios/value/observation.h"

namespace touchstone::fuzz {

struct EvidenceCount {
  std::string name, line;
  SuiteKind kind = SuiteKind::random;
  BroadLevel level = BroadLevel::boxes;
  std::uint64_t planned = 0;     // cases
  std::uint64_t population = 0;  // exhaustive: number of all cases; planned < population is a sample
  std::uint64_t cases = 0;  // run; fewer than planned if crashes, a time-out or the end of the time ended it
  std::uint64_t answered = 0, refused = 0;  // cases; refused: unsupported or invalid input, with a reason
  std::uint64_t steps = 0, queries = 0;
  std::uint64_t pairs_true = 0, pairs_reported = 0;  // the price is reported / true - 1
  std::uint64_t undecided = 0;                       // pairs that the referee could not decide
  std::uint64_t digest = 0;                          // over cases and answers
  std::string refusal;                               // the first reason for a refusal
  bool out_of_time = false;                          // ended by the time allowed for all evidence
  double seconds = 0;                                // not compared
};

/// What a fault is about; the most certain to be a defect first.
enum class FaultKind : std::uint8_t {
  solid,      // a lost pair: both have volume, and they overlap by more than 1 % of their size
  touching,   // a lost pair that touches, overlaps by less, or has no volume
  moving,     // a lost pair that meets only within the step
  numbers,    // another fault than a lost pair, in a scene of finite bodies only
  unbounded,  // shown only with an infinite box in the scene
  invalid     // shown only with a NaN, infinite or inverted box in the scene
};
inline constexpr auto fault_kind_names =
    std::to_array<std::string_view>({"solid", "touching", "moving", "numbers", "unbounded", "invalid"});
static_assert(fault_kind_names.size() == static_cast<std::size_t>(FaultKind::invalid) + 1);
constexpr std::string_view to_string(FaultKind k) { return fault_kind_names[static_cast<std::size_t>(k)]; }

struct FaultClass {
  std::string fault;  // missed, stale, no_number, crashed, threw, not_converged
  FaultKind kind = FaultKind::numbers;
  bool operator==(const FaultClass&) const = default;
};
/// For messages: "missed, solid pair".
std::string in_words(const FaultClass& c);
/// Lost pairs first, by kind; then the other faults.
bool is_graver(const FaultClass& x, const FaultClass& y);

/// The cases of one evidence that show a class of fault.
struct FaultCount {
  BroadLevel level = BroadLevel::boxes;
  std::string evidence;
  FaultClass what;
  std::uint64_t cases = 0;
  std::uint64_t index = 0;  // the first case with the largest share
  double share = 0;         // of a lost solid pair: overlap / size of the smaller body, 0 to 1
  std::string words;        // description for that case
};

/// A question that was not answered in time, which says nothing about what the answer would have been.
struct TooSlow {
  BroadLevel level = BroadLevel::boxes;
  std::string evidence;
  std::uint64_t index = 0;
  std::size_t bodies = 0, steps = 0;
  double allowed = 0;     // CPU seconds per question
  double sufficient = 0;  // CPU seconds within which a retry was answered; 0: none was
  double tried = 0;       // most CPU seconds allowed in a retry
};

/// A class of fault with the smallest script that shows it.
struct Refutation {
  BroadLevel level = BroadLevel::boxes;
  std::string evidence;
  std::uint64_t index = 0;  // case of that evidence
  FaultClass what;
  std::string words;                  // description for the smallest script
  std::string shrink;                 // how shrinking ended
  std::size_t bodies = 0, steps = 0;  // used by the script
  bool is_shown_again = true;         // reproduced when the case was run again, alone
  std::optional<Case> script;         // empty: it has NaN or infinite numbers, which JSON lacks
};

struct BroadCertificate {
  std::string subject;
  EngineCard card;
  std::string plugin_hash;  // FNV-1a of the file; empty: the core
  std::string program;      // "touchstone 0.1.0"
  std::string scope;        // "quick", "full"
  std::uint64_t seed = 1;
  std::uint64_t limit = 0;  // most cases per evidence; 0: the scope's number
  std::vector<BroadLevel> levels;
  bool first_fault = false;  // requested: end a level at the first evidence that shows a fault
  std::optional<double> margin = std::nullopt;  // pairs no farther apart had to be reported
  bool sweeps = false;                          // bodies that move within the step were tested too
  std::vector<std::string> without;             // evidence left out by request
  std::vector<EvidenceCount> evidence;
  std::vector<FaultCount> faults;       // every class shown, in the order of the evidence
  std::vector<Refutation> refutations;  // one per level and class, the gravest of a level first
  std::vector<TooSlow> too_slow;
};

enum class LevelVerdict : std::uint8_t { certified, refuted, nothing_proved, not_asked, not_certified };
std::string_view to_string(LevelVerdict v);
LevelVerdict verdict(const BroadCertificate& c, BroadLevel level);
/// 0: certified at every level tested; 1: refuted at one; 3: nothing proved, or too slow to be certified.
int exit_code(const BroadCertificate& c);

/// What the certificate does not prove, one sentence each.
std::vector<std::string> not_proved(const BroadCertificate& c);

/// Hash of everything that is compared; also stored in the JSON as "digest".
std::uint64_t digest(const BroadCertificate& c);
nlohmann::ordered_json to_json(const BroadCertificate& c);
/// Throws InputError. Sets `digest_holds` to whether the stored digest matches the rest.
BroadCertificate broad_certificate_from_json(const nlohmann::ordered_json& j, bool& digest_holds);

}  // namespace touchstone::fuzz
