#include "scenarios/import/model/mjcf_defaults.h"

#include <array>
#include <numbers>

#include "scenarios/import/fcl_motion.h"
#include "scenarios/import/pose_algebra.h"
#include "scenarios/text/printable.h"

namespace touchstone {
namespace {

constexpr std::string_view main_class = "main";

Quat normalized_at(const Quat& q, const XmlElement& e) {
  if (q.x == 0 && q.y == 0 && q.z == 0 && q.w == 0) e.fail("the zero quaternion denotes no rotation");
  return normalized(q);
}

std::vector<double> exactly(const XmlElement& e, std::string_view attribute, std::size_t count) {
  auto v = e.numbers(attribute);
  if (v.size() != count)
    e.fail(std::string(attribute) + " has " + std::to_string(v.size()) + " numbers instead of " +
           std::to_string(count));
  return v;
}

Vec3 direction(const XmlElement& e, const Vec3& v, std::string_view what) {
  if (v.isZero(0)) e.fail(std::string(what) + " has a zero vector");
  return v.stableNormalized();
}

Quat of_axes(const XmlElement& e) {
  const auto v = exactly(e, "xyaxes", 6);
  Mat3 r;
  r.col(0) = direction(e, {v[0], v[1], v[2]}, "xyaxes");
  const Vec3 y(v[3], v[4], v[5]);
  r.col(1) = direction(e, y - r.col(0) * r.col(0).dot(y), "xyaxes");
  r.col(2) = r.col(0).cross(r.col(1));
  return quaternion_of(r);
}

Quat of_axis_and_angle(const XmlElement& e, const MjcfCompiler& c) {
  const auto v = exactly(e, "axisangle", 4);
  return about(direction(e, {v[0], v[1], v[2]}, "axisangle"),
               c.degrees ? v[3] * (std::numbers::pi / 180) : v[3]);
}

}  // namespace

Quat euler_rotation(const Vec3& angles, const MjcfCompiler& c) {
  Quat q;
  for (int i = 0; i < 3; ++i) {
    const char axis = c.euler_sequence[static_cast<std::size_t>(i)];
    const bool is_fixed = axis < 'a';  // capital letters: about axes that stay
    const int k = axis - (is_fixed ? 'X' : 'x');
    const Quat turn = about(Vec3::Unit(k), c.degrees ? angles[i] * (std::numbers::pi / 180) : angles[i]);
    q = is_fixed ? turn * q : q * turn;
  }
  return q;
}

void MjcfDefaults::read(const XmlElement& e, const std::string& parent, const Expand& expand) {
  const std::string name = e.attribute("class").value_or(parent.empty() ? std::string(main_class) : "");
  if (name.empty()) e.fail("a nested class needs a name");
  Class& c = classes_[name];
  if (!parent.empty() && c.parent != parent && !(c.parent.empty() && c.elements.empty()))
    e.fail("class " + printable(name) + " is defined twice");
  if (name != parent) c.parent = parent;
  const std::vector<XmlElement> children = expand(e);
  for (const XmlElement& child : children)
    if (child.name() != "default") classes_[name].elements[child.name()].push_back(child);
  for (const XmlElement& child : children) {
    if (child.name() != "default") continue;
    const std::string nested = child.attribute("class").value_or("");
    if (nested == name || classes_.contains(nested))
      child.fail("class " + printable(nested) + " is defined twice");
    read(child, name, expand);
  }
}

void MjcfDefaults::require(const std::string& name, const XmlElement& user) const {
  if (!name.empty() && name != main_class && !classes_.contains(name))
    user.fail("there is no default class " + printable(name));
}

std::vector<XmlElement> MjcfDefaults::holders(const std::string& of_class, const std::string& kind,
                                              std::string_view attribute) const {
  std::vector<XmlElement> found;
  for (std::string name = of_class.empty() ? std::string(main_class) : of_class; !name.empty();) {
    const auto c = classes_.find(name);
    if (c == classes_.end()) break;
    if (const auto list = c->second.elements.find(kind); list != c->second.elements.end())
      for (auto it = list->second.rbegin(); it != list->second.rend(); ++it)
        if (it->attribute(attribute)) found.push_back(*it);
    name = c->second.parent;
  }
  return found;
}

MjcfElement::MjcfElement(const XmlElement& e, const MjcfDefaults& defaults, const std::string& around)
    : e_(e), defaults_(defaults), class_(e.attribute("class").value_or(around)) {
  defaults.require(class_, e);
}

XmlElement MjcfElement::source(std::string_view attribute) const {
  if (e_.attribute(attribute)) return e_;
  const auto h = defaults_.holders(class_, e_.name(), attribute);
  return h.empty() ? e_ : h.front();
}

std::optional<std::string> MjcfElement::text(std::string_view a) const { return source(a).attribute(a); }
double MjcfElement::number(std::string_view a, double fallback) const {
  return source(a).number(a).value_or(fallback);
}
std::optional<Vec3> MjcfElement::vec3(std::string_view a) const { return source(a).vec3(a); }

std::vector<double> MjcfElement::numbers(std::string_view a) const {
  std::vector<double> own = e_.numbers(a);
  for (const XmlElement& h : defaults_.holders(class_, e_.name(), a)) {
    const std::vector<double> inherited = h.numbers(a);
    for (std::size_t i = own.size(); i < inherited.size(); ++i) own.push_back(inherited[i]);
  }
  return own;
}

std::optional<Quat> MjcfElement::orientation(const MjcfCompiler& c) const {
  static constexpr auto forms =
      std::to_array<std::string_view>({"quat", "axisangle", "euler", "xyaxes", "zaxis"});
  std::optional<XmlElement> from;
  std::string_view form;
  for (const std::string_view f : forms) {
    if (!e_.attribute(f)) continue;
    if (from) e_.fail("states its orientation twice, by " + std::string(form) + " and " + std::string(f));
    from = e_;
    form = f;
  }
  for (std::size_t i = 0; !from && i < forms.size(); ++i) {
    const auto h = defaults_.holders(class_, e_.name(), forms[i]);
    if (!h.empty()) from = h.front();
    form = forms[i];
  }
  if (!from) return std::nullopt;
  if (form == "axisangle") return of_axis_and_angle(*from, c);
  if (form == "euler") {
    const auto v = exactly(*from, "euler", 3);
    return euler_rotation({v[0], v[1], v[2]}, c);
  }
  if (form == "xyaxes") return of_axes(*from);
  if (form == "zaxis") {
    const auto v = exactly(*from, "zaxis", 3);
    return from_z_to(direction(*from, {v[0], v[1], v[2]}, "zaxis"));
  }
  const auto v = exactly(*from, "quat", 4);
  return normalized_at({v[1], v[2], v[3], v[0]}, *from);
}

}  // namespace touchstone
