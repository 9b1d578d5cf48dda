#include "cli/own_engines.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "cli/adapter_build.h"
#include "cli/command.h"
#include "cli/engine_catalog.h"
#include "cli/logged_command.h"
#include "core/base/input_error.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/name_list.h"

namespace touchstone::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* registration_file = "registration.json";
constexpr std::size_t longest_name = 40;

bool is_good_name(const std::string& name) {
  const auto is_good = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; };
  return !name.empty() && name.size() <= longest_name && name.front() >= 'a' && name.front() <= 'z' &&
         std::all_of(name.begin(), name.end(), is_good);
}

// The user's own, and writable by nobody else.
void require_private(const fs::path& path) {
  struct stat s {};
  if (lstat(path.c_str(), &s) != 0) throw InputError(path.string(), std::strerror(errno));
  if (S_ISLNK(s.st_mode)) throw InputError(path.string(), "is a symbolic link");
  if (s.st_uid != geteuid() && s.st_uid != 0)
    throw InputError(path.string(), "belongs to another user, so what is in it is not loaded");
  if ((s.st_mode & (S_IWGRP | S_IWOTH)) != 0)
    throw InputError(path.string(), "can be written by others, so what is in it is not loaded (chmod go-w)");
}

void make_private(const fs::path& path) {
  fs::permissions(path, fs::perms::group_write | fs::perms::others_write, fs::perm_options::remove);
}

Json registration_of(const OwnEngine& own) {
  return {{"touchstone_registration", 1},
          {"name", own.name},
          {"adapter", own.adapter},
          {"prefix", own.prefix.string()}};
}

// "fcl-libccd" of the adapter fcl as the registration fcl-head shows it: "fcl-head-libccd".
std::string shown_name(const OwnEngine& own, const std::string& engine) {
  const bool begins = engine == own.adapter || engine.starts_with(own.adapter + "-");
  return begins ? own.name + engine.substr(own.adapter.size()) : own.name + "-" + engine;
}

std::string shown_version(const OwnEngine& own, const std::string& version) {
  if (own.prefix.empty()) return version;
  return fmt::format("{}in {}", version.empty() ? "" : version + " ", own.prefix.string());
}

std::string default_name(const std::string& adapter) {
  const bool is_own = own_name_of(adapter) == adapter;
  const bool is_taken = is_catalogued_folder(adapter) || (!is_own && is_catalogued(adapter));
  return is_taken ? adapter + "-own" : adapter;
}

void require_free(const std::string& name) {
  if (!is_good_name(name))
    throw InputError("--name " + name,
                     fmt::format("is not a name: lower-case letters, digits and hyphens, at "
                                 "most {}, a letter first",
                                 longest_name));
  const auto taken = own_names();
  if (std::find(taken.begin(), taken.end(), name) != taken.end()) return;  // is replaced
  if (is_catalogued_folder(name) || is_catalogued(name))
    throw InputError("--name " + name, "is the name of another engine; choose one with --name");
}

// The engines of `own` must not have names that mean something else.
void require_no_clash(const OwnEngine& own, const std::vector<PluginEngine>& engines) {
  for (const PluginEngine& e : engines)
    if (is_catalogued(e.card.name) && own_name_of(e.card.name) != own.name)
      throw InputError("--name " + own.name,
                       e.card.name + " is the name of another engine; choose a name with --name");
}

// Folders of one build: removed at the end, whatever happens.
struct BuildPlace {
  fs::path build, result;
  explicit BuildPlace(const fs::path& root, const std::string& name)
      : build(root / (name + ".build")), result(root / (name + ".new")) {
    clear();
    create_folder(result);
  }
  ~BuildPlace() { clear(); }
  BuildPlace(const BuildPlace&) = delete;
  BuildPlace& operator=(const BuildPlace&) = delete;
  void clear() const {
    std::error_code none;
    fs::remove_all(build, none);
    fs::remove_all(result, none);
  }
};

void run_users_command(const std::string& command, const fs::path& log) {
  if (command.empty()) return;
  fmt::print(stderr, "running {}\n", command);
  if (!run_logged({"sh", "-c", command}, log))
    throw CommandFailed(fmt::format("--rebuild-with: the command failed:\n{}full log: {}",
                                    reasons_in(log, "touchstone: "), log.string()));
}

std::string plural(std::size_t n, const std::string& word) {
  return fmt::format("{} {}{}", n, word, n == 1 ? "" : "s");
}

void report(const OwnEngine& own, const std::vector<PluginEngine>& engines) {
  std::string pairs;
  std::size_t others = 0;
  for (const PluginEngine& e : engines)
    if (e.kind == EngineKind::pairs)
      pairs += (pairs.empty() ? "" : ", ") + e.card.name;
    else
      ++others;
  fmt::print("{}: {} {} is registered in {}\nuse it with --engines {}: {}{}\n", own.name,
             engines.front().card.library, engines.front().card.version, own.folder.string(), own.name,
             pairs.empty() ? "no engine that answers about pairs" : pairs,
             others == 0 ? "" : fmt::format("; and {} by name", plural(others, "further engine")));
}

}  // namespace

