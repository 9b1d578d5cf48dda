#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/input_error.h"
#include "scenarios/import/model/gltf_file.h"
#include "scenarios/import/model/names.h"
#include "scenarios/import/model/readers.h"
#include "scenarios/import/pose_algebra.h"
#include "scenarios/text/printable.h"

namespace touchstone {
namespace {

constexpr std::string_view physics = "KHR_physics_rigid_bodies", shapes_extension = "KHR_implicit_shapes";

std::optional<JsonReader> extension(const JsonReader& j, std::string_view name) {
  if (!j.has("extensions") || !j["extensions"].has(name)) return std::nullopt;
  return j["extensions"][name];
}

std::set<std::string> strings(const JsonReader& j, std::string_view field) {
  std::set<std::string> all;
  if (j.has(field))
    for (const JsonReader& s : j[field].items()) all.insert(s.string());
  return all;
}

bool is_part_of(const std::set<std::string>& a, const std::set<std::string>& b) {
  return std::includes(b.begin(), b.end(), a.begin(), a.end());
}

// With which other colliders one collides; a collider without a filter is `all`.
struct CollisionFilter {
  std::set<std::string> systems, with, not_with;
  bool only_with = false;

  static CollisionFilter read(const JsonReader& j) {
    CollisionFilter f{strings(j, "collisionSystems"), strings(j, "collideWithSystems"),
                      strings(j, "notCollideWithSystems"), j.has("collideWithSystems")};
    if (f.only_with && j.has("notCollideWithSystems"))
      j.fail("states both collideWithSystems and notCollideWithSystems");
    return f;
  }
  bool admits(const CollisionFilter& other) const {
    if (other.systems.empty()) return true;
    return only_with ? is_part_of(other.systems, with) : !is_part_of(other.systems, not_with);
  }
};

double positive(const JsonReader& j) {
  const double v = j.number();
  if (!(v > 0)) j.fail("is not positive");
  return v;
}
double not_negative(const JsonReader& j) {
  const double v = j.number();
  if (!(v >= 0)) j.fail("is negative");
  return v;
}

// A shape along glTF's y axis, and the rotation that brings ours to it.
struct Turned {
  Shape shape;
  Quat rotation;
};

// Where a node is: in its link, and in the world. Nothing with shear.
struct NodePlace {
  int link = 0;
  std::optional<GltfTransform> in_link, in_world;
};

class GltfReader {
 public:
  GltfReader(const std::filesystem::path& file, ImportContext& context)
      : context_(context), file_(file, context) {
    model_.name = file.stem().string();
  }

  bool has_physics() const {
    for (std::size_t i = 0; i < file_.count("nodes"); ++i)
      if (extension(file_.element("nodes", i), physics)) return true;
    return false;
  }

  Model read() {
    model_.links.emplace_back().name = "world";
    names_.insert("world");
    read_filters();
    link_of_.assign(file_.count("nodes"), -1);
    const GltfTransform origin;
    for (const std::size_t n : roots()) visit(n, {0, origin, origin}, 0);
    for (const auto& [a, b] : joined_)
      if (link_of_[a] >= 0 && link_of_[b] >= 0 && link_of_[a] != link_of_[b])
        add_filter(model_, link_of_[a], link_of_[b]);
    sort_filters(model_);
    return std::move(model_);
  }

 private:
  static constexpr int max_depth = 200;
  static constexpr std::size_t most_filters =
      31;  // bits of a mask, less the one of colliders without a filter

  std::vector<std::size_t> numbers_of(const JsonReader& list) const {
    std::vector<std::size_t> all;
    for (const JsonReader& n : list.items()) {
      file_.element("nodes", n);
      all.push_back(count_of(n));
    }
    return all;
  }

