#include "fuzz/shrink/canonical.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/base/input_error.h"
#include "fuzz/shrink/reductions.h"
#include "scenarios/random/numbers.h"

namespace touchstone::fuzz {
namespace {

constexpr std::size_t most_permuted_bodies = 4;
constexpr int float_bits = 24;
constexpr double rotation_noise = 0x1p-45;  // entries below this are roundings of zero
constexpr double tie = 1 + 1e-9;            // components this near count as equally large

// --- signed permutations of the axes

struct SignedAxes {
  Mat3 matrix;
  double determinant = 1;
};

const std::vector<SignedAxes>& signed_axes() {
  static const std::vector<SignedAxes> all = [] {
    std::vector<SignedAxes> list;
    std::array<Eigen::Index, 3> axis{0, 1, 2};
    do {
      for (unsigned signs = 0; signs < 8; ++signs) {
        Mat3 m = Mat3::Zero();
        for (unsigned k = 0; k < 3; ++k) m(k, axis[k]) = (signs >> k & 1U) != 0 ? -1 : 1;
        list.push_back({m, m.determinant()});
      }
    } while (std::next_permutation(axis.begin(), axis.end()));
    return list;
  }();
  return all;
}

// --- shapes in other axes of their own

bool is_before(const Vec3& x, const Vec3& y) {
  return std::lexicographical_compare(x.begin(), x.end(), y.begin(), y.end());
}

std::optional<Shape> in_axes(const Sphere& s, const Mat3&) { return s; }
template <class S>
requires std::is_same_v<S, Box> || std::is_same_v<S, RoundedBox> std::optional<Shape> in_axes(S s,
                                                                                              const Mat3& p) {
  s.half_extents = (p * s.half_extents).cwiseAbs();
  return s;
}
std::optional<Shape> in_axes(Ellipsoid s, const Mat3& p) {
  s.semi_axes = (p * s.semi_axes).cwiseAbs();
  return s;
}
template <class S>
requires std::is_same_v<S, Capsule> || std::is_same_v<S, Cylinder> std::optional<Shape> in_axes(
    const S& s, const Mat3& p) {
  return p(2, 2) != 0 ? std::optional<Shape>(s) : std::nullopt;
}
std::optional<Shape> in_axes(const Cone& s, const Mat3& p) {
  return p(2, 2) > 0 ? std::optional<Shape>(s) : std::nullopt;
}
std::optional<Shape> in_axes(const Hull& s, const Mat3& p) {
  Hull h = s;
  for (Vec3& v : h.vertices) v = p * v;
  std::sort(h.vertices.begin(), h.vertices.end(), is_before);
  return h;
}
template <class S>
std::optional<Shape> in_axes(const Padded<S>& s, const Mat3& p) {
  const auto inner = in_axes(s.inner, p);
  return inner ? std::optional<Shape>(Padded<S>{std::get<S>(*inner), s.padding}) : std::nullopt;
}
std::optional<Shape> in_axes(HalfSpace s, const Mat3& p) {
  s.normal = p * s.normal;
  return s;
}
// A mirrored triangle would face the other way.
template <class S>
requires has_triangles<S> std::optional<Shape> in_axes(S s, const Mat3& p) {
  for (Vec3& v : s.vertices) v = p * v;
  if (p.determinant() < 0)
    for (auto& t : s.triangles) std::swap(t[1], t[2]);
  return s;
}

// --- one body

using Key = std::vector<double>;

struct ShapeForm {
  Shape shape;
  Key key;
  const SignedAxes* axes = nullptr;
};

std::vector<ShapeForm> forms_of(const Shape& shape) {
  std::vector<ShapeForm> forms;
  for (const SignedAxes& p : signed_axes()) {
    auto turned = std::visit([&](const auto& s) { return in_axes(s, p.matrix); }, shape);
    if (!turned) continue;
    ShapeForm f{*std::move(turned), {static_cast<double>(shape.index())}, &p};
    for (double* x : numbers(f.shape)) f.key.push_back(*x += 0.0);  // -0 becomes 0
    if (const TriangleMesh* m = triangles_if(f.shape))
      for (const auto& t : m->triangles) f.key.insert(f.key.end(), t.begin(), t.end());
    forms.push_back(std::move(f));
  }
  return forms;
}

double cleaned(double x) { return std::abs(x) < rotation_noise ? 0 : rounded_to(x, float_bits); }

// A body seen in other axes of the world: compared by its distance from the identity first.
struct BodyForm {
  const ShapeForm* shape = nullptr;
  Mat3 rotation;
  std::array<double, 10> key{};
  bool operator<(const BodyForm& o) const { return key != o.key ? key < o.key : shape->key < o.shape->key; }
};

BodyForm body_form(const Mat3& rotation, const ShapeForm& shape) {
  BodyForm f{&shape, (rotation * shape.axes->matrix.transpose()).unaryExpr(&cleaned), {}};
  f.key[0] = 3 - f.rotation.trace();
  std::copy_n(f.rotation.data(), 9, f.key.begin() + 1);
  for (double& x : f.key) x += 0.0;
  return f;
}

BodyForm least_form(const Mat3& rotation, const SignedAxes& world, const std::vector<ShapeForm>& shapes) {
  std::optional<BodyForm> least;
  for (const ShapeForm& s : shapes) {
    if (s.axes->determinant != world.determinant) continue;
    BodyForm f = body_form(world.matrix * rotation, s);
    if (!least || f < *least) least = std::move(f);
  }
  return *least;
}

// With its largest component 1; w if there are several.
Quat quaternion_of(const Mat3& r) {
  const Eigen::Quaterniond q(r);
  const double components[] = {q.w(), q.x(), q.y(), q.z()};
  double largest = components[0];
  for (const double x : components)
    if (std::abs(x) > std::abs(largest) * tie) largest = x;
  const auto part = [&](double x) { return cleaned(x / largest) + 0.0; };
  return {part(q.x()), part(q.y()), part(q.z()), part(q.w())};
}

// --- the whole case

struct Image {
  Key key;
  std::vector<std::size_t> order;  // the body of the case at each place
  std::vector<BodyForm> forms;     // by place
  std::vector<Body> bodies;        // by place; poses without rotation, shapes not set
  int exponent = 0;
  double margin = 0;
};

class Canonical {
 public:
  explicit Canonical(const Case& c) : case_(c) {
    for (const Body& b : c.scene.bodies) {
      rotations_.push_back(rotation_matrix(b.pose.rotation));
      shapes_.push_back(forms_of(c.scene.shapes[static_cast<std::size_t>(b.shape)]));
    }
  }

