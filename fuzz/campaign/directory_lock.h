// One campaign per directory: the process that writes it holds DIR/lock until it ends, however it ends.
#pragma once

#include <filesystem>

namespace touchstone::fuzz {

class DirectoryLock {
 public:
  enum class For { writing, reading };

  /// Precondition: the directory exists. Readers share the lock. Throws InputError naming the process that
  /// holds it. A read-only directory, or a file system without locks, is used unlocked.
  DirectoryLock(const std::filesystem::path& directory, For purpose);
  ~DirectoryLock();
  DirectoryLock(DirectoryLock&& from) noexcept;
  DirectoryLock& operator=(DirectoryLock&&) = delete;

 private:
  int file_ = -1;
};

}  // namespace touchstone::fuzz
