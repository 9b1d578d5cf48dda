#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/input_error.h"
#include "scenarios/import/mesh_import.h"
#include "scenarios/import/model/names.h"
#include "scenarios/import/model/readers.h"
#include "scenarios/import/pose_algebra.h"
#include "scenarios/text/printable.h"

namespace touchstone {
namespace {

bool is_one_of(const std::string& name, std::initializer_list<std::string_view> list) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

class UrdfReader {
 public:
  UrdfReader(const std::filesystem::path& file, ImportContext& context)
      : file_(file), xml_(file), context_(context) {}

  Model read() {
    const XmlElement robot = xml_.root();
    refuse_xacro(robot);
    if (robot.name() != "robot") robot.fail("is not the root element <robot> of a URDF file");
    model_.name = robot.attribute("name").value_or(file_.stem().string());
    for (const XmlElement& e : robot.children("link")) add_link(e);
    for (const XmlElement& e : robot.children("joint")) joints_.add(e, e.need("name"), joint_count_++);
    for (const XmlElement& e : robot.children("joint")) add_joint(e);
    for (const XmlElement& e : robot.children()) refuse_unknown(e);
    for (std::size_t j = 0; j < model_.joints.size(); ++j) check_mimic(j, robot);
    check_roots(robot);
    sort_links_of(model_, robot);
    return std::move(model_);
  }

 private:
  void refuse_xacro(const XmlElement& e) const {
    const bool is_macro = e.name().starts_with("xacro:") || lower_extension(file_) == ".xacro";
    if (is_macro)
      throw InputError(e.place(),
                       "is a xacro file, which is a program that writes URDF; expand it first: xacro " +
                           shell_word(file_.string()) + " > robot.urdf");
    for (const XmlElement& c : e.children()) refuse_xacro(c);
  }

  void refuse_unknown(const XmlElement& e) {
    // None of these says anything about collision geometry.
    if (!is_one_of(e.name(), {"link", "joint", "material", "transmission", "gazebo", "sensor", "mujoco",
                              "drake", "ros2_control", "plugin", "version", "self_collision_checking"}))
      context_.refuse(e, "is not known");
  }

  static Pose origin_in(const XmlElement& e) {
    const auto o = e.child("origin");
    if (!o) return {};
    return {o->vec3("xyz").value_or(Vec3::Zero()), roll_pitch_yaw(o->vec3("rpy").value_or(Vec3::Zero()))};
  }

  void add_link(const XmlElement& e) {
    ModelLink link;
    link.name = e.need("name");
    require_few_links(model_, e);
    links_.add(e, link.name, static_cast<int>(model_.links.size()));
    for (const XmlElement& c : e.children()) {
      if (c.name() == "collision")
        add_shape(c, link);
      else if (!is_one_of(c.name(), {"visual", "inertial", "sensor", "contact"}))
        context_.refuse(c, "is not known");
    }
    model_.links.push_back(std::move(link));
  }

  void add_shape(const XmlElement& e, ModelLink& link) {
    for (const XmlElement& c : e.children())
      if (!is_one_of(c.name(), {"origin", "geometry", "material", "verbose"}))
        context_.refuse(c, "is not known");
    const auto geometry = e.need_child("geometry").children();
    if (geometry.size() != 1) e.need_child("geometry").fail("must have exactly one shape");
    require_few_shapes(++shapes_, e);
    if (auto shape = shape_in(geometry[0]))
      link.shapes.push_back({e.attribute("name").value_or(""), std::move(*shape), origin_in(e)});
  }

  std::optional<Shape> shape_in(const XmlElement& g) {
    if (g.name() == "mesh") return mesh_in(g);
    Shape shape;
    if (g.name() == "box") {
      g.need("size");
      shape = Box{*g.vec3("size") / 2};
    } else if (g.name() == "sphere") {
      shape = Sphere{g.need_number("radius")};
    } else if (g.name() == "cylinder") {
      shape = Cylinder{g.need_number("radius"), g.need_number("length") / 2};
    } else if (g.name() == "capsule") {
      shape = Capsule{g.need_number("radius"), g.need_number("length") / 2};
    } else {
      context_.refuse(g, "is not a shape of URDF; known are box, sphere, cylinder, capsule and mesh");
      return std::nullopt;
    }
    try {
      validate(shape);
    } catch (const InputError& e) {
      g.fail(e.what());
    }
    return shape;
  }

