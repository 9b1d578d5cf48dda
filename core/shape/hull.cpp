// Computes the faces of a hull by qhull, and its dimension and the outline of a flat one by exact arithmetic
// on the doubles.
#include "core/shape/hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <numeric>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include "core/base/exact_text.h"
#include "core/base/input_error.h"
#include "core/math/expansion.h"
#include "core/shape/hull_edges.h"

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

// A triangle whose normal is shorter than this, relative to its sides, is a sliver: its plane is unreliable.
constexpr double thinnest_triangle = 0x1p-30;
// Rounding of a face's plane, relative to the size of the hull.
constexpr double plane_rounding = 0x1p-20;

// The least distance from `p` to the planes of the faces, minus a margin for the rounding of the faces; < 0
// outside.
double clearance(const Hull& h, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity(), size = 0;
  for (const Vec3& v : h.vertices) size = std::max(size, (v - p).norm());
  for (const auto& f : h.faces) {
    const Vec3 &a = h.vertices[static_cast<std::size_t>(f[0])],
               &b = h.vertices[static_cast<std::size_t>(f[1])],
               &c = h.vertices[static_cast<std::size_t>(f[2])];
    const Vec3 u = b - a, v = c - a, n = u.cross(v);
    const double area = n.norm();
    // The plane of a sliver is unreliable: claim no clearance.
    if (!(area > thinnest_triangle * u.norm() * v.norm())) return 0;
    least = std::min(least, n.dot(a - p) / area);
  }
  return h.faces.empty() ? 0 : least - plane_rounding * size;
}

// qhull needs a file for its messages. A stream in memory costs no system call, and what does not fit is
// lost.
FILE* message_sink() {
  thread_local std::array<char, 256> room;
  thread_local const std::unique_ptr<FILE, int (*)(FILE*)> sink(fmemopen(room.data(), room.size(), "w"),
                                                                &std::fclose);
  return sink.get();
}

// qhull's default merges facets that are coplanar within its rounding bound; Qt then triangulates them again.
std::vector<std::array<int, 3>> triangulated_faces(const std::vector<Vec3>& v) {
  std::vector<coordT> points;
  points.reserve(3 * v.size());
  for (const Vec3& p : v) points.insert(points.end(), {p.x(), p.y(), p.z()});
  std::unique_ptr<qhT, QhullFree> qh(new qhT);
  qh_zero(qh.get(), nullptr);
  char options[] = "qhull Qt Pp";
  const int failed = qh_new_qhull(qh.get(), 3, static_cast<int>(v.size()), points.data(), False, options,
                                  nullptr, message_sink());
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
        f[static_cast<std::size_t>(n)] = qh_pointid(q, static_cast<vertexT*>(SETelem_(vertices, n))->point);
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

// Two faces are in one plane if the corner of one is this near the other's plane, relative to the size of the
// hull. A contact loses no more by the edge between them.
constexpr double same_plane = 0x1p-20;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// An edge of a face, from a to b, and the face's third corner.
struct FaceSide {
  int a, b, third;
  auto key() const { return std::pair(std::min(a, b), std::max(a, b)); }
};

convex::VertexEdges edges_between(const std::vector<std::array<int, 3>>& faces, const std::vector<Vec3>& v) {
  std::vector<FaceSide> sides;
  for (const auto& f : faces)
    for (std::size_t k = 0; k < 3; ++k) sides.push_back({f[k], f[(k + 1) % 3], f[(k + 2) % 3]});
  const auto is_before = [](const FaceSide& x, const FaceSide& y) {
    return std::pair(x.key(), x.a) < std::pair(y.key(), y.a);
  };
  std::sort(sides.begin(), sides.end(), is_before);
  const double near = same_plane * largest_half_extent(v);
  convex::VertexEdges edges;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const FaceSide& s = sides[i];
    const Vec3 &p = v[at(s.a)], n = (v[at(s.b)] - p).cross(v[at(s.third)] - p);
    const bool has_twin = i + 1 < sides.size() && sides[i + 1].key() == s.key();
    if (!has_twin || std::abs(n.dot(v[at(sides[i + 1].third)] - p)) > near * n.norm())
      edges.push_back({s.a, s.b});
    if (has_twin) ++i;
  }
  return edges;
}

// The coordinate axis along which a flat hull is seen from its broad side.
int broad_axis(const std::vector<Vec3>& v) {
  Vec3 length = Vec3::Zero(), normal = Vec3::Zero();
  for (const Vec3& p : v)
    if ((p - v[0]).norm() > length.norm()) length = p - v[0];
  for (const Vec3& p : v)
    if (const Vec3 n = length.cross(p - v[0]); n.norm() > normal.norm()) normal = n;
  int axis = 0;
  if (normal.norm() > 0)
    normal.cwiseAbs().maxCoeff(&axis);
  else
    length.cwiseAbs().minCoeff(&axis);
  return axis;
}

// Of at most two dimensions, or nearly so. Andrew's monotone chain (1979).
convex::VertexEdges outline_of(const std::vector<Vec3>& v) {
  const int axis = broad_axis(v), x = (axis + 1) % 3, y = (axis + 2) % 3;
  std::vector<int> order(v.size()), outline;
  std::iota(order.begin(), order.end(), 0);
  const auto place = [&](int i) { return std::pair(v[at(i)][x], v[at(i)][y]); };
  std::sort(order.begin(), order.end(), [&](int i, int k) { return place(i) < place(k); });
  order.erase(std::unique(order.begin(), order.end(), [&](int i, int k) { return place(i) == place(k); }),
              order.end());
  const auto turns_left = [&](int i, int j, int k) {
    const Vec3 &p = v[at(i)], &q = v[at(j)], &r = v[at(k)];
    return orient2d_sign(p[x], p[y], q[x], q[y], r[x], r[y]) > 0;
  };
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t base = outline.size();
    for (const int k : order) {
      while (outline.size() >= base + 2 && !turns_left(outline.end()[-2], outline.back(), k))
        outline.pop_back();
      outline.push_back(k);
    }
    outline.pop_back();
    std::reverse(order.begin(), order.end());
  }
  convex::VertexEdges edges;
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < (n == 2 ? 1 : n); ++i) edges.push_back({outline[i], outline[(i + 1) % n]});
  return edges;
}

}  // namespace

Hull make_hull(std::vector<Vec3> vertices) {
  if (vertices.empty()) throw InputError("vertices", "is empty");
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (!vertices[i].allFinite()) throw InputError("vertices[" + std::to_string(i) + "]", "is not finite");
  Hull h;
  h.dimension = affine_dimension(vertices);
  if (h.dimension == 3) h.faces = triangulated_faces(vertices);
  h.vertices = std::move(vertices);
  derive_edges(h);
  return h;
}

void derive_edges(Hull& h) {
  h.edges.clear();
  for (const Vec3& v : h.vertices)
    if (!v.allFinite()) return;
  h.edges = h.faces.empty() ? outline_of(h.vertices) : edges_between(h.faces, h.vertices);
}

InnerRadii Hull::inner_radii() const {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& v : vertices) mean += v / static_cast<double>(vertices.size());
  const double about_origin = clearance(*this, Vec3::Zero()),
               about_mean = std::max(0.0, clearance(*this, mean));
  if (about_origin > 0) return {std::max(about_origin, about_mean), about_origin};
  double nearest = vertices.front().norm();
  for (const Vec3& v : vertices) nearest = std::min(nearest, v.norm());
  return {about_mean, -nearest};
}

}  // namespace touchstone
