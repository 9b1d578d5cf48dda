// "To add ..., touch ..." of CONTRIBUTING.md, tried: a scratch copy of the sources gets one addition of each
// kind. What it touches is what the table says, the build finds it, it compiles, no wall breaks, and the
// catalogs list it.
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/arch/include_walls.h"
#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/workspace.h"

using namespace touchstone::test;
namespace fs = std::filesystem;

namespace {

fs::path scratch_copy(const Workspace& w) {
  const fs::path root = w.dir / "source";
  fs::create_directory(root);
  for (const char* part : {"CMakeLists.txt", "cli", "cmake", "core", "docs", "fuzz", "library", "oracles",
                           "reports", "scenarios", "tests"})
    fs::copy(fs::path(TS_SOURCE_DIR) / part, root / part, fs::copy_options::recursive);
  return root;
}

// One addition to a source tree, and the files it touches.
struct Addition {
  std::string kind;  // as in the first column of the table
  std::string name;  // <name> in the second
  fs::path root;
  std::set<std::string> touched;

  void write(const std::string& file, const std::string& text) {
    INFO(file);
    REQUIRE_FALSE(fs::exists(root / file));
    fs::create_directories((root / file).parent_path());
    std::ofstream(root / file) << text;
    touched.insert(file);
  }
  // Puts `text` before the only occurrence of `mark`.
  void insert(const std::string& file, const std::string& mark, const std::string& text) {
    INFO(file << ": " << mark);
    std::string all = read_all(root / file);
    const auto at = all.find(mark);
    REQUIRE(at != std::string::npos);
    REQUIRE(all.find(mark, at + 1) == std::string::npos);
    std::ofstream(root / file) << all.insert(at, text);
    touched.insert(file);
  }
};

Addition broad_phase(const fs::path& root) {
  Addition a{"a broad phase", "nested_loop", root, {}};
  a.write("core/broad/nested_loop.h", R"(#pragma once

#include "core/broad/stored_phase.h"

namespace touchstone::broad {

class NestedLoopFinder {
 public:
  void find(const BoxStore& store, PairSink& sink);
  void validate(const BoxStore&) const {}
  std::size_t memory_bytes() const { return 0; }
  std::string explain() const { return "nested loop"; }
};

BroadPhasePtr make_nested_loop(const Options& options = {});

}  // namespace touchstone::broad
)");
  a.write("core/broad/nested_loop.cpp", R"(#include "core/broad/nested_loop.h"

namespace touchstone::broad {

void NestedLoopFinder::find(const BoxStore& store, PairSink& sink) {
  for (BoxStore::Slot i = 0; i < store.slots(); ++i)
    for (BoxStore::Slot j = i + 1; j < store.slots(); ++j) {
      if (!store.is_present(i) || !store.is_present(j)) continue;
      if (store.is_fixed(i) && store.is_fixed(j)) continue;
      if (overlaps(store.boxes()[i], store.boxes()[j])) sink.add(i, j);
    }
}

BroadPhasePtr make_nested_loop(const Options& options) {
  return std::make_unique<StoredPhase<NestedLoopFinder>>(options);
}

}  // namespace touchstone::broad
)");
  a.insert("core/broad/catalog.h", "#include \"core/broad/sort_and_sweep.h\"\n",
           "#include \"core/broad/nested_loop.h\"\n");
  a.insert("core/broad/catalog.h", "    {\"bounding_volume_hierarchy\",",
           "    {\"nested_loop\", &make_nested_loop},\n");
  return a;
}

Addition check(const fs::path& root) {
  Addition a{"a check of an answer", "witness_alone", root, {}};
  a.write("fuzz/judge/checks/witness_alone.cpp", R"(#include "fuzz/judge/check.h"

namespace touchstone::fuzz {

void check_witness_alone(const CheckInput& in, CheckOutput& out) {
  if (in.answer.witness && !in.answer.distance)
    out.fault_always(Fault::witness_alone, 0, in.query, "states witness points without a distance");
}

}  // namespace touchstone::fuzz
)");
  a.insert("fuzz/judge/check.h", "\nstruct CheckRow {",
           "void check_witness_alone(const CheckInput& in, CheckOutput& out);\n");
  a.insert("fuzz/judge/check.h", "    {Question::contact, check_contact},\n",
           "    {Question::distance, check_witness_alone},\n");
  a.insert("scenarios/value/judgement.h", "  normal_not_unit,  //",
           "  witness_alone,    // points, but no distance\n");
  a.insert("scenarios/value/judgement.h", "\"normal_not_unit\",", "\"witness_alone\", ");
  a.insert("tests/mutants/distance_lies.cpp", "\n}  // namespace\n\nstd::vector<Mutant> distance_lies() {",
           R"(
void no_distance(const Case&, const Query& q, Observation& o) {
  if (!asks(q, Question::distance) || !o.distance) return;
  o.overlap = *o.distance <= 0;
  o.distance.reset();
}
)");
  a.insert("tests/mutants/distance_lies.cpp", "      {\"witness_swapped\",",
           "      {\"witness_alone\", \"witness_alone\", \"separate\", \"no distance\", no_distance},\n");
  return a;
}

Addition engine(const fs::path& root) {
  Addition a{"an engine", "plain", root, {}};
  a.write("oracles/plain/CMakeLists.txt", "ts_add_plugin(plain SOURCES engine.cpp)\n");
  a.write("oracles/plain/engine.cpp", R"(#include "oracles/abi/plugin_kit.h"

namespace touchstone::plain {
namespace {

class Engine {
 public:
  static std::vector<kit::CardText> cards() {
    return {{"plain", "plain", "1", "spheres only", 0x1p-53, 64, "arithmetic only"}};
  }
  explicit Engine(unsigned) {}
  void load(const ts_scene& scene, const ts_received&) { scene_ = &scene; }
  void unload() { scene_ = nullptr; }
  void ask(ts_question question, int a, int b, ts_answer& out, const ts_sink&) {
    if (question != TS_OVERLAP) throw kit::Unsupported("overlap only");
    const ts_body &one = scene_->bodies[a], &two = scene_->bodies[b];
    const ts_shape &p = scene_->shapes[one.shape], &q = scene_->shapes[two.shape];
    if (p.kind != TS_SPHERE || q.kind != TS_SPHERE) throw kit::Unsupported("spheres only");
    const Vec3 between = kit::vec3(two.pose.translation) - kit::vec3(one.pose.translation);
    kit::set_overlap(out, between.norm() <= p.size[0] + q.size[0]);
  }

 private:
  const ts_scene* scene_ = nullptr;
};

}  // namespace
}  // namespace touchstone::plain

TS_PLUGIN(touchstone::plain::Engine)
)");
  a.write("oracles/plain/routes.cpp", R"(#include "oracles/routes/routes.h"

namespace touchstone::routes {
namespace {

std::string_view route(std::string_view, const Pair& p) { return common_route(p); }

}  // namespace

Library plain_library() { return {"Plain", "plain", route}; }

}  // namespace touchstone::routes
)");
  a.write("oracles/plain/reproducer_source.cpp", R"(#include "oracles/reproducer/engine_source.h"

namespace touchstone::fuzz {
namespace {

EngineSource source(const EngineQuestion&) { return {}; }

}  // namespace

SourceWriter plain_source_writer() { return {{"plain"}, source}; }

}  // namespace touchstone::fuzz
)");
  a.insert("cli/engine_catalog.cpp", "\"ode\"};\n\n// The core is part", "\"plain\", ");
  return a;
}

Addition scenario(const fs::path& root) {
  Addition a{"a scenario", "cubes_thirds", root, {}};
  a.insert(
      "scenarios/handmade/touching/polytopes.cpp", "      pair(\"touching\", \"cubes_a_hair_apart\",",
      R"(      pair("touching", "cubes_thirds", "equal cubes share a third of an edge", {unit, at(0, 0, 0), {}},
           {unit, at(2, 2, 1.5), {}}, gap_is(0, 0, x, "1 + 1 = 2 along x and y")),
)");
  return a;
}

