// Attributes of MJCF elements with their default classes, and orientations in each of MJCF's forms.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/import/xml.h"

namespace touchstone {

struct MjcfCompiler {
  bool degrees = true;
  std::string euler_sequence = "xyz", mesh_folder;
  bool strip_path = false;
};

/// Three rotations in the compiler's sequence and unit.
Quat euler_rotation(const Vec3& angles, const MjcfCompiler& compiler);

class MjcfDefaults {
 public:
  /// The children of an element, with included files in place of <include>.
  using Expand = std::function<std::vector<XmlElement>(const XmlElement&)>;
  /// A <default> element with its nested classes.
  void read(const XmlElement& e, const std::string& parent, const Expand& expand);
  /// Throws InputError at `user` when there is no such class.
  void require(const std::string& name, const XmlElement& user) const;
  /// The elements of a kind ("geom") that set an attribute in a class and in the classes around it, the
  /// innermost first.
  std::vector<XmlElement> holders(const std::string& of_class, const std::string& kind,
                                  std::string_view attribute) const;

 private:
  struct Class {
    std::string parent;
    std::map<std::string, std::vector<XmlElement>> elements;
  };
  std::map<std::string, Class> classes_;
};

/// An element with the defaults of its class.
class MjcfElement {
 public:
  MjcfElement(const XmlElement& e, const MjcfDefaults& defaults, const std::string& around);
  const XmlElement& xml() const { return e_; }
  std::optional<std::string> text(std::string_view attribute) const;
  double number(std::string_view attribute, double fallback) const;
  std::optional<Vec3> vec3(std::string_view attribute) const;
  /// The element's numbers, then those of the class from there on.
  std::vector<double> numbers(std::string_view attribute) const;
  /// By quat, axisangle, euler, xyaxes or zaxis; nothing without any.
  std::optional<Quat> orientation(const MjcfCompiler& compiler) const;

 private:
  XmlElement source(std::string_view attribute) const;
  XmlElement e_;
  const MjcfDefaults& defaults_;
  std::string class_;
};

}  // namespace touchstone
