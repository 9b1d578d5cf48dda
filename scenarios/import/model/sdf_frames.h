// The frames of an SDFormat file: models, links, joints and frames, each given relative to another by name
// (http://sdformat.org/tutorials?tut=pose_frame_semantics).
#pragma once

#include <deque>
#include <map>
#include <string>

#include "scenarios/import/xml.h"

namespace touchstone {

struct SdfFrame {
  enum class Kind { world, model, link, joint, frame };
  Kind kind;
  XmlElement element;
  int scope = 0;            // in which relative_to and attached_to are names
  int around = -1;          // what the pose is relative to unless relative_to says so; -1: nothing
  std::string relative_to;  // empty: `around`
  std::string attached_to;  // of frames and joints; empty: `around`
  Pose raw;
  int link = -1;  // of links: in the model; of models: their canonical link
  int state = 0;  // 0: not resolved, 1: being resolved, 2: done
  Pose in_world;
};

/// The names of one model, or of the world.
struct SdfScope {
  int own = 0;  // the frame of the model itself
  int outer = -1;
  std::map<std::string, int> frames;
  std::map<std::string, int> models;  // scopes of nested models
};

class SdfFrames {
 public:
  int add_scope(int outer);
  /// Throws InputError when the scope has the name already.
  int add(SdfFrame frame, int scope, const std::string& name);
  int scope_count() const { return static_cast<int>(scopes_.size()); }
  SdfScope& scope(int i) { return scopes_[static_cast<std::size_t>(i)]; }
  SdfFrame& at(int i) { return frames_[static_cast<std::size_t>(i)]; }

  /// By a name such as "link", "model::link", "__model__" or "world". Throws InputError at `user`.
  int find(int scope, const std::string& name, const XmlElement& user) const;
  /// Throws InputError when frames are relative to each other in a circle.
  const Pose& pose(int frame);
  /// The link to which a frame is attached; -1 for the world. Throws InputError as above.
  int link_of(int frame, int depth = 0);

 private:
  std::deque<SdfFrame> frames_;
  std::deque<SdfScope> scopes_;
};

/// The <pose> of an element, in each of its forms; the identity without one.
Pose sdf_pose(const XmlElement& e, std::string& relative_to);

}  // namespace touchstone