Addition command(const fs::path& root) {
  Addition a{"a command", "count", root, {}};
  a.write("cli/cmd_count.cpp", R"(#include <fmt/format.h>

#include "cli/command.h"

namespace touchstone::cli {

Run declare_count(CLI::App&) {
  return [] {
    fmt::print("{}\n", commands.size());
    return exit_clean;
  };
}

}  // namespace touchstone::cli
)");
  a.insert("cli/command.h", "Run declare_view(CLI::App& app);\n", "Run declare_count(CLI::App& app);\n");
  a.insert("cli/command.h", "    {\"families\",",
           "    {\"count\", \"print the number of commands\", declare_count},\n");
  return a;
}

// The paths that the table names for a kind of addition, as regular expressions: <name> is the addition's,
// any other
// <...> is a part of a file's name, and a path that ends with a slash is a folder.
std::vector<std::string> paths_of(const std::string& kind, const std::string& name) {
  static const std::regex row(R"(\| ([^|]+) \| ([^|]+) \|)"), parameter("<[^>]+>"),
      path("`((?:cli|core|docs|fuzz|oracles|reports|scenarios|tests)/[^`]+)`");
  std::ifstream in(TS_SOURCE_DIR "/CONTRIBUTING.md");
  std::vector<std::string> paths;
  std::smatch m;
  for (std::string line; std::getline(in, line);) {
    if (!std::regex_match(line, m, row) || m[1] != kind) continue;
    const std::string cell = m[2];
    for (std::sregex_iterator i(cell.begin(), cell.end(), path), end; i != end; ++i) {
      std::string p = std::regex_replace((*i)[1].str(), std::regex("<name>"), name);
      p = std::regex_replace(p, parameter, "[^/]+");
      paths.push_back(p.ends_with('/') ? p + ".+" : p);
    }
  }
  return paths;
}

