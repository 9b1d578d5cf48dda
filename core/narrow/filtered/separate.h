// The fast answer of a pair of shapes in the arithmetic R, or `unsure`. Instantiated for double and float.
#pragma once

#include "core/narrow/filtered/patch.h"

namespace touchstone::narrow::filtered {

/// Where a contact's points come from.
enum class ContactForm {
  point,     // halfway between the witness points
  segments,  // two nearly parallel capsules: an interval when they are collinear
  cores,     // contact_patch of a and b
  plane      // contact_patch of a alone
};

/// Input of contact_patch from a pair that has been queried.
template <class R>
struct PairScene {
  ConvexBody<R> a, b;
  Relative<R> at;
  V3<R> normal;  // A's frame; set with `contact` other than point and segments
  V3<R> middle;  // A's frame: halfway between the witness points; set with `has_middle`
  bool has_middle = false;
  ContactForm contact = ContactForm::point;
  /// A's frame: in, the initial direction of a search, or zero; out, its final direction.
  V3<R> guess = V3<R>::Zero();
  /// In: where two polytopes touched in an earlier query; out: where they do. Null: nobody asks.
  TouchingFeatures* features = nullptr;
};

template <class R>
using Function = void (*)(const PlacedShape&, const PlacedShape&, Asked, Answer<R>&, PairScene<R>&);

/// Any two bounded convex shapes: GJK, and the expanding polytope when their cores meet.
template <class R>
void convex_pair(const PlacedShape& a, const PlacedShape& b, Asked asked, Answer<R>& out,
                 PairScene<R>& scene);

/// The same for the bodies and frames in `scene`. A distance beyond `enough` is reported as `apart` without a
/// value.
template <class R>
void separate_cores(const RoundedPose<R>& a, const RoundedPose<R>& b, Asked asked, R enough, Answer<R>& out,
                    PairScene<R>& scene);

/// A bounded convex A and a mesh B, in double.
template <class R>
void convex_mesh(const PlacedShape& a, const PlacedShape& b, Asked asked, Answer<R>& out,
                 PairScene<R>& scene);

/// Two meshes, in double.
template <class R>
void mesh_mesh(const PlacedShape& a, const PlacedShape& b, Asked asked, Answer<R>& out, PairScene<R>& scene);

template <class R>
void box_box(const PlacedShape& a, const PlacedShape& b, Asked asked, Answer<R>& out, PairScene<R>& scene);

template <class R>
void box_and_capsule(const PlacedShape& a, const PlacedShape& b, Asked asked, Answer<R>& out,
                     PairScene<R>& scene);

/// A bounded convex A and a half-space B.
template <class R>
void convex_half_space(const PlacedShape& a, const PlacedShape& b, Asked asked, Answer<R>& out,
                       PairScene<R>& scene);

/// A closed form of closed_forms.h as a row of the table.
template <class R, void (*form)(const Shape&, const Pose&, const Shape&, const Pose&, Asked, Answer<R>&)>
void closed(const PlacedShape& a, const PlacedShape& b, Asked asked, Answer<R>& out, PairScene<R>&) {
  form(*a.shape, a.pose, *b.shape, b.pose, asked, out);
}

/// Bodies and frames of two shapes, for contact_patch after a closed form.
template <class R>
void prepare(const ShapeRef& pa, const RoundedPose<R>& a, const ShapeRef& pb, const RoundedPose<R>& b,
             PairScene<R>& s) {
  s.a = pa.body<R>();
  s.b = pb.body<R>();
  s.at = relative(a, b);
}

}  // namespace touchstone::narrow::filtered
