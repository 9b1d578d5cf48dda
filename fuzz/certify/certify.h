// Certifies a broad phase as conservative, or refutes it (truth.md §6): asks the subject about every case of
// every evidence and judges each answer. Every class of fault that an evidence shows is listed, and each
// class is shrunk to a script of few bodies and steps. A question that is not answered in time proves
// nothing: it is neither a fault nor certified. Same seed, same bytes, whatever the number of jobs, for a
// subject that answers in time; times are kept apart.
#pragma once

#include <atomic>
#include <functional>

#include "scenarios/exhaustive/evidence.h"
#include "reports/record/broad_certificate.h"
#include "oracles/abi/engine.h"

namespace touchstone::fuzz {

struct Subject {
  std::string name;
  std::string plugin_hash;
  bool sweeps = false;  // answers `swept_candidates` too
  /// An engine that answers `candidates`; the same for both levels unless the subject takes boxes as such.
  std::function<EnginePtr(BroadLevel)> make;
  double case_seconds = 1;  // CPU seconds that it may spend on one question
  /// The same with `times` of these seconds, to learn what a question needs. Null: it is not asked again.
  std::function<EnginePtr(BroadLevel, double times)> make_patient = {};
};

struct CertifyConfig {
  Scope scope = Scope::quick;
  std::uint64_t seed = 1;
  std::uint64_t limit = 0;  // cases of an evidence at most; 0: as the scope says
  std::vector<BroadLevel> levels{BroadLevel::boxes, BroadLevel::bodies};
  std::vector<std::string> without;  // names of evidence to leave out; throws InputError on an unknown one
  bool first_fault = false;          // a level ends with the first evidence that shows a fault
  int jobs = 1;
  std::string program;
};

/// Called between evidence and now and then within one.
using CertifyProgress = std::function<void(const EvidenceCount& now, std::size_t index, std::size_t count)>;

/// Nothing: stopped.
std::optional<BroadCertificate> certify(const Subject& subject, const CertifyConfig& config,
                                        const CertifyProgress& progress, const std::atomic<bool>& stop);

}  // namespace touchstone::fuzz
