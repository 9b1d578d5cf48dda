// Follows engines through smooth motions: every frame is judged as always, and what an answer does between
// two frames is compared with what the truth does (docs/truth.md §7).
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "oracles/abi/engine.h"
#include "reports/record/motions.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

struct MotionPlan {
  std::string motion;  // name of a row; empty: all
  std::uint64_t seed = 1;
  int count = 12;   // motions a row
  int frames = 32;  // of a motion, at least 2
};

/// Makes the engine forget: the next question meets one that has answered nothing. False: it cannot.
using Forget = std::function<bool(Engine&)>;
/// One motion in this many is asked again frame by frame, each without the earlier ones.
inline constexpr int state_every = 4;

/// Throws InputError when there is no such motion.
Motions follow_all(const MotionPlan& plan, std::span<const EnginePtr> engines, const Forget& forget,
                   const std::function<void(const std::string&)>& progress);

/// One motion; `ask_alone`: every frame also without the earlier ones. One result per engine.
std::vector<MotionResult> follow(const Case& motion, std::span<const EnginePtr> engines, const Forget& forget,
                                 bool ask_alone);

}  // namespace touchstone::fuzz
