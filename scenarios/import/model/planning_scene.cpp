#include <sstream>

#include "core/base/input_error.h"
#include "scenarios/codec/scene_codec.h"
#include "scenarios/import/model/readers.h"
#include "scenarios/text/printable.h"

namespace touchstone {
namespace {

// The text form of a planning scene as MoveIt exports it: a name, then objects "* NAME" with shapes, and a
// single "." at the end. Files of newer versions state a pose for each object, a list of named subframes, and
// a count of shapes; the number of lines tells them apart.
class PlanningSceneReader {
 public:
  PlanningSceneReader(const std::filesystem::path& file, ImportContext& context)
      : file_(file.string()), context_(context) {
    std::istringstream in(read_file(file));
    for (std::string l; std::getline(in, l);)
      lines_.push_back(l.ends_with('\r') ? l.substr(0, l.size() - 1) : l);
  }

  Model read() {
    Model m;
    m.name = line("the name of the scene");
    for (std::string l = line("an object or the end, \".\""); l != ".";
         l = line("an object or the end, \".\"")) {
      if (!l.starts_with("* ")) fail("expected \"* NAME\" or \".\"");
      m.links.push_back(object(l.substr(2)));
    }
    return m;
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw InputError(file_ + ":" + std::to_string(next_), reason);
  }
  std::string line(const std::string& expected) {
    if (next_ == lines_.size()) fail("the file ends here; expected " + expected);
    return lines_[next_++];
  }
  std::vector<double> numbers(std::size_t count, const std::string& what) {
    const auto v = numbers_in(line(what));
    if (!v || v->size() != count) fail("expected " + what + ": " + std::to_string(count) + " numbers");
    return *v;
  }
  std::size_t count(const std::string& what) {
    constexpr double most = 1 << 20;
    const double n = numbers(1, what)[0];
    if (!(n >= 0 && n <= most) || n != static_cast<double>(static_cast<int>(n)))
      fail(what + " is not a count");
    return static_cast<std::size_t>(n);
  }
  Pose pose() {
    const auto t = numbers(3, "a position"), q = numbers(4, "a quaternion");
    if (q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 0) fail("the zero quaternion denotes no rotation");
    return {Vec3(t[0], t[1], t[2]), normalized({q[0], q[1], q[2], q[3]})};
  }

  ModelLink object(const std::string& name) {
    ModelLink link;
    link.name = name;
    const auto peek = next_ < lines_.size() ? numbers_in(lines_[next_]) : std::nullopt;
    const bool has_pose = peek && peek->size() == 3;
    if (has_pose) link.pose = pose();
    const std::size_t shapes = count("the number of shapes");
    for (std::size_t i = 0; i < shapes; ++i) shape(link);
    if (has_pose)
      for (std::size_t i = count("the number of subframes"); i > 0; --i) {
        line("the name of a subframe");
        pose();
      }
    return link;
  }

  void shape(ModelLink& link) {
    const std::string kind = line("a shape");
    const std::size_t at = next_;
    std::optional<Shape> s;
    if (kind == "box") {
      const auto v = numbers(3, "the size of a box");
      s = Box{Vec3(v[0], v[1], v[2]) / 2};
    } else if (kind == "sphere") {
      s = Sphere{numbers(1, "a radius")[0]};
    } else if (kind == "cylinder" || kind == "cone") {
      const auto v = numbers(2, "a radius and a length");
      s = kind == "cone" ? Shape(Cone{v[0], v[1] / 2}) : Shape(Cylinder{v[0], v[1] / 2});
    } else if (kind == "mesh") {
      s = mesh();
    } else if (kind == "plane") {
      const auto v = numbers(4, "the equation of a plane");
      context_.refuse(file_ + ":" + std::to_string(at), "a plane without thickness cannot be represented");
    } else {
      fail("unknown shape " + printable(kind) + "; known are box, sphere, cylinder, cone, mesh and plane");
    }
    const Pose in_link = pose();
    numbers(4, "a colour");
    if (!s) return;
    try {
      validate(*s);
    } catch (const InputError& e) {
      throw InputError(file_ + ":" + std::to_string(at), e.what());
    }
    if (context_.options().convex_meshes && kind == "mesh")
      s = make_hull(std::get<TriangleMesh>(*s).vertices);
    link.shapes.push_back({"", std::move(*s), in_link});
  }

  Shape mesh() {
    const auto n = numbers(2, "the numbers of vertices and triangles");
    constexpr double most = 1 << 24;
    for (const double x : n)
      if (!(x >= 0 && x <= most)) fail("the numbers of vertices and triangles are no counts");
    TriangleMesh m;
    for (double i = 0; i < n[0]; ++i) {
      const auto v = numbers(3, "a vertex");
      m.vertices.emplace_back(v[0], v[1], v[2]);
    }
    for (double i = 0; i < n[1]; ++i) {
      const auto v = numbers(3, "a triangle");
      std::array<int, 3> t{};
      for (std::size_t k = 0; k < 3; ++k) {
        if (!(v[k] >= 0 && v[k] < n[0])) fail("a triangle names a vertex that does not exist");
        t[k] = static_cast<int>(v[k]);
      }
      m.triangles.push_back(t);
    }
    return m;
  }

  std::string file_;
  ImportContext& context_;
  std::vector<std::string> lines_;
  std::size_t next_ = 0;
};

}  // namespace

Model read_planning_scene(const std::filesystem::path& file, ImportContext& context) {
  return PlanningSceneReader(file, context).read();
}

}  // namespace touchstone
