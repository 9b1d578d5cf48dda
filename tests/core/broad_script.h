// Random scripts for broad phases, run alongside the definition, and crowds.
#pragma once

#include "core/broad/catalog.h"
#include "tests/core/broad_boxes.h"

namespace touchstone::test {

struct Count {
  long pairs = 0, possible = 0, queries = 0;
};

// A broad phase and the definition, driven by the same random operations.
class Script {
 public:
  Script(const broad::CatalogRow& row, std::uint64_t seed, BoxKind kind, int id_step,
         const broad::Options& options = {})
      : subject_(row.make(options)), r_(seed), kind_(kind), id_step_(id_step) {}

  void insert_many(int n) {
    for (int i = 0; i < n; ++i) insert();
  }
  void step() {
    const double what = r_.uniform();
    if (reference_.bodies.empty() || what < 0.2) {
      insert();
    } else if (what < 0.35) {
      const int id = any();
      subject_->remove(id);
      reference_.bodies.erase(id);
      removed_.push_back(id);
    } else if (what < 0.8) {
      move_some(1 + r_.below(3));
    } else if (what < 0.9) {  // small, coherent motion of all
      drift();
    } else if (what < 0.93) {
      move_some(reference_.bodies.size());
    } else {
      move_some(reference_.bodies.size() / 8 + 1);
    }
  }
  /// Throws what validate() throws.
  bool agrees(Count& count) {
    subject_->pairs(out_);
    const auto expected = reference_.pairs();
    subject_->validate();
    const auto n = static_cast<long>(reference_.bodies.size());
    count.pairs += static_cast<long>(out_.size());
    count.possible += n * (n - 1) / 2;
    ++count.queries;
    return out_ == expected;
  }

 private:
  int any() {
    auto it = reference_.bodies.begin();
    std::advance(it, static_cast<long>(r_.below(reference_.bodies.size())));
    return it->first;
  }
  void insert() {
    int id = (next_++ * 7919 % 10007 - 5000) * id_step_;
    if (!removed_.empty() && r_.chance(0.5)) {
      id = removed_.back();
      removed_.pop_back();
    }
    if (reference_.bodies.contains(id)) return;
    const bool fixed = r_.chance(0.3);
    const Aabb box = make_box(r_, kind_);
    subject_->insert(id, box, fixed ? broad::Mobility::fixed : broad::Mobility::moving);
    reference_.bodies[id] = {box, fixed};
  }
  void move_some(std::size_t n) {
    std::vector<broad::BoxUpdate> moves;
    for (std::size_t i = 0; i < n; ++i) {
      const int id = any();
      moves.push_back({id, make_box(r_, kind_)});
      reference_.bodies[id].box = moves.back().box;
    }
    if (n == 1)
      subject_->move(moves[0].id, moves[0].box);
    else
      subject_->update(moves);
  }
  void drift() {
    std::vector<broad::BoxUpdate> moves;
    for (auto& [id, body] : reference_.bodies) {
      if (body.fixed) continue;
      const Vec3 v = r_.vector(0, 0.1);
      body.box.lo += v;
      body.box.hi += v;
      moves.push_back({id, body.box});
    }
    subject_->update(moves);
  }
  broad::BroadPhasePtr subject_;
  Reference reference_;
  Rng r_;
  BoxKind kind_;
  int id_step_, next_ = 0;
  std::vector<int> removed_;
  std::vector<broad::IdPair> out_;
};

// Boxes of side 1/2..3/2 in a cube with two units of volume per box: about four partners each.
inline std::vector<broad::BoxUpdate> uniform_scene(Rng& r, int n, double large_share, double large) {
  const double side = std::cbrt(2.0 * n);
  std::vector<broad::BoxUpdate> all;
  for (int i = 0; i < n; ++i) {
    const double scale = r.chance(large_share) ? large : 1;
    Aabb b;
    for (int k = 0; k < 3; ++k) {
      const double c = r.uniform(-side / 2, side / 2), h = r.uniform(0.25, 0.75) * scale;
      b.lo[k] = c - h;
      b.hi[k] = c + h;
    }
    all.push_back({i, b});
  }
  return all;
}

/// `blobs` clusters in a world that is `wide` times as wide as the uniform one, each of the same deviation.
inline std::vector<broad::BoxUpdate> clustered_scene(Rng& r, int n, int blobs, double wide,
                                                     double deviation) {
  auto all = uniform_scene(r, n, 0, 1);
  const double side = std::cbrt(2.0 * n) * wide;
  std::vector<Vec3> centres;
  for (int b = 0; b < blobs; ++b) {
    Vec3 c;
    for (int k = 0; k < 3; ++k) c[k] = r.uniform(-side / 2, side / 2);
    centres.push_back(c);
  }
  for (broad::BoxUpdate& u : all) {
    const Vec3& c = centres[r.below(centres.size())];
    const Vec3 size = u.box.hi - u.box.lo;
    for (int k = 0; k < 3; ++k) {
      double sum = -6;
      for (int d = 0; d < 12; ++d) sum += r.uniform();
      u.box.lo[k] = c[k] + deviation * sum;
      u.box.hi[k] = u.box.lo[k] + size[k];
    }
  }
  return all;
}

}  // namespace touchstone::test
