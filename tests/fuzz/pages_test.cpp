// The pages: their data in a browser when node, playwright-core and chromium are there (else said and
// skipped), and what happens where the pages are not built.
#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <regex>

#include "tests/support/catch.h"
#include "tests/support/workspace.h"

namespace fs = std::filesystem;
using touchstone::test::read_all;
using touchstone::test::Workspace;
using Json = nlohmann::json;

namespace {

const fs::path built = TS_BINARY_DIR "/share/touchstone/web";

// Empty when all is there that a browser test needs.
std::string missing_for_browser() {
  for (const char* kind : {"case", "report", "chart", "stability"})
    if (!fs::exists(built / (std::string(kind) + ".html"))) return "the built pages";
  if (!fs::exists(TS_BINARY_DIR "/web/node_modules/playwright-core")) return "playwright-core";
  if (std::system("command -v node >/dev/null 2>&1") != 0) return "node";
  if (!fs::exists("/usr/bin/chromium")) return "/usr/bin/chromium";
  return "";
}

}  // namespace

TEST_CASE("pages load, show the numbers of their JSON, draw, move and link in a browser", "[pages]") {
  if (const std::string missing = missing_for_browser(); !missing.empty()) {
    WARN("skipped: " << missing << " is missing");
    return;
  }
  const Workspace w("pages");
  const std::string engines = " --engines core,fcl-libccd,libccd-mpr";
  const std::string few = fs::exists(TS_BINARY_DIR "/lib/libtouchstone_fcl.so") &&
                                  fs::exists(TS_BINARY_DIR "/lib/libtouchstone_libccd.so")
                              ? engines
                              : " --engines core,core-f32";
  for (const std::string& line :
       {"view " TS_SOURCE_DIR "/scenarios/corpus/drake-1668-cubes-corner-overlap.json -o case.html" + few,
        "view bullet_through_thin_wall -o motion.html" + few, "stability --quick --ladder gap --out ." + few,
        "chart --quick --measure 0 --broad grid,brute_force --out ." + few}) {
    const auto r = w.touchstone(line);
    INFO(line << "\n" << r.err);
    REQUIRE(r.code <= 1);  // 1: some engine is wrong
  }
  CHECK(w.touchstone("fuzz --cases 200 --seed 7 --relations 0 --out run --subject core" + few).code == 0);
  REQUIRE(w.touchstone("report run -o report.html").code == 0);
  const auto node = w.run("node " TS_BINARY_DIR "/web/test/pages.mjs /usr/bin/chromium " + w.dir.string());
  INFO(node.out << node.err);
  CHECK(node.code == 0);
  CHECK(node.out.find("all checks hold") != std::string::npos);
}

TEST_CASE("what builds and tests the pages runs on Debian 12's Node 18 and npm 9", "[pages]") {
  const fs::path web = TS_SOURCE_DIR "/reports/web";
  // npm 9 cannot read an alias ("npm:…") among overrides: npm ci ends with "Invalid comparator".
  CHECK_FALSE(Json::parse(read_all(web / "package.json")).contains("overrides"));
  int asked = 0;
  const Json lock = Json::parse(read_all(web / "package-lock.json"));
  for (const auto& [name, package] : lock["packages"].items()) {
    if (package.value("optional", false) || !package.contains("engines")) continue;
    const std::string node = package["engines"].value("node", ">=18");
    // The first number after an operator: versions from this one on.
    static const std::regex lower_bound(R"((>=|\^)\s*(\d+))");
    bool runs = false;
    for (std::sregex_iterator m(node.begin(), node.end(), lower_bound), end; m != end; ++m)
      runs |= (*m)[1] == "^" ? (*m)[2] == "18" : std::stoi((*m)[2]) <= 18;
    INFO(name << " wants node " << node);
    CHECK(runs);
    ++asked;
  }
  CHECK(asked >= 5);
}

TEST_CASE("without built pages the data remains and one line says what is missing", "[pages][cli]") {
  const Workspace w("nopages");
  fs::create_directories(w.dir / "bin");
  fs::create_symlink(TS_BINARY_DIR "/lib", w.dir / "lib");
  fs::copy_file(TS_BINARY_DIR "/bin/touchstone", w.dir / "bin/touchstone");
  const auto r = w.run("bin/touchstone view spheres_kiss --engines core -o page.html");
  CHECK(r.code == 3);
  CHECK(r.err.find("./touchstone pages --install") != std::string::npos);
  CHECK(std::count(r.err.begin(), r.err.end(), '\n') == 1);
  CHECK_FALSE(fs::exists(w.dir / "page.html"));
  const Json j = Json::parse(read_all(w.dir / "page.json"));
  CHECK(j["queries"].size() == 3);
  CHECK(j["queries"][2]["engines"]["core"]["right"] == true);
  const auto s = w.run("bin/touchstone stability --quick --ladder angle --engines core --out s");
  CHECK(s.code == 0);
  CHECK(fs::exists(w.dir / "s/stability.json"));
  CHECK_FALSE(fs::exists(w.dir / "s/stability.html"));
}

TEST_CASE("report says what is not a campaign", "[pages][cli]") {
  const Workspace w("noreport");
  CHECK(w.touchstone("report .").code == 2);
  w.write("summary.json", "{}");
  const auto r = w.touchstone("report .");
  CHECK(r.code == 2);
  CHECK(r.err.find("stored result") != std::string::npos);
  w.write("summary.json", "no JSON");
  CHECK(w.touchstone("report .").code == 2);
}
