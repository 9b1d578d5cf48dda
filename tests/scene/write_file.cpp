// Files are replaced whole or not at all.
#include <filesystem>
#include <fstream>

#include "core/base/input_error.h"
#include "core/scene/input_file.h"
#include "tests/scene/temp_dir.h"
#include "tests/support/catch.h"

using namespace touchstone;
namespace fs = std::filesystem;

TEST_CASE("a file that cannot be written keeps what was in it", "[scene][file]") {
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
