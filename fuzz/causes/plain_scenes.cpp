// Plain cases of whole scenes.
#include "fuzz/causes/plain_cases.h"

#include <cmath>
#include <string_view>

#include "fuzz/causes/plain_shapes.h"

namespace touchstone::fuzz {
namespace {

constexpr double spacing = 1.5;    // of bodies of half extent 1: neighbours overlap by a half
constexpr double elsewhere = 100;  // where a body touches no other

Case row_of(const Case& c, const Shape& shape, int bodies) {
  Case r = c;
  r.scene.shapes = {shape};
  r.scene.bodies.assign(static_cast<std::size_t>(bodies), Body{});
  r.scene.script.clear();
  r.scene.ignored.clear();
  for (int i = 0; i < bodies; ++i)
    r.scene.bodies[static_cast<std::size_t>(i)].pose.translation.x() = spacing * i;
  return r;
}

// Scripts as text: a letter inserts the body with that place in the alphabet, a capital removes it, and q is
// a query. After a letter, '=' moves the body to where it is, '~' by a little, '>' away, '<' back.
constexpr std::string_view scripts[] = {
    "abq",        "abqq",     "aqbq",   "abqb=q",  "abqa=b=q",     "abqb~q",          "ab>qb<q",
    "abqb>qb<q",  "abqb>b<q", "ab>b<q", "abqBbq",  "abqB>bq",      "abqBqbq",         "abqBbqBbq",
    "abcqCq",     "abcqAq",   "abcqBq", "abcAcaq", "abqb=qb=qb=q", "abqb>qb<qb>qb<q", "abqBbb=q",
    "abqBbb>b<q", "abqAaBbq", "cbaq",
};

void append(Scene& s, Step::Op op, int body, double away) {
  Step step{op, body, std::nullopt};
  if (op == Step::Op::move) {
    step.pose = s.bodies[static_cast<std::size_t>(body)].pose;
    step.pose->translation.y() += away;
  }
  s.script.push_back(std::move(step));
}

Scene with_script(Scene s, std::string_view text) {
  constexpr double little = 0x1p-12;  // of the bodies' size: a small move, exact in doubles and floats
  int body = 0;
  std::vector<bool> is_present(s.bodies.size(), false);
  for (const char x : text) {
    if (x == 'q') {
      append(s, Step::Op::query, -1, 0);
    } else if (x >= 'a' && x <= 'c') {
      body = x - 'a';
      // A letter that is followed by a move names a body that is already there.
      if (!is_present[static_cast<std::size_t>(body)]) append(s, Step::Op::insert, body, 0);
      is_present[static_cast<std::size_t>(body)] = true;
    } else if (x >= 'A' && x <= 'C') {
      body = x - 'A';
      append(s, Step::Op::remove, body, 0);
      is_present[static_cast<std::size_t>(body)] = false;
    } else {
      append(s, Step::Op::move, body, x == '>' ? elsewhere : x == '~' ? little : 0);
    }
  }
  return s;
}

// What else a fault of a scene at rest may need.
struct Layout {
  int bodies = 2;
  Numbers step = {spacing, 0, 0};  // from each body to the next
  Numbers at = {0, 0, 0};          // the first body
  double size_of_first = 1;
  int static_body = -1;
  bool turned = false, in_groups = false, ignores_ends = false, on_plane = false;
};
constexpr double almost_touching = 2 - 0x1p-40;  // of unit half extents: an overlap that only doubles hold
constexpr Layout layouts[] = {
    {},
    {.bodies = 3},
    {.step = {2, 0, 0}},
    {.step = {almost_touching, 0, 0}},
    {.step = {0, spacing, 0}},
    {.step = {0, 0, spacing}},
    {.step = {-spacing, 0, 0}},
    {.step = {spacing, 0.5, 0.25}},
    {.static_body = 0},
    {.static_body = 1},
    {.turned = true},
    {.at = {-16, -32, -64}},
    {.at = {8192, 0, 0}},
    {.step = {0.25, 0.25, 0.25}, .size_of_first = 4},
    {.step = {64.5, 0, 0}, .size_of_first = 64},
    {.in_groups = true},
    {.bodies = 3, .ignores_ends = true},
    {.on_plane = true},
    {.bodies = 3, .step = {0.5, 0, 0}},
    {.bodies = 4},
    {.bodies = 9},
    {.bodies = 9, .step = {0.75, 0, 0}},
    {.bodies = 9, .step = {0.125, 0, 0}},
    {.bodies = 36},
};

Case laid_out(const Case& c, const Shape& shape, const Layout& how) {
  Case r = row_of(c, shape, how.bodies);
  Scene& s = r.scene;
  if (how.size_of_first != 1) {
    s.shapes.push_back(kind_of(shape) == ShapeKind::sphere ? Shape(Sphere{how.size_of_first})
                                                           : Shape(Box{Vec3::Constant(how.size_of_first)}));
    s.bodies[0].shape = 1;
  }
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    Body& b = s.bodies[i];
    b.pose.translation = vec3(how.at) + vec3(how.step) * static_cast<double>(i);
    if (how.turned) b.pose.rotation = normalized(Quat{0.25, 0.125, 0.5, 1});
    b.is_static = static_cast<int>(i) == how.static_body;
    if (how.in_groups) b.group = static_cast<int>(i);
  }
  if (how.ignores_ends) s.ignored = {{0, how.bodies - 1}};
  if (how.on_plane) {
    s.shapes.emplace_back(HalfSpace{Vec3::UnitX(), 0.5});
    s.bodies[0].shape = static_cast<int>(s.shapes.size()) - 1;
    s.bodies[0].is_static = true;
  }
  return r;
}

// How the second body reaches the first, which is at the origin.
struct Journey {
  Numbers from = {8, 0, 0}, way = {-6.5, 0, 0};
  double turn = 0;           // about z
  bool first_moves = false;  // in place of the second, the other way
};
constexpr Journey journeys[] = {
    {},
    {.way = {-16, 0, 0}},
    {.first_moves = true},
    {.from = {0, 8, 0}, .way = {0, -6.5, 0}},
    {.from = {0, 0, 8}, .way = {0, 0, -6.5}},
    {.from = {8, 0, 0}, .way = {-6.5, 0, 0}, .turn = 1},
    {.from = {40, 0, 0}, .way = {-38.5, 0, 0}},
    {.from = {1.5, 0, 0}, .way = {8, 0, 0}},
    {.from = {0, 3, 0}, .way = {0, 0, 0}, .turn = 1.5},
};

// What turns without travelling is a bar.
Case under_way(const Case& c, const Shape& shape, const Journey& how) {
  Case r = row_of(c, shape, 2);
  Body &a = r.scene.bodies[0], &b = r.scene.bodies[1];
  if (vec3(how.way).isZero(0)) {
    r.scene.shapes.emplace_back(Box{Vec3(4, 0.25, 0.25)});
    b.shape = 1;
  }
  b.pose.translation = vec3(how.from);
  const Vec3 way = vec3(how.way);
  if (how.first_moves)
    a.motion = Motion{-way, Vec3::Zero()};
  else
    b.motion = Motion{way, Vec3(0, 0, how.turn)};
  return r;
}

void add_scripts(std::vector<Case>& to, const Case& c, const Shape& shape) {
  for (const std::string_view text : scripts) {
    Case r = row_of(c, shape, text.find_first_of("cC") == std::string_view::npos ? 2 : 3);
    r.scene = with_script(std::move(r.scene), text);
    to.push_back(std::move(r));
  }
}

}  // namespace

std::vector<Case> plain_scenes(const Case& c, bool moving) {
  std::vector<Case> all;
  const Shape shapes[] = {Box{Vec3::Ones()}, Sphere{1}};
  if (moving) {
    for (const Journey& how : journeys)
      for (const Shape& shape : shapes) all.push_back(under_way(c, shape, how));
    return all;
  }
  for (const Layout& how : layouts)
    for (const Shape& shape : shapes) all.push_back(laid_out(c, shape, how));
  if (is_script_question(c.queries[0].question))
    for (const Shape& shape : shapes) add_scripts(all, c, shape);
  return all;
}

}  // namespace touchstone::fuzz
