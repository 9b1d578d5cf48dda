// `engines --build`: an adapter compiled against a library in a prefix, registered, asked and removed.
#include <cstdlib>
#include <sys/stat.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using namespace touchstone::test;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

const fs::path stubs = TS_SOURCE_DIR "/tests/oracles/stubs";

struct Place : Workspace {
  explicit Place(const std::string& name) : Workspace(name) {
    setenv("TOUCHSTONE_ENGINES", (dir / "engines").c_str(), 1);
  }
  ~Place() { unsetenv("TOUCHSTONE_ENGINES"); }
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// A body of this shape at a translation, turned by 120 degrees about (1, 1, 1).
std::string body(int shape, const std::string& at, const std::string& motion = "") {
  return R"({"shape":)" + std::to_string(shape) + R"(,"pose":{"translation":)" + at +
         R"(,"rotation":[1,1,1,1]})" + motion + "}";
}

std::string queries(const std::string& names) {
  std::string list;
  const std::regex name("[a-z_]+");
  for (std::sregex_iterator i(names.begin(), names.end(), name), end; i != end; ++i)
    list += (list.empty() ? "" : ",") + (R"({"question":")" + i->str() + R"(","a":0,"b":1})");
  return "[" + list + "]";
}

std::string case_of(const std::string& shapes, const std::string& bodies, const std::string& questions) {
  return R"({"touchstone_case":1,"scene":{"touchstone_scene":1,"shapes":[)" + shapes + R"(],"bodies":[)" +
         bodies + R"(]},"queries":)" + queries(questions) + "}";
}

const std::string spheres = R"({"type":"sphere","radius":1},{"type":"sphere","radius":0.5})";

// A stand-in's answers about spheres that overlap, are apart and meet: all right.
void check_spheres(const Place& w, const std::string& engine, const std::string& moving) {
  w.write("overlap.json",
          case_of(spheres, body(0, "[3,1,0]") + "," + body(1, "[3,2.25,0]"), "overlap contact"));
  w.write("apart.json",
          case_of(spheres, body(1, "[3,1,0]") + "," + body(0, "[3,4,4]"), "overlap distance contact"));
  w.write("meet.json", case_of(spheres,
                               body(1, "[3,1,0]", R"(,"motion":{"linear":[0,4,0],"angular":[0,0,0]})") + "," +
                                   body(0, "[3,4,0]"),
                               moving));
  for (const char* file : {"overlap.json", "apart.json", "meet.json"}) {
    const Run r = w.touchstone("replay --json " + std::string(file) + " --engines " + engine);
    INFO(engine << " " << file << "\n" << r.out << r.err);
    CHECK(r.code == 0);
    const json replayed = parsed<json>(r.out);
    for (const json& query : replayed.at(0).at("queries"))
      CHECK(query.at("engines").at(engine).at("answer").value("outcome", "answered") == "answered");
  }
}

Run build_stub(const Place& w, const std::string& name) {
  const Run r =
      w.touchstone("engines --build " + name + " --prefix " + (stubs / name).string() + " --name my-" + name);
  INFO(r.out << r.err);
  CHECK(r.code == 0);
  return r;
}

}  // namespace

TEST_CASE("an adapter is compiled against the library in a prefix, and its engines have names of their own",
          "[own]") {
  const Place w("own-build");
  const Run built = build_stub(w, "box3d");
  CHECK(has(built.out, "my-box3d: Box3D 0.0.1 in " + (stubs / "box3d").string() + " is registered in"));
  CHECK(has(built.err, "compiling the adapter box3d against"));
  check_spheres(w, "my-box3d", "time_of_impact");

  // A capsule is the first shape for Box3D, whichever body it is: the normal is turned round again.
  const std::string shapes =
      R"({"type":"sphere","radius":1},{"type":"capsule","radius":0.5,"half_height":2})";
  w.write("ab.json", case_of(shapes, body(0, "[0,0,0]") + "," + body(1, "[0.5,1,0.25]"), "contact"));
  w.write("ba.json", case_of(shapes, body(1, "[0.5,1,0.25]") + "," + body(0, "[0,0,0]"), "contact"));
  for (const char* file : {"ab.json", "ba.json"}) {
    const Run r = w.touchstone("replay --json " + std::string(file) + " --engines my-box3d");
    INFO(r.out << r.err);
    CHECK(r.code == 0);
    CHECK(has(r.out, "\"normal\""));
  }

  const Run listed = w.touchstone("engines my-box3d");
  CHECK(has(listed.out, "my-box3d"));
  CHECK(has(listed.out, "in " + (stubs / "box3d").string()));
  CHECK(has(w.touchstone("engines --json").out, "\"my-box3d\""));
  CHECK(w.touchstone("engines --remove my-box3d").code == 0);
  CHECK(w.touchstone("engines my-box3d").code == 2);
  CHECK(has(w.touchstone("engines --remove my-box3d").err, "is not registered"));
}

