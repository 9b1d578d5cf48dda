#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <numbers>
#include <set>

#include "core/base/input_error.h"
#include "scenarios/import/height_field.h"
#include "scenarios/import/model/mjcf_defaults.h"
#include "scenarios/import/model/names.h"
#include "scenarios/import/model/readers.h"
#include "scenarios/import/pose_algebra.h"

namespace touchstone {
namespace {

bool is_any(const std::string& name, std::initializer_list<std::string_view> list) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

// Where bodies, geoms and frames are.
struct MjcfPlace {
  int link = 0;
  Pose pose;             // in the link
  std::string of_class;  // childclass around
};

class MjcfReader {
 public:
  MjcfReader(const std::filesystem::path& file, ImportContext& context) : file_(file), context_(context) {
    add_file(file);
  }

  Model read() {
    const XmlElement root = files_.front().root();
    if (root.name() != "mujoco") root.fail("is not the root element <mujoco> of an MJCF file");
    model_.name = root.attribute("model").value_or(file_.stem().string());
    model_.links.emplace_back().name = "world";
    bodies_.add(root, "world", 0);
    const std::vector<XmlElement> sections = expanded(root);
    for (const XmlElement& s : sections)
      if (s.name() == "compiler") read_compiler(s);
    for (const XmlElement& s : sections)
      if (s.name() == "default") defaults_.read(s, "");
    for (const XmlElement& s : sections)
      if (s.name() == "asset") read_assets(s);
    for (const XmlElement& s : sections)
      if (s.name() == "option") read_option(s);
    for (const XmlElement& s : sections)
      if (s.name() == "worldbody")
        read_contents(s, expanded(s), {0, {}, s.attribute("childclass").value_or("")}, 0);
    if (filters_parents_) filter_parents();
    for (const XmlElement& s : sections) read_rest(s);
    sort_filters(model_);
    return std::move(model_);
  }

 private:
  static constexpr int max_depth = 200;

  void add_file(const std::filesystem::path& file) {
    files_.emplace_back(file);
    opened_.insert(file.lexically_normal().string());
  }

  // The children, with included files in place of <include>.
  std::vector<XmlElement> expanded(const XmlElement& e) {
    std::vector<XmlElement> list;
    for (const XmlElement& c : e.children()) {
      if (c.name() != "include") {
        list.push_back(c);
        continue;
      }
      const auto file = context_.resolve(c.need("file"), file_.parent_path(), c.place());
      if (opened_.contains(file.lexically_normal().string())) c.fail("includes a file for the second time");
      add_file(file);
      const auto inner = expanded(files_.back().root());
      list.insert(list.end(), inner.begin(), inner.end());
    }
    return list;
  }

  void read_compiler(const XmlElement& e) {
    if (const auto a = e.attribute("angle")) compiler_.degrees = *a != "radian";
    if (e.attribute("coordinate").value_or("local") != "local") e.fail("only local coordinates are read");
    if (const auto d = e.attribute("assetdir")) compiler_.mesh_folder = *d;
    if (const auto d = e.attribute("meshdir")) compiler_.mesh_folder = *d;
    if (const auto s = e.attribute("strippath")) compiler_.strip_path = *s == "true";
    if (const auto s = e.attribute("eulerseq")) {
      if (s->size() != 3 || s->find_first_not_of("xyzXYZ") != std::string::npos)
        e.fail("eulerseq must be three of the letters xyzXYZ");
      compiler_.euler_sequence = *s;
    }
  }

  void read_option(const XmlElement& e) {
    for (const XmlElement& f : e.children("flag"))
      if (f.attribute("filterparent").value_or("enable") == "disable") filters_parents_ = false;
  }

  void read_assets(const XmlElement& e) {
    for (const XmlElement& a : expanded(e)) {
      if (a.name() != "mesh" && a.name() != "hfield") continue;
      const std::string stem = std::filesystem::path(a.attribute("file").value_or("")).stem().string();
      (a.name() == "mesh" ? meshes_ : height_fields_).emplace(a.attribute("name").value_or(stem), a);
    }
  }

