#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <span>

#include "core/base/input_error.h"
#include "scenarios/import/model/mjcf_cable.h"
#include "scenarios/import/model/mjcf_document.h"
#include "scenarios/import/model/names.h"
#include "scenarios/import/model/readers.h"
#include "scenarios/import/pose_algebra.h"

namespace touchstone {
namespace {

// One of the copies that a <replicate> makes.
struct Replica {
  int replicate = 0, copy = 0;
  bool operator==(const Replica&) const = default;
};

// Where bodies, geoms and frames are.
struct MjcfPlace {
  int link = 0;
  Pose pose;                   // in the link
  std::string of_class;        // childclass around
  std::string prefix, suffix;  // of names, by attachments and replicas around
  std::vector<Replica> replicas;

  std::string named(const std::string& name) const { return prefix + name + suffix; }
};

// A joint of a body, which may be in frames and replicas of it.
struct PlacedJoint {
  XmlElement element;
  MjcfPlace at;
};

// A body by the name in its file, of which replicas have copies.
struct NamedBody {
  int link = 0;
  std::vector<Replica> replicas;
};

// Whether replicas that both are in are the same copies.
bool are_together(const NamedBody& a, const NamedBody& b) {
  for (const Replica& x : a.replicas)
    for (const Replica& y : b.replicas)
      if (x.replicate == y.replicate && x.copy != y.copy) return false;
  return true;
}

// Copy i of `count`: as many digits as the count has.
std::string numbered(int i, int count) {
  const std::string digits = std::to_string(i);
  return std::string(std::to_string(count).size() - digits.size(), '0') + digits;
}

// A body or frame by its name, and the class around it.
struct Found {
  XmlElement element;
  std::string of_class;
};

class MjcfReader {
 public:
  MjcfReader(const std::filesystem::path& file, ImportContext& context) : context_(context) {
    document_ = &document(file);
  }

  Model read() {
    const XmlElement root = document_->root();
    model_.name = root.attribute("model").value_or(document_->file().stem().string());
    model_.links.emplace_back().name = "world";
    add_body(root, "world", {}, 0);
    for (const XmlElement& s : document_->sections())
      if (s.name() == "worldbody") {
        MjcfPlace at;
        at.of_class = s.attribute("childclass").value_or("");
        read_contents(s, document_->expanded(s), at, 0);
      }
    if (document_->filters_parents()) filter_parents();
    for (const XmlElement& s : document_->sections()) read_rest(s);
    sort_filters(model_);
    return std::move(model_);
  }

 private:
  static constexpr int max_depth = 200;
  static constexpr int most_elements = 200'000;  // after replication and attachment

  MjcfDocument& document(const std::filesystem::path& file) {
    auto& d = documents_[file.lexically_normal().string()];
    if (!d) d = std::make_unique<MjcfDocument>(file, context_);
    return *d;
  }

  Pose pose_in(const MjcfElement& e) const {
    return {e.vec3("pos").value_or(Vec3::Zero()), e.orientation(document_->compiler()).value_or(Quat{})};
  }
  // Of an element that default classes do not concern.
  Pose own_pose(const XmlElement& e) const { return pose_in(MjcfElement(e, document_->defaults(), "")); }

  // The class for the children of a body, frame or replicate.
  std::string class_in(const XmlElement& e, const std::string& around) const {
    std::string of_class = e.attribute("childclass").value_or(around);
    document_->defaults().require(of_class, e);
    return of_class;
  }

  MjcfPlace in_frame(const XmlElement& e, MjcfPlace at) const {
    at.pose = compose(at.pose, own_pose(e));
    at.of_class = class_in(e, at.of_class);
    return at;
  }

