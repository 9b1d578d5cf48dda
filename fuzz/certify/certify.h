// Certifies a broad phase as conservative, or refutes it (truth.md §6): puts every case of every evidence to
// the subject and judges each answer. Every class of fault that an evidence shows is listed, and each class
// is shrunk to a script of few bodies and steps. A question that is not answered in time proves nothing: it
// is not a fault, but the subject is not certified either. For a subject that answers in time, the same seed
// gives the same bytes for any number of jobs; times are stored separately.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <optional>

#include "fuzz/certify/candidate_verdict.h"
#include "oracles/abi/engine.h"
#include "reports/record/broad_certificate.h"
#include "scenarios/exhaustive/evidence.h"

namespace touchstone::fuzz {

/// An engine that claims a coarser unit roundoff than this computes in float.
inline constexpr double max_float64_roundoff = 0x1p-50;

struct Subject {
  std::string name;
  std::string plugin_hash;
  bool sweeps = false;  // answers `swept_candidates` too
  /// Makes an engine that answers `candidates`. The level matters only to a subject that takes boxes
  /// directly.
  std::function<EnginePtr(BroadLevel)> make;
  double case_seconds = 1;  // CPU seconds allowed per question
  /// The same with `times` as many seconds, to measure what a question needs. Null: slow questions are not
  /// retried.
  std::function<EnginePtr(BroadLevel, double times)> make_patient = {};
};

struct CertifyConfig {
  Scope scope = Scope::quick;
  std::uint64_t seed = 1;
  std::uint64_t limit = 0;  // most cases per evidence; 0: the scope's number
  std::vector<BroadLevel> levels{BroadLevel::boxes, BroadLevel::bodies};
  /// If given, >= 0: pairs that are no farther apart must be reported (`candidates_within`). Motions are not
  /// asked about then.
  std::optional<double> margin = std::nullopt;
  std::vector<std::string> without;  // evidence to leave out, by name; an unknown name throws InputError
  bool first_fault = false;          // end a level at the first evidence that shows a fault
  /// Time for all evidence together, without refutations. Each evidence gets an equal share of what is left,
  /// and runs a prefix of its cases, at least its first part: what was run depends on the machine, the result
  /// of what was run does not.
  std::optional<double> minutes = std::nullopt;
  /// By name: the cases of an evidence that ran out of time, to run the same ones again.
  std::map<std::string, std::uint64_t> most_cases = {};
  int jobs = 1;
  std::string program;
};

/// Called after each evidence and repeatedly during one.
using CertifyProgress = std::function<void(const EvidenceCount& now, std::size_t index, std::size_t count)>;

/// Returns nothing if it was stopped.
std::optional<BroadCertificate> certify(const Subject& subject, const CertifyConfig& config,
                                        const CertifyProgress& progress, const std::atomic<bool>& stop);

// Reduces a wrong answer to the smallest script that shows it.

/// `c` is the case of `found`. If the subject's answers depend on earlier questions, every case gets a new
/// engine. Shrinking keeps the class of the fault: a solid pair stays solid.
Refutation refute(const Subject& subject, const EvidenceRow& e, const FaultCount& found, const Case& c);

/// Number of bodies that the script inserts; all bodies if there is no script.
std::size_t bodies_used(const Case& c);

}  // namespace touchstone::fuzz
