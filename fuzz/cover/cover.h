// Are convex pieces a safe stand-in for a mesh? Whether every point of the mesh is in the union of the
// pieces, exactly, and if not a point that is in none; how far the two reach beyond each other; how much more
// space the pieces take.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/cover/measure.h"
#include "reports/record/observation_json.h"

namespace touchstone::fuzz {

/// A point of a triangle that is in no piece.
struct Uncovered {
  int triangle = 0;
  std::array<std::string, 3> exact;  // "n/d"
  Vec3 rounded = Vec3::Zero();
};

struct Cover {
  std::size_t triangles = 0, pieces = 0;
  std::vector<int> uncovered;        // triangles with points in no piece, in order
  std::optional<Uncovered> witness;  // of the first of them
  Reach sticks_out;                  // the mesh out of the pieces; 0 if all is covered
  bool closed = false;
  std::optional<Reach> reaches_beyond;  // the pieces out of the solid; of a closed mesh
  referee::Bracket union_volume;
  std::optional<double> mesh_volume;
  bool interrupted = false;
  bool covers() const { return uncovered.empty(); }
};

using CoverProgress = std::function<void(std::string_view what, std::size_t done, std::size_t of)>;

/// The mesh is the surface of its triangles, pieces the convex hulls of their points; `names` for messages.
/// Throws InputError naming a piece that is flat, or has too many points, or coordinates beyond 1e90.
Cover cover(const TriangleMesh& mesh, const std::vector<std::vector<Vec3>>& pieces,
            const std::vector<std::string>& names, const CoverProgress& progress,
            const std::atomic<bool>& stop);

Json to_json(const Cover& c);

}  // namespace touchstone::fuzz
