// What tests of imported models ask of them.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <string>

#include "scenarios/import/model/import.h"
#include "tests/support/catch.h"

namespace touchstone::test {

/// Largest difference of coordinates and of entries of rotation matrices, in metres and without unit: some
/// thousand roundings of numbers near 1.
inline constexpr double pose_tolerance = 1e-12;

inline std::string model_file(const std::string& name) {
  return std::string(TS_SOURCE_DIR "/tests/scenarios/import/files/") + name;
}

inline int body(const Scene& s, const std::string& name) {
  const auto it =
      std::find_if(s.bodies.begin(), s.bodies.end(), [&](const Body& b) { return b.name == name; });
  INFO(name);
  REQUIRE(it != s.bodies.end());
  return static_cast<int>(it - s.bodies.begin());
}

inline std::size_t joint(const ImportedModel& m, const std::string& name) {
  const auto it = std::find_if(m.model.joints.begin(), m.model.joints.end(),
                               [&](const ModelJoint& j) { return j.name == name; });
  INFO(name);
  REQUIRE(it != m.model.joints.end());
  return static_cast<std::size_t>(it - m.model.joints.begin());
}

inline Eigen::Isometry3d isometry(const Pose& p) {
  Eigen::Isometry3d f = Eigen::Isometry3d::Identity();
  f.linear() = rotation_matrix(p.rotation);
  f.translation() = p.translation;
  return f;
}

inline Eigen::Isometry3d link_frame(const ImportedModel& m, const std::string& name) {
  const auto poses = link_poses(m.model, m.configurations[0]);
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (m.model.links[i].name == name) return isometry(poses[i]);
  FAIL("no link " + name);
  return {};
}

inline void check_near(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b,
                       double tolerance = pose_tolerance) {
  CHECK((a.matrix() - b.matrix()).cwiseAbs().maxCoeff() <= tolerance);
}

}  // namespace touchstone::test
