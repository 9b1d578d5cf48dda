#include "scenarios/import/model/model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/base/input_error.h"
#include "scenarios/import/pose_algebra.h"
#include "scenarios/text/name_list.h"
#include "scenarios/text/printable.h"

namespace touchstone {
namespace {

using Names = std::span<const std::string_view>;

Names suffixes(JointType type) {
  static constexpr auto planar = std::to_array<std::string_view>({"/x", "/y", "/theta"});
  static constexpr auto ball = std::to_array<std::string_view>({"/rot_x", "/rot_y", "/rot_z", "/rot_w"});
  static constexpr auto free = std::to_array<std::string_view>(
      {"/trans_x", "/trans_y", "/trans_z", "/rot_x", "/rot_y", "/rot_z", "/rot_w"});
  static constexpr auto one = std::to_array<std::string_view>({""});
  switch (type) {
    case JointType::fixed:
      return {};
    case JointType::hinge:
    case JointType::slide:
      return one;
    case JointType::planar:
      return planar;
    case JointType::ball:
      return ball;
    case JointType::free:
      return free;
  }
  return {};
}

// The rotation about a point.
Pose turn_about(const Vec3& anchor, const Quat& rotation) {
  Pose p;
  p.rotation = rotation;
  if (!anchor.isZero(0)) p.translation = anchor - rotation_matrix(rotation) * anchor;
  return p;
}

Quat unit_of(std::span<const double> v, const ModelJoint& joint) {
  const Quat q{v[0], v[1], v[2], v[3]};
  if (q.x == 0 && q.y == 0 && q.z == 0 && q.w == 0)
    throw InputError("joint " + printable(joint.name), "the zero quaternion denotes no rotation");
  return normalized(q);
}

// The child's frame in the joint's frame.
Pose motion_of(const ModelJoint& joint, std::span<const double> v) {
  switch (joint.type) {
    case JointType::fixed:
      return {};
    case JointType::hinge:
      return turn_about(joint.anchor, about(joint.axis, v[0] - joint.reference));
    case JointType::slide:
      return {joint.axis * (v[0] - joint.reference), {}};
    case JointType::planar: {
      const Mat3 plane = rotation_matrix(from_z_to(joint.axis));
      return {plane.col(0) * v[0] + plane.col(1) * v[1], about(joint.axis, v[2])};
    }
    case JointType::ball:
      return turn_about(joint.anchor, unit_of(v, joint));
    case JointType::free:
      return {Vec3(v[0], v[1], v[2]), unit_of(v.subspan(3), joint)};
  }
  return {};
}

// Readers refuse chains of mimic joints that end in themselves.
double value_of_mimic(const Model& m, const Configuration& values, int joint) {
  const ModelJoint& j = m.joints[static_cast<std::size_t>(joint)];
  if (!j.mimic) return values[static_cast<std::size_t>(joint)][0];
  return j.mimic->multiplier * value_of_mimic(m, values, j.mimic->joint) + j.mimic->offset;
}

const NamedState& state_named(const Model& model, const std::string& text, const std::string& place) {
  std::vector<const NamedState*> found;
  std::vector<std::string> known;
  for (const NamedState& s : model.states) {
    known.push_back(s.name);
    if (s.name == text) return s;
    if (s.name.substr(s.name.find('/') + 1) == text) found.push_back(&s);
  }
  if (found.size() == 1) return *found[0];
  if (found.size() > 1)
    throw InputError(place,
                     "several groups have the state " + printable(text) + "; write GROUP/" + printable(text));
  throw InputError(place, "there is no state " + printable(text) + did_you_mean(text, known));
}

Vec3 checked_end(const Pose& p, const ModelLink& link) {
  if (!p.translation.allFinite())
    throw InputError("link " + printable(link.name), "its coordinates exceed the range of doubles");
  return p.translation;
}

void check_values(std::span<const double> values, const ModelJoint& joint) {
  for (const double v : values)
    if (!std::isfinite(v - joint.reference))
      throw InputError("joint " + printable(joint.name), "its value exceeds the range of doubles");
}

}  // namespace

std::size_t variable_count(JointType type) { return suffixes(type).size(); }

std::vector<std::string> variable_names(const ModelJoint& joint) {
  std::vector<std::string> names;
  for (const std::string_view s : suffixes(joint.type)) names.push_back(joint.name + std::string(s));
  return names;
}

Configuration standard_configuration(const Model& model) {
  Configuration c;
  for (const ModelJoint& j : model.joints) c.push_back(j.standard);
  return c;
}

void set_variable(const Model& model, Configuration& to, const std::string& variable, double value,
                  const std::string& place) {
  std::vector<std::string> known;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const auto names = variable_names(model.joints[j]);
    const auto it = std::find(names.begin(), names.end(), variable);
    if (it == names.end()) {
      known.insert(known.end(), names.begin(), names.end());
      continue;
    }
    if (const auto& mimic = model.joints[j].mimic)
      throw InputError(place, "joint " + printable(variable) + " follows joint " +
                                  printable(model.joints[static_cast<std::size_t>(mimic->joint)].name) +
                                  " and has no value of its own");
    to[j][static_cast<std::size_t>(it - names.begin())] = value;
    return;
  }
  throw InputError(place,
                   "there is no joint variable " + printable(variable) + did_you_mean(variable, known));
}

