// Files are replaced atomically, and only regular files are read.
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/base/input_error.h"
#include "scenarios/codec/json_file.h"
#include "tests/scenarios/import/temp_dir.h"
#include "tests/support/catch.h"

using namespace touchstone;
namespace fs = std::filesystem;

TEST_CASE("a file that cannot be written keeps its content", "[scene][file]") {
  const test::TempDir dir;
  const fs::path file = dir.path() / "kept.json";
  write_file(file, "first");
  write_file(file, "second");
  CHECK(read_file(file, 100) == "second");
  CHECK_FALSE(fs::exists(file.string() + ".part"));
  fs::create_directory(file.string() + ".part");  // in the way
  CHECK_THROWS_AS(write_file(file, "third"), InputError);
  CHECK(read_file(file, 100) == "second");
  CHECK_THROWS_AS(write_file(dir.path() / "no" / "folder", "x"), InputError);
}

TEST_CASE("links and devices are written to, not replaced", "[scene][file]") {
  const test::TempDir dir;
  write_file(dir.path() / "target", "old");
  fs::create_symlink("target", dir.path() / "link");
  write_file(dir.path() / "link", "new");
  CHECK(fs::is_symlink(dir.path() / "link"));
  CHECK(read_file(dir.path() / "target", 100) == "new");
  CHECK_NOTHROW(write_file("/dev/null", "gone"));
  CHECK(fs::is_character_file("/dev/null"));
  if (fs::exists("/dev/full")) CHECK_THROWS_AS(write_file("/dev/full", "too much"), InputError);
}

namespace {

std::string refused(const fs::path& file) {
  try {
    read_file(file, 100);
  } catch (const InputError& e) {
    return e.reason();
  }
  return "(read)";
}

}  // namespace

TEST_CASE("only regular files are read, without waiting for others", "[scene][file]") {
  const test::TempDir dir;
  CHECK(refused(dir.path() / "none") == "no such file");
  CHECK(refused(dir.path() / "none/x") == "no such file");
  CHECK(refused(dir.path()) == "is a directory, not a file");
  CHECK(refused("/dev/null") == "is a device, not a file");
  REQUIRE(mkfifo((dir.path() / "pipe").c_str(), 0600) == 0);
  CHECK(refused(dir.path() / "pipe") == "is a pipe, not a file");
  fs::create_symlink("pipe", dir.path() / "link");
  CHECK(refused(dir.path() / "link") == "is a pipe, not a file");
  fs::create_symlink("itself", dir.path() / "itself");
  CHECK(refused(dir.path() / "itself").starts_with("cannot be read: "));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string socket_file = (dir.path() / "socket").string();
  REQUIRE(socket_file.size() < sizeof address.sun_path);
  std::strcpy(address.sun_path, socket_file.c_str());
  const int listener = socket(AF_UNIX, SOCK_STREAM, 0);
  REQUIRE(bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  CHECK(refused(socket_file) == "is a socket, not a file");
  close(listener);
  write_file(dir.path() / "empty", "");
  CHECK(read_file(dir.path() / "empty", 100).empty());
  write_file(dir.path() / "full", std::string(100, 'x'));
  CHECK(read_file(dir.path() / "full", 100).size() == 100);
  write_file(dir.path() / "more", std::string(101, 'x'));
  CHECK(refused(dir.path() / "more").find("are refused") != std::string::npos);
  if (fs::exists("/proc/self/status")) CHECK(read_file("/proc/self/status", 1 << 16).size() > 100);  // size 0
}

TEST_CASE("a link or a pipe where the temporary file goes is not written to", "[scene][file]") {
  const test::TempDir dir;
  write_file(dir.path() / "victim", "kept");
  fs::create_symlink("victim", dir.path() / "a.part");
  write_file(dir.path() / "a", "new");
  CHECK(read_file(dir.path() / "a", 100) == "new");
  CHECK(read_file(dir.path() / "victim", 100) == "kept");
  REQUIRE(mkfifo((dir.path() / "b.part").c_str(), 0600) == 0);
  write_file(dir.path() / "b", "new");
  CHECK(read_file(dir.path() / "b", 100) == "new");
}
