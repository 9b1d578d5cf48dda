#include "core/narrow/narrow_phase.h"

#include "core/narrow/bounded.h"
#include "core/narrow/flat_mesh.h"
#include "core/narrow/pair_table.h"
#include "core/narrow/solid.h"
#include "core/narrow/wide_answer.h"

namespace touchstone {
namespace {

namespace filtered = narrow::filtered;
using filtered::Asked;
using filtered::Found;
using narrow::FastAnswer;

template <class R>
Vec3 world(const V3<R>& p, const PlacedShape& origin) {
  if constexpr (sizeof(R) == sizeof(double))
    return p + origin.pose.translation;
  else
    return (p + origin.pose.translation.cast<R>()).template cast<double>();
}

// An uncertain sign is left to extended precision unless R is to be used `alone`.
template <class R>
bool is_decided(const FastAnswer<R>& f, bool alone) {
  return f.answer.found == Found::touching ? alone : f.answer.found != Found::unsure;
}

template <class R>
bool overlaps(const FastAnswer<R>& f) {
  return f.answer.found == Found::touching ? f.answer.gap <= 0 : f.answer.found == Found::meeting;
}

// Transforms the points from the frame of the table row's A to the world.
template <class R>
bool fill_manifold(const FastAnswer<R>& f, const PlacedShape& a, const PlacedShape& b, double margin,
                   Manifold& out) {
  const filtered::Answer<R>& s = f.answer;
  if (f.scene.contact == filtered::ContactForm::point) {
    out.push_back({world<R>((s.a + s.b) / 2, a), std::max<double>(-margin, -s.gap), 0});
    return true;
  }
  const PlacedShape& origin = f.mirrored ? b : a;
  const filtered::PairScene<R>& c = f.scene;
  const auto patch =
      filtered::contact_patch<R>(c.a, c.contact == filtered::ContactForm::plane ? nullptr : &c.b, c.at,
                                 c.normal, s.gap, static_cast<R>(margin), c.has_middle ? &c.middle : nullptr);
  for (int i = 0; i < patch.size; ++i) {
    const auto& p = patch.point[static_cast<std::size_t>(i)];
    out.push_back({world<R>(c.at.a_to_world * p.p, origin), static_cast<double>(p.depth),
                   f.mirrored ? narrow::outline::mirrored_id(p.id) : p.id});
  }
  return patch.size > 0;
}

// Sets the bodies and frames of two bounded convex shapes, as a closed form does not.
template <class R>
void prepare_cores(FastAnswer<R>& f, const PlacedShape& a, const PlacedShape& b) {
  const PlacedShape &x = f.mirrored ? b : a, &y = f.mirrored ? a : b;
  const auto from = filtered::rounded_pose<R>(x.pose), to = filtered::rounded_pose<R>(y.pose);
  f.scene.contact = filtered::ContactForm::cores;
  filtered::prepare<R>(x, from, y, to, f.scene);
  const V3<R> n = f.mirrored ? V3<R>(-f.answer.normal) : f.answer.normal;
  f.scene.normal = f.scene.at.a_to_world.transpose() * n;
  // (a + b)/2 relative to the row's A; the answer's points are relative to the query's A.
  const V3<R> middle = (f.answer.a + f.answer.b) / 2 +
                       (f.mirrored ? V3<R>(a.pose.translation.cast<R>() - b.pose.translation.cast<R>())
                                   : V3<R>(V3<R>::Zero()));
  f.scene.middle = f.scene.at.a_to_world.transpose() * middle;
  f.scene.has_middle = true;
}

template <class R>
void fill(const FastAnswer<R>& f, const PlacedShape& a, DistanceAnswer& r) {
  r.distance = static_cast<double>(f.answer.gap);
  r.error_bound = static_cast<double>(f.answer.bound);
  r.normal = f.answer.normal.template cast<double>();
  r.witness = {world<R>(f.answer.a, a), world<R>(f.answer.b, a)};
}

template <class R>
bool fill(FastAnswer<R>& f, const PlacedShape& a, const PlacedShape& b, ContactAnswer& r) {
  r.overlap = overlaps(f);
  r.error_bound = r.regret_bound = static_cast<double>(f.answer.bound);
  if (!r.overlap) return true;
  r.normal = f.answer.normal.template cast<double>();
  r.depth = std::max<double>(0, -f.answer.gap);
  if (f.scene.contact == filtered::ContactForm::segments) prepare_cores(f, a, b);
  return fill_manifold(f, a, b, 0, r.manifold);
}

// Computes the fast answer. `memory`, if any, supplies the initial guess and receives the final direction.
template <class R>
void separate(const PlacedShape& a, const PlacedShape& b, Asked asked, PairMemory* memory, FastAnswer<R>& f) {
  f.scene.guess = memory ? V3<R>(memory->direction.cast<R>()) : V3<R>(V3<R>::Zero());
  f.scene.features = memory ? &memory->features : nullptr;
  narrow::separate_fast<R>(a, b, asked, f);
  if (memory) memory->direction = f.scene.guess.template cast<double>();
}

template <class R, class A>
bool is_unsupported(const PlacedShape& a, const PlacedShape& b, A& r) {
  if (narrow::has_fast<R>(kind_of(*a.shape), kind_of(*b.shape))) return false;
  r.outcome = Outcome::unsupported;
  return true;
}

// Uses the arithmetic R only.
template <class R>
OverlapAnswer overlap_alone(const PlacedShape& a, const PlacedShape& b, PairMemory* memory) {
  OverlapAnswer r;
  if (is_unsupported<R>(a, b, r)) return r;
  FastAnswer<R> f;
  separate<R>(a, b, Asked::overlap, memory, f);
  if (!is_decided(f, true)) separate<R>(a, b, Asked::distance, memory, f);
  r.outcome = is_decided(f, true) ? Outcome::answered : Outcome::not_converged;
  r.overlap = overlaps(f);
  r.error_bound = static_cast<double>(f.answer.bound);
  return r;
}

template <class R>
DistanceAnswer distance_alone(const PlacedShape& a, const PlacedShape& b, PairMemory* memory) {
  DistanceAnswer r;
  if (is_unsupported<R>(a, b, r)) return r;
  FastAnswer<R> f;
  separate<R>(a, b, Asked::distance, memory, f);
  if (is_decided(f, true))
    fill<R>(f, a, r);
  else
    r.outcome = Outcome::not_converged;
  return r;
}

// For a contact whose patch is empty (no face and no edge crossing that R can resolve): uses the witness
// points of the distance, which rows with patches omit from a contact.
template <class R>
void fill_point_alone(const PlacedShape& a, const PlacedShape& b, ContactAnswer& r) {
  FastAnswer<R> f;
  separate<R>(a, b, Asked::distance, nullptr, f);
  if (is_decided(f, true))
    r.manifold.push_back({world<R>((f.answer.a + f.answer.b) / 2, a), r.depth, 0});
  else
    r.outcome = Outcome::not_converged;
}

template <class R>
ContactAnswer contact_alone(const PlacedShape& a, const PlacedShape& b, PairMemory* memory) {
  ContactAnswer r;
  if (is_unsupported<R>(a, b, r)) return r;
  FastAnswer<R> f;
  separate<R>(a, b, Asked::contact, memory, f);
  if (!is_decided(f, true))
    r.outcome = Outcome::not_converged;
  else if (!fill<R>(f, a, b, r))
    fill_point_alone<R>(a, b, r);
  return r;
}

// The answer in double; false: extended precision has to decide. Answers are built in place: a manifold is
// not copied.
bool fast_contact(const PlacedShape& a, const PlacedShape& b, PairMemory* memory, ContactAnswer& r) {
  FastAnswer<double> f;
  separate<double>(a, b, Asked::contact, memory, f);
  return is_decided(f, false) && fill<double>(f, a, b, r);
}

// The same for the contact of bodies within the margin, from the answer of a distance.
template <class R>
bool fill_within(FastAnswer<R>& f, const PlacedShape& a, const PlacedShape& b, double margin,
                 ContactAnswer& r) {
  r.overlap = f.answer.gap <= margin;
  r.error_bound = r.regret_bound = static_cast<double>(f.answer.bound);
  if (!r.overlap) return true;
  r.normal = f.answer.normal.template cast<double>();
  r.depth = -f.answer.gap;
  if (is_convex(kind_of(*a.shape)) && is_convex(kind_of(*b.shape))) prepare_cores(f, a, b);
  return fill_manifold(f, a, b, margin, r.manifold);
}

// In R only; what the patch cannot show is the point between the witness points.
template <class R>
ContactAnswer contact_within_alone(const PlacedShape& a, const PlacedShape& b, double margin,
                                   PairMemory* memory) {
  ContactAnswer r;
  if (is_unsupported<R>(a, b, r)) return r;
  FastAnswer<R> f;
  separate<R>(a, b, Asked::distance, memory, f);
  if (!is_decided(f, true))
    r.outcome = Outcome::not_converged;
  else if (!fill_within<R>(f, a, b, margin, r))
    r.manifold.push_back({world<R>((f.answer.a + f.answer.b) / 2, a), r.depth, 0});
  return r;
}

// Surfaces and solids: the contact of those that overlap, else the point between the nearest ones.
ContactAnswer mesh_contact_within(const PlacedShape& a, const PlacedShape& b, double margin,
                                  Arithmetic arithmetic, PairMemory* memory) {
  const DistanceAnswer d = distance(a, b, arithmetic, memory);
  ContactAnswer r;
  r.outcome = d.outcome;
  r.error_bound = r.regret_bound = d.error_bound;
  if (d.outcome != Outcome::answered || !(d.distance <= margin)) return r;
  if (d.distance <= 0)
    if (ContactAnswer touching = contact(a, b, arithmetic, memory); touching.overlap) return touching;
  r.overlap = true;
  r.normal = d.normal;
  r.depth = -d.distance;
  r.manifold.push_back({(d.witness[0] + d.witness[1]) / 2, r.depth, 0});
  return r;
}

}  // namespace

OverlapAnswer overlap(const PlacedShape& a, const PlacedShape& b, Arithmetic arithmetic, PairMemory* memory) {
  if (narrow::has_solid(a, b)) return narrow::solid_overlap(a, b, arithmetic, memory);
  if (arithmetic == Arithmetic::float32) return overlap_alone<float>(a, b, memory);
  if (arithmetic == Arithmetic::float64_alone) return overlap_alone<double>(a, b, memory);
  FastAnswer<double> f;
  separate<double>(a, b, Asked::overlap, memory, f);
  if (!is_decided(f, false)) return narrow::wide_overlap(a, b);
  return {Outcome::answered, f.answer.found == Found::meeting, f.answer.bound};
}

DistanceAnswer distance(const PlacedShape& a, const PlacedShape& b, Arithmetic arithmetic,
                        PairMemory* memory) {
  if (narrow::has_solid(a, b)) return narrow::solid_distance(a, b, arithmetic, memory);
  if (arithmetic == Arithmetic::float32) return distance_alone<float>(a, b, memory);
  if (arithmetic == Arithmetic::float64_alone) return distance_alone<double>(a, b, memory);
  DistanceAnswer r;
  FastAnswer<double> f;
  separate<double>(a, b, Asked::distance, memory, f);
  if (!is_decided(f, false)) return narrow::wide_distance(a, b);
  fill<double>(f, a, r);
  return r;
}

ContactAnswer contact(const PlacedShape& a, const PlacedShape& b, Arithmetic arithmetic, PairMemory* memory) {
  if (narrow::has_solid(a, b)) return narrow::solid_contact(a, b, arithmetic, memory);
  ContactAnswer r;
  if (arithmetic == Arithmetic::float32)
    r = contact_alone<float>(a, b, memory);
  else if (arithmetic == Arithmetic::float64_alone)
    r = contact_alone<double>(a, b, memory);
  else if (!fast_contact(a, b, memory, r))
    r = narrow::wide_contact(a, b);
  if (r.overlap && narrow::may_be_flat(a, b))
    if (const auto flat = narrow::contact_with_plane_of(a, b, r)) r = *flat;
  return r;
}

ContactAnswer contact_within(const PlacedShape& a, const PlacedShape& b, double margin, Arithmetic arithmetic,
                             PairMemory* memory) {
  if (margin == 0) return contact(a, b, arithmetic, memory);
  if (arithmetic != Arithmetic::float32 && distance_lower_bound(a, b) > margin) return {};
  if (is_mesh(*a.shape) || is_mesh(*b.shape)) return mesh_contact_within(a, b, margin, arithmetic, memory);
  if (arithmetic == Arithmetic::float32) return contact_within_alone<float>(a, b, margin, memory);
  if (arithmetic == Arithmetic::float64_alone) return contact_within_alone<double>(a, b, margin, memory);
  FastAnswer<double> f;
  separate<double>(a, b, Asked::distance, memory, f);
  if (ContactAnswer r; is_decided(f, false) && fill_within<double>(f, a, b, margin, r)) return r;
  return narrow::wide_contact_within(a, b, margin);
}

}  // namespace touchstone
