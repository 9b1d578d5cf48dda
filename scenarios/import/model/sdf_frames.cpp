#include "scenarios/import/model/sdf_frames.h"

#include <numbers>

#include "scenarios/import/pose_algebra.h"
#include "scenarios/text/printable.h"

namespace touchstone {

Pose sdf_pose(const XmlElement& e, std::string& relative_to) {
  const auto p = e.child("pose");
  if (!p) return {};
  relative_to = p->attribute("relative_to").value_or(p->attribute("frame").value_or(""));
  if (p->text().empty()) return {};
  if (p->attribute("rotation_format").value_or("euler_rpy") == "quat_xyzw") {
    const auto v = p->text_numbers(7);
    const Quat q{v[3], v[4], v[5], v[6]};
    if (q.x == 0 && q.y == 0 && q.z == 0 && q.w == 0) p->fail("the zero quaternion denotes no rotation");
    return {Vec3(v[0], v[1], v[2]), normalized(q)};
  }
  const auto v = p->text_numbers(6);
  const double unit = p->attribute("degrees").value_or("false") == "true" ? std::numbers::pi / 180 : 1;
  return {Vec3(v[0], v[1], v[2]), roll_pitch_yaw(Vec3(v[3], v[4], v[5]) * unit)};
}

int SdfFrames::add_scope(int outer) {
  scopes_.push_back({0, outer, {}, {}});
  return static_cast<int>(scopes_.size()) - 1;
}

int SdfFrames::add(SdfFrame frame, int in, const std::string& name) {
  const int number = static_cast<int>(frames_.size());
  if (!scope(in).frames.emplace(name, number).second)
    frame.element.fail("the name " + printable(name) + " is taken");
  frames_.push_back(std::move(frame));
  return number;
}

int SdfFrames::find(int in, const std::string& name, const XmlElement& user) const {
  const SdfScope* s = &scopes_[static_cast<std::size_t>(in)];
  if (name == "__model__") return s->own;
  if (name == "world") return 0;
  std::string rest = name;
  for (std::size_t colons = rest.find("::"); colons != std::string::npos; colons = rest.find("::")) {
    const auto inner = s->models.find(rest.substr(0, colons));
    if (inner == s->models.end()) user.fail("there is no model " + printable(rest.substr(0, colons)));
    s = &scopes_[static_cast<std::size_t>(inner->second)];
    rest = rest.substr(colons + 2);
  }
  const auto it = s->frames.find(rest);
  if (it == s->frames.end()) user.fail("there is no frame " + printable(name));
  return it->second;
}

const Pose& SdfFrames::pose(int number) {
  // Followed by a loop: a file may chain more frames than the stack holds.
  std::vector<int> chain;
  for (int f = number; f >= 0 && at(f).state != 2;) {
    SdfFrame& frame = at(f);
    if (frame.state == 1) frame.element.fail("its pose is relative to itself");
    frame.state = 1;
    chain.push_back(f);
    f = frame.relative_to.empty() ? frame.around : find(frame.scope, frame.relative_to, frame.element);
    frame.around = f;
  }
  for (; !chain.empty(); chain.pop_back()) {
    SdfFrame& frame = at(chain.back());
    frame.in_world = frame.around < 0 ? frame.raw : compose(at(frame.around).in_world, frame.raw);
    frame.state = 2;
  }
  return at(number).in_world;
}

int SdfFrames::link_of(int number, int depth) {
  constexpr int most = 1000;
  SdfFrame& f = at(number);
  if (depth > most) f.element.fail("it is attached to itself");
  if (f.kind == SdfFrame::Kind::world) return -1;
  if (f.kind == SdfFrame::Kind::link || f.kind == SdfFrame::Kind::model) return f.link;
  if (f.attached_to.empty()) return link_of(scope(f.scope).own, depth + 1);
  return link_of(find(f.scope, f.attached_to, f.element), depth + 1);
}

}  // namespace touchstone
