#include "fuzz/answer/body_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>
#include <type_traits>
#include <vector>

#include "core/base/exact_text.h"
#include "core/base/input_error.h"
#include "core/math/pose.h"
#include "core/shape/shape.h"
#include "scenarios/text/name_list.h"
#include "scenarios/text/printable.h"

namespace touchstone::fuzz {
namespace {

using Json = nlohmann::ordered_json;

const std::vector<std::string> clauses{"at", "rot", "quat", "move", "spin", "pad"};

class Words {
 public:
  Words(std::string_view text, std::string place) : place_(std::move(place)) {
    std::istringstream in{std::string(text)};
    for (std::string w; in >> w;) words_.push_back(w);
  }
  [[noreturn]] void fail(const std::string& reason) const { throw InputError(place_, reason); }
  bool done() const { return next_ == words_.size(); }
  std::string word() { return words_[next_++]; }
  std::size_t numbers_ahead() const {
    const auto from = words_.begin() + static_cast<std::ptrdiff_t>(next_);
    const auto is_number = [](const std::string& w) { return double_from_text(w).has_value(); };
    return static_cast<std::size_t>(std::find_if_not(from, words_.end(), is_number) - from);
  }
  double number(const std::string& of) {
    if (done()) fail(fmt::format("`{}` ends too early: a number is missing", of));
    const auto x = double_from_text(words_[next_]);
    if (!x || !std::isfinite(*x))
      fail(fmt::format("`{}` needs a number where `{}` stands", of, shown(words_[next_])));
    ++next_;
    return *x;
  }
  Json numbers(const std::string& of, int count) {
    Json j = Json::array();
    for (int i = 0; i < count; ++i) j.push_back(number(of));
    return j;
  }
  static std::string shown(const std::string& w) { return cut_utf8(printable(w), 40); }