void check_touched(const Addition& a) {
  const std::vector<std::string> paths = paths_of(a.kind, a.name);
  INFO(a.kind);
  CHECK(!paths.empty());
  for (const std::string& p : paths) {
    INFO("CONTRIBUTING.md names " << p);
    CHECK(std::any_of(a.touched.begin(), a.touched.end(),
                      [&](const std::string& file) { return std::regex_match(file, std::regex(p)); }));
  }
  for (const std::string& file : a.touched) {
    INFO("touched " << file);
    CHECK(std::any_of(paths.begin(), paths.end(),
                      [&](const std::string& p) { return std::regex_match(file, std::regex(p)); }));
  }
}

// How the scratch copy's build compiles each file.
struct Commands {
  const Workspace& w;
  fs::path root;
  std::map<std::string, std::string> of_file;

  Commands(const Workspace& workspace, const fs::path& source) : w(workspace), root(source) {
    const Run r = w.run(
        "cmake -S source -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DTOUCHSTONE_WEB=OFF"
        " -DCMAKE_C_COMPILER=" TS_C_COMPILER " -DCMAKE_CXX_COMPILER=" TS_CXX_COMPILER);
    INFO(r.out << r.err);
    REQUIRE(r.code == 0);
    for (const auto& entry : parsed<nlohmann::json>(read_all(w.dir / "build/compile_commands.json")))
      of_file.emplace(
          fs::relative(entry.at("file").get<std::string>(), root).generic_string(),
          "cd " + entry.at("directory").get<std::string>() + " && " + entry.at("command").get<std::string>());
  }

  // Checks a file's syntax with the flags of `like`, a file of the build.
  void compile(const std::string& file, const std::string& like) const {
    INFO(file << " with the flags of " << like);
    REQUIRE(of_file.contains(like));
    const std::string source = (root / like).string();
    std::string command = of_file.at(like);
    const auto from = command.rfind(" -c " + source);
    REQUIRE(from != std::string::npos);
    command.replace(from, std::string::npos, " -fsyntax-only " + (root / file).string());
    const Run r = w.run(command);
    INFO(r.err);
    CHECK(r.code == 0);
  }
  void compile(const std::string& file) const { compile(file, file); }

