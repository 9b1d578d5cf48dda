#include "core/scene/input_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <vector>

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

// 0, or the system's reason why not.
int write_in_place(const std::filesystem::path& file, std::string_view text) {
  errno = 0;
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  if (out) out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (out) return 0;
  return errno != 0 ? errno : EIO;
}

}  // namespace

std::string read_file(const std::filesystem::path& file, std::uintmax_t max_bytes) {
  namespace fs = std::filesystem;
  std::error_code ec;
  const fs::file_status status = fs::status(file, ec);
  if (status.type() == fs::file_type::not_found) throw InputError(file.string(), "no such file");
  if (ec) throw InputError(file.string(), "cannot be read: " + ec.message());
  if (fs::is_directory(status)) throw InputError(file.string(), "is a directory, not a file");
  if (fs::is_regular_file(status)) {
    const std::uintmax_t size = fs::file_size(file, ec);
    if (!ec && size > max_bytes) refuse_size(file, mebibytes(size), max_bytes);
  }
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(file.string(), std::string("cannot be opened: ") + std::strerror(errno));
  // In pieces, with the limit again: a pipe has no size, and a file may grow.
  std::string text;
  std::vector<char> piece(std::size_t{1} << 16);
  while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())) || in.gcount() > 0) {
    text.append(piece.data(), static_cast<std::size_t>(in.gcount()));
    if (text.size() > max_bytes) refuse_size(file, "larger", max_bytes);
  }
  if (in.bad()) throw InputError(file.string(), "cannot be read to the end");
  return text;
}

void write_file(const std::filesystem::path& file, std::string_view text) {
  namespace fs = std::filesystem;
  std::error_code ec;
  const fs::file_status status = fs::status(file, ec);
  if (fs::exists(status) && !fs::is_regular_file(status))
    return require_written(file, write_in_place(file, text));
  const fs::path target = fs::is_symlink(file, ec) ? fs::canonical(file, ec) : file;
  const fs::path temporary = target.string() + ".part";
  if (const int why = write_in_place(temporary, text); why != 0) {
    if (fs::is_regular_file(temporary, ec)) fs::remove(temporary, ec);
    require_written(file, why);
  }
  fs::rename(temporary, target, ec);
  if (ec) throw InputError(file.string(), "cannot be replaced: " + ec.message());
}

}  // namespace touchstone
