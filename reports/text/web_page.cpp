#include "reports/text/web_page.h"

#include <zlib.h>

#include <algorithm>
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

// The bytes that base64() was given. Throws InputError on anything else.
std::string from_base64(std::string_view text, const std::string& place) {
  const auto value = [&](char c) -> unsigned {
    if (c >= 'A' && c <= 'Z') return static_cast<unsigned>(c - 'A');
    if (c >= 'a' && c <= 'z') return static_cast<unsigned>(c - 'a') + 26;
    if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0') + 52;
    if (c == '+') return 62;
    if (c == '/') return 63;
    throw InputError(place, "the data of the page is not base64");
  };
  if (text.size() % 4 != 0) throw InputError(place, "the data of the page is cut off");
  const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with("=") ? 1 : 0;
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  for (std::size_t i = 0; i < text.size(); i += 4) {
    unsigned three = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const bool is_padding = i + k >= text.size() - padding;
      three = three << 6 | (is_padding ? 0U : value(text[i + k]));
    }
    for (const unsigned shift : {16U, 8U, 0U}) bytes += static_cast<char>(three >> shift & 0xFFU);
  }
  bytes.erase(bytes.size() - std::min(padding, bytes.size()));
  return bytes;
}

// Grows with what is there, so that a few bytes that claim to be gigabytes cost nothing.
std::string inflated(std::string_view bytes, const std::string& place, std::size_t most) {
  z_stream z{};
  if (inflateInit(&z) != Z_OK) throw std::runtime_error("zlib could not be started");
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  z.avail_in = static_cast<uInt>(bytes.size());
  std::string text;
  int state = Z_OK;
  while (state == Z_OK && text.size() <= most) {
    char piece[1 << 16];
    z.next_out = reinterpret_cast<Bytef*>(piece);
    z.avail_out = sizeof piece;
    state = inflate(&z, Z_NO_FLUSH);
    text.append(piece, sizeof piece - z.avail_out);
  }
  inflateEnd(&z);
  if (text.size() > most) throw InputError(place, "the data of the page is too long");
  if (state != Z_STREAM_END) throw InputError(place, "the data of the page is damaged");
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

std::optional<std::string> data_of_page(std::string_view page, const std::string& place, std::size_t most) {
  constexpr std::string_view before = "<script id=\"data\" type=\"application/json\">", after = "</script>",
                             packed = "{\"deflate\":\"", packed_end = "\"}";
  const auto from = page.find(before);
  if (from == std::string_view::npos) return std::nullopt;
  std::string_view data = page.substr(from + before.size());
  const auto end = data.find(after);
  if (end == std::string_view::npos) throw InputError(place, "the page is cut off");
  data = data.substr(0, end);
  if (!data.starts_with(packed)) return std::string(data);
  if (!data.ends_with(packed_end)) throw InputError(place, "the data of the page is damaged");
  data = data.substr(packed.size(), data.size() - packed.size() - packed_end.size());
  return inflated(from_base64(data, place), place, most);
}

}  // namespace touchstone::reports
