#include "cli/engine_catalog.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "cli/command.h"
#include "cli/debian_engines.h"
#include "cli/npm_engines.h"
#include "core/base/input_error.h"
#include "oracles/core/core_engine.h"
#include "reports/chart/sub_steps.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/name_list.h"

namespace touchstone::cli {
namespace {

constexpr std::string_view fcl = "libtouchstone_fcl.so", f32 = "libtouchstone_bullet_f32.so",
                           f64 = "libtouchstone_bullet_f64.so", ccd = "libtouchstone_libccd.so",
                           ode = "libtouchstone_ode.so";

constexpr EngineRow rows[] = {
    {"core", "", "our own core"},
    {"core-f32", "", "its narrow phase in float"},
    {"core-kept", "", "our core with everything it may keep: hull graphs, pair memory, StepWorld"},
    {"fcl-libccd", fcl, "FCL as shipped, GST_LIBCCD"},
    {"fcl-libccd-tuned", fcl, "FCL, GST_LIBCCD, tolerances 1e-12 and 1e-7"},
    {"fcl-indep", fcl, "FCL as shipped, GST_INDEP"},
    {"fcl-indep-tuned", fcl, "FCL, GST_INDEP, tolerances 1e-12"},
    {"bullet-f32-query", f32, "Bullet float, contactPairTest, default margins"},
    {"bullet-f32-query-tuned", f32, "Bullet float, contactPairTest, margin 0"},
    {"bullet-f32-sim", f32, "Bullet float, performDiscreteCollisionDetection, default margins"},
    {"bullet-f32-sim-tuned", f32, "Bullet float, performDiscreteCollisionDetection, margin 0"},
    {"bullet-f64-query", f64, "Bullet double, contactPairTest, default margins"},
    {"bullet-f64-query-tuned", f64, "Bullet double, contactPairTest, margin 0"},
    {"bullet-f64-sim", f64, "Bullet double, performDiscreteCollisionDetection, default margins"},
    {"bullet-f64-sim-tuned", f64, "Bullet double, performDiscreteCollisionDetection, margin 0"},
    {"libccd-gjk", ccd, "libccd as shipped, GJK and EPA"},
    {"libccd-gjk-tuned", ccd, "libccd, GJK and EPA, tight tolerances"},
    {"libccd-mpr", ccd, "libccd as shipped, MPR"},
    {"libccd-mpr-tuned", ccd, "libccd, MPR, tight tolerances"},
    {"ode", ode, "ODE as shipped, dCollide"},
};

constexpr std::string_view fcl_sweep = "libtouchstone_fcl_sweep.so",
                           ccd_sweep = "libtouchstone_libccd_sweep.so",
                           f32_sweep = "libtouchstone_bullet_sweep_f32.so",
                           f64_sweep = "libtouchstone_bullet_sweep_f64.so";

constexpr EngineRow sweep_rows[] = {
    {"core-extended", "", "our core, every pair in extended precision"},
    {"core-speculative@0.25", "", "our core, speculative contact, margin a quarter of the farthest approach"},
    {"core-speculative@0.5", "", "our core, speculative contact, margin half of the farthest approach"},
    {"core-speculative@1", "", "our core, speculative contact, margin the farthest approach"},
    {"fcl-libccd@1e-3", fcl_sweep, "FCL, GST_LIBCCD, tolerances 1e-3"},
    {"fcl-indep@1e-3", fcl_sweep, "FCL, GST_INDEP, tolerances 1e-3"},
    {"fcl-libccd@1e-9", fcl_sweep, "FCL, GST_LIBCCD, tolerances 1e-9"},
    {"fcl-indep@1e-9", fcl_sweep, "FCL, GST_INDEP, tolerances 1e-9"},
    {"fcl-naive@4", fcl_sweep, "FCL, CCDC_NAIVE, 4 samples"},
    {"fcl-naive@16", fcl_sweep, "FCL, CCDC_NAIVE, 16 samples"},
    {"fcl-naive@64", fcl_sweep, "FCL, CCDC_NAIVE, 64 samples"},
    {"fcl-naive@256", fcl_sweep, "FCL, CCDC_NAIVE, 256 samples"},
    {"fcl-advance@1e-2", fcl_sweep, "FCL, CCDC_CONSERVATIVE_ADVANCEMENT, toc_err 1e-2"},
    {"fcl-advance@1e-8", fcl_sweep, "FCL, CCDC_CONSERVATIVE_ADVANCEMENT, toc_err 1e-8"},
    {"libccd-gjk@1e-2", ccd_sweep, "libccd, GJK and EPA, tolerances 1e-2"},
    {"libccd-mpr@1e-2", ccd_sweep, "libccd, MPR, tolerance 1e-2"},
    {"libccd-gjk@1e-6", ccd_sweep, "libccd, GJK and EPA, tolerances 1e-6"},
    {"libccd-mpr@1e-6", ccd_sweep, "libccd, MPR, tolerance 1e-6"},
    {"libccd-gjk@1e-8", ccd_sweep, "libccd, GJK and EPA, tolerances 1e-8"},
    {"libccd-mpr@1e-8", ccd_sweep, "libccd, MPR, tolerance 1e-8"},
    {"libccd-gjk-iterations@8", ccd_sweep, "libccd, GJK and EPA, at most 8 iterations"},
    {"libccd-mpr-iterations@8", ccd_sweep, "libccd, MPR, at most 8 iterations"},
    {"libccd-gjk-iterations@16", ccd_sweep, "libccd, GJK and EPA, at most 16 iterations"},
    {"libccd-mpr-iterations@16", ccd_sweep, "libccd, MPR, at most 16 iterations"},
    {"libccd-gjk-iterations@32", ccd_sweep, "libccd, GJK and EPA, at most 32 iterations"},
    {"libccd-mpr-iterations@32", ccd_sweep, "libccd, MPR, at most 32 iterations"},
    {"libccd-gjk-iterations@128", ccd_sweep, "libccd, GJK and EPA, at most 128 iterations"},
    {"libccd-mpr-iterations@128", ccd_sweep, "libccd, MPR, at most 128 iterations"},
    {"bullet-f32-query@0.001", f32_sweep, "Bullet float, contactPairTest, margin 0.001"},
    {"bullet-f32-query@0.01", f32_sweep, "Bullet float, contactPairTest, margin 0.01"},
    {"bullet-f32-sim@0.01", f32_sweep, "Bullet float, performDiscreteCollisionDetection, margin 0.01"},
    {"bullet-f32-minkowski@0", f32_sweep, "Bullet float, Minkowski depth solver, margin 0"},
    {"bullet-f32-minkowski@0.01", f32_sweep, "Bullet float, Minkowski depth solver, margin 0.01"},
    {"bullet-f32-minkowski@0.04", f32_sweep, "Bullet float, Minkowski depth solver, margin 0.04"},
    {"bullet-f32-epa@1e-1", f32_sweep, "Bullet float, margin 0, EPA tolerance 1e-1"},
    {"bullet-f32-epa@1e-5", f32_sweep, "Bullet float, margin 0, EPA tolerance 1e-5"},
    {"bullet-f32-epa@1e-9", f32_sweep, "Bullet float, margin 0, EPA tolerance 1e-9"},
    {"bullet-f32-cast@0.001", f32_sweep, "Bullet float, convexSweepTest, allowed penetration 0.001"},
    {"bullet-f32-cast@0.01", f32_sweep, "Bullet float, convexSweepTest, allowed penetration 0.01"},
    {"bullet-f32-cast@0.1", f32_sweep, "Bullet float, convexSweepTest, allowed penetration 0.1"},
    {"bullet-f64-query@0.001", f64_sweep, "Bullet double, contactPairTest, margin 0.001"},
    {"bullet-f64-query@0.01", f64_sweep, "Bullet double, contactPairTest, margin 0.01"},
    {"bullet-f64-sim@0.01", f64_sweep, "Bullet double, performDiscreteCollisionDetection, margin 0.01"},
    {"bullet-f64-minkowski@0", f64_sweep, "Bullet double, Minkowski depth solver, margin 0"},
    {"bullet-f64-minkowski@0.01", f64_sweep, "Bullet double, Minkowski depth solver, margin 0.01"},
    {"bullet-f64-minkowski@0.04", f64_sweep, "Bullet double, Minkowski depth solver, margin 0.04"},
    {"bullet-f64-epa@1e-1", f64_sweep, "Bullet double, margin 0, EPA tolerance 1e-1"},
    {"bullet-f64-epa@1e-5", f64_sweep, "Bullet double, margin 0, EPA tolerance 1e-5"},
    {"bullet-f64-epa@1e-9", f64_sweep, "Bullet double, margin 0, EPA tolerance 1e-9"},
    {"bullet-f64-cast@0.001", f64_sweep, "Bullet double, convexSweepTest, allowed penetration 0.001"},
    {"bullet-f64-cast@0.01", f64_sweep, "Bullet double, convexSweepTest, allowed penetration 0.01"},
    {"bullet-f64-cast@0.1", f64_sweep, "Bullet double, convexSweepTest, allowed penetration 0.1"},
};

constexpr std::string_view stepped[] = {"core", "fcl-libccd", "bullet-f32-query", "bullet-f64-query",
                                        "libccd-gjk"};

constexpr std::string_view fcl_broad = "libtouchstone_fcl_broad.so",
                           f32_broad = "libtouchstone_bullet_broad_f32.so",
                           f64_broad = "libtouchstone_bullet_broad_f64.so",
                           ode_broad = "libtouchstone_ode_broad.so";

constexpr EngineRow broad_rows[] = {
    {"fcl-naive", fcl_broad, "FCL, NaiveCollisionManager"},
    {"fcl-sap", fcl_broad, "FCL, SaPCollisionManager"},
    {"fcl-ssap", fcl_broad, "FCL, SSaPCollisionManager"},
    {"fcl-interval-tree", fcl_broad, "FCL, IntervalTreeCollisionManager"},
    {"fcl-spatial-hash", fcl_broad, "FCL, SpatialHashingCollisionManager"},
    {"fcl-dynamic-tree", fcl_broad, "FCL, DynamicAABBTreeCollisionManager"},
    {"fcl-dynamic-tree-array", fcl_broad, "FCL, DynamicAABBTreeCollisionManager_Array"},
    {"fcl-sap-update-one", fcl_broad, "FCL, update(object) after each move"},
    {"fcl-interval-tree-update-one", fcl_broad, "FCL, update(object) after each move"},
    {"fcl-spatial-hash-update-one", fcl_broad, "FCL, update(object) after each move"},
    {"fcl-dynamic-tree-update-one", fcl_broad, "FCL, update(object) after each move"},
    {"fcl-dynamic-tree-array-update-one", fcl_broad, "FCL, update(object) after each move"},
    {"bullet-f32-dbvt", f32_broad, "Bullet float, btDbvtBroadphase"},
    {"bullet-f32-axis-sweep", f32_broad, "Bullet float, btAxisSweep3"},
    {"bullet-f32-axis-sweep-32", f32_broad, "Bullet float, bt32BitAxisSweep3"},
    {"bullet-f32-simple", f32_broad, "Bullet float, btSimpleBroadphase"},
    {"bullet-f64-dbvt", f64_broad, "Bullet double, btDbvtBroadphase"},
    {"bullet-f64-axis-sweep", f64_broad, "Bullet double, btAxisSweep3"},
    {"bullet-f64-axis-sweep-32", f64_broad, "Bullet double, bt32BitAxisSweep3"},
    {"bullet-f64-simple", f64_broad, "Bullet double, btSimpleBroadphase"},
    {"ode-simple", ode_broad, "ODE, dSimpleSpace"},
    {"ode-hash", ode_broad, "ODE, dHashSpace"},
    {"ode-quadtree", ode_broad, "ODE, dQuadTreeSpace"},
    {"ode-sap", ode_broad, "ODE, dSweepAndPruneSpace"},
};

std::filesystem::path program_directory() {
  std::error_code ec;
  const auto exe = std::filesystem::read_symlink("/proc/self/exe", ec);
  return ec ? std::filesystem::current_path() : exe.parent_path();
}

bool is_pipe(const std::string& name) { return name.starts_with("pipe:"); }

bool is_path(const std::string& name) {
  return name.find('/') != std::string::npos || (name.size() > 3 && name.ends_with(".so"));
}

bool is_core_broad_phase(std::string_view name) {
  const auto phases = core_broad_phases();
  return std::find(phases.begin(), phases.end(), name) != phases.end();
}

const EngineRow* find_row(const std::string& name) {
  for (const auto catalog : {engine_catalog(), broad_catalog(), sweep_catalog()})
    for (const EngineRow& r : catalog)
      if (r.name == name) return &r;
  return nullptr;
}

// "./libmine.so:name" names one engine of a plug-in, "./libmine.so" its only one.
RemoteSpec plugin_spec(const std::string& name) {
  const auto colon = name.rfind(".so:");
  if (colon == std::string::npos) return {host_program(), name, "", {}};
  return {host_program(), name.substr(0, colon + 3), name.substr(colon + 4), {}};
}

// The words of a command that are paths of existing files: the program or its script.
std::vector<std::filesystem::path> files_named_in(const std::string& command) {
  std::vector<std::filesystem::path> out;
  std::string word;
  char quote = 0;
  const auto end_word = [&] {
    std::error_code error;
    if (std::filesystem::is_regular_file(word, error)) out.emplace_back(word);
    word.clear();
  };
  for (const char c : command) {
    if (quote ? c == quote : c == '\'' || c == '"')
      quote = quote ? char{0} : c;
    else if (!quote && (c == ' ' || c == '\t'))
      end_word();
    else
      word += c;
  }
  end_word();
  return out;
}

[[noreturn]] void refuse_unknown(const std::string& name) {
  const std::string near = did_you_mean(name, catalogued_names());
  throw InputError("engine " + name, "unknown" + (near.empty() ? "; `touchstone engines` lists them" : near));
}

void check_name(const std::string& name) {
  if (is_pipe(name)) {
    if (name == "pipe:") throw InputError(name, "has no command; write pipe:COMMAND");
    return;
  }
  if (const auto stepped = fuzz::sub_steps_name(name)) return check_name(stepped->engine);
  if (is_path(name)) {
    const auto file = plugin_spec(name).plugin;
    if (!std::filesystem::exists(file)) throw InputError(file.string(), "no such plug-in file");
    return require_regular_file(file);  // loading a named pipe would block the worker
  }
  if (const NpmRow* npm = find_npm_row(name)) {
    if (is_installed(*npm)) return;
    throw InputError("engine " + name,
                     fmt::format("is not installed: ./touchstone engines --install {} installs {} {}", name,
                                 npm->package, npm->version));
  }
  if (const DebianRow* debian = find_debian_row(name)) {
    if (is_installed(*debian)) return;
    throw InputError("engine " + name,
                     fmt::format("is not installed: ./touchstone engines --install {} compiles it", name));
  }
  if (is_core_broad_phase(name)) return;
  const EngineRow* row = find_row(name);
  if (!row) refuse_unknown(name);
  if (!is_present(*row))
    throw InputError("engine " + name,
                     fmt::format("is not available: {} was not built because its library was not found",
                                 std::string(row->library)));
}

/// Null if the core has no engine of this native name. The instance made here only provides the card.
EnginePtr core_in_worker(const std::string& native, const WorkerLimits& limits) {
  const auto here = make_native_core(native);
  if (!here) return nullptr;
  const std::filesystem::path library = plugin_directory() / "libtouchstone_core.so";
  // The worker starts with the first question; a missing file would then look like a failure of the core.
  for (const std::filesystem::path& file : {host_program(), library})
    if (std::error_code none; !std::filesystem::is_regular_file(file, none))
      throw InputError(file.string(), "is missing; the core's engines need it");
  return std::make_unique<RemoteEngine>(RemoteSpec{host_program(), library, native, limits, here->card()});
}

}  // namespace

std::span<const EngineRow> engine_catalog() { return rows; }
std::span<const EngineRow> broad_catalog() { return broad_rows; }
std::span<const EngineRow> sweep_catalog() { return sweep_rows; }
std::span<const std::string_view> stepped_engines() { return stepped; }

void add_case_seconds(CLI::App& app, WorkerLimits& limits) {
  app.add_option(
         "--case-seconds", limits.query_cpu_seconds,
         "CPU seconds an engine may spend on one question; campaigns and their replays stop it after four "
         "times that, and count answers in between as slow")
      ->check(a_positive_number())
      ->capture_default_str();
  add_no_sandbox(app, limits);
}

void add_no_sandbox(CLI::App& app, WorkerLimits& limits) {
  app.add_flag_callback(
      "--no-sandbox", [&limits] { limits.sandbox = false; },
      "let engines write files, use the network and start processes (for debuggers)");
}

std::filesystem::path host_program() { return program_directory() / "touchstone-host"; }

std::filesystem::path plugin_directory() { return program_directory().parent_path() / "lib"; }

bool is_present(const EngineRow& row) {
  return row.library.empty() || std::filesystem::exists(plugin_directory() / row.library);
}

std::vector<std::string> engine_names(const std::string& text) {
  std::vector<std::string> names;
  if (text == "all") {
    for (const EngineRow& row : rows)
      if (is_present(row)) names.emplace_back(row.name);
    return names;
  }
  for_each_in_list(text, [&](std::string_view part) {
    const std::string name(part);
    if (name.empty()) throw InputError("engines '" + text + "'", "contains an empty name");
    check_name(name);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  });
  return names;
}

std::vector<std::string> catalogued_names() {
  std::vector<std::string> names;
  for (const auto catalog : {engine_catalog(), broad_catalog(), sweep_catalog()})
    for (const EngineRow& row : catalog) names.emplace_back(row.name);
  for (const NpmRow& row : npm_catalog()) names.emplace_back(row.name);
  for (const DebianRow& row : debian_catalog()) names.emplace_back(row.name);
  return names;
}

bool is_foreign(const std::string& name) { return is_pipe(name) || is_path(name); }

bool is_catalogued(const std::string& name) {
  return !is_foreign(name) &&
         (find_npm_row(name) || find_debian_row(name) || find_row(name) || fuzz::sub_steps_name(name));
}

std::vector<std::filesystem::path> engine_files(const std::string& name) {
  if (is_pipe(name)) return files_named_in(name.substr(5));
  if (const auto stepped = fuzz::sub_steps_name(name)) return engine_files(stepped->engine);
  if (is_path(name)) return {plugin_spec(name).plugin};
  if (const NpmRow* npm = find_npm_row(name)) return files_of(*npm);
  if (const DebianRow* debian = find_debian_row(name)) return {plugin_of(*debian)};
  const EngineRow* row = find_row(name);
  if (!row || row->library.empty()) return {};
  return {plugin_directory() / row->library};
}

EnginePtr make_core_broad_phase(const std::string& name, BroadBoxes boxes, const WorkerLimits& limits) {
  return core_in_worker(native_name(name, boxes), limits);
}

EnginePtr make_engine(const std::string& name, const WorkerLimits& limits) {
  check_name(name);
  if (EnginePtr core = core_in_worker(name, limits)) return core;
  if (const auto stepped = fuzz::sub_steps_name(name); stepped && !is_pipe(name))
    return fuzz::sub_stepped(make_engine(stepped->engine, limits), stepped->steps);
  const NpmRow* npm = find_npm_row(name);
  const DebianRow* debian = find_debian_row(name);
  RemoteSpec spec = is_pipe(name) || npm ? RemoteSpec{host_program(), npm ? pipe_of(*npm) : name, "", {}}
                    : is_path(name)      ? plugin_spec(name)
                    : debian
                        ? RemoteSpec{host_program(), plugin_of(*debian), name, {}}
                        : RemoteSpec{host_program(), plugin_directory() / find_row(name)->library, name, {}};
  spec.limits = limits;
  return std::make_unique<RemoteEngine>(std::move(spec));
}

}  // namespace touchstone::cli
