#include "scenarios/codec/json_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "core/base/input_error.h"

namespace touchstone {
namespace {

std::string mebibytes(std::uintmax_t bytes) { return std::to_string(bytes >> 20) + " MiB"; }

[[noreturn]] void refuse_size(const std::filesystem::path& file, const std::string& size,
                              std::uintmax_t max_bytes) {
  throw InputError(file.string(),
                   "is " + size + "; files larger than " + mebibytes(max_bytes) + " are refused");
}

void require_written(const std::filesystem::path& file, int why) {
  if (why != 0) throw InputError(file.string(), std::string("cannot be written: ") + std::strerror(why));
}

class Descriptor {
 public:
  Descriptor(const std::filesystem::path& file, int flags)
      : fd_(open(file.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() {
    if (fd_ >= 0) close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }
  bool ok() const { return fd_ >= 0; }
  /// Closes the file. Returns 0 or errno: some file systems report a full disk only here.
  int done() {
    const int fd = fd_;
    fd_ = -1;
    return close(fd) == 0 ? 0 : errno;
  }

 private:
  int fd_;
};

std::string kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a directory";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

// Returns 0 or errno. The flags determine what happens to an existing file.
int write_whole(const std::filesystem::path& file, int flags, std::string_view text) {
  Descriptor out(file, O_WRONLY | O_CREAT | flags);
  if (!out.ok()) return errno;
  while (!text.empty()) {
    const ssize_t n = write(out.get(), text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
  return out.done();
}

}  // namespace

void require_regular_file(const std::filesystem::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) {
    if (errno == ENOENT || errno == ENOTDIR) throw InputError(file.string(), "no such file");
    throw InputError(file.string(), std::string("cannot be read: ") + std::strerror(errno));
  }
  if (!S_ISREG(status.st_mode))
    throw InputError(file.string(), "is " + kind_of(status.st_mode) + ", not a file");
}

// Checks the kind of file before opening it and again afterwards: opening a device may have side effects, and
// opening a pipe waits for a writer unless O_NONBLOCK is set.
std::string read_file(const std::filesystem::path& file, std::uintmax_t max_bytes) {
  require_regular_file(file);
  const Descriptor in(file, O_RDONLY | O_NONBLOCK | O_NOCTTY);
  if (!in.ok()) throw InputError(file.string(), std::string("cannot be opened: ") + std::strerror(errno));
  struct stat status {};
  if (fstat(in.get(), &status) != 0 || !S_ISREG(status.st_mode))
    throw InputError(file.string(), "is no longer a regular file");
  const auto size = static_cast<std::uintmax_t>(status.st_size);
  if (size > max_bytes) refuse_size(file, mebibytes(size), max_bytes);
  // Check the limit again: the file may grow.
  constexpr std::size_t piece = std::size_t{1} << 16;
  std::string text(static_cast<std::size_t>(size) + 1, '\0');
  for (std::size_t filled = 0;;) {
    if (filled == text.size()) text.resize(filled + piece);
    const ssize_t n = read(in.get(), text.data() + filled, text.size() - filled);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw InputError(file.string(), "cannot be read to the end");
    filled += static_cast<std::size_t>(n);
    if (filled > max_bytes) refuse_size(file, "larger", max_bytes);
    if (n > 0) continue;
    text.resize(filled);
    return text;
  }
}

void write_file(const std::filesystem::path& file, std::string_view text) {
  namespace fs = std::filesystem;
  std::error_code ec;
  const fs::file_status status = fs::status(file, ec);
  if (fs::exists(status) && !fs::is_regular_file(status))
    return require_written(file, write_whole(file, O_TRUNC, text));
  const fs::path target = fs::is_symlink(file, ec) ? fs::canonical(file, ec) : file;
  const fs::path temporary = target.string() + ".part";
  // An existing file is left over from a killed run, or is a link that someone else planted: never write to
  // it.
  if (!fs::is_directory(fs::symlink_status(temporary, ec))) fs::remove(temporary, ec);
  if (const int why = write_whole(temporary, O_EXCL | O_NOFOLLOW, text); why != 0) {
    if (why != EEXIST) fs::remove(temporary, ec);
    require_written(file, why);
  }
  fs::rename(temporary, target, ec);
  if (ec) throw InputError(file.string(), "cannot be replaced: " + ec.message());
}

}  // namespace touchstone