void set_state(const Model& model, Configuration& to, const std::string& text, const std::string& place) {
  for (const auto& [joint, values] : state_named(model, text, place).values) {
    const auto it = std::find_if(model.joints.begin(), model.joints.end(),
                                 [&name = joint](const ModelJoint& j) { return j.name == name; });
    if (it == model.joints.end()) throw InputError(place, "there is no joint " + printable(joint));
    if (it->mimic) continue;
    to[static_cast<std::size_t>(it - model.joints.begin())] = values;
  }
}

std::vector<Pose> link_poses(const Model& model, const Configuration& values) {
  std::vector<Pose> poses;
  for (const ModelLink& link : model.links) {
    if (link.parent < 0) {
      poses.push_back(link.pose);
      continue;
    }
    const auto j = static_cast<std::size_t>(link.joint);
    const ModelJoint& joint = model.joints[j];
    const double mimicked = joint.mimic ? value_of_mimic(model, values, link.joint) : 0;
    const std::span<const double> v = joint.mimic ? std::span(&mimicked, 1) : std::span(values[j]);
    check_values(v, joint);
    poses.push_back(
        compose(compose(poses[static_cast<std::size_t>(link.parent)], joint.origin), motion_of(joint, v)));
    checked_end(poses.back(), link);
  }
  return poses;
}

void sort_links(Model& model) {
  const std::size_t n = model.links.size();
  std::vector<std::vector<int>> children(n);
  std::vector<int> order;
  for (std::size_t i = 0; i < n; ++i)
    if (model.links[i].parent < 0)
      order.push_back(static_cast<int>(i));
    else
      children[static_cast<std::size_t>(model.links[i].parent)].push_back(static_cast<int>(i));
  for (std::size_t next = 0; next < order.size(); ++next) {
    const auto& c = children[static_cast<std::size_t>(order[next])];
    order.insert(order.end(), c.begin(), c.end());
  }
  std::vector<int> number(n, -1);
  for (std::size_t i = 0; i < order.size(); ++i)
    number[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
  const auto lost = std::find(number.begin(), number.end(), -1);
  if (lost != number.end())
    throw InputError("link " + printable(model.links[static_cast<std::size_t>(lost - number.begin())].name),
                     "is its own ancestor");
  std::vector<ModelLink> sorted;
  for (const int i : order) {
    sorted.push_back(std::move(model.links[static_cast<std::size_t>(i)]));
    if (int& p = sorted.back().parent; p >= 0) p = number[static_cast<std::size_t>(p)];
  }
  model.links = std::move(sorted);
  for (LinkPair& p : model.filters)
    p = std::minmax(number[static_cast<std::size_t>(p.first)], number[static_cast<std::size_t>(p.second)]);
  sort_filters(model);
}

std::vector<int> rigid_groups(const Model& model) {
  std::vector<int> group;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const ModelLink& l = model.links[i];
    const bool held =
        l.parent >= 0 && model.joints[static_cast<std::size_t>(l.joint)].type == JointType::fixed;
    group.push_back(held ? group[static_cast<std::size_t>(l.parent)] : static_cast<int>(i));
  }
  return group;
}

std::vector<char> anchored_links(const Model& model) {
  const std::vector<int> group = rigid_groups(model);
  std::vector<char> anchored;
  for (const int g : group) {
    const ModelLink& first = model.links[static_cast<std::size_t>(g)];
    anchored.push_back(first.parent < 0 && first.is_anchored);
  }
  return anchored;
}

void add_filter(Model& model, int a, int b) { model.filters.push_back(std::minmax(a, b)); }

void sort_filters(Model& model) {
  std::sort(model.filters.begin(), model.filters.end());
  model.filters.erase(std::unique(model.filters.begin(), model.filters.end()), model.filters.end());
}

std::size_t filter_adjacent(Model& model) {
  sort_filters(model);
  const std::size_t before = model.filters.size();
  const std::vector<int> group = rigid_groups(model);
  const auto parent_group = [&](int g) {
    const int parent = model.links[static_cast<std::size_t>(g)].parent;
    return parent < 0 ? -1 : group[static_cast<std::size_t>(parent)];
  };
  const int n = static_cast<int>(model.links.size());
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b) {
      const int ga = group[static_cast<std::size_t>(a)], gb = group[static_cast<std::size_t>(b)];
      if (ga == gb || parent_group(ga) == gb || parent_group(gb) == ga) add_filter(model, a, b);
    }
  sort_filters(model);
  return model.filters.size() - before;
}

}  // namespace touchstone