 private:
  std::vector<std::string> words_;
  std::size_t next_ = 0;
  std::string place_;
};

std::optional<ShapeKind> kind_named(const std::string& name) {
  for (int k = 0; k < shape_kind_count; ++k)
    if (type_name(static_cast<ShapeKind>(k)) == name) return static_cast<ShapeKind>(k);
  return std::nullopt;
}

[[noreturn]] void refuse_shape(const Words& in, const std::string& name) {
  std::vector<std::string> known;
  std::string list;
  for (int k = 0; k < shape_kind_count; ++k) {
    known.emplace_back(type_name(static_cast<ShapeKind>(k)));
    list += (k ? ", " : "") + known.back();
  }
  const std::string near = did_you_mean(name, known);
  in.fail(
      fmt::format("unknown shape `{}`{}", Words::shown(name), near.empty() ? "; known are " + list : near));
}

// Points, of whose numbers the last `rest` belong to what follows.
Json points(Words& in, const std::string& type, std::size_t rest) {
  Json all = Json::array();
  while (in.numbers_ahead() > rest) all.push_back(in.numbers(type, 3));
  return all;
}

Json shape_from(Words& in) {
  if (in.done()) in.fail("is empty; a body begins with a shape, such as `box 1 1 1`");
  const std::string type = in.word();
  const auto kind = kind_named(type);
  if (!kind) refuse_shape(in, type);
  if (is_mesh(*kind)) in.fail("a mesh is given as JSON, not as text");
  Json j{{"type", type}};
  const Shape empty = shape_of_kind(*kind);
  std::visit(
      [&](const auto& s) {
        std::size_t single = 0;
        for_each_field(s, [&](auto, const auto& value, Domain) {
          single += std::is_same_v<std::decay_t<decltype(value)>, double>;
        });
        for_each_field(s, [&](auto name, const auto& value, Domain) {
          using T = std::decay_t<decltype(value)>;
          if constexpr (std::is_same_v<T, double>) j[name] = in.number(type);
          if constexpr (std::is_same_v<T, Vec3>) j[name] = in.numbers(type, 3);
          if constexpr (std::is_same_v<T, std::vector<Vec3>>) j[name] = points(in, type, single);
        });
      },
      empty);
  return j;
}

// Tangent of half the angle, exact for right angles; empty for half a turn.
std::optional<double> half_tangent(Words& in) {
  if (in.done()) in.fail("`rot` ends too early: an angle such as `30deg` is missing");
  const std::string word = in.word();
  const bool degrees = word.ends_with("deg"), radians = word.ends_with("rad");
  const auto angle =
      degrees || radians ? double_from_text(std::string_view(word).substr(0, word.size() - 3)) : std::nullopt;
  if (!angle || !std::isfinite(*angle))
    in.fail(fmt::format("`rot` needs an angle with its unit, such as `30deg` or `0.5rad`, where `{}` stands",
                        Words::shown(word)));
  if (radians) return std::tan(*angle / 2);
  constexpr double turn = 360;
  const double rest = std::remainder(*angle, turn);
  if (std::abs(rest) == turn / 2) return std::nullopt;
  if (std::abs(rest) == turn / 4) return rest < 0 ? -1.0 : 1.0;
  return std::tan(rest * (std::numbers::pi / turn));
}

// The quaternion need not have unit length: (axis·tan(θ/2), |axis|).
Json rotation_from(Words& in) {
  const Vec3 axis{in.number("rot"), in.number("rot"), in.number("rot")};
  const double length = axis.stableNorm();
  if (!(length > 0)) in.fail("`rot` needs an axis that is not zero");
  const auto t = half_tangent(in);
  const Vec3 v = t ? Vec3(*t * axis) : axis;
  return Json::array({v.x(), v.y(), v.z(), t ? length : 0.0});
}

void read_clause(Words& in, Json& body) {
  const std::string word = in.word();
  const auto set = [&](const char* object, const char* field, Json value) {
    if (body.contains(object) && body[object].contains(field))
      in.fail(fmt::format("`{}`: the {} is given twice", word, field));
    body[object][field] = std::move(value);
  };
  if (word == "at") return set("pose", "translation", in.numbers(word, 3));
  if (word == "rot") return set("pose", "rotation", rotation_from(in));
  if (word == "quat") return set("pose", "rotation", in.numbers(word, 4));
  if (word == "pad") return set("shape", "padding", in.number(word));
  if (word == "move") return set("motion", "linear", in.numbers(word, 3));
  if (word == "spin") return set("motion", "angular", in.numbers(word, 3));
  if (double_from_text(word)) in.fail(fmt::format("has one number too many: `{}`", Words::shown(word)));
  const std::string near = did_you_mean(word, clauses);
  in.fail(fmt::format("unknown word `{}`{}", Words::shown(word),
                      near.empty() ? "; known are at, rot, quat, move, spin, pad" : near));
}

}  // namespace

nlohmann::ordered_json body_from_text(std::string_view text, const std::string& place) {
  Words in(text, place);
  Json body{{"shape", shape_from(in)}};
  while (!in.done()) read_clause(in, body);
  return body;
}

std::string describe_shape_texts() {
  std::string all;
  for (int k = 0; k < shape_kind_count; ++k) {
    if (is_mesh(static_cast<ShapeKind>(k))) continue;
    all += fmt::format("  {}", type_name(static_cast<ShapeKind>(k)));
    const Shape empty = shape_of_kind(static_cast<ShapeKind>(k));
    std::visit(
        [&](const auto& s) {
          for_each_field(s, [&](auto name, const auto& value, Domain) {
            using T = std::decay_t<decltype(value)>;
            const std::string_view count = std::is_same_v<T, double> ? ""
                                           : std::is_same_v<T, Vec3> ? "(3)"
                                                                     : "(3 each)";
            all += fmt::format(" {}{}", name, count);
          });
        },
        empty);
    all += "\n";
  }
  return all;
}

}  // namespace touchstone::fuzz
