#include "scenarios/random/numbers.h"

#include <bit>
#include <cmath>

namespace touchstone::fuzz {
namespace {

std::size_t parts(const Shape& shape) {
  if (const auto* h = hull_if(shape)) return h->vertices.size();
  if (const TriangleMesh* m = triangles_if(shape)) return m->vertices.size() + 3 * m->triangles.size();
  return 0;
}

// The identity costs nothing: w costs nothing when it is 1.
std::uint64_t bits_of(const Pose& p) {
  std::uint64_t n = 0;
  for (double x : p.translation) n += static_cast<std::uint64_t>(fuzz::bits_of(x));
  for (double x : {p.rotation.x, p.rotation.y, p.rotation.z})
    n += static_cast<std::uint64_t>(fuzz::bits_of(x));
  return n + (p.rotation.w == 1 ? 0 : 1 + static_cast<std::uint64_t>(fuzz::bits_of(p.rotation.w)));
}

}  // namespace

int bits_of(double v) {
  if (v == 0) return std::signbit(v) ? 1 : 0;
  if (!std::isfinite(v)) return 64;
  int exponent = 0;
  const auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::frexp(std::abs(v), &exponent), 53));
  const int significant = 53 - std::countr_zero(mantissa);
  return significant + static_cast<int>(std::bit_width(static_cast<unsigned>(std::abs(exponent - 1)))) +
         (std::signbit(v) ? 1 : 0);
}

CaseSize measure(const Case& c) {
  const Scene& s = c.scene;
  CaseSize m{s.bodies.size(), s.script.size(), 0};
  m.bits += s.shapes.size() + c.queries.size() + 2 * s.ignored.size();
  for (Shape shape : s.shapes) {
    for (const double* x : numbers(shape)) m.bits += static_cast<std::uint64_t>(bits_of(*x));
    m.bits += parts(shape);
  }
  for (const Body& b : s.bodies) {
    m.bits += bits_of(b.pose) + b.is_static + (b.group != -1) + !b.name.empty();
    if (!b.motion) continue;
    ++m.bits;
    for (double x : b.motion->linear) m.bits += static_cast<std::uint64_t>(bits_of(x));
    for (double x : b.motion->angular) m.bits += static_cast<std::uint64_t>(bits_of(x));
  }
  m.bits += static_cast<std::uint64_t>(bits_of(s.margin));
  for (const Step& step : s.script)
    if (step.pose) m.bits += 1 + bits_of(*step.pose);
  return m;
}

}  // namespace touchstone::fuzz
