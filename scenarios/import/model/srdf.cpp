#include <algorithm>
#include <map>
#include <set>

#include "core/base/input_error.h"
#include "scenarios/import/model/names.h"
#include "scenarios/import/model/readers.h"

namespace touchstone {
namespace {

class SrdfReader {
 public:
  SrdfReader(Model& model, const std::filesystem::path& file, ImportContext& context)
      : model_(model), xml_(file), context_(context) {
    for (const ModelLink& l : model.links) links_.emplace(l.name, static_cast<int>(links_.size()));
  }

  void read() {
    const XmlElement root = xml_.root();
    if (root.name() != "robot") root.fail("is not the root element <robot> of an SRDF file");
    const std::string name = root.attribute("name").value_or(model_.name);
    if (name != model_.name)
      context_.refuse(root, "describes the robot " + printable(name) + ", not " + printable(model_.name));
    for (const XmlElement& e : root.children()) {
      if (e.name() == "disable_default_collisions") disable_all(e);
      if (e.name() == "virtual_joint") hold_root(e);
    }
    for (const XmlElement& e : root.children()) read_element(e);
    for (const LinkPair& p : enabled_) std::erase(model_.filters, p);
    sort_links_of(model_, root);
  }

 private:
  void read_element(const XmlElement& e) {
    const std::string name = e.name();
    if (name == "disable_collisions") {
      if (const auto p = pair_in(e)) add_filter(model_, p->first, p->second);
    } else if (name == "enable_collisions") {
      if (const auto p = pair_in(e)) enabled_.insert(std::minmax(p->first, p->second));
    } else if (name == "group_state") {
      add_state(e);
    } else if (name != "group" && name != "end_effector" && name != "passive_joint" &&
               name != "virtual_joint" && name != "disable_default_collisions" &&
               name != "link_sphere_approximation" && name != "joint_property") {
      context_.refuse(e, "is not known");  // none of those listed says which collisions are checked
    }
  }

  // Refuses and returns -1 when there is no such link.
  int link_in(const XmlElement& e, const std::string& attribute) {
    const std::string name = e.need(attribute);
    if (const auto it = links_.find(name); it != links_.end()) return it->second;
    context_.refuse(e, "there is no link " + printable(name));
    return -1;
  }

  std::optional<LinkPair> pair_in(const XmlElement& e) {
    const int a = link_in(e, "link1"), b = link_in(e, "link2");
    if (a < 0 || b < 0) return std::nullopt;
    if (a == b) e.fail("names the same link twice");
    return std::minmax(a, b);
  }

  void disable_all(const XmlElement& e) {
    const int link = link_in(e, "link");
    if (!disabled_.insert(link).second) return;
    for (int i = 0; link >= 0 && i < static_cast<int>(model_.links.size()); ++i)
      if (i != link) add_filter(model_, link, i);
  }

  void add_state(const XmlElement& e) {
    NamedState state;
    state.name = e.need("group") + "/" + e.need("name");
    for (const XmlElement& j : e.children("joint")) {
      const std::string name = j.need("name");
      const auto it = std::find_if(model_.joints.begin(), model_.joints.end(),
                                   [&](const ModelJoint& m) { return m.name == name; });
      const std::vector<double> values = j.numbers("value");
      if (it == model_.joints.end())
        context_.refuse(j, "there is no joint " + printable(name));
      else if (values.size() != variable_count(it->type))
        context_.refuse(j, "joint " + printable(name) + " has " + std::to_string(variable_count(it->type)) +
                               " variables, the state " + std::to_string(values.size()) + " values");
      else
        state.values.emplace_back(name, values);
    }
    model_.states.push_back(std::move(state));
  }

  // A joint between the world and the root link.
  void hold_root(const XmlElement& e) {
    ModelJoint joint;
    joint.name = e.need("name");
    const std::string type = e.need("type"), child = e.need("child_link");
    if (type == "fixed") return;
    const auto root = std::find_if(model_.links.begin(), model_.links.end(),
                                   [](const ModelLink& l) { return l.parent < 0; });
    if (root->name != child) return context_.refuse(e, printable(child) + " is not the root link");
    joint.type = type == "planar" ? JointType::planar : JointType::free;
    if (type != "planar" && type != "floating") e.fail("unknown type " + printable(type));
    joint.axis = Vec3::UnitZ();
    joint.origin = root->pose;
    joint.standard.assign(variable_count(joint.type), 0);
    if (joint.type == JointType::free) joint.standard.back() = 1;
    root->parent = static_cast<int>(model_.links.size());
    root->joint = static_cast<int>(model_.joints.size());
    model_.joints.push_back(std::move(joint));
    model_.links.emplace_back().name = e.attribute("parent_frame").value_or("world");
  }

  Model& model_;
  XmlFile xml_;
  ImportContext& context_;
  std::map<std::string, int> links_;
  std::set<LinkPair> enabled_;
  std::set<int> disabled_;  // with all others
};

}  // namespace

void add_srdf(Model& model, const std::filesystem::path& file, ImportContext& context) {
  SrdfReader(model, file, context).read();
}

}  // namespace touchstone
