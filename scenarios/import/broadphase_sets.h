// Published inputs for broad phases: boxes and atoms as CSV.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/math/aabb.h"
#include "core/scene/scene.h"

namespace touchstone {

struct Atom {
  Vec3 center = Vec3::Zero();
  double radius = 0;
  std::string element;
};

/// Columns minx,miny,minz,maxx,maxy,maxz. Throws InputError "file:line: reason", also when lo > hi.
std::vector<Aabb> load_aabbs(const std::filesystem::path& file);
/// Columns x,y,z,radius,element.
std::vector<Atom> load_atoms(const std::filesystem::path& file);

/// One sphere per atom, exactly; equal radii share a shape.
Scene scene_of_atoms(const std::vector<Atom>& atoms);
/// One box per row. Centre and half extents are rounded, so each box matches the given one only to a few
/// ulps.
Scene scene_of_boxes(const std::vector<Aabb>& boxes);

}  // namespace touchstone
