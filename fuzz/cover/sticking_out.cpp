#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

#include "core/math/roundoff.h"
#include "fuzz/cover/limits.h"
#include "fuzz/cover/measure.h"

namespace touchstone::fuzz {
namespace {

using referee::Bracket;

double distance_from(const Aabb& b, const Vec3& p) {
  return (b.lo - p).cwiseMax(p - b.hi).cwiseMax(Vec3::Zero()).norm();
}

// Distances of one point from all pieces; those that are farther than its nearest one by more than a limit
// are not computed.
struct Corner {
  Vec3 p;
  Bracket nearest{infinity, infinity};
  std::vector<std::pair<int, double>> near;  // piece, upper bound of the distance
};

// Part of a triangle.
struct Part {
  std::array<Corner, 3> corner;
  double most = 0;  // upper bound of the distance of its points from the union
  bool operator<(const Part& o) const { return most < o.most; }
};

class Search {
 public:
  explicit Search(std::span<const Hull> pieces) : pieces_(pieces) {
    for (const Hull& h : pieces) {
      shapes_.emplace_back(h);
      Aabb box;
      for (const Vec3& v : h.vertices) {
        box.extend(v);
        reach_ = std::max(reach_, v.cwiseAbs().maxCoeff());
      }
      boxes_.push_back(box);
    }
  }

  void add(const std::array<Vec3, 3>& t) {
    for (const Vec3& v : t) reach_ = std::max(reach_, v.cwiseAbs().maxCoeff());
    Part part;
    const double size = std::max({(t[0] - t[1]).norm(), (t[1] - t[2]).norm(), (t[2] - t[0]).norm()});
    for (std::size_t i = 0; i < 3; ++i) part.corner[i] = corner(t[i], size);
    push(std::move(part));
  }

  Reach run(const std::atomic<bool>& stop) {
    while (!parts_.empty() && !stop) {
      const double hi = parts_.top().most;
      if (hi <= found_.bracket.lo / (1 - bracket_share) || hi <= cover::least_length * reach_) break;
      if (++split_ > most_parts) break;
      Part p = parts_.top();
      parts_.pop();
      divide(p);
    }
    found_.bracket.hi = std::max(found_.bracket.lo, parts_.empty() ? 0.0 : parts_.top().most);
    return found_;
  }

 private:
  // With the pieces whose distance is at most that of the nearest plus `size`.
  Corner corner(const Vec3& p, double size) {
    Corner c;
    c.p = p;
    std::vector<std::pair<double, int>> order;
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      order.emplace_back(distance_from(boxes_[i], p), static_cast<int>(i));
    std::sort(order.begin(), order.end());
    const double moved = cover::moved_by_rounding * reach_;
    for (const auto& [least, i] : order) {
      if (least > c.nearest.hi + size) break;
      const Bracket b = referee::distance_to({&shapes_[static_cast<std::size_t>(i)], {}}, p);
      c.near.emplace_back(i, b.hi + moved);
      c.nearest.lo = std::min(c.nearest.lo, std::max(0.0, b.lo - moved));
      c.nearest.hi = std::min(c.nearest.hi, b.hi + moved);
    }
    if (c.nearest.lo > found_.bracket.lo) found_ = {{c.nearest.lo, infinity}, p};
    return c;
  }

  // The distance from one piece is convex: its maximum over a triangle is at a corner. The distance from the
  // union changes by no more than one moves.
  void push(Part p) {
    p.most = infinity;
    for (const auto& at_first : p.corner[0].near) {
      double most = at_first.second;
      for (std::size_t k = 1; k < 3; ++k) {
        const auto& near = p.corner[k].near;
        const auto it =
            std::find_if(near.begin(), near.end(), [&](const auto& n) { return n.first == at_first.first; });
        most = std::max(most, it == near.end() ? infinity : it->second);
      }
      p.most = std::min(p.most, most);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const double farthest = std::max((p.corner[i].p - p.corner[(i + 1) % 3].p).norm(),
                                       (p.corner[i].p - p.corner[(i + 2) % 3].p).norm());
      p.most = std::min(p.most, p.corner[i].nearest.hi + farthest);
    }
    if (p.most > found_.bracket.lo) parts_.push(std::move(p));
  }

  // At the middle of the longest edge.
  void divide(const Part& p) {
    std::size_t longest = 0;
    double most = -1;
    for (std::size_t i = 0; i < 3; ++i) {
      const double length = (p.corner[i].p - p.corner[(i + 1) % 3].p).norm();
      if (length > most) {
        most = length;
        longest = i;
      }
    }
    const std::size_t i = longest, j = (longest + 1) % 3;
    const Corner middle = corner((p.corner[i].p + p.corner[j].p) / 2, most);
    for (const std::size_t replaced : {i, j}) {
      Part half = p;
      half.corner[replaced] = middle;
      push(std::move(half));
    }
  }

  std::span<const Hull> pieces_;
  std::vector<Shape> shapes_;
  std::vector<Aabb> boxes_;
  std::priority_queue<Part> parts_;
  Reach found_;
  double reach_ = 0;
  std::size_t split_ = 0;
};

}  // namespace

Reach sticking_out(const TriangleMesh& mesh, std::span<const int> triangles, std::span<const Hull> pieces,
                   const std::atomic<bool>& stop) {
  Search search(pieces);
  for (const int i : triangles) {
    std::array<Vec3, 3> t;
    for (std::size_t k = 0; k < 3; ++k)
      t[k] = mesh.vertices[static_cast<std::size_t>(mesh.triangles[static_cast<std::size_t>(i)][k])];
    search.add(t);
  }
  return search.run(stop);
}

}  // namespace touchstone::fuzz
