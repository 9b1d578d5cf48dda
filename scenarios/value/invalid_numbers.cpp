#include "scenarios/value/invalid_numbers.h"

#include <cmath>
#include <unordered_map>

#include "core/base/input_error.h"

namespace touchstone {
namespace {

// Calls visit(place, number, may be negative) for every number that can be invalid.
template <class SceneRef, class Visit>
void for_each_place(SceneRef& s, Visit&& visit) {
  const auto three = [&](const std::string& place, auto& v, bool signed_number) {
    for (int k = 0; k < 3; ++k) visit(place + std::to_string(k), v[k], signed_number);
  };
  for (std::size_t i = 0; i < s.shapes.size(); ++i)
    if (auto* box = std::get_if<Box>(&s.shapes[i]))
      three("/shapes/" + std::to_string(i) + "/half_extents/", box->half_extents, false);
  for (std::size_t i = 0; i < s.bodies.size(); ++i)
    three("/bodies/" + std::to_string(i) + "/pose/translation/", s.bodies[i].pose.translation, true);
  for (std::size_t i = 0; i < s.script.size(); ++i)
    if (s.script[i].pose)
      three("/script/" + std::to_string(i) + "/pose/translation/", s.script[i].pose->translation, true);
}

bool is_invalid(double x, bool signed_number) { return !std::isfinite(x) || (!signed_number && x < 0); }

}  // namespace

std::vector<InvalidNumber> invalid_numbers(const Scene& s) {
  std::vector<InvalidNumber> out;
  for_each_place(s, [&](const std::string& place, double x, bool signed_number) {
    if (is_invalid(x, signed_number)) out.push_back({place, x});
  });
  return out;
}

bool is_closed_set(const Shape& shape, const Pose& pose) {
  const auto* box = std::get_if<Box>(&shape);
  return pose.translation.allFinite() &&
         (!box || (box->half_extents.allFinite() && (box->half_extents.array() >= 0).all()));
}

Scene without_invalid_numbers(Scene s) {
  for_each_place(s, [](const std::string&, double& x, bool signed_number) {
    if (is_invalid(x, signed_number)) x = 0;
  });
  return s;
}

// Uses a table of the places, because a file may list as many numbers as the scene has.
void insert_invalid_numbers(Scene& s, const std::vector<InvalidNumber>& all) {
  struct Place {
    double* number = nullptr;
    bool may_be_negative = false;
  };
  std::unordered_map<std::string, Place> places;
  for_each_place(s, [&](const std::string& place, double& x, bool signed_number) {
    places[place] = {&x, signed_number};
  });
  for (const InvalidNumber& n : all) {
    const auto found = places.find(n.place);
    if (found == places.end())
      throw InputError(n.place, "is not the place of a coordinate or a half extent in this scene");
    if (!is_invalid(n.value, found->second.may_be_negative))
      throw InputError(n.place, "is an ordinary number: it belongs in the scene itself");
    *found->second.number = n.value;
  }
}

}  // namespace touchstone
