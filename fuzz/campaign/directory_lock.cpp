#include "fuzz/campaign/directory_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <utility>

#include "core/base/input_error.h"

namespace touchstone::fuzz {
namespace {

std::string holder(int file) {
  char text[32] = {};
  const ssize_t n = pread(file, text, sizeof text - 1, 0);
  const std::string number(text, n > 0 ? static_cast<std::size_t>(n) : 0);
  const bool is_number = !number.empty() && number.find_first_not_of("0123456789\n") == std::string::npos;
  return is_number ? "process " + number.substr(0, number.find('\n')) : "another process";
}

void write_holder(int file) {
  const std::string text = std::to_string(getpid()) + "\n";
  // For people only: the lock also holds without a process id in the file.
  if (ftruncate(file, 0) == 0 && pwrite(file, text.data(), text.size(), 0) < 0) return;
}

}  // namespace

DirectoryLock::DirectoryLock(const std::filesystem::path& directory, For purpose) {
  const bool writes = purpose == For::writing;
  const auto path = directory / "lock";
  // O_CLOEXEC: child processes do not inherit the lock, so it ends with this process.
  file_ =
      open(path.c_str(), (writes ? O_RDWR | O_CREAT : O_RDONLY) | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  if (file_ < 0) return;  // writing the first file will fail with a better message
  if (flock(file_, (writes ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0) {
    if (writes) write_holder(file_);
    return;
  }
  if (errno != EWOULDBLOCK) return;
  // The file names the last writer, never a reader.
  const bool is_read = writes && flock(file_, LOCK_SH | LOCK_NB) == 0;
  const std::string who = is_read ? "another process is reading it" : holder(file_) + " is writing it";
  close(std::exchange(file_, -1));
  throw InputError(directory.string(), "is in use: " + who);
}

DirectoryLock::~DirectoryLock() {
  if (file_ >= 0) close(file_);
}

DirectoryLock::DirectoryLock(DirectoryLock&& from) noexcept : file_(std::exchange(from.file_, -1)) {}

}  // namespace touchstone::fuzz