  Case run() {
    std::optional<Image> least;
    for (const SignedAxes& world : signed_axes()) {
      std::vector<BodyForm> forms;
      for (std::size_t i = 0; i < rotations_.size(); ++i)
        forms.push_back(least_form(rotations_[i], world, shapes_[i]));
      std::vector<std::size_t> order(rotations_.size());
      std::iota(order.begin(), order.end(), 0);
      do {
        Image image = image_of(world, order, forms);
        if (!least || image.key < least->key) least = std::move(image);
      } while (std::next_permutation(order.begin(), order.end()));
    }
    return case_of(*least);
  }

 private:
  Image image_of(const SignedAxes& world, const std::vector<std::size_t>& order,
                 const std::vector<BodyForm>& forms) const {
    Image image;
    image.order = order;
    image.margin = case_.scene.margin;
    for (const std::size_t i : order) {
      image.forms.push_back(forms[i]);
      image.bodies.push_back(placed(world, i, order.front()));
    }
    number_groups(image.bodies);
    scale(image);
    write_key(image);
    return image;
  }

  Body placed(const SignedAxes& world, std::size_t i, std::size_t first) const {
    const Body& b = case_.scene.bodies[i];
    Body r;
    r.is_static = b.is_static;
    r.group = b.group;
    r.pose.translation = world.matrix * (b.pose.translation - case_.scene.bodies[first].pose.translation);
    if (b.motion)
      r.motion =
          Motion{world.matrix * b.motion->linear, world.determinant * (world.matrix * b.motion->angular)};
    return r;
  }

  static void number_groups(std::vector<Body>& bodies) {
    std::vector<int> seen;
    for (Body& b : bodies) {
      if (b.group < 0) continue;
      const auto at = std::find(seen.begin(), seen.end(), b.group);
      const auto number = static_cast<int>(at - seen.begin());
      if (at == seen.end()) seen.push_back(b.group);
      b.group = number;
    }
  }

  // The largest length is then in [1, 2).
  static void scale(Image& image) {
    double largest = 0;
    const auto consider = [&](double x) { largest = std::max(largest, std::abs(x)); };
    for (const Body& b : image.bodies) {
      for (const double x : b.pose.translation) consider(x);
      if (b.motion)
        for (const double x : b.motion->linear) consider(x);
    }
    for (const BodyForm& f : image.forms) {
      Case only;
      only.scene.shapes = {f.shape->shape};
      for (const double* x : lengths(only)) consider(*x);
    }
    consider(image.margin);
    image.exponent = largest > 0 ? -std::ilogb(rounded_to(largest, float_bits)) : 0;
    const auto scaled = [&](double x) { return rounded_to(std::ldexp(x, image.exponent), float_bits) + 0.0; };
    image.margin = scaled(image.margin);
    for (Body& b : image.bodies) {
      b.pose.translation = b.pose.translation.unaryExpr(scaled);
      if (!b.motion) continue;
      b.motion->linear = b.motion->linear.unaryExpr(scaled);
      b.motion->angular = b.motion->angular.unaryExpr([](double x) { return x + 0.0; });
    }
  }

