// The engines that the Bullet plug-in offers, by their settings. With TOUCHSTONE_SWEEP, a separate plug-in:
// other margins (bullet-f64-query@0.01), the other penetration depth solver (-minkowski@margin:
// btMinkowskiPenetrationDepthSolver), other tolerances of the default solver (-epa@tolerance) and of sweeps
// (-cast@length: allowedCcdPenetration), so that a chart shows a method as a curve. Bullet's other GJK and
// EPA settings are macros.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace touchstone::bullet_adapter {

// One engine. Anything not set here is left at Bullet's default.
struct Setting {
  std::string_view name;  // after bullet-f32- or bullet-f64-
  bool sim = false;
  std::optional<double> margin = {};
  bool minkowski = false;
  std::optional<double> epa_tolerance = {};
  std::optional<double> allowed_penetration = {};  // if set, the engine answers sweeps only
};
#ifndef TOUCHSTONE_SWEEP
inline constexpr Setting settings[] = {
    {"query"}, {"query-tuned", false, 0}, {"sim", true}, {"sim-tuned", true, 0}};
#else
// The values in the names, as lengths in the unit of the scene.
inline constexpr Setting settings[] = {{"query@0.001", false, 0.001},
                                       {"query@0.01", false, 0.01},
                                       {"sim@0.01", true, 0.01},
                                       {"minkowski@0", false, 0, true},
                                       {"minkowski@0.01", false, 0.01, true},
                                       {"minkowski@0.04", false, 0.04, true},
                                       {"epa@1e-1", false, 0, false, 1e-1},
                                       {"epa@1e-5", false, 0, false, 1e-5},
                                       {"epa@1e-9", false, 0, false, 1e-9},
                                       {"cast@0.001", false, 0, false, {}, 0.001},
                                       {"cast@0.01", false, 0, false, {}, 0.01},
                                       {"cast@0.1", false, 0, false, {}, 0.1}};
#endif

inline constexpr const char* query_settings =
    "btCollisionWorld::contactPairTest (distance: m_closestDistanceThreshold BT_LARGE_FLOAT); time of impact "
    "convexSweepTest; rays rayTest with kF_UseGjkConvexCastRaytest; candidates btDbvtBroadphase; height "
    "fields "
    "btHeightfieldTerrainShape; ";
inline constexpr const char* sim_settings =
    "performDiscreteCollisionDetection in a fresh world; no distance, no time of impact; candidates "
    "btDbvtBroadphase; height fields btHeightfieldTerrainShape, in scenes groups btCompoundShape; ";
inline std::string text_of(const Setting& s) {
  std::string text = s.sim ? sim_settings : query_settings;
  if (!s.margin)
    text += "default margins";
  else if (*s.margin == 0)
    text += "margin 0, hull boxes recomputed";
  else
    text += "margin as named, hull boxes recomputed";
  if (s.minkowski) text = "as named; m_useEpaPenetrationAlgorithm false; " + text;
  if (s.epa_tolerance) text = "gGjkEpaPenetrationTolerance as named; " + text;
  if (s.allowed_penetration) text = "sweeps with allowedCcdPenetration as named; " + text;
  return text;
}

}  // namespace touchstone::bullet_adapter
