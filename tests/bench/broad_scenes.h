// Scripts on which broad phases are timed.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/broad/broad_phase.h"
#include "core/math/rng.h"

namespace touchstone::bench {

inline constexpr std::string_view scene_names[] = {"uniform", "mixed", "clustered", "static95", "teleport"};

class BoxScene {
 public:
  BoxScene(std::string_view kind, int n, std::uint64_t seed);
  const std::vector<Aabb>& boxes() const { return boxes_; }
  /// The next frame's moves.
  const std::vector<broad::BoxUpdate>& step();

 private:
  void place(int i);
  void shift(int i);
  std::string kind_;
  int n_;
  Rng r_;
  double side_ = 0;
  std::vector<Vec3> blobs_;
  std::vector<Aabb> boxes_;
  std::vector<broad::BoxUpdate> moves_;
};

/// What is timed: a broad phase of the catalog or a plain competitor.
class Contestant {
 public:
  virtual ~Contestant() = default;
  virtual void start(const std::vector<Aabb>& boxes) = 0;
  virtual void frame(const std::vector<broad::BoxUpdate>& moves, std::vector<broad::IdPair>& out) = 0;
  /// False for a contestant that reports no pairs to compare.
  virtual bool answers() const { return true; }
  /// Candidates that the last frame checked against exact boxes, when the contestant filters its own; else 0.
  virtual std::size_t reported() const { return 0; }
  virtual std::string note() const { return {}; }
  virtual std::size_t memory_bytes() const { return 0; }
};

std::unique_ptr<Contestant> make_plain_sweep();
std::unique_ptr<Contestant> make_plain_grid();
std::unique_ptr<Contestant> make_plain_sweep_sorted();
std::unique_ptr<Contestant> make_plain_grid_sorted();
std::unique_ptr<Contestant> make_bound(std::size_t pairs);

}  // namespace touchstone::bench