  // The places of the copies of a <replicate>.
  std::vector<MjcfPlace> replicas(const XmlElement& e, const MjcfPlace& at) {
    const double count = e.need_number("count");
    if (!(count >= 1 && count <= most_elements) || count != std::floor(count))
      e.fail("count must be a whole number from 1 to " + std::to_string(most_elements));
    const int n = static_cast<int>(count), id = replicates_++;
    const Vec3 offset = e.vec3("offset").value_or(Vec3::Zero()),
               euler = e.vec3("euler").value_or(Vec3::Zero());
    if (!Vec3(euler * (n - 1)).allFinite()) e.fail("the angles of the last copy exceed the range of doubles");
    std::vector<MjcfPlace> places;
    Pose frame;
    for (int i = 0; i < n; ++i) {
      frame.rotation = euler_rotation(euler * i, document_->compiler());
      MjcfPlace& p = places.emplace_back(at);
      p.pose = compose(at.pose, frame);
      p.of_class = class_in(e, at.of_class);
      p.suffix = e.attribute("sep").value_or("") + numbered(i, n) + at.suffix;
      p.replicas.push_back({id, i});
      frame = compose(frame, {offset, {}});
      count_element(e);
    }
    return places;
  }

  void count_element(const XmlElement& e) {
    if (++elements_ > most_elements)
      e.fail("a model with more than " + std::to_string(most_elements) + " elements is not read");
  }

  void read_contents(const XmlElement& e, const std::vector<XmlElement>& children, const MjcfPlace& at,
                     int depth) {
    if (depth > max_depth) e.fail("is nested deeper than " + std::to_string(max_depth) + " levels");
    for (const XmlElement& c : children) {
      count_element(c);
      const std::string name = c.name();
      if (name == "geom") {
        read_geom(c, at);
      } else if (name == "body") {
        read_body(c, at, depth);
      } else if (name == "frame") {
        read_contents(c, document_->expanded(c), in_frame(c, at), depth + 1);
      } else if (name == "replicate") {
        const std::vector<XmlElement> inner = document_->expanded(c);
        for (const MjcfPlace& copy : replicas(c, at)) read_contents(c, inner, copy, depth + 1);
      } else if (name == "attach") {
        read_attach(c, at, depth);
      } else if (name == "composite") {
        read_composite(c, at);
      } else if (!is_any(name, {"joint", "freejoint", "inertial", "site", "camera", "light", "plugin"})) {
        context_.refuse(c, "cannot be represented");
      }
    }
  }

  // Those of a body, in frames and replicas too, in the order of the file.
  void gather_joints(const std::vector<XmlElement>& children, const MjcfPlace& at, int depth,
                     std::vector<PlacedJoint>& joints) {
    for (const XmlElement& c : children) {
      const std::string name = c.name();
      if (name == "joint" || name == "freejoint") joints.push_back({c, at});
      if (depth > max_depth || (name != "frame" && name != "replicate") || !has_joints(c, depth)) continue;
      const std::vector<XmlElement> inner = document_->expanded(c);
      const auto places = name == "frame" ? std::vector{in_frame(c, at)} : replicas(c, at);
      for (const MjcfPlace& p : places) gather_joints(inner, p, depth + 1, joints);
    }
  }
  bool has_joints(const XmlElement& e, int depth) const {
    for (const XmlElement& c : e.children()) {
      const std::string name = c.name();
      if (name == "joint" || name == "freejoint" || name == "include") return true;
      if ((name == "frame" || name == "replicate") && depth <= max_depth && has_joints(c, depth + 1))
        return true;
    }
    return false;
  }

