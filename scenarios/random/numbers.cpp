#include "scenarios/random/numbers.h"

namespace touchstone::fuzz {
namespace {

void collect(double& v, std::vector<double*>& out) { out.push_back(&v); }
void collect(Vec3& v, std::vector<double*>& out) {
  for (double& x : v) out.push_back(&x);
}
void collect(std::vector<Vec3>& v, std::vector<double*>& out) {
  for (Vec3& p : v) collect(p, out);
}
void collect(std::vector<std::array<int, 3>>&, std::vector<double*>&) {}

void collect(Pose& p, std::vector<double*>& out) {
  collect(p.translation, out);
  for (double* x : {&p.rotation.x, &p.rotation.y, &p.rotation.z, &p.rotation.w}) out.push_back(x);
}

void collect(Shape& shape, std::vector<double*>& out) {
  std::visit([&](auto& s) { for_each_field(s, [&](auto, auto& value, Domain) { collect(value, out); }); },
             shape);
}

}  // namespace

std::vector<double*> numbers(Shape& s) {
  std::vector<double*> out;
  collect(s, out);
  return out;
}

std::vector<double*> sizes_of(Shape& shape) {
  std::vector<double*> out;
  std::visit(
      [&](auto& s) {
        for_each_field(s, [&](auto, auto& value, Domain d) {
          if (d == Domain::non_negative) collect(value, out);
        });
      },
      shape);
  return out;
}

std::vector<double*> numbers(Case& c) {
  std::vector<double*> out;
  for (Shape& s : c.scene.shapes) collect(s, out);
  for (Body& b : c.scene.bodies) {
    collect(b.pose, out);
    if (b.motion) {
      collect(b.motion->linear, out);
      collect(b.motion->angular, out);
    }
  }
  for (Step& s : c.scene.script)
    if (s.pose) collect(*s.pose, out);
  if (c.scene.margin != 0) collect(c.scene.margin, out);
  return out;
}

void renew(Case& c) {
  for (Shape& s : c.scene.shapes)
    if (auto* h = hull_if(s)) *h = make_hull(std::move(h->vertices));
}

}  // namespace touchstone::fuzz