  static Pose pose_in(const MjcfElement& e, const MjcfCompiler& compiler) {
    return {e.vec3("pos").value_or(Vec3::Zero()), e.orientation(compiler).value_or(Quat{})};
  }

  void read_contents(const XmlElement& e, const std::vector<XmlElement>& children, const MjcfPlace& at,
                     int depth) {
    if (depth > max_depth) e.fail("is nested deeper than " + std::to_string(max_depth) + " levels");
    for (const XmlElement& c : children) {
      const std::string name = c.name();
      if (name == "geom") {
        read_geom(c, at);
      } else if (name == "body") {
        read_body(c, at, depth);
      } else if (name == "frame") {
        const MjcfElement f(c, defaults_, "");
        read_contents(c, expanded(c),
                      {at.link, compose(at.pose, pose_in(f, compiler_)),
                       c.attribute("childclass").value_or(at.of_class)},
                      depth + 1);
      } else if (!is_any(name, {"joint", "freejoint", "inertial", "site", "camera", "light", "plugin"})) {
        context_.refuse(c, "cannot be represented");
      }
    }
  }

  void read_body(const XmlElement& e, const MjcfPlace& at, int depth) {
    const std::string inner_class = e.attribute("childclass").value_or(at.of_class);
    defaults_.require(inner_class, e);
    const std::string name = e.attribute("name").value_or("body#" + std::to_string(++unnamed_));
    Pose pose = compose(at.pose, pose_in(MjcfElement(e, MjcfDefaults(), ""), compiler_));
    int parent = at.link;
    std::vector<XmlElement> joints;
    const std::vector<XmlElement> children = expanded(e);
    for (const XmlElement& c : children)
      if (c.name() == "joint" || c.name() == "freejoint") joints.push_back(c);
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const bool is_last = i + 1 == joints.size();
      parent = add_link(is_last ? name : name + "~" + std::to_string(i), parent,
                        joint_in(joints[i], pose, inner_class, parent));
      pose = {};
    }
    if (joints.empty()) {
      ModelJoint held;
      held.name = name + ":fixed";
      held.origin = pose;
      parent = add_link(name, parent, std::move(held));
    }
    bodies_.add(e, name, parent);
    read_contents(e, children, {parent, {}, inner_class}, depth + 1);
  }

  int add_link(const std::string& name, int parent, ModelJoint joint) {
    require_few_links(model_, files_.front().root());
    ModelLink link;
    link.name = name;
    link.parent = parent;
    link.joint = static_cast<int>(model_.joints.size());
    model_.joints.push_back(std::move(joint));
    model_.links.push_back(std::move(link));
    return static_cast<int>(model_.links.size()) - 1;
  }

  ModelJoint joint_in(const XmlElement& e, const Pose& origin, const std::string& around, int parent) {
    const MjcfElement j(e, defaults_, around);
    ModelJoint joint;
    joint.name = e.attribute("name").value_or("joint#" + std::to_string(model_.joints.size()));
    joint.origin = origin;
    const std::string type = e.name() == "freejoint" ? "free" : j.text("type").value_or("hinge");
    joint.anchor = j.vec3("pos").value_or(Vec3::Zero());
    if (type == "free") {
      if (parent != 0) e.fail("a free joint must be in a body of the world");
      joint.type = JointType::free;
      const Vec3& t = origin.translation;
      const Quat& q = origin.rotation;
      joint.standard = {t.x(), t.y(), t.z(), q.x, q.y, q.z, q.w};
      joint.origin = {};
      return joint;
    }
    if (type == "ball") {
      joint.type = JointType::ball;
      joint.standard = {0, 0, 0, 1};
      return joint;
    }
    if (type != "hinge" && type != "slide") e.fail("unknown type " + printable(type));
    joint.type = type == "hinge" ? JointType::hinge : JointType::slide;
    const Vec3 axis = j.vec3("axis").value_or(Vec3::UnitZ());
    if (axis.isZero(0)) e.fail("the axis is zero");
    joint.axis = axis.stableNormalized();
    const double unit = type == "hinge" && compiler_.degrees ? std::numbers::pi / 180 : 1;
    joint.reference = j.number("ref", 0) * unit;
    joint.standard = {joint.reference};
    const auto range = j.numbers("range");
    if (range.size() == 2 && j.text("limited").value_or("auto") != "false" && range[0] < range[1]) {
      joint.lower = range[0] * unit;
      joint.upper = range[1] * unit;
    }
    return joint;
  }

