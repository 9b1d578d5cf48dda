#include "cli/output_file.h"

#include <unistd.h>

#include <filesystem>

#include "core/base/input_error.h"

namespace touchstone::cli {

void require_writable(const std::string& file) {
  if (file.empty()) return;
  const auto directory = std::filesystem::absolute(file).parent_path();
  if (std::filesystem::is_directory(file)) throw InputError(file, "cannot be written: it is a directory");
  const bool there = std::filesystem::exists(file);
  if (!there && !std::filesystem::is_directory(directory))
    throw InputError(file, "cannot be written: there is no directory " + directory.string());
  if (there && !std::filesystem::is_regular_file(file)) return;  // a device or a pipe: written in place
  if (access(directory.c_str(), W_OK) != 0) throw InputError(file, "cannot be written: no permission");
}

}  // namespace touchstone::cli
