// Certifies a broad phase as conservative, or refutes it (truth.md §6): asks the subject about every case of
// every evidence and judges each answer; the first wrong one is shrunk to a script of few bodies and steps.
// Same seed, same bytes, whatever the number of jobs; times are kept apart.
#pragma once

#include <atomic>
#include <functional>

#include "fuzz/certify/evidence.h"

namespace touchstone::fuzz {

struct Subject {
  std::string name;
  std::string plugin_hash;
  bool sweeps = false;  // candidates of a body with motion are those of the whole step
  /// An engine that answers `candidates`; the same for both levels unless the subject takes boxes as such.
  std::function<EnginePtr(Level)> make;
};

struct CertifyConfig {
  Scope scope = Scope::quick;
  std::uint64_t seed = 1;
  std::uint64_t limit = 0;  // cases of an evidence at most; 0: as the scope says
  std::vector<Level> levels{Level::boxes, Level::bodies};
  std::vector<std::string> without;  // names of evidence to leave out; throws InputError on an unknown one
  int jobs = 1;
  std::string program;
};

/// Called between evidence and now and then within one.
using CertifyProgress = std::function<void(const EvidenceCount& now, std::size_t index, std::size_t count)>;

/// Nothing: stopped.
std::optional<BroadCertificate> certify(const Subject& subject, const CertifyConfig& config,
                                        const CertifyProgress& progress, const std::atomic<bool>& stop);

}  // namespace touchstone::fuzz
