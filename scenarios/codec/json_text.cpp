#include "scenarios/codec/json_file.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <vector>

#include "core/base/exact_text.h"
#include "core/base/input_error.h"

namespace touchstone {
namespace {

using Json = nlohmann::ordered_json;

std::string line_and_column(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  return std::to_string(line) + ":" + std::to_string(std::max<std::size_t>(1, before.size() - start));
}

// The library's message is "[json.exception.parse_error.101] parse error at line 1, column 2: what; last
// read: 'text'". Our error already has the place, and the text last read may be any bytes.
std::string reason_of(const nlohmann::detail::exception& e, std::string_view at_error) {
  for (std::string_view word : {"NaN", "Infinity", "nan", "inf"})
    if (at_error.starts_with(word)) return std::string(word) + " is not a JSON number";
  std::string s = touchstone::reason_of(e);
  if (s.starts_with("parse error at"))
    if (const auto colon = s.find(": "); colon != std::string::npos) s.erase(0, colon + 2);
  if (const auto last = s.find("; last read: '"); last != std::string::npos) {
    const auto expected = s.rfind("'; expected ");
    s.erase(last, expected != std::string::npos && expected > last ? expected + 1 - last : std::string::npos);
  }
  return s;
}

class Builder final : public nlohmann::json_sax<Json> {
 public:
  Builder(std::string_view text, const std::string& place, std::size_t max_values)
      : text_(text), place_(place), left_(max_values) {}
  Json take() { return std::move(root_); }

  bool null() override {
    put(nullptr);
    return true;
  }
  bool boolean(bool v) override {
    put(v);
    return true;
  }
  // A negative integer token of value 0 is "-0": keep the sign.
  bool number_integer(number_integer_t v) override {
    if (v == 0) {
      put(-0.0);
    } else {
      put(v);
    }
    return true;
  }
  bool number_unsigned(number_unsigned_t v) override {
    put(v);
    return true;
  }
  bool number_float(number_float_t v, const string_t&) override {
    put(v);
    return true;
  }
  bool string(string_t& v) override {
    put(std::move(v));
    return true;
  }
  bool binary(binary_t&) override { return false; }  // not a JSON text event
  bool start_object(std::size_t) override {
    open(Json::object());
    return true;
  }
  bool start_array(std::size_t) override {
    open(Json::array());
    return true;
  }
  bool end_object() override {
    stack_.pop_back();
    keys_.pop_back();
    return true;
  }
  bool end_array() override {
    stack_.pop_back();
    keys_.pop_back();
    return true;
  }
  bool key(string_t& v) override {
    if (!keys_.back().insert(v).second)
      throw InputError(place_, "field \"" + v + "\" is given twice in one object");
    key_ = std::move(v);
    return true;
  }
  bool parse_error(std::size_t offset, const std::string&, const nlohmann::detail::exception& e) override {
    const std::string where = line_and_column(text_, offset);
    const std::string_view at_error = offset > 0 && offset <= text_.size() ? text_.substr(offset - 1) : "";
    throw InputError(place_.empty() ? where : place_ + ":" + where, reason_of(e, at_error));
  }

 private:
  Json* put(Json v) {
    if (left_-- == 0) throw InputError(place_, "has more values than the limit");
    if (stack_.empty()) {
      root_ = std::move(v);
      return &root_;
    }
    Json& top = *stack_.back();
    if (top.is_array()) {
      top.push_back(std::move(v));
      return &top.back();
    }
    // The object is a vector: append, since duplicates are already refused and a lookup would cost O(n).
    auto& object = top.get_ref<Json::object_t&>();
    object.emplace_back(std::move(key_), std::move(v));
    return &object.back().second;
  }
  void open(Json v) {
    if (static_cast<int>(stack_.size()) >= max_json_depth)
      throw InputError(place_, "is nested more than " + std::to_string(max_json_depth) + " levels deep");
    stack_.push_back(put(std::move(v)));
    keys_.emplace_back();
  }

  std::string_view text_;
  const std::string& place_;
  std::size_t left_;
  Json root_;
  std::vector<Json*> stack_;  // open containers; a container's address is stable while it is open
  std::vector<std::unordered_set<std::string>> keys_;
  std::string key_;
};

std::string number_text(double v) {
  if (!std::isfinite(v)) throw InputError("", "JSON cannot represent the number " + to_text(v));
  if (v == 0) return std::signbit(v) ? "-0.0" : "0";
  return to_text(v);
}

void write(const Json& j, std::string& out) {
  switch (j.type()) {
    case Json::value_t::object: {
      out += '{';
      bool first = true;
      for (const auto& [key, value] : j.items()) {
        if (!std::exchange(first, false)) out += ", ";
        write(key, out);
        out += ": ";
        write(value, out);
      }
      out += '}';
      return;
    }
    case Json::value_t::array: {
      out += '[';
      for (std::size_t i = 0; i < j.size(); ++i) {
        if (i) out += ", ";
        write(j[i], out);
      }
      out += ']';
      return;
    }
    case Json::value_t::number_float:
      out += number_text(j.get<double>());
      return;
    default:
      out += j.dump(-1, ' ', false, Json::error_handler_t::replace);
      return;
  }
}

}  // namespace

nlohmann::ordered_json parse_json(std::string_view text, const std::string& place) {
  return parse_json(text, place, {});
}

nlohmann::ordered_json parse_json(std::string_view text, const std::string& place, const JsonLimits& limits) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) throw InputError(place, "is empty");
  Builder builder(text, place, limits.values);
  if (!Json::sax_parse(text, &builder)) throw InputError(place, "is not JSON text");
  return builder.take();
}

std::string to_line(const nlohmann::ordered_json& j) {
  std::string out;
  write(j, out);
  return out;
}

std::string json_place(const std::string& prefix, const std::string& path) {
  if (prefix.empty()) return path;
  return path.empty() ? prefix : prefix + ": " + path;
}

}  // namespace touchstone
