#include "oracles/abi/last_words.h"

#include <cxxabi.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <memory>
#include <vector>

#include "core/base/exact_text.h"
#include "core/base/hash.h"

namespace touchstone {
namespace {

constexpr std::size_t longest_detail = 1000, longest_line = 600, longest_site_word = 48;

std::vector<std::string_view> split(std::string_view text, std::string_view by) {
  std::vector<std::string_view> parts;
  for (std::size_t end; (end = text.find(by)) != std::string_view::npos; text.remove_prefix(end + by.size()))
    parts.push_back(text.substr(0, end));
  parts.push_back(text);
  return parts;
}

std::string_view file_name(std::string_view path) { return path.substr(path.rfind('/') + 1); }

// ---- what it printed

struct Place {
  std::string_view text;  // "dir/distance-inl.h:177" within the line
  /// "distance-inl.h:177", of "dir/distance-inl.h:(177" too.
  std::string label() const {
    std::string name(file_name(text));
    std::erase(name, '(');
    return name;
  }
};

/// The first "file.ext:line" or "file.ext:(line)" in a line, as assertions, panics and exceptions print it.
Place place_in(std::string_view line) {
  const auto in_path = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) ||
           std::string_view("_./+-").find(c) != std::string_view::npos;
  };
  for (std::size_t colon = line.find(':'); colon != std::string_view::npos;
       colon = line.find(':', colon + 1)) {
    std::size_t first_digit = colon + 1, begin = colon;
    if (first_digit < line.size() && line[first_digit] == '(') ++first_digit;
    std::size_t end = first_digit;
    while (end < line.size() && std::isdigit(static_cast<unsigned char>(line[end]))) ++end;
    while (begin > 0 && in_path(line[begin - 1])) --begin;
    const std::string_view file = line.substr(begin, colon - begin);
    if (end > first_digit && file_name(file).find('.') != std::string_view::npos && !file.ends_with('.'))
      return {line.substr(begin, end - begin)};
  }
  return {};
}

/// Rearranges glibc's "program: file:line: function: Assertion `x' failed." so that what matters comes first.
std::string assertion_first(std::string_view line, const Place& place) {
  constexpr std::string_view mark = ": Assertion `";
  const auto assertion = line.find(mark);
  if (assertion == std::string_view::npos || place.text.empty()) return std::string(line);
  const auto after_place = static_cast<std::size_t>(place.text.data() - line.data()) + place.text.size();
  if (after_place > assertion) return std::string(line);
  std::string_view what = line.substr(assertion + 2),
                   function = line.substr(after_place, assertion - after_place);
  if (what.ends_with('.')) what.remove_suffix(1);
  std::string out = place.label() + ": " + std::string(what);
  if (function.starts_with(": ")) out += " in " + std::string(function.substr(2));
  return out;
}

struct Said {
  std::string text, site;
};

/// The last line, or the last assertion if one was printed before it.
Said said(const std::vector<std::string_view>& lines) {
  std::string_view line;
  for (const std::string_view l : lines)
    if (!l.empty() && !(line.find(": Assertion `") != std::string_view::npos &&
                        l.find(": Assertion `") == std::string_view::npos))
      line = l;
  const Place place = place_in(line);
  return {assertion_first(line, place), place.label()};
}

/// The first error that Valgrind's memcheck reports (lines that begin with "==PID=="), with the innermost
/// function and the description of the address. Addresses are left out: they change from run to run.
Said memory_error(const std::vector<std::string_view>& lines) {
  constexpr std::string_view at = "   at 0x", address = " Address 0x";
  Said s;
  bool has_function = false;
  for (std::string_view l : lines) {
    const auto end = l.starts_with("==") ? l.find_first_not_of("0123456789", 2) : std::string_view::npos;
    if (end == std::string_view::npos || !l.substr(end).starts_with("== ")) continue;
    l.remove_prefix(end + 3);
    if (s.text.empty()) {
      if (l.starts_with("Invalid ") || l.starts_with("Mismatched ")) s.text = l;
    } else if (const auto colon = l.find(": "); !has_function && l.starts_with(at) && colon != l.npos) {
      s.text += " in ";
      s.text += l.substr(colon + 2);
      s.site = place_in(l.substr(colon + 2)).label();
      has_function = true;
    } else if (const auto is = l.find(" is "); l.starts_with(address) && is != l.npos) {
      s.text += ";";
      s.text += l.substr(is + 3);
      break;
    }
  }
  return s;
}

// ---- where it was