TEST_CASE("the adapters of Coal and Jolt mean what their documentation says", "[own]") {
  const Place w("own-stubs");
  build_stub(w, "coal");
  check_spheres(w, "my-coal", "distance");
  const Run built = build_stub(w, "jolt");
  CHECK(has(built.out, "use it with --engines my-jolt"));
  for (const char* engine : {"my-jolt", "my-jolt-tuned"}) check_spheres(w, engine, "time_of_impact");
}

TEST_CASE("what cannot be built or registered says why, and leaves nothing behind", "[own][bad-input]") {
  const Place w("own-bad");
  const auto refused = [&](const std::string& arguments, const std::string& why, int code = 2) {
    const Run r = w.touchstone("engines " + arguments);
    INFO(arguments << "\n" << r.out << r.err);
    CHECK(r.code == code);
    CHECK(has(r.err, why));
    CHECK((!fs::exists(w.dir / "engines") ||
           w.touchstone("engines --json").out.find("\"bad\"") == std::string::npos));
  };
  fs::create_directory(w.dir / "empty");
  const std::string good = " --prefix " + (stubs / "box3d").string();
  refused("--build box4d", "did you mean box3d");
  refused("--build box3d --prefix nowhere --name bad", "is not a folder");
  refused("--build box3d --prefix empty --name bad", "found no library for the adapter box3d in ");
  refused("--build box3d --prefix empty --name bad", (w.dir / "engines/bad.log").string());
  refused("--build box3d --name Bad" + good, "is not a name");
  refused("--build box3d --name ../bad" + good, "is not a name");
  refused("--build box3d --name core-kept" + good, "is the name of another engine");
  refused("--build box3d --name jolt" + good, "is the name of another engine");
  refused("--rebuild bad", "is not registered");
  refused("--rebuild-with true", "needs --build or --rebuild");

  // A library whose headers do not fit the adapter.
  fs::copy(stubs / "box3d", w.dir / "other", fs::copy_options::recursive);
  w.write("other/include/box3d/constants.h", "#pragma once\n");
  refused("--build box3d --prefix other --name bad", "does not compile against this library", 3);
  CHECK_FALSE(fs::exists(w.dir / "engines/bad"));
}

TEST_CASE("a system's own copy of the library is not taken for the one in the prefix", "[own][optional]") {
  const Place w("own-prefix");
  if (!fs::exists("/usr/include/ccd/ccd.h")) return skip("libccd is not installed");
  fs::create_directory(w.dir / "empty");
  const Run r = w.touchstone("engines --build libccd --prefix empty --name mine");
  INFO(r.err);
  CHECK(r.code == 2);
  CHECK(has(r.err, "which is not in"));
}

