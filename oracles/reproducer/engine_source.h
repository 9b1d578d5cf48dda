// What each engine's writer contributes to a reproducer: the rest is the same for all.
#pragma once

#include <string>
#include <string_view>

#include "core/scene/scene.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// What is asked, of which bodies, at which query of the script.
struct Asked {
  const Scene& scene;
  Question question;
  int a, b, step;
  std::string_view engine;
  const Body& body(int i) const { return scene.bodies[static_cast<std::size_t>(i)]; }
  bool tuned() const { return engine.ends_with("-tuned"); }
};

struct EngineSource {
  std::string compile;   // the command after "g++ -std=c++17 reproduce.cpp -o reproduce"
  std::string includes;  // lines
  std::string code;      // defines `Answer ask()`
};

/// Throw InputError for what the engine's API does not have.
EngineSource fcl_source(const Asked& q);
EngineSource bullet_source(const Asked& q);
EngineSource libccd_source(const Asked& q);
EngineSource ode_source(const Asked& q);

}  // namespace touchstone::fuzz
