#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <queue>
#include <set>

#include "core/math/expansion.h"
#include "core/math/roundoff.h"
#include "fuzz/cover/closed_mesh.h"
#include "fuzz/cover/limits.h"
#include "fuzz/cover/measure.h"

namespace touchstone::fuzz {
namespace {

struct Corner {
  Vec3 p;
  double surface = 0;  // distance from the mesh
  double solid = 0;    // distance from the solid: 0 inside
  int triangle = 0;    // the nearest
};

// A tetrahedron in one piece.
struct Part {
  std::array<Corner, 4> corner;
  double most = 0;
  bool operator<(const Part& o) const { return most < o.most; }
};

class Search {
 public:
  explicit Search(const TriangleMesh& closed) : mesh_(closed) {
    for (const Vec3& v : closed.vertices) reach_ = std::max(reach_, v.cwiseAbs().maxCoeff());
  }

  // Tetrahedra from one corner of the piece to the facets that do not contain it.
  void add(const ExactHull& piece) {
    for (const Vec3& v : piece.points) reach_ = std::max(reach_, v.cwiseAbs().maxCoeff());
    std::vector<Corner> corners;
    for (const Vec3& v : piece.points) corners.push_back(corner(v));
    for (const auto& f : piece.facets) {
      const auto at = [&](std::size_t k) -> const Vec3& {
        return piece.points[static_cast<std::size_t>(f[k])];
      };
      // Those in one plane with the corner, or with the corner itself, make no tetrahedron.
      if (orient3d_sign(at(0), at(1), at(2), piece.points[0]) == 0) continue;
      Part part;
      part.corner[0] = corners[0];
      for (std::size_t k = 0; k < 3; ++k) part.corner[k + 1] = corners[static_cast<std::size_t>(f[k])];
      push(std::move(part));
    }
  }

  Reach run(const std::atomic<bool>& stop) {
    std::size_t split = 0;
    while (!parts_.empty() && !stop && split++ < most_parts) {
      const double hi = parts_.top().most;
      if (hi <= found_.bracket.lo / (1 - bracket_share) || hi <= cover::least_length * reach_) break;
      const Part p = parts_.top();
      parts_.pop();
      divide(p);
    }
    const double rounding = cover::computed_in_doubles * reach_;
    found_.bracket.hi = std::max(found_.bracket.lo, parts_.empty() ? 0.0 : parts_.top().most) + rounding;
    found_.bracket.lo = std::max(0.0, found_.bracket.lo - rounding);
    return found_;
  }

 private:
  Corner corner(const Vec3& p) {
    const auto near = mesh_.nearest(p);
    Corner c{p, near.distance, near.distance, near.triangle};
    if (near.distance <= cover::computed_in_doubles * reach_ || mesh_.is_inside(p)) c.solid = 0;
    if (c.solid > found_.bracket.lo) found_ = {{c.solid, infinity}, p};
    return c;
  }

  void push(Part p) {
    p.most = infinity;
    for (std::size_t i = 0; i < 4; ++i) {
      double farthest = 0, from_triangle = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        farthest = std::max(farthest, (p.corner[i].p - p.corner[k].p).norm());
        // The distance from one triangle is convex: its maximum is at a corner.
        from_triangle = std::max(from_triangle, mesh_.distance(p.corner[k].p, p.corner[i].triangle));
      }
      // A ball around an inner point that does not reach the surface is inside.
      if (p.corner[i].solid == 0 && p.corner[i].surface > farthest) return;
      p.most = std::min({p.most, p.corner[i].solid + farthest, from_triangle});
    }
    if (p.most > found_.bracket.lo) p.most = std::min(p.most, bound_inside(p));
    if (p.most > found_.bracket.lo) parts_.push(std::move(p));
  }

  // Of a part into which the surface reaches by no more than rounding, and whose middle is inside the solid:
  // where the surface reaches in is left by a step towards the middle, which is at least a quarter of the
  // width from each side of the part.
  double bound_inside(const Part& p) const {
    const std::array<Vec3, 4> t{p.corner[0].p, p.corner[1].p, p.corner[2].p, p.corner[3].p};
    const double slack = cover::computed_in_doubles * reach_;
    const auto width = mesh_.clearance(t, slack);
    if (!width || *width <= 16 * slack || !mesh_.is_inside((t[0] + t[1] + t[2] + t[3]) / 4)) return infinity;
    double diameter = 0;
    for (const Vec3& a : t)
      for (const Vec3& b : t) diameter = std::max(diameter, (a - b).norm());
    return 8 * slack * diameter / *width;
  }

  void divide(const Part& p) {
    std::size_t from = 0, to = 1;
    double most = -1;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j)
        if (const double length = (p.corner[i].p - p.corner[j].p).norm(); length > most) {
          most = length;
          from = i;
          to = j;
        }
    const Corner middle = corner((p.corner[from].p + p.corner[to].p) / 2);
    for (const std::size_t replaced : {from, to}) {
      Part half = p;
      half.corner[replaced] = middle;
      push(std::move(half));
    }
  }

  ClosedMesh mesh_;
  std::priority_queue<Part> parts_;
  Reach found_;
  double reach_ = 0;
};

}  // namespace

bool is_closed(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> passed;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++passed[{t[k], t[(k + 1) % 3]}];
  return std::all_of(passed.begin(), passed.end(), [&](const auto& edge) {
    const auto back = passed.find({edge.first.second, edge.first.first});
    return edge.second == 1 && back != passed.end() && back->second == 1;
  });
}

Reach reaching_beyond(std::span<const ExactHull> pieces, const TriangleMesh& closed,
                      const std::atomic<bool>& stop) {
  Search search(closed);
  for (const ExactHull& h : pieces) search.add(h);
  return search.run(stop);
}

double volume_inside(const TriangleMesh& closed) {
  const Vec3 origin = closed.vertices.front();
  double six = 0;
  for (const auto& t : closed.triangles) {
    const auto at = [&](std::size_t k) {
      return Vec3(closed.vertices[static_cast<std::size_t>(t[k])] - origin);
    };
    six += at(0).dot(at(1).cross(at(2)));
  }
  return six / 6;
}

}  // namespace touchstone::fuzz
