#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "core/base/input_error.h"
#include "scenarios/import/model/names.h"
#include "scenarios/import/model/readers.h"
#include "scenarios/import/model/sdf_frames.h"
#include "scenarios/import/pose_algebra.h"

namespace touchstone {
namespace {

bool is_among(const std::string& name, std::initializer_list<std::string_view> list) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

bool is_true(const std::optional<XmlElement>& e) { return e && (e->text() == "true" || e->text() == "1"); }

class SdfReader {
 public:
  SdfReader(const std::filesystem::path& file, ImportContext& context) : file_(file), context_(context) {}

  Model read() {
    files_.emplace_back(file_);
    const XmlElement sdf = files_.back().root();
    if (sdf.name() != "sdf") sdf.fail("is not the root element <sdf> of an SDFormat file");
    model_.name = file_.stem().string();
    model_.links.emplace_back().name = "world";
    const int scope = frames_.add_scope(-1);
    frames_.scope(scope).own =
        frames_.add({SdfFrame::Kind::world, sdf, scope, -1, {}, {}, {}, -1, 0, {}}, scope, "world");
    std::vector<XmlElement> worlds = sdf.children("world");
    if (worlds.size() > 1) worlds[1].fail("is a second world; one is read");
    if (!worlds.empty()) model_.name = worlds[0].attribute("name").value_or(model_.name);
    const Inside outside{scope, "", file_.parent_path(), -1, false, false, 0};
    read_contents(worlds.empty() ? sdf : worlds[0], outside);
    place_links();
    for (const Joint& j : joints_) add_joint(j);
    filter_models();
    sort_links_of(model_, sdf);
    return std::move(model_);
  }

 private:
  struct Inside {
    int scope;
    std::string prefix;  // of names: "model::"
    std::filesystem::path folder;
    int top_model;  // number of the outermost model; -1 outside
    bool is_static, collides_with_itself;
    int depth;
  };
  struct Joint {
    XmlElement element;
    int scope, frame;
    std::string prefix;
    bool is_static;
  };
  static constexpr int max_depth = 50;

  void read_contents(const XmlElement& e, const Inside& in) {
    if (in.depth > max_depth)
      e.fail("models are nested deeper than " + std::to_string(max_depth) + " levels");
    for (const XmlElement& c : e.children()) {
      const std::string n = c.name();
      if (n == "model") {
        read_model(c, in, c, in.folder);
      } else if (n == "include") {
        include(c, in);
      } else if (n == "link" && in.top_model >= 0) {
        read_link(c, in);
      } else if (n == "joint" && in.top_model >= 0) {
        read_joint(c, in);
      } else if (n == "frame") {
        SdfFrame& f = add_frame(SdfFrame::Kind::frame, c, in, c.need("name"));
        f.attached_to = c.attribute("attached_to").value_or("");
        if (f.relative_to.empty()) f.relative_to = f.attached_to;
      } else if (!is_about_something_else(n)) {
        context_.refuse(c, "cannot be represented");
      }
    }
  }

  static bool is_about_something_else(const std::string& n) {
    return is_among(n, {"pose", "static", "self_collide", "light", "plugin", "physics", "scene", "gui",
                        "audio", "wind", "gravity", "magnetic_field", "atmosphere", "spherical_coordinates",
                        "state", "allow_auto_disable", "enable_wind", "world"}) ||
           n.find(':') != std::string::npos;
  }

  SdfFrame& add_frame(SdfFrame::Kind kind, const XmlElement& e, const Inside& in, const std::string& name) {
    SdfFrame f{kind, e, in.scope, frames_.scope(in.scope).own, {}, {}, {}, -1, 0, {}};
    f.raw = sdf_pose(e, f.relative_to);
    return frames_.at(frames_.add(std::move(f), in.scope, name));
  }

  void include(const XmlElement& e, const Inside& in) {
    if (in.depth > max_depth)
      e.fail("models are included deeper than " + std::to_string(max_depth) + " levels");
    if (is_true(e.child("merge")) || e.attribute("merge").value_or("false") == "true" ||
        e.child("placement_frame"))
      return context_.refuse(e, "merge and placement_frame cannot be represented");
    const XmlElement uri = e.need_child("uri");
    try {
      std::string text = uri.text();
      if (!text.ends_with(".sdf")) text += "/model.sdf";
      const auto file = context_.resolve(text, in.folder, uri.place());
      files_.emplace_back(file);
      const XmlElement sdf = files_.back().root();
      const auto models = sdf.children("model");
      if (sdf.name() != "sdf" || models.size() != 1)
        sdf.fail("must be an <sdf> with one model, since it is included");
      read_model(models[0], in, e, file.parent_path());
    } catch (const InputError& error) {
      if (!context_.options().lenient) throw;
      context_.refuse(error.place(), error.reason());
    }
  }