  // Of the file's scene; without scenes, the nodes that are no node's child.
  std::vector<std::size_t> roots() const {
    if (file_.count("scenes") > 0) {
      const JsonReader root = file_.root();
      const JsonReader scene = root.has("scene") ? file_.element("scenes", root["scene"])
                                                 : file_.element("scenes", std::size_t{0});
      return scene.has("nodes") ? numbers_of(scene["nodes"]) : std::vector<std::size_t>();
    }
    std::vector<char> is_child(file_.count("nodes"), 0);
    for (std::size_t i = 0; i < is_child.size(); ++i)
      if (const JsonReader node = file_.element("nodes", i); node.has("children"))
        for (const std::size_t c : numbers_of(node["children"])) is_child[c] = 1;
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < is_child.size(); ++i)
      if (!is_child[i]) all.push_back(i);
    return all;
  }

  void read_filters() {
    const auto e = extension(file_.root(), physics);
    if (!e || !e->has("collisionFilters")) return;
    const JsonReader list = (*e)["collisionFilters"];
    for (const JsonReader& f : list.items()) filters_.push_back(CollisionFilter::read(f));
    if (filters_.size() > most_filters)
      list.fail("more than " + std::to_string(most_filters) + " filters are not read");
  }

  void visit(std::size_t n, const NodePlace& parent, int depth) {
    const JsonReader node = file_.element("nodes", n);
    if (depth > max_depth) node.fail("is nested deeper than " + std::to_string(max_depth) + " levels");
    if (link_of_[n] >= 0) node.fail("is a child of two nodes, or of itself");
    const GltfTransform local = GltfFile::transform_of(node);
    const auto in = [&](const std::optional<GltfTransform>& outer) {
      return outer ? GltfFile::composed(*outer, local) : std::nullopt;
    };
    NodePlace at{parent.link, in(parent.in_link), in(parent.in_world)};
    const auto body = extension(node, physics);
    if (body && body->has("motion")) at = moving(n, node, at);
    link_of_[n] = at.link;
    if (body && body->has("collider")) read_collider((*body)["collider"], node, n, at);
    if (body && body->has("joint")) read_joint((*body)["joint"], n);
    if (node.has("children"))
      for (const std::size_t c : numbers_of(node["children"])) visit(c, at, depth + 1);
  }

  std::string name_of(const JsonReader& node, std::size_t n) {
    const std::string number = "node#" + std::to_string(n);
    std::string name = node.has("name") ? node["name"].string() : number;
    if (!names_.insert(name).second) name.append("#").append(std::to_string(n));
    names_.insert(name);
    return name;
  }

  // A body of its own from here on.
  NodePlace moving(std::size_t n, const JsonReader& node, const NodePlace& at) {
    if (!at.in_world) {
      context_.refuse(node.place(), "moves and has shear: unequal scales around a rotation");
      return at;
    }
    if (model_.links.size() >= most_links)
      node.fail("a model with more than " + std::to_string(most_links) + " links is not read");
    const Pose& p = at.in_world->pose;
    ModelJoint joint;
    joint.name = name_of(node, n);
    joint.type = JointType::free;
    joint.standard = {p.translation.x(), p.translation.y(), p.translation.z(), p.rotation.x,
                      p.rotation.y,      p.rotation.z,      p.rotation.w};
    ModelLink link;
    link.name = joint.name;
    link.parent = 0;
    link.joint = static_cast<int>(model_.joints.size());
    model_.joints.push_back(std::move(joint));
    model_.links.push_back(std::move(link));
    return {static_cast<int>(model_.links.size()) - 1, GltfTransform{{}, at.in_world->scale}, at.in_world};
  }

  void read_joint(const JsonReader& joint, std::size_t n) {
    file_.element("nodes", joint["connectedNode"]);
    if (joint.has("enableCollision") && joint["enableCollision"].boolean()) return;
    joined_.emplace_back(n, count_of(joint["connectedNode"]));
  }

