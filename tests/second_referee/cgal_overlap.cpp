#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include "tests/second_referee/second_referee.h"

namespace touchstone::second_referee {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangle = Kernel::Triangle_3;
using Triangles = std::vector<Triangle>;
using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, Triangles::const_iterator>;

Triangles triangles_of(const TriangleMesh& m) {
  Triangles all;
  const auto point = [&](int i) {
    const Vec3& v = m.vertices[static_cast<std::size_t>(i)];
    return Kernel::Point_3(v.x(), v.y(), v.z());
  };
  for (const auto& t : m.triangles) all.emplace_back(point(t[0]), point(t[1]), point(t[2]));
  return all;
}

std::vector<Box> boxes_of(const Triangles& triangles) {
  std::vector<Box> all;
  for (auto t = triangles.begin(); t != triangles.end(); ++t) all.emplace_back(t->bbox(), t);
  return all;
}

}  // namespace

bool overlap(const TriangleMesh& a, const TriangleMesh& b) {
  const Triangles p = triangles_of(a), q = triangles_of(b);
  std::vector<Box> boxes_p = boxes_of(p), boxes_q = boxes_of(q);
  bool found = false;
  CGAL::box_intersection_d(
      boxes_p.begin(), boxes_p.end(), boxes_q.begin(), boxes_q.end(),
      [&](const Box& x, const Box& y) { found = found || CGAL::do_intersect(*x.handle(), *y.handle()); });
  return found;
}

}  // namespace touchstone::second_referee
