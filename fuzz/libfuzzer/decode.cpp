#include "fuzz/libfuzzer/decode.h"

#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "fuzz/campaign/campaign.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/random/family.h"

namespace touchstone::fuzz {
namespace {

constexpr std::size_t head_bytes = 9, change_bytes = 4, most_changes = 16;

}  // namespace

std::optional<Case> decode(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < head_bytes) return std::nullopt;
  std::uint64_t seed = 0;
  for (std::size_t i = 8; i > 0; --i) seed = seed << 8 | bytes[i];
  Case c = make_case(seed, 0, families()[bytes[0] % families().size()].name);
  bytes = bytes.subspan(head_bytes);
  for (std::size_t k = 0; k < most_changes && bytes.size() >= change_bytes; ++k) {
    const auto number = static_cast<std::uint16_t>(bytes[0] | bytes[1] << 8);
    if (!apply({number, bytes[2], bytes[3]}, c)) return std::nullopt;
    bytes = bytes.subspan(change_bytes);
  }
  return c;
}

std::vector<std::uint8_t> encode(std::uint8_t family, std::uint64_t seed, std::span<const Change> changes) {
  std::vector<std::uint8_t> r{family};
  for (int i = 0; i < 8; ++i) r.push_back(static_cast<std::uint8_t>(seed >> (8 * i)));
  for (const Change& c : changes)
    for (const int byte : {c.number & 255, c.number >> 8, int{c.kind}, int{c.argument}})
      r.push_back(static_cast<std::uint8_t>(byte));
  return r;
}

void judge_bytes(std::span<const std::uint8_t> bytes, const EnginePtr& engine) {
  const auto c = decode(bytes);
  if (!c) return;
  CampaignResult r;
  ask_and_judge(r, {&*c, 1}, 0, {&engine, 1}, 1);
  if (r.findings.empty()) return;
  for (const auto& [key, f] : r.findings) std::fprintf(stderr, "%s: %s\n", key.c_str(), f.words.c_str());
  std::fprintf(stderr, "%s\n", case_to_json(*c).dump().c_str());
  std::abort();
}

}  // namespace touchstone::fuzz