  static std::uint32_t bits(const MjcfElement& g, std::string_view attribute) {
    const double v = g.number(attribute, 1);
    if (!(v >= 0 && v <= 4294967295.0) || v != std::floor(v))
      g.xml().fail(std::string(attribute) + " is not a whole number of 32 bits");
    return static_cast<std::uint32_t>(v);
  }

  void read_geom(const XmlElement& e, const MjcfPlace& at) {
    const MjcfElement g(e, defaults_, at.of_class);
    ModelShape s;
    s.name = e.attribute("name").value_or("");
    s.category = bits(g, "contype");
    s.mask = bits(g, "conaffinity");
    if (s.category == 0 && s.mask == 0) return;  // drawn, never collides
    Pose pose = pose_in(g, compiler_);
    auto shape = shape_in(g, pose);
    if (!shape) return;
    try {
      validate(*shape);
    } catch (const InputError& error) {
      e.fail(error.what());
    }
    if (kind_of(*shape) == ShapeKind::half_space &&
        !anchored_links(model_)[static_cast<std::size_t>(at.link)])
      return context_.refuse(e, "is a plane on a body that moves");
    s.shape = std::move(*shape);
    s.in_link = compose(at.pose, pose);
    require_few_shapes(++shapes_, e);
    model_.links[static_cast<std::size_t>(at.link)].shapes.push_back(std::move(s));
  }

  // With fromto, the pose and the length are those of the segment.
  static void apply_segment(const MjcfElement& g, const std::string& type, std::vector<double>& size,
                            Pose& pose) {
    const auto v = g.numbers("fromto");
    if (v.size() != 6) g.xml().fail("fromto has " + std::to_string(v.size()) + " numbers instead of 6");
    if (!is_any(type, {"capsule", "cylinder", "ellipsoid", "box"}))
      g.xml().fail("fromto does not fit a " + printable(type));
    if (size.empty()) g.xml().fail("lacks a size");
    const Vec3 from(v[0], v[1], v[2]), to(v[3], v[4], v[5]);
    const Vec3 along = from - to;
    if (along.isZero(0)) g.xml().fail("fromto is a point");
    const double half = along.stableNorm() / 2;
    size = type == "capsule" || type == "cylinder" ? std::vector{size[0], half}
                                                   : std::vector{size[0], size[0], half};
    pose = {(from + to) / 2, from_z_to(along)};
  }

  std::optional<Shape> shape_in(const MjcfElement& g, Pose& pose) {
    const std::string type = g.text("type").value_or("sphere");
    if (type == "mesh") return mesh_in(g);
    if (type == "hfield") return height_field_in(g);
    if (g.text("mesh")) {
      context_.refuse(g.xml(), "fits a " + printable(type) + " to a mesh, which is not supported");
      return std::nullopt;
    }
    if (type == "plane") return Shape(HalfSpace{Vec3::UnitZ(), 0});
    std::vector<double> size = g.numbers("size");
    if (g.text("fromto")) apply_segment(g, type, size, pose);
    const std::size_t need = type == "sphere" ? 1 : type == "capsule" || type == "cylinder" ? 2 : 3;
    if (is_any(type, {"sphere", "capsule", "cylinder", "box", "ellipsoid"}) && size.size() < need)
      g.xml().fail("size has " + std::to_string(size.size()) + " numbers instead of " + std::to_string(need));
    if (type == "sphere") return Shape(Sphere{size[0]});
    if (type == "capsule") return Shape(Capsule{size[0], size[1]});
    if (type == "cylinder") return Shape(Cylinder{size[0], size[1]});
    if (type == "box") return Shape(Box{Vec3(size[0], size[1], size[2])});
    if (type == "ellipsoid") return Shape(Ellipsoid{Vec3(size[0], size[1], size[2])});
    context_.refuse(g.xml(), "type " + printable(type) + " cannot be represented");
    return std::nullopt;
  }