struct StackFrame {
  std::string module, offset, function;
};

std::string demangled(const std::string& name) {
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> text(
      abi::__cxa_demangle(name.c_str(), nullptr, nullptr, &status), &std::free);
  return status == 0 && text ? text.get() : name;
}

/// Strips template arguments, parameters, and the return type that precedes a function template's name.
std::string plain_name(std::string name) {
  constexpr std::string_view unnamed = "(anonymous namespace)::";
  for (std::size_t at; (at = name.find(unnamed)) != std::string::npos;) name.erase(at, unnamed.size());
  std::string out;
  int depth = 0;
  for (const char c : name) {
    if (c == '(' && depth == 0 && !out.empty()) break;
    if (c == '<' || c == '(') ++depth;
    if (depth == 0) out += c;
    if (c == '>' || c == ')') --depth;
  }
  return out.substr(out.rfind(' ') + 1);
}

/// The last two components of a name: enough to find the function.
std::string short_name(const std::string& plain) {
  const auto parts = split(plain, "::");
  if (parts.size() < 2) return plain;
  return std::string(parts[parts.size() - 2]) + "::" + std::string(parts.back());
}

StackFrame frame_from(std::string_view text) {
  const auto words = split(text, " ");
  StackFrame f;
  const auto plus = words[0].rfind('+');
  f.module = words[0].substr(0, plus);
  if (plus != std::string_view::npos) f.offset = words[0].substr(plus);
  if (words.size() > 1)
    f.function = plain_name(demangled(std::string(words[1].substr(0, words[1].rfind('+')))));
  return f;
}

std::vector<StackFrame> frames_in(const std::vector<std::string_view>& lines) {
  std::vector<StackFrame> frames;
  for (const std::string_view line : lines) {
    if (!line.starts_with(frames_prefix)) continue;
    frames.clear();
    for (const std::string_view f : split(line.substr(std::string_view(frames_prefix).size()), " | "))
      if (const auto word = f.find_first_not_of(' '); word != std::string_view::npos)
        frames.push_back(frame_from(f.substr(word)));
  }
  return frames;
}

/// The innermost function with a name. If no frame has one, only the module: offsets change with every build.
std::string site_of(const std::vector<StackFrame>& frames) {
  if (frames.empty()) return "";
  const auto named =
      std::find_if(frames.begin(), frames.end(), [](const StackFrame& f) { return !f.function.empty(); });
  const std::string& module = (named == frames.end() ? frames[0] : *named).module;
  const std::string library = module.substr(0, module.find(".so"));
  return named == frames.end() ? library : library + ":" + short_name(named->function);
}

std::string text_of(const std::vector<StackFrame>& frames) {
  std::string out;
  for (const StackFrame& f : frames)
    out += (out.empty() ? "" : " < ") + f.module + f.offset +
           (f.function.empty() ? "" : " (" + f.function + ")");
  return out;
}

void cut(std::string& s, std::size_t most) {
  if (s.size() > most) s.resize(most);
}

}  // namespace

LastWords last_words(std::string_view how, std::string_view standard_error, bool speaks) {
  std::vector<std::string_view> lines = split(standard_error, "\n");
  const std::vector<StackFrame> frames = frames_in(lines);
  std::erase_if(lines, [](std::string_view l) { return l.starts_with(frames_prefix); });
  LastWords out{std::string(how), ""};
  if (speaks) {
    Said s = memory_error(lines);
    if (s.text.empty()) s = said(lines);
    cut(s.text, longest_line);
    if (!s.text.empty()) out.detail += ": " + s.text;
    out.site = s.site;
  }
  if (out.site.empty()) out.site = site_of(frames);
  if (!frames.empty()) out.detail += "; at " + text_of(frames);
  cut(out.detail, longest_detail);
  std::replace_if(
      out.detail.begin(), out.detail.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return out;
}

std::string site_of_exception(std::string_view text) { return place_in(text).label(); }

std::string site_word(std::string_view site) {
  std::string out;
  for (const char c : site) {
    const auto u = static_cast<unsigned char>(c);
    if (u < 0x80 && (std::isalnum(u) || c == '_'))
      out += static_cast<char>(std::tolower(u));
    else if (!out.empty() && out.back() != '-')
      out += '-';
  }
  while (out.ends_with('-')) out.pop_back();
  if (out.size() <= longest_site_word) return out;
  return out.substr(0, longest_site_word - 9) + "-" +
         hex64(Hasher().add(std::string(site)).value()).substr(0, 8);
}

}  // namespace touchstone
