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

/// minx,miny,minz,maxx,maxy,maxz. Throws InputError "file:line: reason", also on lo > hi.
std::vector<Aabb> load_aabbs(const std::filesystem::path& file);
/// x,y,z,radius,element.
std::vector<Atom> load_atoms(const std::filesystem::path& file);

/// A sphere an atom, exactly; equal radii share a shape.
Scene scene_of_atoms(const std::vector<Atom>& atoms);
/// A box a row; centre and half extents are rounded, so each box is the given one to within a few ulps only.
Scene scene_of_boxes(const std::vector<Aabb>& boxes);

}  // namespace touchstone
