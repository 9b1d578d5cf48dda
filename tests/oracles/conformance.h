// Runs tests of conventions on every built engine: sizes, axes, frames, signs, order of arguments. Poses are
// easy and tolerances wide, so that a failure is the adapter's fault and not the engine's.
#pragma once

#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "oracles/client/remote_engine.h"
#include "tests/support/catch.h"
#include "tests/support/skip.h"

namespace touchstone::testing {

inline std::filesystem::path host_path() {
  return std::filesystem::path(TS_BINARY_DIR) / "bin/touchstone-host";
}

/// The plug-ins of this build.
inline std::vector<std::filesystem::path> built_plugins() {
  std::vector<std::filesystem::path> files;
  std::stringstream names(TS_PLUGIN_NAMES);
  for (std::string name; std::getline(names, name, ',');)
    files.push_back(std::filesystem::path(TS_BINARY_DIR) / "lib" / name);
  return files;
}

struct Subject {
  std::string name;
  RemoteEngine& engine;
  bool is(const char* prefix) const { return name.rfind(prefix, 0) == 0; }
  bool has(const char* part) const { return name.find(part) != std::string::npos; }
  bool is_float() const { return has("f32"); }
};

/// Runs `test` for every engine of every built plug-in. Returns the number of engines.
inline int for_each_engine(const std::function<void(Subject)>& test) {
  int n = 0;
  for (const auto& plugin : built_plugins())
    for (const EngineCard& card : list_plugin_engines(host_path(), plugin)) {
      INFO("engine " << card.name);
      RemoteEngine engine({host_path(), plugin, card.name, {}});
      test({card.name, engine});
      ++n;
    }
  return n;
}

inline Body at(int shape, const Vec3& translation, const Quat& rotation = {}) {
  Body b;
  b.shape = shape;
  b.pose = {translation, rotation};
  return b;
}

/// Two bodies, A then B, each with a shape of its own.
inline Scene pair_scene(Shape a, Shape b, const Vec3& position_b, const Vec3& position_a = Vec3::Zero()) {
  Scene s;
  s.shapes = {std::move(a), std::move(b)};
  s.bodies = {at(0, position_a), at(1, position_b)};
  return s;
}

inline Case case_of(Scene scene, std::vector<Query> queries) {
  Case c;
  c.scene = std::move(scene);
  c.queries = std::move(queries);
  return c;
}

inline CaseObservations ask(Subject& s, const Case& c) { return s.engine.run(std::span(&c, 1))[0]; }

}  // namespace touchstone::testing
