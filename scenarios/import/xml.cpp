#include "scenarios/import/xml.h"

#include <tinyxml2.h>

#include <cmath>

#include "core/base/exact_text.h"
#include "core/base/input_error.h"
#include "scenarios/codec/scene_codec.h"
#include "scenarios/text/printable.h"

namespace touchstone {
namespace {

constexpr std::uintmax_t max_xml_bytes = std::uintmax_t{64} << 20;
constexpr std::string_view blanks = " \t\r\n";

std::string quoted(const std::string& text) {
  constexpr std::size_t most = 60;
  std::string r = cut_utf8(printable(text), most);
  r.insert(r.begin(), '"');
  r.push_back('"');
  return r;
}

}  // namespace

std::optional<std::vector<double>> numbers_in(std::string_view text) {
  std::vector<double> v;
  for (std::size_t at = text.find_first_not_of(blanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
    std::string_view word = text.substr(at, end - at);
    if (word.front() == '+') word.remove_prefix(1);
    const auto x = double_from_text(word);
    if (!x || !std::isfinite(*x)) return std::nullopt;
    v.push_back(*x);
    at = text.find_first_not_of(blanks, end);
  }
  return v;
}

std::string XmlElement::name() const { return printable(e_->Name()); }
std::string XmlElement::place() const { return *file_ + ":" + std::to_string(e_->GetLineNum()); }
std::string XmlElement::said(const std::string& reason) const {
  std::string text;
  text.append(1, '<').append(name()).append(">: ").append(reason);
  return text;
}
void XmlElement::fail(const std::string& reason) const { throw InputError(place(), said(reason)); }

std::optional<std::string> XmlElement::attribute(std::string_view name) const {
  const char* value = e_->Attribute(std::string(name).c_str());
  return value ? std::optional<std::string>(value) : std::nullopt;
}

std::string XmlElement::need(std::string_view attribute_name) const {
  const auto v = attribute(attribute_name);
  if (!v) fail("lacks the attribute " + std::string(attribute_name));
  return *v;
}

std::vector<double> XmlElement::parsed(const std::string& text, const std::string& what) const {
  const auto v = numbers_in(text);
  if (!v) fail(what + quoted(text) + " is not a list of finite numbers");
  return *v;
}

std::vector<double> XmlElement::numbers(std::string_view name) const {
  const auto text = attribute(name);
  return text ? parsed(*text, std::string(name) + " ") : std::vector<double>();
}

std::optional<Vec3> XmlElement::vec3(std::string_view name) const {
  if (!attribute(name)) return std::nullopt;
  const auto v = numbers(name);
  if (v.size() != 3) fail(std::string(name) + " has " + std::to_string(v.size()) + " numbers instead of 3");
  return Vec3(v[0], v[1], v[2]);
}

std::optional<double> XmlElement::number(std::string_view name) const {
  if (!attribute(name)) return std::nullopt;
  const auto v = numbers(name);
  if (v.size() != 1) fail(std::string(name) + " has " + std::to_string(v.size()) + " numbers instead of 1");
  return v[0];
}

double XmlElement::need_number(std::string_view name) const {
  need(name);
  return *number(name);
}

std::string XmlElement::text() const {
  const char* raw = e_->GetText();
  const std::string_view s = raw ? raw : "";
  const std::size_t first = s.find_first_not_of(blanks);
  if (first == std::string_view::npos) return "";
  return std::string(s.substr(first, s.find_last_not_of(blanks) - first + 1));
}

std::vector<double> XmlElement::text_numbers() const { return parsed(text(), ""); }

std::vector<double> XmlElement::text_numbers(std::size_t count) const {
  auto v = text_numbers();
  if (v.size() != count)
    fail("has " + std::to_string(v.size()) + " numbers instead of " + std::to_string(count));
  return v;
}

std::vector<XmlElement> XmlElement::children() const {
  std::vector<XmlElement> r;
  for (auto* c = e_->FirstChildElement(); c; c = c->NextSiblingElement()) r.emplace_back(*c, *file_);
  return r;
}

std::vector<XmlElement> XmlElement::children(std::string_view name) const {
  std::vector<XmlElement> r;
  const std::string n(name);
  for (auto* c = e_->FirstChildElement(n.c_str()); c; c = c->NextSiblingElement(n.c_str()))
    r.emplace_back(*c, *file_);
  return r;
}

std::optional<XmlElement> XmlElement::child(std::string_view name) const {
  const auto* c = e_->FirstChildElement(std::string(name).c_str());
  return c ? std::optional<XmlElement>(std::in_place, *c, *file_) : std::nullopt;
}

XmlElement XmlElement::need_child(std::string_view name) const {
  const auto c = child(name);
  if (!c) fail("lacks a <" + std::string(name) + ">");
  return *c;
}

XmlFile::XmlFile(const std::filesystem::path& file)
    : name_(file.string()), document_(std::make_unique<tinyxml2::XMLDocument>()) {
  const std::string text = read_file(file, max_xml_bytes);
  if (document_->Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    const int line = document_->ErrorLineNum();
    throw InputError(line > 0 ? name_ + ":" + std::to_string(line) : name_,
                     std::string("is not well-formed XML (") +
                         tinyxml2::XMLDocument::ErrorIDToName(document_->ErrorID()) + ")");
  }
  if (!document_->RootElement()) throw InputError(name_, "has no XML element");
}

XmlFile::~XmlFile() = default;

XmlElement XmlFile::root() const { return {*document_->RootElement(), name_}; }

}  // namespace touchstone