  // The same for a text, which asserts something at compile time.
  void assert_in(const std::string& like, const std::string& text) const {
    std::ofstream(root / "asserted.cpp") << text;
    compile("asserted.cpp", like);
  }
};

}  // namespace

TEST_CASE("each addition touches what CONTRIBUTING.md says, and no more", "[arch]") {
  const Workspace w("additions");
  const fs::path root = scratch_copy(w);
  for (const auto add : {broad_phase, check, engine, scenario, command}) check_touched(add(root));
  for (const std::string& sentence : broken_walls(root)) FAIL_CHECK(sentence);

  const Commands commands(w, root);
  commands.compile("core/broad/nested_loop.cpp");
  commands.assert_in("core/broad/nested_loop.cpp", R"(#include "core/broad/catalog.h"
#include <algorithm>
using namespace touchstone::broad;
static_assert(std::any_of(catalog.begin(), catalog.end(), [](const auto& row) {
  return row.name == "nested_loop" && row.make_with == &make_nested_loop;
}));
)");
  commands.compile("fuzz/judge/checks/witness_alone.cpp");
  commands.compile("fuzz/judge/judge.cpp");
  commands.compile("tests/mutants/distance_lies.cpp");
  commands.assert_in("fuzz/judge/judge.cpp", R"(#include "fuzz/judge/check.h"
#include <algorithm>
using namespace touchstone;
static_assert(to_string(Fault::witness_alone) == "witness_alone");
static_assert(to_string(Fault::failed) == "failed");
static_assert(std::any_of(fuzz::checks.begin(), fuzz::checks.end(),
                          [](const auto& row) { return row.check == &fuzz::check_witness_alone; }));
)");
  commands.compile("scenarios/handmade/touching/polytopes.cpp");
  commands.compile("cli/cmd_count.cpp");
  commands.compile("cli/main.cpp");
  commands.assert_in("cli/engine_catalog.cpp", R"(#include "cli/engine_catalog.cpp"
namespace touchstone::cli {
static_assert(std::any_of(commands.begin(), commands.end(), [](const auto& row) { return row.name == "count"; }));
static_assert(std::find(std::begin(folders), std::end(folders), "plain") != std::end(folders));
}  // namespace touchstone::cli
)");

  // Both tables of the build call the engine's part, and nothing else.
  commands.compile("oracles/plain/routes.cpp");
  commands.compile("oracles/plain/reproducer_source.cpp");
  const auto calls = [&](const std::string& table, const std::string& function) {
    const std::string text = read_all(w.dir / "build/oracles" / table);
    INFO(table << "\n" << text);
    CHECK(text.find("      " + function + "(),\n") != std::string::npos);
  };
  calls("routes/libraries.cpp", "plain_library");
  calls("reproducer/source_writers.cpp", "plain_source_writer");

  // The engine is built and asked. The program that asks is that of the tree itself, which refuses libraries
  // of other sources (oracles/abi/source_id.h); a C interface is all that the two share here.
  const std::string id = "oracles/abi/source_id.cpp";
  const Run identified = w.run("ninja -C build " + id);
  INFO(identified.out << identified.err);
  REQUIRE(identified.code == 0);
  fs::copy_file(fs::path(TS_BINARY_DIR) / id, w.dir / "build" / id, fs::copy_options::overwrite_existing);
  const Run built = w.run("ninja -C build touchstone_plain");
  INFO(built.out << built.err);
  REQUIRE(built.code == 0);
  const Run asked = w.touchstone("engines --check build/lib/libtouchstone_plain.so");
  INFO(asked.out << asked.err);
  CHECK(asked.code == 0);
  CHECK(std::regex_search(asked.out, std::regex("plain: [1-9][0-9]* right, 0 wrong")));
}
