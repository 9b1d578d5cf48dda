// Where the corpus's cases come from.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fuzz/corpus/corpus_case.h"

namespace touchstone::fuzz::corpus {

/// One file of the corpus.
struct Part {
  std::string name;  // of its file, without .json; ids begin with it
  std::vector<Seed> seeds;
};

/// Reported failures and causes, from `directory`/*.json; ladders, handmade scenarios and the lattice, from
/// this program. Sorted by name. Throws InputError.
std::vector<Part> all_parts(const std::filesystem::path& directory);

}  // namespace touchstone::fuzz::corpus
