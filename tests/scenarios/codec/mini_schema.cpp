#include "tests/scenarios/codec/mini_schema.h"

#include <stdexcept>

namespace touchstone::test {
namespace {

bool is_type(const Json& v, const std::string& type) {
  if (type == "object") return v.is_object();
  if (type == "array") return v.is_array();
  if (type == "string") return v.is_string();
  if (type == "number") return v.is_number();
  if (type == "integer") return v.is_number_integer();
  if (type == "boolean") return v.is_boolean();
  throw std::runtime_error("type " + type);
}

std::string object_violation(const Json& root, const Json& schema, const Json& v, const std::string& path) {
  for (const Json& name : schema.value("required", Json::array()))
    if (!v.contains(name.get<std::string>())) return path + " lacks " + name.get<std::string>();
  const Json properties = schema.value("properties", Json::object());
  for (const auto& [key, item] : v.items()) {
    if (properties.contains(key)) {
      const std::string s = schema_violation(root, properties[key], item, path + "." + key);
      if (!s.empty()) return s;
    } else if (schema.contains("additionalProperties") && !schema["additionalProperties"].get<bool>()) {
      return path + " has unknown " + key;
    }
  }
  return "";
}

std::string array_violation(const Json& root, const Json& schema, const Json& v, const std::string& path) {
  if (schema.contains("minItems") && v.size() < schema["minItems"].get<std::size_t>())
    return path + " is too short";
  if (schema.contains("maxItems") && v.size() > schema["maxItems"].get<std::size_t>())
    return path + " is too long";
  if (!schema.contains("items")) return "";
  for (std::size_t i = 0; i < v.size(); ++i) {
    const std::string s = schema_violation(root, schema["items"], v[i], path + "[" + std::to_string(i) + "]");
    if (!s.empty()) return s;
  }
  return "";
}

}  // namespace

std::string schema_violation(const Json& root, const Json& schema, const Json& v, const std::string& path) {
  for (const auto& [word, arg] : schema.items()) {
    std::string bad;
    if (word == "$ref") {
      bad = schema_violation(root, root.at(Json::json_pointer(arg.get<std::string>().substr(1))), v, path);
    } else if (word == "type") {
      if (!is_type(v, arg.get<std::string>())) bad = path + " is not of type " + arg.get<std::string>();
    } else if (word == "const") {
      if (v != arg) bad = path + " is not " + arg.dump();
    } else if (word == "minimum") {
      if (v.is_number() && v.get<double>() < arg.get<double>()) bad = path + " is below the minimum";
    } else if (word == "maximum") {
      if (v.is_number() && v.get<double>() > arg.get<double>()) bad = path + " is above the maximum";
    } else if (word == "exclusiveMinimum") {
      if (v.is_number() && v.get<double>() <= arg.get<double>()) bad = path + " is not above the minimum";
    } else if (word == "oneOf") {
      int matches = 0;
      for (const Json& option : arg) matches += schema_violation(root, option, v, path).empty();
      if (matches != 1) bad = path + " matches " + std::to_string(matches) + " of the choices";
    } else if (word == "properties") {
      if (v.is_object()) bad = object_violation(root, schema, v, path);
    } else if (word == "items") {
      if (v.is_array()) bad = array_violation(root, schema, v, path);
    } else if (word != "required" && word != "additionalProperties" && word != "minItems" &&
               word != "maxItems" && word != "$schema" && word != "$id" && word != "title" &&
               word != "description" && word != "$defs") {
      throw std::runtime_error("keyword " + word);
    }
    if (!bad.empty()) return bad;
  }
  return "";
}

}  // namespace touchstone::test
