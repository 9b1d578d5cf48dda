#include "tests/hostile/mutation.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace touchstone::test {
namespace {

using Json = nlohmann::ordered_json;

// Text that is hard for readers of numbers, names, paths or rationals.
const std::vector<std::string>& hostile_texts() {
  static const std::vector<std::string> all{"",
                                            "../../victim",
                                            "/tmp/x",
                                            "pipe:touch mark",
                                            "./evil.so",
                                            "all",
                                            "-1/-2",
                                            "1/-0",
                                            "1/0",
                                            "0/1",
                                            "-",
                                            "nan",
                                            "inf",
                                            "-inf",
                                            "1e999",
                                            "-00000000000000f",
                                            std::string(70'000, '7'),
                                            "\x1b[2J",
                                            std::string("a\0b", 3),
                                            "\xe2\x80\xae",
                                            "line\nline",
                                            std::string(2'000, 'x'),
                                            "core",
                                            "overlap",
                                            "sphere"};
  return all;
}

Json hostile_number(Rng& rng) {
  constexpr std::array numbers{0.0,    -0.0,          1.0,          -1.0,   0.5,
                               1e-308, 5e-324,        1e308,        -1e308, 1e154,
                               1e11,   99999999999.0, 2147483648.0, 9.3e18, 1.8446744073709552e19,
                               1e15};
  constexpr std::array<std::uint64_t, 4> large{UINT64_MAX, INT64_MAX, 1U << 31, 1U << 20};
  switch (rng.below(3)) {
    case 0:
      return numbers[rng.below(numbers.size())];
    case 1:
      return static_cast<std::int64_t>(rng.below(7)) - 3;
    default:
      return large[rng.below(large.size())];
  }
}

Json nest(Rng& rng) {
  Json deep = 1;
  for (std::uint64_t i = rng.below(80); i > 0; --i)
    deep = rng.chance(0.5) ? Json::array({deep}) : Json{{"k", deep}};
  return deep;
}

Json hostile_value(Rng& rng) {
  switch (rng.below(8)) {
    case 0:
      return nullptr;
    case 1:
      return rng.chance(0.5);
    case 2:
      return rng.chance(0.5) ? Json::array() : Json::object();
    case 3:
      return rng.chance(0.1) ? nest(rng) : Json(1);
    case 4:
    case 5:
    case 6:
      return hostile_number(rng);
    default:
      return hostile_texts()[rng.below(hostile_texts().size())];
  }
}

// All values of a document, containers included.
void collect(Json& j, std::vector<Json*>& into) {
  into.push_back(&j);
  if (j.is_structured())
    for (auto& child : j) collect(child, into);
}

void change_member(Json& at, Rng& rng) {
  if (!at.is_object() || at.empty()) return;
  auto member = at.begin();
  std::advance(member, static_cast<std::ptrdiff_t>(rng.below(at.size())));
  const Json value = *member;
  at.erase(member);
  if (rng.chance(0.5)) at[hostile_texts()[rng.below(hostile_texts().size())]] = value;
}

void change_items(Json& at, Rng& rng) {
  if (!at.is_array() || at.empty()) return;
  const std::size_t i = rng.below(at.size());
  const Json item = at[i];
  if (rng.chance(0.5))
    for (std::uint64_t n = rng.below(40); n > 0; --n) at.push_back(item);
  else
    at.erase(i);
}

std::string mutated_json(Json j, Rng& rng) {
  for (std::uint64_t n = 1 + rng.below(3); n > 0; --n) {
    std::vector<Json*> all;
    collect(j, all);
    Json& one = *all[rng.below(all.size())];
    const Json other = *all[rng.below(all.size())];
    switch (rng.below(6)) {
      case 0:
        change_member(one, rng);
        break;
      case 1:
        change_items(one, rng);
        break;
      case 2:
        one = other;
        break;
      default:
        one = hostile_value(rng);
    }
  }
  return j.dump(-1, ' ', false, Json::error_handler_t::ignore);
}

// A hundred thousand levels, which even a copy would not survive; rare, because it is large.
std::string nested(const std::string& text, Rng& rng) {
  const std::size_t at = text.find_first_of("[{", rng.below(text.size()));
  if (at == std::string::npos) return text;
  constexpr std::size_t levels = 100'000;
  return text.substr(0, at) + std::string(levels, '[') + std::string(levels, ']') + text.substr(at);
}

std::string mutated_bytes(std::string text, Rng& rng) {
  constexpr auto pieces =
      std::to_array<std::string_view>({"99999999999", "1e308", "-", "\xff", "\n", "nan", "[[["});
  if (text.empty()) return "x";
  for (std::uint64_t n = 1 + rng.below(8); n > 0 && !text.empty(); --n) {
    const std::size_t at = rng.below(text.size()),
                      length = 1 + rng.below(std::min<std::size_t>(64, text.size()));
    switch (rng.below(6)) {
      case 0:
      case 1:
        text[at] = static_cast<char>(rng.below(256));
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(at, text.substr(rng.below(text.size()), length));
        break;
      case 4:
        text.insert(at, pieces[rng.below(pieces.size())]);
        break;
      default:
        if (rng.chance(0.2)) text.resize(at);
    }
  }
  return text;
}

}  // namespace

Original original_of(std::string text) {
  Json j = Json::parse(text, nullptr, false);
  return {std::move(text), std::move(j)};
}

std::string mutated(const Original& good, Rng& rng) {
  if (good.json.is_discarded() || rng.chance(0.3)) return mutated_bytes(good.text, rng);
  return rng.chance(0.005) ? nested(good.text, rng) : mutated_json(good.json, rng);
}

}  // namespace touchstone::test