  void write_key(Image& image) const {
    Key& key = image.key;
    for (const BodyForm& f : image.forms) key.insert(key.end(), f.key.begin(), f.key.end());
    for (const BodyForm& f : image.forms) {
      key.push_back(static_cast<double>(f.shape->key.size()));
      key.insert(key.end(), f.shape->key.begin(), f.shape->key.end());
    }
    for (const Body& b : image.bodies) {
      for (const double x : b.pose.translation) key.push_back(-x);
      key.push_back(b.motion ? 1 : 0);
      if (b.motion) {
        key.insert(key.end(), b.motion->linear.begin(), b.motion->linear.end());
        key.insert(key.end(), b.motion->angular.begin(), b.motion->angular.end());
      }
      key.push_back(b.is_static ? 1 : 0);
      key.push_back(b.group);
    }
    for (const Query& q : queries(image.order)) {
      key.push_back(q.a);
      key.push_back(q.b);
    }
    for (const auto& [a, b] : ignored(image.order)) {
      key.push_back(a);
      key.push_back(b);
    }
    if (image.margin != 0) key.push_back(image.margin);
  }

  // The new number of each body.
  static std::vector<int> places(const std::vector<std::size_t>& order) {
    std::vector<int> place(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = static_cast<int>(k);
    return place;
  }

  std::vector<Query> queries(const std::vector<std::size_t>& order) const {
    const auto place = places(order);
    std::vector<Query> all;
    for (const Query& q : case_.queries) {
      Query r{q.question, 0, 1};
      if (is_pair_question(q.question))
        std::tie(r.a, r.b) =
            std::minmax({place[static_cast<std::size_t>(q.a)], place[static_cast<std::size_t>(q.b)]});
      all.push_back(r);
    }
    return all;
  }

  std::vector<BodyPair> ignored(const std::vector<std::size_t>& order) const {
    const auto place = places(order);
    std::vector<BodyPair> all;
    for (const auto& [a, b] : case_.scene.ignored)
      all.push_back(std::minmax({place[static_cast<std::size_t>(a)], place[static_cast<std::size_t>(b)]}));
    std::sort(all.begin(), all.end());
    return all;
  }

  Case case_of(const Image& image) const {
    Case r;
    r.queries = queries(image.order);
    r.scene.ignored = ignored(image.order);
    r.scene.margin = image.margin;
    for (std::size_t i = 0; i < image.bodies.size(); ++i) {
      Body b = image.bodies[i];
      b.pose.rotation = quaternion_of(image.forms[i].rotation);
      b.shape = add_shape(r.scene.shapes, scaled_shape(image.forms[i].shape->shape, image.exponent));
      r.scene.bodies.push_back(std::move(b));
    }
    return r;
  }

  static Shape scaled_shape(const Shape& shape, int exponent) {
    Case only;
    only.scene.shapes = {shape};
    for (double* x : lengths(only)) *x = std::ldexp(*x, exponent);
    renew(only);
    return only.scene.shapes.front();
  }

  static int add_shape(std::vector<Shape>& shapes, Shape s) {
    const auto at = std::find(shapes.begin(), shapes.end(), s);
    const auto index = static_cast<int>(at - shapes.begin());
    if (at == shapes.end()) shapes.push_back(std::move(s));
    return index;
  }

  const Case& case_;
  std::vector<Mat3> rotations_;
  std::vector<std::vector<ShapeForm>> shapes_;  // by body
};

// Translations are rounded once they are relative to a body, so that a common one does not change them.
void round_all_but_positions(Case& c) {
  std::set<const double*> positions;
  for (Body& b : c.scene.bodies)
    for (double& x : b.pose.translation) positions.insert(&x);
  for (double* x : numbers(c))
    if (!positions.contains(x)) *x = rounded_to(*x, float_bits);
}

Case without_names(Case c) {
  c.id.clear();
  c.family.clear();
  c.scene.name.clear();
  for (Body& b : c.scene.bodies) b.name.clear();
  return c;
}

bool has_images(Case& c) {
  const auto all = numbers(c);
  return !c.scene.bodies.empty() && c.scene.bodies.size() <= most_permuted_bodies && c.scene.script.empty() &&
         std::all_of(all.begin(), all.end(), [](const double* x) { return std::isfinite(*x); });
}

}  // namespace

Case canonical(const Case& c) {
  Case r = without_names(c);
  if (has_images(r)) {
    round_all_but_positions(r);
    return Canonical(r).run();
  }
  Case rounded = r;
  for (double* x : numbers(rounded)) *x = rounded_to(*x, float_bits);
  try {
    renew(rounded);
  } catch (const InputError&) {
    return r;  // a vertex is not finite
  }
  return rounded;
}

}  // namespace touchstone::fuzz