  // `placed`: the element with the name and the pose, which is the <include> of an included model.
  void read_model(const XmlElement& e, const Inside& in, const XmlElement& placed,
                  const std::filesystem::path& folder) {
    if (e.attribute("placement_frame")) return context_.refuse(e, "placement_frame cannot be represented");
    const bool included = placed.name() == "include";
    const auto own_name = included ? placed.child("name") : std::nullopt;
    const std::string name = own_name ? own_name->text() : e.need("name");
    const XmlElement& with_pose = included && !placed.child("pose") ? e : placed;
    if (in.top_model < 0) {
      ++models_;
      const bool is_only_model = files_.front().root().children("world").empty();
      if (models_ == 1 && is_only_model) model_.name = name;
    }
    const int number = frames_.add(
        SdfFrame{
            SdfFrame::Kind::model, with_pose, in.scope, frames_.scope(in.scope).own, {}, {}, {}, -1, 0, {}},
        in.scope, name);
    frames_.at(number).raw = sdf_pose(with_pose, frames_.at(number).relative_to);
    const int scope = frames_.add_scope(in.scope);
    frames_.scope(scope).own = number;
    frames_.scope(in.scope).models[name] = scope;
    const std::size_t first = model_.links.size();
    const Inside inner{scope,
                       in.prefix + name + "::",
                       folder,
                       in.top_model >= 0 ? in.top_model : models_,
                       in.is_static || is_true(e.child("static")) || is_true(placed.child("static")),
                       is_true(e.child("self_collide")),
                       in.depth + 1};
    read_contents(e, inner);
    const auto canonical = e.attribute("canonical_link");
    if (canonical)
      frames_.at(number).link = frames_.link_of(frames_.find(scope, *canonical, e));
    else if (model_.links.size() > first)
      frames_.at(number).link = static_cast<int>(first);
  }

  void read_link(const XmlElement& e, const Inside& in) {
    const std::string name = e.need("name");
    SdfFrame& f = add_frame(SdfFrame::Kind::link, e, in, name);
    f.link = static_cast<int>(model_.links.size());
    ModelLink link;
    link.name = in.prefix + name;
    link.is_anchored = in.is_static;
    const bool own = e.child("self_collide") ? is_true(e.child("self_collide")) : in.collides_with_itself;
    for (const XmlElement& c : e.children("collision")) read_shape(c, in, link);
    for (const XmlElement& c : e.children())
      if (!is_among(c.name(),
                    {"collision", "pose", "visual", "inertial", "sensor", "light", "gravity", "enable_wind",
                     "self_collide", "kinematic", "must_be_base_link", "velocity_decay", "battery",
                     "audio_source", "audio_sink", "plugin", "projector", "particle_emitter", "contact"}) &&
          c.name().find(':') == std::string::npos)
        context_.refuse(c, "is not known");
    model_.links.push_back(std::move(link));
    tops_.push_back({f.link, in.top_model, own});
  }

  void read_shape(const XmlElement& e, const Inside& in, ModelLink& link) {
    ModelShape s;
    s.name = e.need("name");
    std::string relative_to;
    s.in_link = sdf_pose(e, relative_to);
    if (!relative_to.empty())
      return context_.refuse(e, "a pose relative to " + printable(relative_to) + " cannot be represented");
    const auto kinds = e.need_child("geometry").children();
    if (kinds.size() != 1) e.need_child("geometry").fail("must have exactly one shape");
    auto shape = shape_in(kinds[0], in);
    if (!shape) return;
    try {
      validate(*shape);
    } catch (const InputError& error) {
      kinds[0].fail(error.what());
    }
    s.shape = std::move(*shape);
    s.category = bitmask(e);
    s.mask = s.category;
    link.shapes.push_back(std::move(s));
  }

