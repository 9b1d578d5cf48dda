// Collections of convex hulls and point clouds: zoo.txt with zoo.csv (format cdh-hulls 1), and raw clouds of
// float32.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/math/pose.h"

namespace touchstone {

struct ZooHull {
  int id = 0;
  std::string category;                 // "cloud", "plate", "needle", … from zoo.csv
  std::vector<Vec3> vertices;           // strictly extreme
  std::vector<std::vector<int>> faces;  // polygons, counter-clockwise from outside
  double min_dihedral_rad = 0;          // smallest angle between normals of adjacent faces
};

/// Reads zoo.txt and zoo.csv of one directory. Throws InputError "file:line: reason".
std::vector<ZooHull> load_hull_zoo(const std::filesystem::path& directory);

/// Repeated { uint32 n; n × float32[3] }, little-endian.
std::vector<std::vector<Vec3>> load_point_clouds(const std::filesystem::path& file);

}  // namespace touchstone
