// Damaged files of robots and worlds: elements, attributes and values removed, repeated and exchanged, and
// bytes changed. A reader must accept the file, or refuse it with an error that names the damaged file,
// quickly, and open nothing outside the folder: paths are made to lead to files beside it, which are watched.
// ctest tries a few; by hand, in a build with AddressSanitizer, many:
//   build/asan-ubsan/bin/mutate_models --seed 7 --count 1000000
#include <fcntl.h>
#include <sys/inotify.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>
#include <algorithm>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/base/input_error.h"
#include "core/math/rng.h"
#include "scenarios/codec/scene_codec.h"
#include "scenarios/import/model/import.h"
#include "tests/hostile/mutation.h"

#if defined(__SANITIZE_ADDRESS__)
#define TS_HAS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define TS_HAS_SANITIZER
#endif
#endif
#ifdef TS_HAS_SANITIZER
#include <sanitizer/common_interface_defs.h>
#endif

// LeakSanitizer's hook: libassimp loses memory when it refuses a file.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp"; }

namespace {

using namespace touchstone;
namespace fs = std::filesystem;

struct Span {
  std::size_t first = 0, end = 0;
};

std::vector<Span> tags_in(const std::string& s) {
  std::vector<Span> tags;
  for (std::size_t at = s.find('<'); at != std::string::npos; at = s.find('<', at + 1)) {
    const std::size_t end = s.find('>', at);
    if (end == std::string::npos) break;
    tags.push_back({at, end + 1});
  }
  return tags;
}

// Values of attributes with their quotes.
std::vector<Span> values_in(const std::string& s) {
  std::vector<Span> values;
  for (std::size_t at = s.find("=\""); at != std::string::npos; at = s.find("=\"", at + 1)) {
    const std::size_t end = s.find('"', at + 2);
    if (end == std::string::npos) break;
    values.push_back({at + 1, end + 1});
  }
  return values;
}

// From a tag to the end of its element.
Span element_at(const std::string& s, const std::vector<Span>& tags, std::size_t i) {
  int depth = 0;
  for (std::size_t k = i; k < tags.size(); ++k) {
    const bool closes = s[tags[k].first + 1] == '/', is_empty = s[tags[k].end - 2] == '/';
    depth += closes ? -1 : is_empty ? 0 : 1;
    if (depth <= 0) return {tags[i].first, tags[k].end};
  }
  return tags[i];
}

constexpr std::string_view outside_name = "outside";

std::string hostile_value(Rng& rng) {
  static const auto values = std::to_array<std::string>({"",
                                                         "nan",
                                                         "1e999",
                                                         "-1e308 1e308 1",
                                                         "0 0 0",
                                                         "0 0 0 0",
                                                         "../outside/wedge.stl",
                                                         "../outside/m.xml",
                                                         "../../outside/wedge.stl",
                                                         "meshes/../../outside/wedge.stl",
                                                         "/etc/passwd",
                                                         "package://parts/../../outside/wedge.stl",
                                                         "package://outside/wedge.stl",
                                                         "package://../outside/wedge.stl",
                                                         "link.stl",
                                                         "link.xml",
                                                         "linked/wedge.stl",
                                                         "file:///etc/passwd",
                                                         "99999999999999999999",
                                                         "-1",
                                                         "3",
                                                         "200",
                                                         "100000",
                                                         "1e-320 1 1",
                                                         "world",
                                                         "base",
                                                         "tip",
                                                         "&#0;",
                                                         "\xff\xfe",
                                                         "xyzxyz",
                                                         "mesh",
                                                         "plane",
                                                         "free",
                                                         "ball",
                                                         "cos(s) s sin(s)",
                                                         "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0",
                                                         "replicas.xml",
                                                         "arm.xml",
                                                         "m.xml",
                                                         "__model__",
                                                         "a::b::c"});
  return values[rng.below(values.size())];
}

// Strings in quotes, of JSON.
std::string with_hostile_string(std::string s, Rng& rng) {
  const std::size_t from = s.find('"', rng.below(s.size() + 1));
  const std::size_t end = from == std::string::npos ? from : s.find('"', from + 1);
  if (end == std::string::npos) return s;
  return s.replace(from + 1, end - from - 1, hostile_value(rng));
}

std::string mutated_xml(std::string s, Rng& rng) {
  for (std::uint64_t n = 1 + rng.below(4); n > 0; --n) {
    const auto tags = tags_in(s);
    const auto values = values_in(s);
    if (tags.empty() || values.empty()) return s;
    const std::size_t t = rng.below(tags.size()), v = rng.below(values.size());
    const Span element = element_at(s, tags, t), value = values[v];
    switch (rng.below(6)) {
      case 0:
        s.erase(element.first, element.end - element.first);
        break;
      case 1:
        s.insert(tags[rng.below(tags.size())].end, s.substr(element.first, element.end - element.first));
        break;
      case 2:
        s.erase(tags[t].first, tags[t].end - tags[t].first);
        break;
      case 3: {
        const Span other = values[rng.below(values.size())];
        s.replace(value.first, value.end - value.first, s.substr(other.first, other.end - other.first));
        break;
      }
      case 4: {
        const std::size_t name = s.find_last_of(" \n<", value.first);
        if (name != std::string::npos) s.erase(name + 1, value.end - name - 1);
        break;
      }
      default:
        s.replace(value.first + 1, value.end - value.first - 2, hostile_value(rng));
    }
  }
  return s;
}

struct Good {
  std::string damaged, text, model;  // which file is damaged, its good text, and the file that is imported
  ImportOptions options;
  bool is_included = false;  // then what it lacks may be noticed in the file that is imported
};

// The files that the good text includes or attaches: what is damaged may contradict one of them, and be
// noticed there.
std::vector<std::string> files_named_in(const std::string& text) {
  static constexpr std::string_view before = "file=\"";
  std::vector<std::string> files;
  for (std::size_t at = text.find(before); at != std::string::npos; at = text.find(before, at + 1)) {
    const std::size_t from = at + before.size();
    files.push_back(text.substr(from, text.find('"', from) - from));
  }
  return files;
}

// Sanitizers write their reports beside the folder of the models. One that says that libassimp asked for more
// memory than there is, which a file may bring about, is what an exception is in other builds.
constexpr std::string_view report_name = "report";
bool is_out_of_memory(const fs::path& folder) {
  bool is_memory = false, is_other = false;
  for (const auto& file : fs::directory_iterator(folder.parent_path())) {
    if (!file.path().filename().string().starts_with(report_name)) continue;
    const bool says_so = read_file(file.path()).find("allocator is out of memory") != std::string::npos;
    (says_so ? is_memory : is_other) = true;
    fs::remove(file.path());
  }
  return is_memory && !is_other;
}

std::string said_about(const Good& g, const fs::path& folder) try {
  const ImportedModel m = import_model(folder / g.model, g.options);
  const Scene scene = scene_of(m);
  return scene_from_text(to_text(scene)) == scene ? "" : "the scene changes when it is written and read";
} catch (const InputError& e) {
  const auto names = [&](const std::string& file) {
    return std::string(e.what()).find(file) != std::string::npos;
  };
  // A mesh is read by a child process, which a sanitizer has ended.
  if (e.reason().find("ended without a result") != std::string::npos && !is_out_of_memory(folder))
    return std::string("a child process exited: ") + e.what();
  const bool says_where = names(g.damaged) || (g.is_included && names(g.model)) ||
                          std::ranges::any_of(files_named_in(g.text), names);
  return says_where && !e.reason().empty() ? ""
                                           : std::string("the error does not name the file: ") + e.what();
}

// The folder beside that of the models, and whether anything in it was opened.
class Watched {
 public:
  explicit Watched(const fs::path& folder) : queue_(inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
    if (queue_ < 0 || inotify_add_watch(queue_, folder.c_str(), IN_OPEN) < 0) {
      std::perror("inotify");
      std::exit(1);
    }
  }
  ~Watched() { close(queue_); }
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;
  bool was_opened() const {
    alignas(inotify_event) char events[4096];
    return read(queue_, events, sizeof events) > 0;
  }

