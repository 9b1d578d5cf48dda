// Lies about the contacts of a whole scene.
#include <algorithm>

#include "tests/mutants/pair.h"
#include "tests/mutants/replay.h"
#include "tests/mutants/topics.h"

namespace touchstone::mutants {
namespace {

using Contacts = std::vector<SceneContact>;
void last_dropped(const Case&, Contacts& x) {
  if (!x.empty()) x.pop_back();
}
void eight_at_most(const Case&, Contacts& x) {
  if (x.size() > 8) x.resize(8);
}
void one_a_body(const Case&, Contacts& x) {
  std::vector<int> seen;
  std::erase_if(x, [&](const SceneContact& k) {
    const bool again = std::find(seen.begin(), seen.end(), k.a) != seen.end();
    seen.push_back(k.a);
    return again;
  });
}
void static_dropped(const Case& c, Contacts& x) {
  std::erase_if(x, [&](const SceneContact& k) { return body(c, k.a).is_static || body(c, k.b).is_static; });
}
void shallow_dropped(const Case&, Contacts& x) {
  std::erase_if(x, [](const SceneContact& k) { return k.depth < 0.01; });
}
void negative_dropped(const Case& c, Contacts& x) {
  std::erase_if(x, [&](const SceneContact& k) {
    return (body(c, k.a).pose.translation.array() < 0).all() &&
           (body(c, k.b).pose.translation.array() < 0).all();
  });
}
void contained_dropped(const Case& c, Contacts& x) {
  std::erase_if(x, [&](const SceneContact& k) { return contained(c, {Question::contact, k.a, k.b}); });
}
void duplicated_deeper(const Case&, Contacts& x) {
  if (x.empty()) return;
  x.push_back(x.back());
  x.back().depth *= 1.5;
}
void swapped_without_flip(const Case&, Contacts& x) {
  if (!x.empty()) std::swap(x.back().a, x.back().b);
}
void named_off_by_one(const Case& c, Contacts& x) {
  if (!x.empty() && x.back().b + 1 < static_cast<int>(c.scene.bodies.size())) ++x.back().b;
}
void body_that_never_was(const Case& c, Contacts& x) {
  if (!x.empty()) x.back().b = static_cast<int>(c.scene.bodies.size());
}
void boxes_as_contacts(const Case& c, Contacts& x) {
  const int n = static_cast<int>(c.scene.bodies.size());
  const auto box = [&](int i) { return plain_box(c.scene.shape_of(i), body(c, i).pose); };
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b) {
      const bool known =
          std::any_of(x.begin(), x.end(), [&](const SceneContact& k) { return k.a == a && k.b == b; });
      if (!known && overlaps(box(a), box(b))) return x.push_back({a, b, Vec3::UnitZ(), 0});
    }
}
void normals_shifted(const Case&, Contacts& x) {
  for (std::size_t i = 0; i + 1 < x.size(); ++i) std::swap(x[i].normal, x[i + 1].normal);
}
void depths_shifted(const Case&, Contacts& x) {
  for (std::size_t i = 0; i + 1 < x.size(); ++i) std::swap(x[i].depth, x[i + 1].depth);
}
void normals_local(const Case& c, Contacts& x) {
  for (SceneContact& k : x) k.normal = rotation_matrix(body(c, k.a).pose.rotation).transpose() * k.normal;
}
void least_depth(const Case&, Contacts& x) {
  for (SceneContact& k : x) k.depth = std::max(k.depth, 0.001);
}

}  // namespace

std::vector<Mutant> scene_lies() {
  return {
      {"contact_dropped", "missed", "crowd", "the last contact is lost", on_scene(last_dropped)},
      {"contacts_eight", "missed", "crowd", "a buffer of 8 contacts", on_scene(eight_at_most)},
      {"contacts_one_a_body", "missed", "crowd", "only one contact for each lower id", on_scene(one_a_body)},
      {"contacts_static_dropped", "missed", "crowd", "no contact with a static body",
       on_scene(static_dropped)},
      {"contacts_shallow_dropped", "missed", "tiles", "no contact of less than 0.01",
       on_scene(shallow_dropped)},
      {"contacts_negative_dropped", "missed", "crowd", "no contact between bodies in the negative octant",
       on_scene(negative_dropped)},
      {"contacts_contained_dropped", "missed", "crowd", "no contact of a body within the other's box",
       on_scene(contained_dropped)},
      {"contact_duplicated", "depth_excess", "crowd",
       "the last contact twice, the second time 1.5 times as deep", on_scene(duplicated_deeper)},
      {"contact_swapped", "infeasible", "crowd",
       "the bodies of the last contact are swapped, but not the normal", on_scene(swapped_without_flip)},
      {"contact_off_by_one", "missed", "crowd", "the last contact names the next body",
       on_scene(named_off_by_one)},
      {"contact_of_no_body", "stale", "crowd", "the last contact names a body that does not exist",
       on_scene(body_that_never_was)},
      {"contact_of_boxes", "ghost", "crowd", "a contact where only the boxes overlap",
       on_scene(boxes_as_contacts)},
      {"contact_normals_shifted", "infeasible", "crowd", "each contact has the normal of the next one",
       on_scene(normals_shifted)},
      {"contact_depths_shifted", "infeasible", "crowd", "each contact has the depth of the next one",
       on_scene(depths_shifted)},
      {"contact_normals_local", "infeasible", "crowd", "normals in A's frame", on_scene(normals_local)},
      {"contact_least_depth", "depth_excess", "tiles", "no depth is below 0.001", on_scene(least_depth)},
  };
}

}  // namespace touchstone::mutants
