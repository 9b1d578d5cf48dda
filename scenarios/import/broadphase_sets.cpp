#include "scenarios/import/broadphase_sets.h"

#include <map>

#include "scenarios/import/text_lines.h"

namespace touchstone {

std::vector<Aabb> load_aabbs(const std::filesystem::path& file) {
  TextLines in(file, ',');
  in.need_header("minx,miny,minz,maxx,maxy,maxz");
  std::vector<Aabb> boxes;
  while (in.next()) {
    in.need_tokens(6);
    Aabb b;
    b.lo = in.vec3(0);
    b.hi = in.vec3(3);
    if ((b.lo.array() > b.hi.array()).any()) in.fail("a minimum is larger than its maximum");
    boxes.push_back(b);
  }
  return boxes;
}

std::vector<Atom> load_atoms(const std::filesystem::path& file) {
  TextLines in(file, ',');
  in.need_header("x,y,z,radius,element");
  std::vector<Atom> atoms;
  while (in.next()) {
    in.need_tokens(5);
    atoms.push_back({in.vec3(0), in.number(3), std::string(in.token(4))});
    if (atoms.back().radius < 0) in.fail("the radius is negative");
  }
  return atoms;
}

Scene scene_of_atoms(const std::vector<Atom>& atoms) {
  Scene s;
  s.name = "atoms";
  std::map<double, int> shape_of_radius;
  for (const Atom& a : atoms) {
    const auto [it, is_new] = shape_of_radius.try_emplace(a.radius, static_cast<int>(s.shapes.size()));
    if (is_new) s.shapes.push_back(Sphere{a.radius});
    Body b;
    b.name = a.element;
    b.shape = it->second;
    b.pose.translation = a.center;
    s.bodies.push_back(std::move(b));
  }
  return s;
}

Scene scene_of_boxes(const std::vector<Aabb>& boxes) {
  Scene s;
  s.name = "boxes";
  for (const Aabb& box : boxes) {
    Body b;
    b.shape = static_cast<int>(s.shapes.size());
    b.pose.translation = box.lo / 2 + box.hi / 2;
    s.shapes.push_back(Box{box.hi / 2 - box.lo / 2});
    s.bodies.push_back(std::move(b));
  }
  return s;
}

}  // namespace touchstone