  // MuJoCo collides the convex hulls of meshes.
  std::optional<Shape> mesh_in(const MjcfElement& g) {
    const std::string name = g.text("mesh").value_or("");
    const auto it = meshes_.find(name);
    if (it == meshes_.end()) g.xml().fail("there is no mesh " + printable(name));
    const MjcfElement m(it->second, defaults_, "");
    try {
      return mesh_of(m);
    } catch (const InputError& e) {
      context_.refuse(e.place(), e.reason());
      return std::nullopt;
    }
  }

  Shape mesh_of(const MjcfElement& m) {
    const Vec3 scale = m.vec3("scale").value_or(Vec3::Ones());
    if (m.text("refpos") || m.text("refquat")) m.xml().fail("refpos and refquat are not supported");
    if (!m.text("file")) {
      const auto v = m.numbers("vertex");
      if (v.size() < 12 || v.size() % 3 != 0) m.xml().fail("needs a file, or four vertices or more");
      std::vector<Vec3> points;
      for (std::size_t i = 0; i < v.size(); i += 3)
        points.push_back(Vec3(v[i], v[i + 1], v[i + 2]).cwiseProduct(scale));
      try {
        Shape hull = make_hull(std::move(points));
        validate(hull);
        return hull;
      } catch (const InputError& e) {
        m.xml().fail(e.what());
      }
    }
    return context_.mesh(asset_file(m), scale, true, m.xml().place());
  }

  std::filesystem::path asset_file(const MjcfElement& asset) const {
    std::filesystem::path file = *asset.text("file");
    if (compiler_.strip_path) file = file.filename();
    if (!compiler_.mesh_folder.empty()) file = std::filesystem::path(compiler_.mesh_folder) / file;
    return context_.resolve(file.lexically_normal().string(), file_.parent_path(), asset.xml().place());
  }

  std::optional<Shape> height_field_in(const MjcfElement& g) {
    const std::string name = g.text("hfield").value_or("");
    const auto it = height_fields_.find(name);
    if (it == height_fields_.end()) g.xml().fail("there is no hfield " + printable(name));
    const MjcfElement field(it->second, defaults_, "");
    try {
      return height_field_of(field);
    } catch (const InputError& e) {
      context_.refuse(field.xml(), e.place() == field.xml().place() ? e.reason() : e.what());
      return std::nullopt;
    }
  }

  // MuJoCo fills it down to a base, whose thickness is the fourth size; here it is a surface.
  Shape height_field_of(const MjcfElement& f) const {
    HeightGrid grid = f.text("file") ? read_height_file(asset_file(f)) : written_heights(f);
    normalize(grid);
    const std::vector<double> size = f.numbers("size");
    if (size.size() != 4 || !std::all_of(size.begin(), size.end(), [](double x) { return x > 0; }))
      throw InputError("", "needs a size of four positive numbers");
    return surface_of(grid, size[0], size[1], size[2]);
  }

  // The heights in the file itself, if any, are written from the greatest y to the least.
  static HeightGrid written_heights(const MjcfElement& f) {
    const double rows = f.number("nrow", 0), columns = f.number("ncol", 0);
    if (rows != std::floor(rows) || columns != std::floor(columns))
      throw InputError("", "nrow and ncol must be whole numbers");
    require_grid_size(rows, columns, "");
    HeightGrid grid{static_cast<std::size_t>(rows), static_cast<std::size_t>(columns), {}};
    grid.heights.resize(grid.rows * grid.columns);
    if (!f.text("elevation")) return grid;
    const std::vector<double> v = f.numbers("elevation");
    if (v.size() != grid.heights.size())
      throw InputError("", "elevation has " + std::to_string(v.size()) + " numbers instead of " +
                               std::to_string(grid.heights.size()));
    for (std::size_t r = 0; r < grid.rows; ++r)
      for (std::size_t c = 0; c < grid.columns; ++c)
        grid.heights[r * grid.columns + c] = finite_float(v[(grid.rows - 1 - r) * grid.columns + c]);
    return grid;
  }
  static float finite_float(double x) {
    if (std::abs(x) > std::numeric_limits<float>::max())
      throw InputError("", "a height is too large for a float");
    return static_cast<float>(x);
  }

