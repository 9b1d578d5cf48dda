// One campaign a directory: whoever writes it holds DIR/lock until the process ends, however it ends.
#pragma once

#include <filesystem>

namespace touchstone::fuzz {

class DirectoryLock {
 public:
  enum class For { writing, reading };

  /// The directory is there. Readers share it. Throws InputError, naming the process that holds it. A file
  /// system that knows no locks, and a directory that only can be read, is used without.
  DirectoryLock(const std::filesystem::path& directory, For purpose);
  ~DirectoryLock();
  DirectoryLock(DirectoryLock&& from) noexcept;
  DirectoryLock& operator=(DirectoryLock&&) = delete;

 private:
  int file_ = -1;
};

}  // namespace touchstone::fuzz