  void read_collider(const JsonReader& c, const JsonReader& node, std::size_t n, const NodePlace& at) {
    if (!at.in_link) return context_.refuse(node.place(), "has shear: unequal scales around a rotation");
    if (at.in_link->scale.isZero(0)) return;  // disabled, says the specification
    if ((at.in_link->scale.array() == 0).any())
      return context_.refuse(node.place(), "is scaled to a flat shape");
    const JsonReader geometry = c.has("geometry") ? c["geometry"] : c;
    auto shape = geometry.has("shape") ? implicit_shape(geometry["shape"], *at.in_link, at.link)
                                       : mesh_shape(geometry, *at.in_link);
    if (!shape) return;
    try {
      validate(shape->shape);
    } catch (const InputError& e) {
      geometry.fail(e.what());
    }
    if (++shapes_ > most_shapes)
      c.fail("a model with more than " + std::to_string(most_shapes) + " shapes is not read");
    ModelShape s;
    s.name = node.has("name") ? node["name"].string() : "node#" + std::to_string(n);
    s.shape = std::move(shape->shape);
    s.in_link = compose(at.in_link->pose, {Vec3::Zero(), shape->rotation});
    set_filter(c, s);
    model_.links[static_cast<std::size_t>(at.link)].shapes.push_back(std::move(s));
  }

  // Each filter is a category; its mask has those that admit it and that it admits.
  void set_filter(const JsonReader& c, ModelShape& s) const {
    static const CollisionFilter all;
    std::size_t own = filters_.size();
    if (c.has("collisionFilter")) {
      own = count_of(c["collisionFilter"]);
      if (own >= filters_.size())
        c["collisionFilter"].fail("names number " + std::to_string(own) + " of " +
                                  std::to_string(filters_.size()) + " collision filters");
    }
    const auto filter = [&](std::size_t i) -> const CollisionFilter& {
      return i < filters_.size() ? filters_[i] : all;
    };
    s.category = 1U << own;
    s.mask = 0;
    for (std::size_t i = 0; i <= filters_.size(); ++i)
      if (filter(own).admits(filter(i)) && filter(i).admits(filter(own))) s.mask |= 1U << i;
  }

  std::optional<Turned> implicit_shape(const JsonReader& number, const GltfTransform& at, int link) {
    const auto e = extension(file_.root(), shapes_extension);
    if (!e) number.fail("names a shape, and the file has no " + std::string(shapes_extension));
    const auto list = (*e)["shapes"].items();
    const std::uint64_t i = count_of(number);
    if (i >= list.size())
      number.fail("names number " + std::to_string(i) + " of " + std::to_string(list.size()) + " shapes");
    const JsonReader& j = list[i];
    const std::string type = j["type"].string();
    const JsonReader own = j.has(type) ? j[type] : j;
    const Vec3 scale = at.scale.cwiseAbs();
    if (type == "box") return Turned{Box{half_extents(own).cwiseProduct(scale)}, {}};
    if (type == "plane") return plane(own, link);
    if (type == "cylinder") return cylinder(own, scale);
    if (type != "sphere" && type != "capsule") {
      context_.refuse(j.place(), "type " + printable(type) + " cannot be represented");
      return std::nullopt;
    }
    if (scale.x() != scale.y() || scale.y() != scale.z()) {
      context_.refuse(j.place(), "a " + type + " with unequal scales cannot be represented");
      return std::nullopt;
    }
    if (type == "sphere") return Turned{Sphere{scale.x() * positive(own["radius"])}, {}};
    const double top = not_negative(own["radiusTop"]), bottom = not_negative(own["radiusBottom"]);
    if (top != bottom) {
      context_.refuse(j.place(), "a capsule with unequal radii cannot be represented");
      return std::nullopt;
    }
    return Turned{Capsule{scale.x() * top, scale.x() * positive(own["height"]) / 2},
                  from_z_to(Vec3::UnitY())};
  }

  static Vec3 half_extents(const JsonReader& box) {
    const Vec3 size = box["size"].vec3();
    if (!(size.minCoeff() > 0)) box["size"].fail("is not positive");
    return size / 2;
  }