  // MuJoCo skips a body and its parent, welded bodies counting as one, unless the parent is part of the
  // world.
  void filter_parents() {
    const std::vector<int> group = rigid_groups(model_);
    std::vector<int> moved_by(model_.links.size(), -1);  // group that carries the body's group
    for (std::size_t i = 0; i < model_.links.size(); ++i) {
      int parent = model_.links[static_cast<std::size_t>(group[i])].parent;
      // Links between the joints of one body are no bodies.
      while (parent >= 0 &&
             model_.links[static_cast<std::size_t>(parent)].name.find('~') != std::string::npos)
        parent = model_.links[static_cast<std::size_t>(parent)].parent;
      moved_by[i] = parent < 0 ? -1 : group[static_cast<std::size_t>(parent)];
    }
    const int n = static_cast<int>(model_.links.size());
    for (int a = 0; a < n; ++a)
      for (int b = a + 1; b < n; ++b) {
        const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
        const bool is_parent =
            (moved_by[j] == group[i] && group[i] != 0) || (moved_by[i] == group[j] && group[j] != 0);
        if (group[i] == group[j] || is_parent) add_filter(model_, a, b);
      }
  }

  void read_rest(const XmlElement& s) {
    if (s.name() == "contact") read_contacts(s);
    if (s.name() == "keyframe")
      for (const XmlElement& k : expanded(s)) read_key(k);
    if (!is_any(s.name(),
                {"compiler", "default", "asset", "option", "worldbody", "contact", "keyframe", "size",
                 "statistic", "visual", "custom", "equality", "tendon", "actuator", "sensor", "extension"}))
      context_.refuse(s, "cannot be represented");
  }

  void read_contacts(const XmlElement& e) {
    for (const XmlElement& c : expanded(e)) {
      if (c.name() == "exclude")
        exclude(c);
      else
        context_.refuse(c, "pairs that are asked whatever the filters say cannot be represented");
    }
  }

  void exclude(const XmlElement& e) {
    const int a = bodies_.need(e, e.need("body1"), "body"), b = bodies_.need(e, e.need("body2"), "body");
    if (a == b) e.fail("names the same body twice");
    add_filter(model_, a, b);
  }

  void read_key(const XmlElement& e) {
    NamedState state;
    state.name = e.attribute("name").value_or("key#" + std::to_string(model_.states.size()));
    const auto q = e.numbers("qpos");
    if (q.empty()) return;
    std::size_t next = 0;
    const auto take = [&](std::size_t n) {
      if (next + n > q.size())
        e.fail("qpos has " + std::to_string(q.size()) + " numbers, too few for all joints");
      next += n;
      return std::span(q).subspan(next - n, n);
    };
    for (const ModelJoint& j : model_.joints) {
      const auto v = take(variable_count(j.type));
      std::vector<double> values(v.begin(), v.end());
      // MuJoCo's quaternions begin with w.
      if (j.type == JointType::ball || j.type == JointType::free)
        std::rotate(values.end() - 4, values.end() - 3, values.end());
      if (!values.empty()) state.values.emplace_back(j.name, std::move(values));
    }
    if (next != q.size())
      e.fail("qpos has " + std::to_string(q.size()) + " numbers instead of " + std::to_string(next));
    model_.states.push_back(std::move(state));
  }

  std::filesystem::path file_;
  ImportContext& context_;
  std::deque<XmlFile> files_;
  std::set<std::string> opened_;
  Model model_;
  MjcfCompiler compiler_;
  MjcfDefaults defaults_;
  std::map<std::string, XmlElement> meshes_, height_fields_;
  NumberByName bodies_;
  bool filters_parents_ = true;
  int unnamed_ = 0;
  std::size_t shapes_ = 0;
};

}  // namespace

Model read_mjcf(const std::filesystem::path& file, ImportContext& context) {
  return MjcfReader(file, context).read();
}

}  // namespace touchstone
