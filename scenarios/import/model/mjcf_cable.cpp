#include "scenarios/import/model/mjcf_cable.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "scenarios/import/fcl_motion.h"
#include "scenarios/import/pose_algebra.h"
#include "scenarios/text/printable.h"

namespace touchstone {
namespace {

constexpr double most_vertices = 4096;
constexpr double straight = 1e-14;  // sine of an angle that MuJoCo takes for none

// MuJoCo stores the vertices as floats.
Vec3 in_floats(const XmlElement& e, const Vec3& v) {
  if (!(v.cwiseAbs().maxCoeff() <= std::numeric_limits<float>::max()))
    e.fail("a vertex is too far away for a float");
  return v.cast<float>().cast<double>();
}

// One coordinate of vertex i of n: "s", "cos(s)", "sin(s)" or "0".
double coordinate(const std::string& function, double part, const std::vector<double>& size) {
  const double angle = std::numbers::pi * part * size[2];
  if (function == "s") return part * size[0];
  if (function == "cos(s)") return size[1] * std::cos(angle);
  if (function == "sin(s)") return size[1] * std::sin(angle);
  return 0;
}

std::vector<std::string> functions_of(const XmlElement& e) {
  std::vector<std::string> list;
  std::istringstream words(e.attribute("curve").value_or(""));
  for (std::string word; words >> word;) {
    if (word != "s" && word != "cos(s)" && word != "sin(s)" && word != "0")
      e.fail("curve has the unknown function " + printable(word));
    list.push_back(word);
  }
  if (list.size() > 3) e.fail("curve has more than three functions");
  list.resize(3, "0");
  return list;
}

std::vector<Vec3> curve_vertices(const XmlElement& e, const Quat& turn) {
  const std::vector<double> count = e.numbers("count");
  if (count.empty() || !(count[0] >= 2 && count[0] <= most_vertices) || count[0] != std::floor(count[0]))
    e.fail("count must begin with a whole number from 2 to " +
           std::to_string(static_cast<int>(most_vertices)));
  for (std::size_t k = 1; k < count.size(); ++k)
    if (count[k] != 1) e.fail("a cable has one dimension: the further counts must be 1");
  std::vector<double> size = e.numbers("size");
  if (size.empty()) size = {1};
  size.resize(3, 0);
  const auto functions = functions_of(e);
  std::vector<Vec3> v;
  for (double i = 0; i < count[0]; ++i) {
    Vec3 p;
    for (int k = 0; k < 3; ++k)
      p[k] = coordinate(functions[static_cast<std::size_t>(k)], i / (count[0] - 1), size);
    v.push_back(in_floats(e, rotation_matrix(turn) * p));
  }
  return v;
}

std::vector<Vec3> written_vertices(const XmlElement& e) {
  if (e.attribute("count")) e.fail("states both count and vertex");
  const std::vector<double> n = e.numbers("vertex");
  if (n.size() % 3 != 0 || n.size() < 6 || static_cast<double>(n.size()) > 3 * most_vertices)
    e.fail("vertex has " + std::to_string(n.size()) + " numbers: three each for two vertices or more");
  std::vector<Vec3> v;
  for (std::size_t i = 0; i < n.size(); i += 3) v.push_back(in_floats(e, {n[i], n[i + 1], n[i + 2]}));
  return v;
}

// The shortest rotation from x to t, or for a t that points back, MuJoCo's.
Quat along(const Vec3& t) {
  return normalized(t.x() > 0 ? Quat{0, -t.z(), t.y(), 1 + t.x()} : Quat{t.z(), 0, 1 - t.x(), t.y()});
}

// The frame along the chain. Its y axis is carried from part to part by the rotation from one direction to
// the next; a chain that begins straight has none, and every part then takes the shortest rotation from x.
class Carried {
 public:
  Carried(const Vec3& first, const Vec3& second) {
    const Vec3 bend = first.cross(second);
    if (bend.norm() >= straight) y_ = bend.normalized().cross(first).normalized();
  }
  Quat at(const Vec3& previous, const Vec3& t) {
    if (y_.isZero(0)) return along(t);
    const Vec3 bend = previous.cross(t);
    if (const double sine = bend.norm(); sine >= straight)
      y_ = (rotation_matrix(about(bend / sine, std::atan2(sine, previous.dot(t)))) * y_).normalized();
    Mat3 r;
    r.col(0) = t;
    r.col(1) = y_;
    r.col(2) = t.cross(y_).normalized();
    return quaternion_of(r);
  }

 private:
  Vec3 y_ = Vec3::Zero();
};

void place_parts(const XmlElement& e, const std::vector<Vec3>& v, const Vec3& offset, MjcfCable& cable) {
  std::vector<Vec3> direction;
  for (std::size_t i = 0; i + 1 < v.size(); ++i) {
    const Vec3 edge = (v[i + 1].cast<float>() - v[i].cast<float>()).cast<double>();  // in floats, as MuJoCo
    const double length = edge.norm();
    if (!(length > 0) || !std::isfinite(length))
      e.fail("two vertices that follow each other are equal or too far apart");
    cable.lengths.push_back(length);
    direction.push_back(edge / length);
  }
  Carried frame(direction[0], direction[direction.size() > 1 ? 1 : 0]);
  Quat last;
  for (std::size_t i = 0; i < direction.size(); ++i) {
    if (i > 0 && direction[i - 1].cross(direction[i]).norm() < straight &&
        direction[i - 1].dot(direction[i]) < 0)
      e.fail("the cable turns straight back at vertex " + std::to_string(i));
    const Quat q = frame.at(direction[i > 0 ? i - 1 : 0], direction[i]);
    if (i == 0)
      cable.parts.push_back({offset + v[0], q});
    else
      cable.parts.push_back(
          {{cable.lengths[i - 1], 0, 0}, normalized(Quat{-last.x, -last.y, -last.z, last.w} * q)});
    last = q;
  }
}

}  // namespace

MjcfCable read_cable(const XmlElement& e) {
  if (e.need("type") != "cable") e.fail("type " + printable(e.need("type")) + " cannot be represented");
  MjcfCable cable;
  cable.prefix = e.attribute("prefix").value_or("");
  cable.initial = e.attribute("initial").value_or("ball");
  Quat turn;
  if (e.attribute("quat")) {
    const auto q = e.numbers("quat");
    if (q.size() != 4 || (q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 0))
      e.fail("quat needs four numbers that are not all zero");
    turn = normalized(Quat{q[1], q[2], q[3], q[0]});
  }
  const auto v = e.attribute("vertex") ? written_vertices(e) : curve_vertices(e, turn);
  place_parts(e, v, e.vec3("offset").value_or(Vec3::Zero()), cable);
  return cable;
}

}  // namespace touchstone
