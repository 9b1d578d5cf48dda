// A cable of MJCF (<composite type="cable">): where the parts of the chain are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/math/pose.h"
#include "scenarios/import/xml.h"

namespace touchstone {

struct MjcfCable {
  std::string prefix;
  std::string initial = "ball";  // the joint of the first body: "free", "none", or else a ball, as in MuJoCo
  /// Each part in the frame of the one before it, the first in that of the element; its x axis leads along
  /// the part.
  std::vector<Pose> parts;
  std::vector<double> lengths;
  /// "B_first", "B_1", …, "B_last", with the prefix.
  std::string body_name(std::size_t part) const { return prefix + "B_" + part_name(part); }
  std::string joint_name(std::size_t part) const { return prefix + "J_" + part_name(part); }

 private:
  std::string part_name(std::size_t part) const {
    return part == 0 ? "first" : part + 1 == parts.size() ? "last" : std::to_string(part);
  }
};

/// Throws InputError at the element.
MjcfCable read_cable(const XmlElement& composite);

}  // namespace touchstone