  std::optional<Shape> mesh_in(const XmlElement& g) {
    const Vec3 scale = g.vec3("scale").value_or(Vec3::Ones());
    try {
      return context_.mesh(context_.resolve(g.need("filename"), file_.parent_path(), g.place()), scale, false,
                           g.place());
    } catch (const InputError& e) {
      context_.refuse(e.place(), "<mesh>: " + e.reason());
      return std::nullopt;
    }
  }

  static JointType type_of(const XmlElement& e) {
    const std::string type = e.need("type");
    if (type == "fixed") return JointType::fixed;
    if (type == "revolute" || type == "continuous") return JointType::hinge;
    if (type == "prismatic") return JointType::slide;
    if (type == "planar") return JointType::planar;
    if (type == "floating") return JointType::free;
    e.fail("unknown type " + printable(type) +
           "; known are fixed, revolute, continuous, prismatic, planar and floating");
  }

  void add_joint(const XmlElement& e) {
    ModelJoint joint;
    joint.name = e.need("name");
    joint.type = type_of(e);
    joint.origin = origin_in(e);
    joint.standard.assign(variable_count(joint.type), 0);
    if (joint.type == JointType::free) joint.standard.back() = 1;
    read_axis(e, joint);
    for (const XmlElement& c : e.children())
      if (!is_one_of(c.name(), {"origin", "parent", "child", "axis", "limit", "mimic", "dynamics",
                                "calibration", "safety_controller", "hardwareInterface", "joint_properties"}))
        context_.refuse(c, "is not known");
    const XmlElement p = e.need_child("parent"), c = e.need_child("child");
    const int parent = links_.need(p, p.need("link"), "link"), child = links_.need(c, c.need("link"), "link");
    ModelLink& link = model_.links[static_cast<std::size_t>(child)];
    if (link.parent >= 0) c.fail("link " + printable(link.name) + " has a parent already");
    link.parent = parent;
    link.joint = static_cast<int>(model_.joints.size());
    model_.joints.push_back(std::move(joint));
  }

  void read_axis(const XmlElement& e, ModelJoint& joint) {
    if (const auto a = e.child("axis")) {
      const Vec3 axis = a->vec3("xyz").value_or(Vec3::UnitX());
      const bool needed =
          joint.type == JointType::hinge || joint.type == JointType::slide || joint.type == JointType::planar;
      if (needed && axis.isZero(0)) a->fail("the axis is zero");
      if (!axis.isZero(0)) joint.axis = axis.stableNormalized();
    }
    const auto limit = e.child("limit");
    const bool continuous = e.need("type") == "continuous";
    if (limit && !continuous && variable_count(joint.type) == 1) {
      const double lower = limit->number("lower").value_or(0), upper = limit->number("upper").value_or(0);
      if (lower > upper) {
        context_.refuse(*limit, "lower is larger than upper; Bullet takes that as no limit");
      } else {
        joint.lower = lower;
        joint.upper = upper;
      }
    }
    if (const auto m = e.child("mimic")) {
      ModelJoint::Mimic mimic;
      mimic.joint = joints_.need(*m, m->need("joint"), "joint");
      mimic.multiplier = m->number("multiplier").value_or(1);
      mimic.offset = m->number("offset").value_or(0);
      joint.mimic = mimic;
    }
  }

  void check_mimic(std::size_t first, const XmlElement& robot) const {
    std::size_t steps = 0;
    for (std::size_t j = first; model_.joints[j].mimic; ++steps) {
      const ModelJoint& joint = model_.joints[j];
      j = static_cast<std::size_t>(joint.mimic->joint);
      if (steps > model_.joints.size()) robot.fail("joint " + printable(joint.name) + " mimics itself");
      if (variable_count(joint.type) != 1 || variable_count(model_.joints[j].type) != 1)
        robot.fail("joint " + printable(joint.name) + " mimics " + printable(model_.joints[j].name) +
                   "; both must have one variable");
    }
  }

  void check_roots(const XmlElement& robot) const {
    const ModelLink* root = nullptr;
    for (const ModelLink& l : model_.links) {
      if (l.parent >= 0) continue;
      if (root)
        robot.fail("has two root links, " + printable(root->name) + " and " + printable(l.name) +
                   "; a joint must connect them");
      root = &l;
    }
    if (model_.links.empty()) robot.fail("has no links");
  }

  std::filesystem::path file_;
  XmlFile xml_;
  ImportContext& context_;
  Model model_;
  NumberByName links_, joints_;
  int joint_count_ = 0;
  std::size_t shapes_ = 0;
};

}  // namespace

Model read_urdf(const std::filesystem::path& file, ImportContext& context) {
  return UrdfReader(file, context).read();
}

}  // namespace touchstone
