// Whether the certificates of a corpus hold.
#pragma once

#include <string>

#include "fuzz/corpus/corpus_json.h"

namespace touchstone::fuzz::corpus {

struct CheckedCase {
  int certificates = 0;  // that hold and prove what the case says
  /// Which one does not, and why; empty if all hold.
  std::string refused;
  /// Verdict and both ends of the gap, or the whole impact, have a certificate.
  bool complete = false;
};

/// By the checker (oracles/checker) alone, not the referee. Throws InputError if a certificate cannot be
/// read.
CheckedCase check_certificates(const StoredCorpusCase& c);

}  // namespace touchstone::fuzz::corpus