  static std::uint32_t bitmask(const XmlElement& e) {
    const auto surface = e.child("surface");
    const auto contact = surface ? surface->child("contact") : std::nullopt;
    const auto mask = contact ? contact->child("collide_bitmask") : std::nullopt;
    if (!mask) return 0xffff;
    const double v = mask->text_numbers(1)[0];
    if (!(v >= 0 && v <= std::numeric_limits<std::uint32_t>::max()) || v != std::floor(v))
      mask->fail("is not a whole number of 32 bits");
    return static_cast<std::uint32_t>(v);
  }

  static Vec3 vec3_in(const XmlElement& e, std::string_view name) {
    const auto v = e.need_child(name).text_numbers(3);
    return {v[0], v[1], v[2]};
  }
  static double number_in(const XmlElement& e, std::string_view name) {
    return e.need_child(name).text_numbers(1)[0];
  }

  std::optional<Shape> shape_in(const XmlElement& g, const Inside& in) {
    const std::string kind = g.name();
    if (kind == "box") return Shape(Box{vec3_in(g, "size") / 2});
    if (kind == "sphere") return Shape(Sphere{number_in(g, "radius")});
    if (kind == "cylinder") return Shape(Cylinder{number_in(g, "radius"), number_in(g, "length") / 2});
    if (kind == "capsule") return Shape(Capsule{number_in(g, "radius"), number_in(g, "length") / 2});
    if (kind == "ellipsoid") return Shape(Ellipsoid{vec3_in(g, "radii")});
    if (kind == "mesh") return mesh_in(g, in);
    if (kind == "plane") {
      if (!in.is_static) {
        context_.refuse(g, "a plane of a model that is not static cannot be represented");
        return std::nullopt;
      }
      const Vec3 normal = g.child("normal") ? vec3_in(g, "normal") : Vec3(Vec3::UnitZ());
      return Shape(HalfSpace{normal, 0});
    }
    if (kind != "empty") context_.refuse(g, "cannot be represented");
    return std::nullopt;
  }

  std::optional<Shape> mesh_in(const XmlElement& g, const Inside& in) {
    if (g.child("submesh")) {
      context_.refuse(g, "a submesh cannot be represented");
      return std::nullopt;
    }
    const Vec3 scale = g.child("scale") ? vec3_in(g, "scale") : Vec3(Vec3::Ones());
    try {
      const XmlElement uri = g.need_child("uri");
      return context_.mesh(context_.resolve(uri.text(), in.folder, uri.place()), scale, false, uri.place());
    } catch (const InputError& e) {
      context_.refuse(e.place(), "<mesh>: " + e.reason());
      return std::nullopt;
    }
  }

  void read_joint(const XmlElement& e, const Inside& in) {
    const std::string name = e.need("name");
    SdfFrame& f = add_frame(SdfFrame::Kind::joint, e, in, name);
    f.attached_to = e.need_child("child").text();
    if (f.relative_to.empty()) f.relative_to = f.attached_to;
    joints_.push_back({e, in.scope, frames_.find(in.scope, name, e), in.prefix + name, in.is_static});
  }

  // Every link as a root, where it is when all joints are zero.
  void place_links() {
    for (int s = 0; s < frames_.scope_count(); ++s)
      for (const auto& [name, number] : frames_.scope(s).frames)
        if (frames_.at(number).kind == SdfFrame::Kind::link)
          model_.links[static_cast<std::size_t>(frames_.at(number).link)].pose = frames_.pose(number);
  }

  struct Ends {
    int parent, child;  // links; the parent may be 0, the world
  };

  Ends ends_of(const Joint& j) {
    const XmlElement p = j.element.need_child("parent"), c = j.element.need_child("child");
    const int parent = frames_.link_of(frames_.find(j.scope, p.text(), p)),
              child = frames_.link_of(frames_.find(j.scope, c.text(), c));
    if (child < 0) c.fail("the world cannot be the child of a joint");
    return {std::max(parent, 0), child};
  }