 private:
  int queue_;
};

// Files that paths may lead to, and links to them in the folder of the models. A watch that sees nothing
// would prove nothing, so it is tried first.
void make_outside(const fs::path& outside, const fs::path& folder) {
  fs::create_directories(outside);
  fs::copy_file(folder / "wedge.stl", outside / "wedge.stl");
  fs::copy_file(folder / "every_geom.xml", outside / "m.xml");
  fs::create_symlink(outside / "wedge.stl", folder / "link.stl");
  fs::create_symlink(outside / "m.xml", folder / "link.xml");
  fs::create_directory_symlink(outside, folder / "linked");
  const Watched watch(outside);
  std::ifstream(outside / "m.xml").get();
  if (!watch.was_opened()) {
    std::fprintf(stderr, "an opened file is not noticed\n");
    std::exit(1);
  }
}

std::uint64_t current = 0;  // for the handler
void on_timer(int) {
  std::fprintf(stderr, "mutant %llu takes too long\n", static_cast<unsigned long long>(current));
  std::_Exit(1);
}

// Processor time, which does not depend on what else runs.
void start_timer() {
  constexpr int cpu_seconds = 20;
  itimerval t{};
  t.it_value.tv_sec = cpu_seconds;
  setitimer(ITIMER_PROF, &t, nullptr);
}

std::vector<Good> good_files(const fs::path& folder) {
  const fs::path from = TS_SOURCE_DIR "/tests/scenarios/import/files";
  fs::copy(from, folder, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  ImportOptions plain, with_all;
  plain.package_paths = {folder};
  with_all = plain;
  with_all.srdf = (folder / "every_joint.srdf").string();
  with_all.trajectory = (folder / "sweep.csv").string();
  ImportOptions lenient = plain, with_filters = plain;
  lenient.lenient = true;
  with_filters.srdf = (folder / "cell/arm7.srdf").string();
  std::vector<Good> all{{"every_joint.urdf", "", "every_joint.urdf", plain},
                        {"every_joint.urdf", "", "every_joint.urdf", lenient},
                        {"every_joint.srdf", "", "every_joint.urdf", with_all},
                        {"sweep.csv", "", "every_joint.urdf", with_all},
                        {"arm.urdf", "", "arm.urdf", plain},
                        {"every_geom.xml", "", "every_geom.xml", plain},
                        {"every_geom.xml", "", "every_geom.xml", lenient},
                        {"terrain.xml", "", "terrain.xml", plain},
                        {"terrain.xml", "", "terrain.xml", lenient},
                        {"hills.png", "", "terrain.xml", plain},
                        {"hills.bin", "", "terrain.xml", plain},
                        {"nested.sdf", "", "nested.sdf", plain},
                        {"nested.sdf", "", "nested.sdf", lenient},
                        {"table.scene", "", "table.scene", plain},
                        {"wedge.stl", "", "wedge.stl", plain},
                        {"mjcf/replicas.xml", "", "mjcf/replicas.xml", plain},
                        {"mjcf/replicas.xml", "", "mjcf/replicas.xml", lenient},
                        {"mjcf/arm.xml", "", "mjcf/replicas.xml", plain, true},
                        {"mjcf/defaults.xml", "", "mjcf/replicas.xml", plain, true},
                        {"gltf/yard.gltf", "", "gltf/yard.gltf", plain},
                        {"gltf/yard.gltf", "", "gltf/yard.gltf", lenient},
                        {"gltf/yard.glb", "", "gltf/yard.glb", plain},
                        {"cell/arm7.urdf", "", "cell/arm7.urdf", plain},
                        {"cell/arm7.srdf", "", "cell/arm7.urdf", with_filters},
                        {"cell/table15.scene", "", "cell/table15.scene", plain},
                        {"cell/table15.sdf", "", "cell/table15.sdf", plain},
                        {"cell/arm7.xml", "", "cell/arm7.xml", plain},
                        {"cell/meshes/finger.obj", "", "cell/arm7.urdf", plain},
                        {"cell/meshes/finger.obj", "", "cell/meshes/finger.obj", plain},
                        {"cell/meshes/wedge.dae", "", "cell/meshes/wedge.dae", plain},
                        {"cell/meshes/wedge.ply", "", "cell/meshes/wedge.ply", plain},
                        {"cell/meshes/forearm_shell_mm.stl", "", "cell/arm7.xml", plain}};
  for (Good& g : all) g.text = read_file(folder / g.damaged);
  return all;
}

std::string damaged_form(const Good& g, Rng& rng) {
  if (g.text.starts_with("<") && rng.chance(0.8)) return mutated_xml(g.text, rng);
  if (g.damaged.ends_with(".gltf") && rng.chance(0.3)) return with_hostile_string(g.text, rng);
  return test::mutated(test::original_of(g.text), rng);
}

int run(std::uint64_t seed, std::uint64_t count, const fs::path& folder) {
  const std::vector<Good> all = good_files(folder);
  const fs::path outside = folder.parent_path() / outside_name;
  make_outside(outside, folder);
  const Watched watch(outside);
  std::uint64_t accepted = 0;
  for (current = 0; current < count; ++current) {
    Rng rng = Rng::stream(seed, current);
    const Good& g = all[rng.below(all.size())];
    const std::string text = damaged_form(g, rng);
    std::ofstream(folder / g.damaged, std::ios::binary) << text;
    start_timer();
    std::string fault = said_about(g, folder);
    if (watch.was_opened()) fault = "a file outside the folder was opened; " + fault;
    std::ofstream(folder / g.damaged, std::ios::binary) << g.text;
    if (!fault.empty()) {
      const std::string kept = "failed-" + fs::path(g.damaged).filename().string();
      std::ofstream(kept, std::ios::binary) << text;
      std::fprintf(stderr, "mutant %llu of %s, kept as %s: %s\n", static_cast<unsigned long long>(current),
                   g.damaged.c_str(), kept.c_str(), fault.c_str());
      return 1;
    }
    constexpr std::uint64_t report_every = 20000;
    if (++accepted % report_every == 0)
      std::fprintf(stderr, "%llu damaged files so far\n", static_cast<unsigned long long>(accepted));
  }
  std::printf("%llu damaged files: each read, or refused by name; none outside the folder was opened\n",
              static_cast<unsigned long long>(accepted));
  return accepted == count && count > 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t seed = 1, count = 2000;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::uint64_t value = std::strtoull(argv[i + 1], nullptr, 10);
    if (std::strcmp(argv[i], "--seed") == 0) seed = value;
    if (std::strcmp(argv[i], "--count") == 0) count = value;
  }
  std::signal(SIGPROF, on_timer);
  const fs::path top = fs::temp_directory_path() / ("touchstone-models-" + std::to_string(getpid()));
  fs::create_directories(top / "models");
#ifdef TS_HAS_SANITIZER
  __sanitizer_set_report_path((top / report_name).c_str());
#endif
  const int code = run(seed, count, top / "models");
  fs::remove_all(top);
  return code;
}
