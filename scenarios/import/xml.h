// XML with places: every element knows its file and line, and errors name both. Document types and entities
// other than XML's own are not expanded.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/pose.h"

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace touchstone {

/// An element of a document that must outlive it.
class XmlElement {
 public:
  XmlElement(const tinyxml2::XMLElement& e, const std::string& file) : e_(&e), file_(&file) {}

  std::string name() const;
  std::string place() const;  // "file:line"
  /// "<name>: reason".
  std::string said(const std::string& reason) const;
  /// Throws InputError "file:line: <name>: reason".
  [[noreturn]] void fail(const std::string& reason) const;

  std::optional<std::string> attribute(std::string_view name) const;
  std::string need(std::string_view attribute) const;
  /// The numbers, separated by blanks, of an attribute; `fallback` without it. The first form takes exactly
  /// `count` of them.
  std::vector<double> numbers(std::string_view attribute) const;
  std::optional<Vec3> vec3(std::string_view attribute) const;
  std::optional<double> number(std::string_view attribute) const;
  double need_number(std::string_view attribute) const;

  /// The element's own text, without surrounding blanks.
  std::string text() const;
  std::vector<double> text_numbers() const;
  std::vector<double> text_numbers(std::size_t count) const;

  std::vector<XmlElement> children() const;
  std::vector<XmlElement> children(std::string_view name) const;
  std::optional<XmlElement> child(std::string_view name) const;
  XmlElement need_child(std::string_view name) const;

 private:
  std::vector<double> parsed(const std::string& text, const std::string& what) const;
  const tinyxml2::XMLElement* e_;
  const std::string* file_;
};

class XmlFile {
 public:
  /// Throws InputError naming file and line when it is not well-formed.
  explicit XmlFile(const std::filesystem::path& file);
  ~XmlFile();
  XmlFile(const XmlFile&) = delete;
  XmlFile& operator=(const XmlFile&) = delete;
  XmlElement root() const;
  const std::string& name() const { return name_; }

 private:
  std::string name_;
  std::unique_ptr<tinyxml2::XMLDocument> document_;
};

/// All numbers of a text separated by blanks; empty when one of them is not a finite number.
std::optional<std::vector<double>> numbers_in(std::string_view text);

}  // namespace touchstone
