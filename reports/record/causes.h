// The distinct causes behind a campaign's findings: what `touchstone causes` prints, stores and draws. Plain
// values, with their JSON.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "reports/record/observation_json.h"
#include "scenarios/codec/json_reader.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// How grave a cause is: that of its gravest fault. Causes are listed in this order.
enum class Severity : std::uint8_t {
  crash,        // the engine crashed, threw, or gave an answer that cannot be read
  hang,         // it exceeded its time
  missed,       // it denies an overlap, an impact or a pair
  ghost,        // it claims one that does not exist
  infeasible,   // moving by the depth along the normal does not separate the bodies, or there is no such
                // number
  time,         // an impact late or early
  not_minimal,  // the contact separates, but by more than necessary
  distance,     // the signed distance
  witness,      // points of a distance or of a manifold
  declined,     // it says that it has no answer: not converged, input refused
  unstable,     // the same question is answered differently
  relation      // it contradicts itself, and no other fault explains that
};
inline constexpr auto severity_names =
    std::to_array<std::string_view>({"crash", "hang", "missed", "ghost", "infeasible", "time", "not minimal",
                                     "distance", "witness", "declined", "unstable", "contradiction"});
static_assert(severity_names.size() == static_cast<std::size_t>(Severity::relation) + 1);
constexpr std::string_view to_string(Severity s) { return severity_names[static_cast<std::size_t>(s)]; }

/// What became of the fault when one thing was changed.
enum class Response : std::uint8_t {
  stays,
  gone,
  differs,        // wrong, but in another way
  open,           // no verdict: the referee could not decide, or the engine does not answer
  not_applicable  // there is nothing to change: no engine of other precision, no box to give as a hull
};
inline constexpr auto response_names =
    std::to_array<std::string_view>({"stays", "gone", "differs", "open", "not applicable"});
static_assert(response_names.size() == static_cast<std::size_t>(Response::not_applicable) + 1);
constexpr std::string_view to_string(Response r) { return response_names[static_cast<std::size_t>(r)]; }

struct Responded {
  std::string intervention;  // its name: "scaled_up"
  std::string change;        // what was changed, for people: "scaled by 1024"
  Response response = Response::not_applicable;
  bool operator==(const Responded&) const = default;
};

/// A case that shows a cause.
struct CauseCase {
  std::string engine, key;  // who shows it, and the finding's key there
  Json c;                   // the case, as `touchstone replay` reads it; null: none
  std::string words;        // the fault in one sentence, with the numbers
  double error_in_l = 0;
  CaseSize size;
};

struct Cause {
  std::string id;    // of path, route and response: the same in every run; a word that may name a directory
  std::string path;  // engines that share the code concerned: "fcl-libccd", "bullet-query"
  std::string library;  // of its engines, with the version: "FCL 0.7.0"
  std::string route;    // the library's routine, or the kinds of shapes that it serves: "sphere", "convex"
  std::string title;    // one sentence
  Severity severity = Severity::relation;
  /// Where the engine's documentation states the behaviour; empty: it does not. A documented cause is listed
  /// last.
  std::string documented;
  std::uint64_t wrong = 0;  // wrong answers, and how many the same engines gave to such questions
  std::uint64_t asked = 0;
  double worst_in_l = 0;
  std::uint64_t first_index = 0;                                          // of the first case in the campaign
  std::vector<std::string> engines, questions, faults, shapes, families;  // each sorted
  std::vector<Responded> response;
  std::vector<std::string> keys;  // of the findings, sorted
  /// Faults that follow from this one: "contact not_minimal (212)".
  std::vector<std::string> consequences;
  CauseCase smallest;    // the smallest case found
  CauseCase defensible;  // solid bodies, plainly apart or overlapping, plain numbers; its case may be null
  CauseCase worst;       // the largest error of the campaign, as it was found
  Json certificate;      // of the case shown; null: there is none
  /// A program in the engine's own API that shows it; empty: none, for `no_program`.
  std::string program, no_program;

  /// The case to show first: the defensible one if there is one.
  const CauseCase& shown() const { return defensible.c.is_null() ? smallest : defensible; }
  double rate() const { return asked > 0 ? static_cast<double>(wrong) / static_cast<double>(asked) : 0; }
};

/// From these rates of wrong answers on, and below, a cause is called systematic or a corner case; neither
/// with fewer answers than this, of which a rate says little.
inline constexpr double systematic_from = 0.30, corner_case_below = 0.01;
inline constexpr std::uint64_t fewest_for_rate = 10;

struct Causes {
  std::string campaign;  // its directory, for people
  std::string digest;    // of its results
  std::uint64_t seed = 0, cases = 0;
  std::vector<Cause> causes;  // in the order in which to read them
  std::uint64_t answers = 0;  // wrong answers in all, and the keys that they were filed under
  std::uint64_t keys = 0;
  /// Good–Turing estimate of the chance that the next wrong answer belongs to a cause not listed: causes seen
  /// once, divided by wrong answers.
  double unseen = 0;
  /// Reasons why the evidence is incomplete: engines that are missing, the budget exhausted. Sorted.
  std::vector<std::string> notes;
};

/// True for an id: 1 to 120 lower-case letters, digits, _ and -, not beginning with -. It may name a
/// directory.
bool is_cause_id(std::string_view id);

Json to_json(const Cause& c);
Json to_json(const Causes& c);
/// Throws InputError, naming file and place.
Causes causes_from_json(const JsonReader& j);

}  // namespace touchstone::fuzz
