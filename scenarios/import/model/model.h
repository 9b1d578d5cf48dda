// Robots and worlds as plain values: links that carry collision shapes, joints that move them, pairs that are
// never asked, named joint values; and their forward kinematics. Lengths in metres and angles in radians, as
// the formats define. Right-handed frames; a pose takes coordinates of the child frame to its parent's.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/scene.h"

namespace touchstone {

struct ModelShape {
  std::string name;  // for display; may be empty
  Shape shape;
  Pose in_link;
  /// Two shapes are asked about if a category of one is in the mask of the other.
  std::uint32_t category = 1, mask = 1;
};

/// `hinge`: URDF's revolute and continuous joints; `slide`: its prismatic ones. `planar`: two translations in
/// the plane perpendicular to the axis, then a rotation about it. `ball`: a quaternion. `free`: a position,
/// then a quaternion.
enum class JointType : std::uint8_t { fixed, hinge, slide, planar, ball, free };

struct ModelJoint {
  struct Mimic {
    int joint = 0;  // of one variable, as this one has
    double multiplier = 1, offset = 0;
  };
  std::string name;
  JointType type = JointType::fixed;
  /// The joint's frame in the parent link. It is the child link's frame when all variables are zero (for
  /// quaternions: the identity).
  Pose origin;
  Vec3 axis = Vec3::UnitX();     // hinge, slide, planar: unit length, in the joint's frame
  Vec3 anchor = Vec3::Zero();    // hinge, ball: a point of the axis or the centre, in the joint's frame
  std::optional<Mimic> mimic;    // its variable is multiplier · that joint's variable + offset
  double reference = 0;          // hinge, slide: the value at which the joint is at its origin
  std::vector<double> standard;  // the values that the file states, else zeros; one a variable
  /// Of joints with one variable; infinite where the file states none.
  double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();
};

struct ModelLink {
  std::string name;
  int parent = -1;          // a link before this one; -1: the link is a root
  int joint = -1;           // that holds it to the parent; -1 for roots
  Pose pose;                // of a root, in the world
  bool is_anchored = true;  // of a root: fixed to the world
  std::vector<ModelShape> shapes;
};

using LinkPair = std::pair<int, int>;

/// Values of joints by name, one list a joint.
struct NamedState {
  std::string name;  // "group/state"
  std::vector<std::pair<std::string, std::vector<double>>> values;
};

struct Model {
  std::string name;
  std::vector<ModelLink> links;  // parents before children
  std::vector<ModelJoint> joints;
  std::vector<LinkPair> filters;  // first < second, sorted: pairs of links that are never asked
  std::vector<NamedState> states;
};

/// The values of every joint, in the order of Model::joints. Those of mimic joints are not used.
using Configuration = std::vector<std::vector<double>>;

/// How many variables a joint has: 0, 1, 1, 3, 4, 7.
std::size_t variable_count(JointType type);

/// The joint's own name if it has one variable; else "joint/x", "joint/theta", "joint/trans_x", "joint/rot_w"
/// and so on, as MoveIt names them.
std::vector<std::string> variable_names(const ModelJoint& joint);

Configuration standard_configuration(const Model& model);

/// Sets one variable. Throws InputError at `place` when no variable has the name, or its joint is a mimic.
void set_variable(const Model& model, Configuration& to, const std::string& variable, double value,
                  const std::string& place);

/// Sets all joints of a state; `text` is "group/state", or a state's own name if it is the only one. Throws
/// InputError at `place`.
void set_state(const Model& model, Configuration& to, const std::string& text, const std::string& place);

/// The pose of each link in the world. Quaternions need not be of unit length, but not zero: throws
/// InputError naming the joint.
std::vector<Pose> link_poses(const Model& model, const Configuration& values);

/// Orders links so that parents come first; filters and joints follow. Throws InputError naming a link that
/// is its own ancestor.
void sort_links(Model& model);

/// For each link the smallest number of a link that it is held to by fixed joints only (itself included).
std::vector<int> rigid_groups(const Model& model);

/// True for links that fixed joints hold to an anchored root.
std::vector<char> anchored_links(const Model& model);

/// Adds the pairs of links that cannot move relative to each other, and those that one joint connects, fixed
/// joints aside. Returns how many of them were new.
std::size_t filter_adjacent(Model& model);

/// Adds a pair to the filters unless it is there; the order of a and b does not matter.
void add_filter(Model& model, int a, int b);
void sort_filters(Model& model);

/// Puts the bodies of a scene that scene_of made of `model` where they are at a configuration.
void place_bodies(const Model& model, const Configuration& at, Scene& scene);

/// The scene at the first configuration: a body for every shape, in the order of links. Shapes of one link
/// are of one group. With several configurations, also the script that inserts all bodies, queries, and for
/// each further configuration moves what moves and queries again. Precondition: at least one configuration.
Scene scene_of(const Model& model, std::span<const Configuration> configurations);

}  // namespace touchstone
