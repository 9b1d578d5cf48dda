#include "scenarios/import/model/mjcf_document.h"

#include <algorithm>

#include "scenarios/text/printable.h"

namespace touchstone {

bool is_any(const std::string& name, std::initializer_list<std::string_view> list) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

MjcfDocument::MjcfDocument(const std::filesystem::path& file, ImportContext& context)
    : file_(file), context_(context) {
  add_file(file);
  if (root().name() != "mujoco") root().fail("is not the root element <mujoco> of an MJCF file");
  sections_ = expanded(root());
  const auto expand = [this](const XmlElement& e) { return expanded(e); };
  for (const XmlElement& s : sections_) {
    if (s.name() == "compiler") read_compiler(s);
    if (s.name() == "default") defaults_.read(s, "", expand);
    if (s.name() == "asset") read_assets(s);
    if (s.name() == "option")
      for (const XmlElement& f : s.children("flag"))
        if (f.attribute("filterparent").value_or("enable") == "disable") filters_parents_ = false;
  }
}

void MjcfDocument::add_file(const std::filesystem::path& file) {
  files_.emplace_back(file);
  opened_.insert(file.lexically_normal().string());
}

std::vector<XmlElement> MjcfDocument::expanded(const XmlElement& e) {
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

void MjcfDocument::read_compiler(const XmlElement& e) {
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

void MjcfDocument::read_assets(const XmlElement& e) {
  for (const XmlElement& a : expanded(e)) {
    if (!is_any(a.name(), {"mesh", "hfield", "model"})) continue;
    std::string name = std::filesystem::path(a.attribute("file").value_or("")).stem().string();
    if (a.name() == "model" && !a.attribute("name"))
      name = XmlFile(model_file(a)).root().attribute("model").value_or(name);
    assets_.emplace(std::pair(a.name(), a.attribute("name").value_or(name)), a);
  }
}

const XmlElement& MjcfDocument::need_asset(const std::string& kind, const std::string& name,
                                           const XmlElement& user) const {
  const auto it = assets_.find(std::pair(kind, name));
  if (it == assets_.end()) user.fail("there is no " + kind + " " + printable(name));
  return it->second;
}

std::filesystem::path MjcfDocument::asset_file(const MjcfElement& asset) const {
  std::filesystem::path file = *asset.text("file");
  if (compiler_.strip_path) file = file.filename();
  if (!compiler_.mesh_folder.empty()) file = std::filesystem::path(compiler_.mesh_folder) / file;
  return context_.resolve(file.lexically_normal().string(), file_.parent_path(), asset.xml().place());
}

std::filesystem::path MjcfDocument::model_file(const XmlElement& asset) const {
  return context_.resolve(asset.need("file"), file_.parent_path(), asset.place());
}

}  // namespace touchstone
