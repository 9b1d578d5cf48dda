// FCL's pair queries, called as its users call them.
#pragma once

#include <fcl/narrowphase/gjk_solver_type.h>
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "oracles/abi/plugin_kit.h"
#include "oracles/fcl/shapes.h"

namespace touchstone::fcl_adapter {

struct Placed {
  const fcl::CollisionGeometryd* geometry;
  fcl::Transform3d transform;
  int kind;  // ts_shape_kind; of a padded body, that of its core
  double padding = 0;
};

struct Settings {
  fcl::GJKSolverType solver;
  bool tuned;
  double tolerance = 0;  // of the iterative solvers; 0: the default of this setting
  // For continuousCollide; 0: its default.
  std::size_t samples = 0;
  double impact_tolerance = 0;
  bool libccd() const { return solver == fcl::GST_LIBCCD; }
};

struct Point {
  Vec3 position;
  double depth;
  Vec3 normal;
};

struct Contact {
  bool overlap = false;
  Vec3 normal = Vec3::Zero();  // A to B
  double depth = 0;
  std::vector<Point> points;
  double claimed_tolerance = 0;
};

bool overlap(const Placed& a, const Placed& b, const Settings& s);
Contact contact(const Placed& a, const Placed& b, const Settings& s);

struct Distance {
  bool overlap = false;  // set by an unsigned query, which gives no distance for overlapping bodies
  std::optional<double> distance;
  std::optional<std::array<Vec3, 2>> points;  // nothing where FCL's documentation disclaims them
  double claimed_tolerance = 0;
};
/// Of padded bodies: that of their cores, less the paddings.
Distance distance(const Placed& a, const Placed& b, const Settings& s);

/// Time of first contact; nullopt for "no hit".
std::optional<double> time_of_impact(const Placed& a, const Pose& a_start, const Motion& a_motion,
                                     const Placed& b, const Pose& b_start, const Motion& b_motion,
                                     const Settings& s);

/// toc_err ("error in first contact time", by default 1e-4 of the step) as a length: multiplied by the
/// closing speed.
double impact_tolerance(const Placed& a, const Motion& a_motion, const Placed& b, const Motion& b_motion,
                        const Settings& s);

double overlap_tolerance(const Settings& s);

// Runs a script on FCL's dynamic AABB tree in the way a user would.

/// Runs the scene's steps; calls `pair(k, a, b)` for every pair that the manager's callback receives at the
/// k-th query.
void run_script(const ts_scene& scene, const std::vector<Geometry>& geometries,
                const std::function<void(int k, int a, int b)>& pair);

/// Calls `pair` for every pair that the manager's callback receives, with all bodies at their own poses.
void all_pairs(const ts_scene& scene, const std::vector<Geometry>& geometries,
               const std::function<void(int a, int b)>& pair);

}  // namespace touchstone::fcl_adapter
