#include "fuzz/cli/case_argument.h"

#include <filesystem>

#include "scenarios/catalog.h"

namespace touchstone::cli {

StoredCase case_argument(const std::string& text) {
  const std::filesystem::path path = text;
  if (std::filesystem::is_directory(path)) return load_stored_case(path / "case.json");
  if (!std::filesystem::exists(path))
    for (const auto& s : scenarios::catalog())
      if (s.name == text) return {s.make(), s.line, "scenario " + s.name, s.expect};
  return load_stored_case(path);
}

}  // namespace touchstone::cli