  void read_body(const XmlElement& e, const MjcfPlace& at, int depth) {
    const auto own_name = e.attribute("name");
    const std::string name = own_name ? at.named(*own_name) : "body#" + std::to_string(++unnamed_);
    MjcfPlace inner = at;
    inner.of_class = class_in(e, at.of_class);
    inner.pose = {};
    Pose pose = compose(at.pose, own_pose(e));
    int parent = at.link;
    std::vector<PlacedJoint> joints;
    const std::vector<XmlElement> children = document_->expanded(e);
    gather_joints(children, inner, depth, joints);
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const bool is_last = i + 1 == joints.size();
      parent = add_link(is_last ? name : name + "~" + std::to_string(i), parent,
                        joint_in(joints[i], pose, parent));
      pose = {};
    }
    if (joints.empty()) parent = add_link(name, parent, held(name, pose));
    add_body(e, name, own_name ? at.prefix + *own_name : name, parent, at.replicas);
    inner.link = parent;
    read_contents(e, children, inner, depth + 1);
  }

  void add_body(const XmlElement& e, const std::string& name, const std::string& in_file, int link,
                const std::vector<Replica>& replicas = {}) {
    bodies_.add(e, name, link);
    by_name_in_file_.emplace(in_file.empty() ? name : in_file, NamedBody{link, replicas});
  }

  static ModelJoint held(const std::string& name, const Pose& pose) {
    ModelJoint joint;
    joint.name = name + ":fixed";
    joint.origin = pose;
    return joint;
  }
  static ModelJoint quaternion_joint(const std::string& name, bool is_free, const Pose& origin) {
    ModelJoint joint;
    joint.name = name;
    joint.type = is_free ? JointType::free : JointType::ball;
    joint.standard = {0, 0, 0, 1};
    joint.origin = origin;
    if (!is_free) return joint;
    const Vec3& t = origin.translation;
    const Quat& q = origin.rotation;
    joint.standard = {t.x(), t.y(), t.z(), q.x, q.y, q.z, q.w};
    joint.origin = {};
    return joint;
  }

  int add_link(const std::string& name, int parent, ModelJoint joint) {
    require_few_links(model_, document_->root());
    ModelLink link;
    link.name = name;
    link.parent = parent;
    link.joint = static_cast<int>(model_.joints.size());
    model_.joints.push_back(std::move(joint));
    model_.links.push_back(std::move(link));
    return static_cast<int>(model_.links.size()) - 1;
  }

  ModelJoint joint_in(const PlacedJoint& placed, const Pose& origin, int parent) {
    const XmlElement& e = placed.element;
    const MjcfElement j(e, document_->defaults(), placed.at.of_class);
    const auto own_name = e.attribute("name");
    const std::string name =
        own_name ? placed.at.named(*own_name) : "joint#" + std::to_string(model_.joints.size());
    const std::string type = e.name() == "freejoint" ? "free" : j.text("type").value_or("hinge");
    replicated_joints_ = replicated_joints_ || !placed.at.replicas.empty();
    if (type == "free" && parent != 0) e.fail("a free joint must be in a body of the world");
    const Vec3 anchor = compose(placed.at.pose, {j.vec3("pos").value_or(Vec3::Zero()), {}}).translation;
    if (type == "free" || type == "ball") {
      ModelJoint joint = quaternion_joint(name, type == "free", origin);
      joint.anchor = anchor;
      return joint;
    }
    if (type != "hinge" && type != "slide") e.fail("unknown type " + printable(type));
    ModelJoint joint;
    joint.name = name;
    joint.origin = origin;
    joint.anchor = anchor;
    joint.type = type == "hinge" ? JointType::hinge : JointType::slide;
    const Vec3 axis = j.vec3("axis").value_or(Vec3::UnitZ());
    if (axis.isZero(0)) e.fail("the axis is zero");
    const Quat& turn = placed.at.pose.rotation;
    joint.axis = axis.stableNormalized();
    if (turn != Quat{}) joint.axis = (rotation_matrix(turn) * joint.axis).normalized();
    set_range(j, joint);
    return joint;
  }

