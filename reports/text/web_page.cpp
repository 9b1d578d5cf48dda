#include "reports/text/web_page.h"

#include <zlib.h>

#include <stdexcept>

#include "core/base/input_error.h"

namespace touchstone::reports {
namespace {

std::string base64(std::string_view bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(bytes.size() / 3 * 4 + 4);
  const auto byte = [&](std::size_t i) -> unsigned {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0;
  };
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    text += digits[three >> 18];
    text += digits[three >> 12 & 63];
    text += i + 1 < bytes.size() ? digits[three >> 6 & 63] : '=';
    text += i + 2 < bytes.size() ? digits[three & 63] : '=';
  }
  return text;
}

}  // namespace

std::string json_for_script(std::string_view json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json)
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

std::string deflated(std::string_view json) {
  uLongf size = compressBound(static_cast<uLong>(json.size()));
  std::string bytes(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(json.data()),
                static_cast<uLong>(json.size()), 6) != Z_OK)
    throw std::runtime_error("zlib could not compress a page's data");
  return "{\"deflate\":\"" + base64(std::string_view(bytes).substr(0, size)) + "\"}";
}

std::string web_page(std::string built, std::string_view json) {
  constexpr std::string_view placeholder = "__TOUCHSTONE_DATA__";
  const auto at = built.find(placeholder);
  if (at == std::string::npos)
    throw InputError("page", "has no placeholder for data; was it built from another version?");
  return built.replace(at, placeholder.size(),
                       json.size() < compressed_from ? json_for_script(json) : deflated(json));
}

}  // namespace touchstone::reports
