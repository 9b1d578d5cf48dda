// One MJCF file with its includes: settings of the compiler, default classes, assets.
#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/shape/shape.h"
#include "scenarios/import/import_context.h"
#include "scenarios/import/model/mjcf_defaults.h"

namespace touchstone {

/// Whether the name is in the list.
bool is_any(const std::string& name, std::initializer_list<std::string_view> list);

class MjcfDocument {
 public:
  /// Reads settings, classes and assets. Throws InputError.
  MjcfDocument(const std::filesystem::path& file, ImportContext& context);
  MjcfDocument(const MjcfDocument&) = delete;
  MjcfDocument& operator=(const MjcfDocument&) = delete;

  XmlElement root() const { return files_.front().root(); }
  const std::filesystem::path& file() const { return file_; }
  /// The children of the root, those of included files among them.
  const std::vector<XmlElement>& sections() const { return sections_; }
  const MjcfCompiler& compiler() const { return compiler_; }
  const MjcfDefaults& defaults() const { return defaults_; }
  bool filters_parents() const { return filters_parents_; }

  /// The children, with included files in place of <include>.
  std::vector<XmlElement> expanded(const XmlElement& e);

  /// An asset by its kind ("mesh", "hfield", "model") and name. Throws InputError at `user`.
  const XmlElement& need_asset(const std::string& kind, const std::string& name,
                               const XmlElement& user) const;
  /// The file of a mesh or height field.
  std::filesystem::path asset_file(const MjcfElement& asset) const;
  /// The file of a model, which the folders of assets do not concern.
  std::filesystem::path model_file(const XmlElement& asset) const;

 private:
  void add_file(const std::filesystem::path& file);
  void read_compiler(const XmlElement& e);
  void read_assets(const XmlElement& e);

  std::filesystem::path file_;
  ImportContext& context_;
  std::deque<XmlFile> files_;
  std::set<std::string> opened_;
  std::vector<XmlElement> sections_;
  MjcfCompiler compiler_;
  MjcfDefaults defaults_;
  std::map<std::pair<std::string, std::string>, XmlElement> assets_;
  bool filters_parents_ = true;
};

/// The shape of a geom; `fromto` replaces its pose. Nothing for what cannot be represented, if
/// ImportContext::refuse lets it pass. Throws InputError.
std::optional<Shape> mjcf_shape(const MjcfElement& geom, const MjcfDocument& document, ImportContext& context,
                                Pose& pose);

/// A sphere, capsule, cylinder, box or ellipsoid of MJCF's sizes. Throws InputError at `e` for too few.
Shape sized_shape(const std::string& type, const std::vector<double>& size, const XmlElement& e);

}  // namespace touchstone