  void set_range(const MjcfElement& j, ModelJoint& joint) const {
    const bool is_angle = joint.type == JointType::hinge && document_->compiler().degrees;
    const double unit = is_angle ? std::numbers::pi / 180 : 1;
    joint.reference = j.number("ref", 0) * unit;
    joint.standard = {joint.reference};
    const auto range = j.numbers("range");
    if (range.size() == 2 && j.text("limited").value_or("auto") != "false" && range[0] < range[1]) {
      joint.lower = range[0] * unit;
      joint.upper = range[1] * unit;
    }
  }

  static std::uint32_t bits(const MjcfElement& g, std::string_view attribute) {
    const double v = g.number(attribute, 1);
    if (!(v >= 0 && v <= 4294967295.0) || v != std::floor(v))
      g.xml().fail(std::string(attribute) + " is not a whole number of 32 bits");
    return static_cast<std::uint32_t>(v);
  }

  void read_geom(const XmlElement& e, const MjcfPlace& at) {
    const MjcfElement g(e, document_->defaults(), at.of_class);
    ModelShape s;
    const auto own_name = e.attribute("name");
    s.name = own_name ? at.named(*own_name) : "";
    s.category = bits(g, "contype");
    s.mask = bits(g, "conaffinity");
    if (s.category == 0 && s.mask == 0) return;  // drawn, never collides
    Pose pose = pose_in(g);
    auto shape = mjcf_shape(g, *document_, context_, pose);
    if (!shape) return;
    if (kind_of(*shape) == ShapeKind::half_space &&
        !anchored_links(model_)[static_cast<std::size_t>(at.link)])
      return context_.refuse(e, "is a plane on a body that moves");
    s.shape = std::move(*shape);
    s.in_link = compose(at.pose, pose);
    add_shape(e, at.link, std::move(s));
  }

  void add_shape(const XmlElement& e, int link, ModelShape s) {
    try {
      validate(s.shape);
    } catch (const InputError& error) {
      e.fail(error.what());
    }
    require_few_shapes(++shapes_, e);
    model_.links[static_cast<std::size_t>(link)].shapes.push_back(std::move(s));
  }

  // ---- a chain of bodies

  void read_composite(const XmlElement& e, const MjcfPlace& at) {
    if (e.need("type") != "cable")
      return context_.refuse(e, "type " + printable(e.need("type")) + " cannot be represented");
    const MjcfCable cable = read_cable(e);
    MjcfPlace here = at;
    for (std::size_t i = 0; i < cable.parts.size(); ++i) {
      const std::string name = at.named(cable.body_name(i));
      const Pose pose = compose(here.pose, cable.parts[i]);
      const bool is_free = i == 0 && cable.initial == "free";
      if (is_free && at.link != 0) e.fail("a free joint must be in a body of the world");
      const int link = add_link(name, here.link,
                                i == 0 && cable.initial == "none"
                                    ? held(name, pose)
                                    : quaternion_joint(at.named(cable.joint_name(i)), is_free, pose));
      replicated_joints_ = replicated_joints_ || !at.replicas.empty();
      add_body(e, name, at.prefix + cable.body_name(i), link, at.replicas);
      add_cable_shape(e, cable, i, link, at);
      if (i > 0) add_filter(model_, here.link, link);
      here.link = link;
      here.pose = {};
    }
  }

  // Default classes do not concern the parts of composites.
  void add_cable_shape(const XmlElement& e, const MjcfCable& cable, std::size_t part, int link,
                       const MjcfPlace& at) {
    const MjcfElement g(e.need_child("geom"), no_defaults_, "");
    const std::string type = g.text("type").value_or("sphere");
    if (!is_any(type, {"capsule", "cylinder", "box"}))
      g.xml().fail("the parts of a cable are of type capsule, cylinder or box");
    std::vector<double> size = g.numbers("size");
    if (size.empty()) g.xml().fail("lacks a size");
    const double half = cable.lengths[part] / 2;
    ModelShape s;
    s.name = at.named(cable.prefix + "G" + std::to_string(part));
    s.category = bits(g, "contype");
    s.mask = bits(g, "conaffinity");
    s.in_link.translation = {half, 0, 0};
    if (type == "box") {
      size[0] = half;
    } else {
      size = {size[0], half};
      s.in_link.rotation = from_z_to(-Vec3::UnitX());  // as of fromto
    }
    s.shape = sized_shape(type, size, g.xml());
    if (s.category != 0 || s.mask != 0) add_shape(g.xml(), link, std::move(s));
  }