  // With one radius of 0, a cone.
  std::optional<Turned> cylinder(const JsonReader& j, const Vec3& scale) {
    const double top = not_negative(j["radiusTop"]), bottom = not_negative(j["radiusBottom"]);
    const double half = positive(j["height"]) / 2 * scale.y();
    const bool is_cone = (top == 0) != (bottom == 0);
    if (scale.x() != scale.z() || (top != bottom && !is_cone) || top + bottom == 0) {
      context_.refuse(j.place(), "a cylinder with unequal radii cannot be represented");
      return std::nullopt;
    }
    const Quat upward = from_z_to(Vec3::UnitY()), downward = from_z_to(-Vec3::UnitY());
    if (!is_cone) return Turned{Cylinder{top * scale.x(), half}, upward};
    return Turned{Cone{(top + bottom) * scale.x(), half}, top == 0 ? upward : downward};
  }

  // Without sizes, all below it is solid.
  std::optional<Turned> plane(const JsonReader& j, int link) {
    const auto is_open = [&](std::string_view size) { return !j.has(size) || j[size].number() == 0; };
    const bool two_sided = j.has("doubleSided") && j["doubleSided"].boolean();
    if (is_open("sizeX") && is_open("sizeZ") && !two_sided && link == 0)
      return Turned{HalfSpace{Vec3::UnitY(), 0}, {}};
    context_.refuse(j.place(), "a plane that moves, ends or has two sides cannot be represented");
    return std::nullopt;
  }

  std::optional<Turned> mesh_shape(const JsonReader& g, const GltfTransform& at) {
    TriangleMesh mesh;
    GltfTransform scale;
    scale.scale = at.scale;
    if (g.has("node"))
      add_meshes(file_.element("nodes", g["node"]), scale, 0, mesh);
    else if (g.has("mesh"))  // earlier drafts
      file_.add_triangles(file_.element("meshes", g["mesh"]), scale, mesh);
    else
      g.fail("names neither a shape nor a node");
    if (mesh.triangles.empty()) g.fail("names a node without triangles");
    const bool convex = g.has("convexHull") && g["convexHull"].boolean();
    if (!convex && !context_.options().convex_meshes) return Turned{std::move(mesh), {}};
    try {
      return Turned{make_hull(std::move(mesh.vertices)), {}};
    } catch (const InputError& e) {
      g.fail(e.what());
    }
  }

  // Of a node in its own frame, and of the nodes below it.
  void add_meshes(const JsonReader& node, const GltfTransform& at, int depth, TriangleMesh& to) const {
    if (depth > max_depth) node.fail("is nested deeper than " + std::to_string(max_depth) + " levels");
    if (node.has("skin") || node.has("weights")) node.fail("deforms its mesh, which is not read");
    if (node.has("mesh")) file_.add_triangles(file_.element("meshes", node["mesh"]), at, to);
    if (!node.has("children")) return;
    for (const std::size_t c : numbers_of(node["children"])) {
      const JsonReader child = file_.element("nodes", c);
      const auto inner = GltfFile::composed(at, GltfFile::transform_of(child));
      if (!inner) child.fail("has shear: unequal scales around a rotation");
      if (++visited_ > most_visited) child.fail("is one of too many nodes of colliders");
      add_meshes(child, *inner, depth + 1, to);
    }
  }

  static constexpr std::size_t most_visited = 200'000;

  ImportContext& context_;
  GltfFile file_;
  Model model_;
  std::vector<CollisionFilter> filters_;
  std::vector<int> link_of_;  // of each node; -1: not visited
  std::vector<std::pair<std::size_t, std::size_t>> joined_;
  std::set<std::string> names_;
  std::size_t shapes_ = 0;
  mutable std::size_t visited_ = 0;
};

}  // namespace

Model read_gltf(const std::filesystem::path& file, ImportContext& context) {
  GltfReader reader(file, context);
  return reader.has_physics() ? reader.read() : read_mesh_model(file, context);
}

}  // namespace touchstone
