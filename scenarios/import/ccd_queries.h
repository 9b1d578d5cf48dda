// Vertex-face and edge-edge queries of linear motions with their exact answers, in the format of the
// published Sample-Queries (Wang et al. 2021): every coordinate is a rational that is exactly a double.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/math/pose.h"

namespace touchstone {

struct CcdTruth {
  std::optional<bool> source_truth;   // as published
  bool collides = false;              // decided in rational arithmetic
  double toi_lo = 0, toi_hi = 0;      // of the earliest contact; valid when it collides
  std::optional<int> coplanar_times;  // times in [0,1] at which the four points are coplanar; empty: always
};

struct CcdQuery {
  std::string file;  // relative to the directory that was read
  int index = 0;     // within its file
  bool is_vertex_face = false;
  /// vertex-face: v f0 f1 f2; edge-edge: a0 a1 b0 b1. At t = 0, then at t = 1.
  std::array<Vec3, 4> start, end;
  bool file_truth = false;  // last column of the query's rows
  std::optional<CcdTruth> truth;
};

/// One file of queries, with the truth given in the file. Throws InputError "file:line: reason", also when a
/// rational is not exactly a double.
std::vector<CcdQuery> load_ccd_file(const std::filesystem::path& file, bool is_vertex_face);

/// All queries listed in `directory`/truth.csv, in its order, with the truth attached.
std::vector<CcdQuery> load_ccd_set(const std::filesystem::path& directory);

}  // namespace touchstone
