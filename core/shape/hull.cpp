// Computes the faces of a hull by qhull and its dimension by exact arithmetic on the doubles.
#include "core/shape/hull.h"

#include <cmath>
#include <cstdio>
#include <memory>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include "core/base/exact_text.h"
#include "core/base/input_error.h"
#include "core/math/expansion.h"

namespace touchstone {
namespace {

struct QhullFree {
  void operator()(qhT* qh) const {
    int current = 0, total = 0;
    qh_freeqhull(qh, !qh_ALL);
    qh_memfreeshort(qh, &current, &total);
    delete qh;
  }
};

bool same(const Vec3& a, const Vec3& b) { return a == b; }

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (orient2d_sign(a[i], a[j], b[i], b[j], c[i], c[j]) != 0) return false;
  }
  return true;
}

int affine_dimension(const std::vector<Vec3>& v) {
  std::size_t i = 1;
  while (i < v.size() && same(v[0], v[i])) ++i;
  if (i == v.size()) return 0;
  std::size_t j = i + 1;
  while (j < v.size() && collinear(v[0], v[i], v[j])) ++j;
  if (j >= v.size()) return 1;
  for (std::size_t k = j + 1; k < v.size(); ++k)
    if (orient3d_sign(v[0], v[i], v[j], v[k]) != 0) return 3;
  return 2;
}

// qhull's default merges facets that are coplanar within its rounding bound; Qt then triangulates them again.
std::vector<std::array<int, 3>> triangulated_faces(const std::vector<Vec3>& v) {
  std::vector<coordT> points;
  points.reserve(3 * v.size());
  for (const Vec3& p : v) points.insert(points.end(), {p.x(), p.y(), p.z()});
  std::unique_ptr<qhT, QhullFree> qh(new qhT);
  qh_zero(qh.get(), nullptr);
  char options[] = "qhull Qt Pp";
  std::unique_ptr<FILE, int (*)(FILE*)> sink(std::fopen("/dev/null", "w"), &std::fclose);
  const int failed =
      qh_new_qhull(qh.get(), 3, static_cast<int>(v.size()), points.data(), False, options, nullptr, sink.get());
  std::vector<std::array<int, 3>> faces;
  if (failed) return faces;
  qhT* const q = qh.get();
  for (facetT* facet = q->facet_list; facet && facet->next; facet = facet->next) {
    std::array<int, 3> f{};
    int n = 0;
    setT* const vertices = qh_facet3vertex(q, facet);
    const int count = qh_setsize(q, vertices);
    if (count == 3)
      for (; n < 3; ++n)
        f[static_cast<std::size_t>(n)] =
            qh_pointid(q, static_cast<vertexT*>(SETelem_(vertices, n))->point);
    qh_settempfree(q, const_cast<setT**>(&vertices));
    if (n != 3) return {};
    // qh_facet3vertex orders by the facet's orientation; make it outward by the facet's own normal.
    const Vec3 e1 = v[static_cast<std::size_t>(f[1])] - v[static_cast<std::size_t>(f[0])];
    const Vec3 e2 = v[static_cast<std::size_t>(f[2])] - v[static_cast<std::size_t>(f[0])];
    const Vec3 outward(facet->normal[0], facet->normal[1], facet->normal[2]);
    if (e1.cross(e2).dot(outward) < 0) std::swap(f[1], f[2]);
    faces.push_back(f);
  }
  return faces;
}

}  // namespace

Hull make_hull(std::vector<Vec3> vertices) {
  if (vertices.empty()) throw InputError("vertices", "is empty");
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (!vertices[i].allFinite())
      throw InputError("vertices[" + std::to_string(i) + "]", "is not finite");
  Hull h;
  h.dimension = affine_dimension(vertices);
  if (h.dimension == 3) h.faces = triangulated_faces(vertices);
  h.vertices = std::move(vertices);
  return h;
}

}  // namespace touchstone