TEST_CASE("a command is run when it is given, and never stored", "[own]") {
  const Place w("own-command");
  const std::string ran = (w.dir / "ran").string();
  const std::string good = " --build coal --name mine --prefix " + (stubs / "coal").string();
  const Run failed = w.touchstone("engines" + good + " --rebuild-with 'echo broken; false'");
  CHECK(failed.code == 3);
  CHECK(has(failed.err, "the command failed"));
  CHECK(has(failed.err, "broken"));
  CHECK_FALSE(fs::exists(w.dir / "engines/mine"));

  REQUIRE(w.touchstone("engines" + good + " --rebuild-with 'echo run >>" + ran + "'").code == 0);
  CHECK(read_all(ran) == "run\n");
  CHECK_FALSE(has(read_all(w.dir / "engines/mine/registration.json"), "echo"));
  const Run again = w.touchstone("engines --rebuild mine");
  INFO(again.out << again.err);
  CHECK(again.code == 0);
  CHECK(read_all(ran) == "run\n");
  CHECK(w.touchstone("engines --rebuild mine --rebuild-with 'echo run >>" + ran + "; false'").code == 3);
  CHECK(read_all(ran) == "run\nrun\n");
  CHECK(w.touchstone("engines mine").code == 0);  // as before the failure

  // A registration that others may write is not loaded.
  const fs::path folder = w.dir / "engines/mine";
  const auto refuses = [&](const std::string& why) {
    const Run r = w.touchstone("engines mine");
    INFO(r.out << r.err);
    CHECK(r.code == 2);
    CHECK(has(r.err, why));
    // The others are listed, and this one with the reason.
    const Run all = w.touchstone("engines");
    CHECK(all.code == 0);
    CHECK(has(all.out, "unusable"));
  };
  for (const fs::path& path : {folder, folder / "registration.json", folder / "libtouchstone_coal.so"}) {
    fs::permissions(path, fs::perms::group_write, fs::perm_options::add);
    refuses("can be written by others");
    fs::permissions(path, fs::perms::group_write, fs::perm_options::remove);
  }
  CHECK(w.touchstone("engines mine").code == 0);
  for (const char* text :
       {"{}", R"({"touchstone_registration":1,"name":"mine","adapter":"../x","prefix":""})",
        R"({"touchstone_registration":2,"name":"mine","adapter":"coal","prefix":""})"}) {
    w.write("engines/mine/registration.json", text);
    refuses("registration.json");
  }
}

TEST_CASE("a registered engine takes part in causes, certificates and programs under its own name",
          "[own][optional]") {
  const Place w("own-libccd");
  if (!fs::exists("/usr/include/ccd/ccd.h") || !fs::exists("/usr/include/ode/ode.h"))
    return skip("libccd and ODE are not installed");
  const Run built = w.touchstone("engines --build libccd --prefix /usr --name ccd-mine");
  INFO(built.out << built.err);
  REQUIRE(built.code == 0);
  CHECK(has(built.out, "ccd-mine-gjk, ccd-mine-gjk-tuned"));
  CHECK(has(w.touchstone("engines ccd-mine").out, "ccd-mine-mpr-tuned"));

  // The same findings as those of the build's own plug-in.
  const auto keys = [&](const std::string& engine) {
    w.touchstone("fuzz --engines " + engine + " --cases 200 --seed 3 --out " + engine);
    std::set<std::string> found;
    for (const auto& entry : fs::directory_iterator(w.dir / engine / "findings"))
      found.insert(entry.path().filename().string().substr(engine.size()));
    return found;
  };
  const auto mine = keys("ccd-mine-gjk");
  CHECK(!mine.empty());
  CHECK(mine == keys("libccd-gjk"));

  const Run causes = w.touchstone("causes ccd-mine-gjk --json");
  INFO(causes.err);
  REQUIRE(causes.code <= 1);
  CHECK(has(causes.out, "ccd-mine-gjk"));
  CHECK(has(causes.out, "\"other_solver\""));  // ccd-mine-mpr was asked

  bool written = false;
  for (const std::string& key : mine) {
    const Run r = w.touchstone("reproduce ccd-mine-gjk/findings/ccd-mine-gjk" + key);
    if (r.code != 0) continue;
    written = true;
    CHECK(has(r.out, "-o reproduce -I /usr/include -L /usr/lib -Wl,-rpath,/usr/lib -lccd"));
  }
  CHECK(written);

  // A broad phase, by its own name.
  REQUIRE(w.touchstone("engines --build ode --prefix /usr --name ode-mine").code == 0);
  const Run certified = w.touchstone("certify --subject ode-mine-simple --limit 20");
  INFO(certified.out << certified.err);
  CHECK(has(certified.out, "ode-mine-simple"));
  CHECK(certified.code != 2);
}
