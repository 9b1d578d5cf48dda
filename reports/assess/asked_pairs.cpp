#include "reports/assess/asked_pairs.h"

#include <cmath>
#include <numbers>

#include "core/math/rng.h"
#include "oracles/referee/referee.h"
#include "scenarios/value/candidate_pairs.h"

namespace touchstone::fuzz {
namespace {

bool is_drawn(const ModelJoint& j) {
  const bool has_range = std::isfinite(j.lower) && std::isfinite(j.upper) && j.lower < j.upper;
  return !j.mimic && ((j.type == JointType::hinge) || (j.type == JointType::slide && has_range));
}

std::vector<BodyPair> near_pairs_of(const Scene& s, double near) {
  std::vector<BoxedBody> boxed;
  const Vec3 margin = Vec3::Constant(near / 2);
  for (int i = 0; i < static_cast<int>(s.bodies.size()); ++i) {
    Aabb box = referee::outer_box({&s.shape_of(i), s.bodies[static_cast<std::size_t>(i)].pose});
    box.lo -= margin;
    box.hi += margin;
    boxed.push_back({box, i});
  }
  auto pairs = overlapping_boxes(std::move(boxed));
  std::erase_if(pairs, [&](const BodyPair& p) { return !is_reportable(s, p.first, p.second); });
  return pairs;
}

}  // namespace

std::vector<Configuration> drawn_configurations(const Model& model, const Configuration& standard,
                                                std::uint64_t seed, std::uint64_t count) {
  std::vector<Configuration> all;
  for (std::uint64_t i = 0; i < count; ++i) {
    Rng rng = Rng::stream(seed, i);
    Configuration c = standard;
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      const ModelJoint& joint = model.joints[j];
      if (!is_drawn(joint)) continue;
      const bool has_range = std::isfinite(joint.lower) && std::isfinite(joint.upper);
      c[j][0] = has_range ? rng.uniform(joint.lower, joint.upper)
                          : rng.uniform(-std::numbers::pi, std::numbers::pi);
    }
    all.push_back(std::move(c));
  }
  return all;
}

std::vector<std::string> joints_not_drawn(const Model& model) {
  std::vector<std::string> names;
  for (const ModelJoint& j : model.joints)
    if (variable_count(j.type) > 0 && !j.mimic && !is_drawn(j)) names.push_back(j.name);
  return names;
}

std::vector<AskedPair> near_pairs(const Model& model, Scene scene, const std::vector<Configuration>& all,
                                  double near, const PairProgress& progress, const std::atomic<bool>& stop) {
  std::vector<AskedPair> pairs;
  for (std::size_t i = 0; i < all.size() && !stop; ++i) {
    place_bodies(model, all[i], scene);
    for (const auto& [a, b] : near_pairs_of(scene, near)) pairs.push_back({i, a, b});
    progress(i + 1, all.size());
  }
  return pairs;
}

std::vector<AskedPair> thinned(const std::vector<AskedPair>& all, std::uint64_t most) {
  if (all.size() <= most) return all;
  std::vector<AskedPair> some;
  for (std::uint64_t i = 0; i < most; ++i) some.push_back(all[i * all.size() / most]);
  return some;
}

std::uint64_t possible_pairs(const Scene& s) {
  std::uint64_t n = 0;
  for (int b = 0; b < static_cast<int>(s.bodies.size()); ++b)
    for (int a = 0; a < b; ++a) n += is_reportable(s, a, b);
  return n;
}

}  // namespace touchstone::fuzz