  // ---- parts of other models, or of this one once more

  void read_attach(const XmlElement& e, const MjcfPlace& at, int depth) {
    const auto model = e.attribute("model"), body = e.attribute("body"), frame = e.attribute("frame");
    if (body && frame) e.fail("names both a body and a frame");
    if (!model && !body && !frame) e.fail("names neither a model nor a body or frame of this one");
    MjcfDocument* const outer = document_;
    MjcfPlace inner = at;
    inner.prefix += e.need("prefix");
    const int first_link = static_cast<int>(model_.links.size());
    const std::size_t first_joint = model_.joints.size();
    if (model) document_ = &document(document_->model_file(document_->need_asset("model", *model, e)));
    read_attached(e, body ? "body" : frame ? "frame" : "", body ? *body : frame.value_or(""), inner, depth);
    const Attached range{inner.prefix, model ? "" : at.prefix, first_link, !model.has_value()};
    for (const XmlElement& s : document_->sections())
      if (s.name() == "contact") read_contacts(s, range);
    if (model) read_attached_keys(inner, first_joint);
    document_ = outer;
  }

  void read_attached(const XmlElement& e, const std::string& kind, const std::string& name, MjcfPlace at,
                     int depth) {
    for (const XmlElement& s : document_->sections()) {
      if (s.name() != "worldbody") continue;
      at.of_class = s.attribute("childclass").value_or("");
      if (kind.empty()) {
        read_contents(e, document_->expanded(s), at, depth + 1);
      } else if (const auto found = find(s, at.of_class, kind, name, 0)) {
        at.of_class = found->of_class;
        read_contents(e, {found->element}, at, depth + 1);
        return;
      }
    }
    if (!kind.empty()) e.fail("there is no " + kind + " " + printable(name));
  }

  std::optional<Found> find(const XmlElement& e, const std::string& of_class, const std::string& kind,
                            const std::string& name, int depth) {
    if (depth > max_depth) return std::nullopt;
    for (const XmlElement& c : document_->expanded(e)) {
      count_element(c);
      if (c.name() != "body" && c.name() != "frame") continue;
      if (c.name() == kind && c.attribute("name").value_or("") == name) return Found{c, of_class};
      if (auto found = find(c, class_in(c, of_class), kind, name, depth + 1)) return found;
    }
    return std::nullopt;
  }

  // Only states that have a value for all joints of the attached model can be taken over.
  void read_attached_keys(const MjcfPlace& at, std::size_t first_joint) {
    const std::span<const ModelJoint> joints = std::span(model_.joints).subspan(first_joint);
    for (const XmlElement& s : document_->sections())
      if (s.name() == "keyframe")
        for (const XmlElement& k : document_->expanded(s)) read_key(k, joints, at);
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
    if (s.name() == "contact") read_contacts(s, {});
    if (s.name() == "keyframe")
      for (const XmlElement& k : document_->expanded(s)) read_key(k, model_.joints, {});
    if (s.name() == "deformable") {
      for (const XmlElement& d : document_->expanded(s))
        if (d.name() != "skin") context_.refuse(d, "cannot be represented");
    } else if (!is_any(s.name(), {"compiler", "default", "asset", "option", "worldbody", "contact",
                                  "keyframe", "size", "statistic", "visual", "custom", "equality", "tendon",
                                  "actuator", "sensor", "extension"})) {
      context_.refuse(s, "cannot be represented");
    }
  }

