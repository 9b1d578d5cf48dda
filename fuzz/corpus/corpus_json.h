// The JSON of the corpus, whose schema is corpus/schema.json, and whether the certificates in it hold.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "fuzz/corpus/corpus_case.h"

namespace touchstone::fuzz::corpus {

/// The version of the format, and that of the cases.
inline constexpr int format_version = 1;
inline constexpr std::string_view release = "1.0.0";

nlohmann::ordered_json to_json(const CorpusCase& c);
/// The text of one file: a case a line.
std::string file_text(const std::vector<CorpusCase>& cases);

/// A case as it is needed to ask engines and to check certificates.
struct StoredCorpusCase {
  std::string place;  // file and position, for messages
  std::string id, mechanism, size, source;
  std::vector<std::string> degeneracy;
  Scene scene;
  nlohmann::ordered_json truth;
  std::vector<int> exponents;  // of the tolerances for which right times are listed, of moving bodies
};

/// The cases of DIR/cases/*.json, sorted by file. Throws InputError, also when there is none.
std::vector<StoredCorpusCase> load_corpus(const std::filesystem::path& directory);

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