fs::path own_engines_folder() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return value ? fs::path(value) : fs::path();
  };
  if (const fs::path chosen = variable("TOUCHSTONE_ENGINES"); !chosen.empty()) return fs::absolute(chosen);
  fs::path data = variable("XDG_DATA_HOME");
  if (!data.is_absolute()) data = variable("HOME") / ".local/share";
  return data / "touchstone/engines";
}

std::vector<std::string> own_names() {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(own_engines_folder(), none)) {
    const std::string name = entry.path().filename();
    if (is_good_name(name) && fs::exists(entry.path() / registration_file, none)) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

OwnEngine own_engine(const std::string& name) {
  const auto names = own_names();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw InputError("engine " + name, "is not registered" + did_you_mean(name, names));
  OwnEngine own{name, "", "", own_engines_folder() / name};
  const fs::path file = own.folder / registration_file;
  for (const fs::path& path : {own_engines_folder(), own.folder, file}) require_private(path);
  const Json text = load_json(file);
  const JsonReader r(text, file.string());
  if (count_of(r["touchstone_registration"]) != 1)
    throw InputError(file.string() + ": touchstone_registration", "is not 1");
  own.adapter = r["adapter"].string();
  own.prefix = r["prefix"].string();
  if (!is_good_name(own.adapter)) throw InputError(file.string() + ": adapter", "is not a name");
  return own;
}

std::vector<PluginEngine> engines_of(const OwnEngine& own) {
  const auto plugins = plugins_of(own.folder, own.adapter);
  if (plugins.empty())
    throw InputError(own.folder.string(), "holds no plug-in of the adapter " + own.adapter);
  for (const fs::path& plugin : plugins) require_private(plugin);
  std::vector<PluginEngine> engines = engines_in(plugins);
  for (PluginEngine& e : engines) {
    e.card.name = shown_name(own, e.engine);
    e.card.version = shown_version(own, e.card.version);
  }
  return engines;
}

std::string own_name_of(const std::string& engine) {
  std::string found;
  for (const std::string& name : own_names())
    if ((engine == name || engine.starts_with(name + "-")) && name.size() > found.size()) found = name;
  return found;
}

std::string name_in_adapter(const std::string& engine) {
  const std::string name = own_name_of(engine);
  return name.empty() ? engine : own_engine(name).adapter + engine.substr(name.size());
}

std::string beside(const std::string& engine, const std::string& in_adapter) {
  const std::string name = own_name_of(engine);
  return name.empty() ? in_adapter : shown_name(own_engine(name), in_adapter);
}

int build_own_engine(OwnBuild build) {
  require_adapter(build.adapter);
  if (build.name.empty()) build.name = default_name(build.adapter);
  require_free(build.name);
  const fs::path root = own_engines_folder(), log = root / (build.name + ".log");
  create_folder(root);
  make_private(root);
  const BuildPlace place(root, build.name);
  write_file(log, "");
  run_users_command(build.command, log);
  if (!build.prefix.empty()) build.prefix = fs::absolute(build.prefix).lexically_normal();
  fmt::print(stderr, "compiling the adapter {}{} (log: {})\n", build.adapter,
             build.prefix.empty() ? "" : " against " + build.prefix.string(), log.string());
  const auto plugins = build_adapter({build.adapter, build.prefix, place.build, log});
  OwnEngine own{build.name, build.adapter, build.prefix, place.result};
  for (const fs::path& plugin : plugins) fs::copy_file(plugin, place.result / plugin.filename());
  write_file(place.result / registration_file, json_text(registration_of(own), 1) + "\n");
  for (const auto& entry : fs::directory_iterator(place.result)) make_private(entry.path());
  make_private(place.result);
  const auto engines = engines_of(own);  // loads each plug-in
  require_no_clash(own, engines);
  own.folder = root / build.name;
  fs::remove_all(own.folder);
  fs::rename(place.result, own.folder);
  report(own, engines);
  return exit_clean;
}

int rebuild_own_engine(const std::string& name, const std::string& command) {
  const OwnEngine own = own_engine(name);
  return build_own_engine({own.adapter, own.name, own.prefix, command});
}

int remove_own_engine(const std::string& name) {
  const auto names = own_names();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw InputError("--remove " + name, "is not registered" + did_you_mean(name, names));
  std::error_code error;
  fs::remove_all(own_engines_folder() / name, error);
  if (error)
    throw InputError((own_engines_folder() / name).string(), "cannot be removed: " + error.message());
  fs::remove(own_engines_folder() / (name + ".log"), error);
  fmt::print("{} is removed; the library itself is not touched\n", name);
  return exit_clean;
}

}  // namespace touchstone::cli