  // What the contact filters of a file are about: all of it, or a part of it that was attached. Those of a
  // part of this model may also name a body outside the part.
  struct Attached {
    std::string prefix, prefix_outside;
    int first_link = 0;
    bool is_of_this_model = false;
  };

  void read_contacts(const XmlElement& e, const Attached& range) {
    for (const XmlElement& c : document_->expanded(e)) {
      if (c.name() == "exclude")
        exclude(c, range);
      else
        context_.refuse(c, "pairs that are asked whatever the filters say cannot be represented");
    }
  }

  // The copies of a body from a link on.
  std::vector<NamedBody> copies(const std::string& in_file, int first_link) const {
    std::vector<NamedBody> list;
    const auto [begin, end] = by_name_in_file_.equal_range(in_file);
    for (auto it = begin; it != end; ++it)
      if (it->second.link >= first_link) list.push_back(it->second);
    return list;
  }

  void exclude(const XmlElement& e, const Attached& range) {
    count_element(e);
    const std::array<std::string, 2> names{e.need("body1"), e.need("body2")};
    std::array<std::vector<NamedBody>, 2> found;
    const bool is_whole = range.first_link == 0;
    for (std::size_t k = 0; k < 2; ++k) {
      found[k] = copies(range.prefix + names[k], range.first_link);
      if (is_whole && found[k].empty()) found[k] = {{bodies_.need(e, names[k], "body"), {}}};
    }
    if (found[0].empty() && found[1].empty()) return;
    for (std::size_t k = 0; k < 2; ++k)
      if (range.is_of_this_model && found[k].empty()) found[k] = copies(range.prefix_outside + names[k], 0);
    for (const NamedBody& a : found[0])
      for (const NamedBody& b : found[1]) {
        if (a.link == b.link && is_whole) e.fail("names the same body twice");
        if (a.link != b.link && are_together(a, b)) add_filter(model_, a.link, b.link);
      }
  }

  void read_key(const XmlElement& e, std::span<const ModelJoint> joints, const MjcfPlace& at) {
    NamedState state;
    const auto own_name = e.attribute("name");
    state.name = own_name ? at.named(*own_name) : "key#" + std::to_string(model_.states.size());
    const auto q = e.numbers("qpos");
    if (q.empty()) return;
    std::size_t need = 0;
    for (const ModelJoint& j : joints) need += variable_count(j.type);
    if (q.size() != need) {
      const std::string reason =
          "qpos has " + std::to_string(q.size()) + " numbers instead of " + std::to_string(need);
      if (!replicated_joints_ && joints.size() == model_.joints.size()) e.fail(reason);
      return context_.refuse(e, reason + ": keyframes are read if they state all joints, copies included");
    }
    std::size_t next = 0;
    for (const ModelJoint& j : joints) {
      const std::size_t n = variable_count(j.type);
      const auto v = std::span(q).subspan(next, n);
      next += n;
      std::vector<double> values(v.begin(), v.end());
      // MuJoCo's quaternions begin with w.
      if (j.type == JointType::ball || j.type == JointType::free)
        std::rotate(values.end() - 4, values.end() - 3, values.end());
      if (!values.empty()) state.values.emplace_back(j.name, std::move(values));
    }
    model_.states.push_back(std::move(state));
  }

  ImportContext& context_;
  std::map<std::string, std::unique_ptr<MjcfDocument>> documents_;
  MjcfDocument* document_ = nullptr;  // the one that is being read
  Model model_;
  const MjcfDefaults no_defaults_;
  NumberByName bodies_;
  std::multimap<std::string, NamedBody> by_name_in_file_;  // with the prefixes of attachments
  bool replicated_joints_ = false;
  int unnamed_ = 0, replicates_ = 0, elements_ = 0;
  std::size_t shapes_ = 0;
};

}  // namespace

Model read_mjcf(const std::filesystem::path& file, ImportContext& context) {
  return MjcfReader(file, context).read();
}

}  // namespace touchstone