  void add_joint(const Joint& j) {
    const std::string type = j.element.need("type");
    const Ends ends = ends_of(j);
    if (ends.parent == ends.child) j.element.fail("its parent is its child");
    if (j.is_static) return;  // nothing moves
    ModelLink& child = model_.links[static_cast<std::size_t>(ends.child)];
    joined_.emplace_back(ends.parent, ends.child);
    if (child.parent >= 0) return context_.refuse(j.element, "closes a loop, which cannot be represented");
    if (!is_among(type, {"fixed", "revolute", "continuous", "prismatic", "ball", "universal", "revolute2"})) {
      context_.refuse(j.element, "type " + printable(type) + " cannot be represented");
      return;
    }
    const Pose parent_pose = model_.links[static_cast<std::size_t>(ends.parent)].pose;
    ModelJoint joint;
    joint.name = j.prefix;
    joint.origin = compose(inverse(parent_pose), child.pose);
    const Pose in_child = compose(inverse(child.pose), frames_.pose(j.frame));
    joint.anchor = in_child.translation;
    joint.type = type == "fixed"       ? JointType::fixed
                 : type == "prismatic" ? JointType::slide
                 : type == "ball"      ? JointType::ball
                                       : JointType::hinge;
    joint.standard.assign(variable_count(joint.type), 0);
    if (joint.type == JointType::ball) joint.standard.back() = 1;
    const bool has_two = type == "universal" || type == "revolute2";
    if (joint.type == JointType::hinge || joint.type == JointType::slide)
      read_axis(j, j.element.need_child("axis"), child.pose, type == "continuous", joint);
    if (has_two) {
      ModelJoint second = joint;
      joint.name += "/axis";
      second.name += "/axis2";
      second.origin = {};
      read_axis(j, j.element.need_child("axis2"), child.pose, false, second);
      const int between = hold(child.name + "~", ends.parent, std::move(joint));
      attach(ends.child, between, std::move(second));
      return;
    }
    attach(ends.child, ends.parent, std::move(joint));
  }

  int hold(const std::string& name, int parent, ModelJoint joint) {
    ModelLink& link = model_.links.emplace_back();
    link.name = name;
    const int number = static_cast<int>(model_.links.size()) - 1;
    attach(number, parent, std::move(joint));
    return number;
  }

  void attach(int link, int parent, ModelJoint joint) {
    ModelLink& l = model_.links[static_cast<std::size_t>(link)];
    l.parent = parent;
    l.joint = static_cast<int>(model_.joints.size());
    model_.joints.push_back(std::move(joint));
  }

  void read_axis(const Joint& j, const XmlElement& e, const Pose& child, bool is_continuous, ModelJoint& to) {
    const XmlElement xyz = e.need_child("xyz");
    const auto v = xyz.text_numbers(3);
    const Vec3 axis(v[0], v[1], v[2]);
    if (axis.isZero(0)) xyz.fail("the axis is zero");
    // By default, in the joint's frame.
    std::string in = xyz.attribute("expressed_in").value_or("");
    if (is_true(e.child("use_parent_model_frame"))) in = "__model__";
    const Pose frame = in.empty() ? frames_.pose(j.frame) : frames_.pose(frames_.find(j.scope, in, xyz));
    const Vec3 world = rotation_matrix(frame.rotation) * axis.stableNormalized();
    to.axis = (rotation_matrix(child.rotation).transpose() * world).stableNormalized();
    const auto limit = e.child("limit");
    if (!limit || is_continuous) return;
    constexpr double unlimited = 1e16;  // sdformat's default bounds
    const double lower = limit->child("lower") ? number_in(*limit, "lower") : -unlimited;
    const double upper = limit->child("upper") ? number_in(*limit, "upper") : unlimited;
    if (lower > -unlimited) to.lower = lower;
    if (upper < unlimited) to.upper = upper;
  }

  // Gazebo's rule: links of one model collide only if both ask for it, and never if a joint connects them.
  void filter_models() {
    for (const LinkPair& p : joined_) add_filter(model_, p.first, p.second);
    for (const LinkOfModel& x : tops_)
      for (const LinkOfModel& y : tops_)
        if (x.link < y.link && x.top_model == y.top_model && !(x.collides && y.collides))
          add_filter(model_, x.link, y.link);
  }

  std::filesystem::path file_;
  ImportContext& context_;
  std::deque<XmlFile> files_;
  SdfFrames frames_;
  Model model_;
  std::vector<Joint> joints_;
  struct LinkOfModel {
    int link, top_model;
    bool collides;  // with other links of its model
  };
  std::vector<LinkOfModel> tops_;
  std::vector<LinkPair> joined_;
  int models_ = 0;
};

}  // namespace

Model read_sdf(const std::filesystem::path& file, ImportContext& context) {
  return SdfReader(file, context).read();
}

}  // namespace touchstone
