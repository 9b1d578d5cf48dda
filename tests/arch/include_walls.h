// The walls of docs/architecture.md, for a source tree.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace touchstone::test {

/// One sentence for each #include of a room that the table does not permit, each permission that nothing
/// uses, each file outside the rooms, and each header of a foreign engine outside that engine's folder.
std::vector<std::string> broken_walls(const std::filesystem::path& root);

}  // namespace touchstone::test
