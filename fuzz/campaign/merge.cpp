#include "fuzz/campaign/shard.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "core/base/input_error.h"
#include "fuzz/campaign/answers_file.h"
#include "fuzz/campaign/directory_lock.h"
#include "fuzz/campaign/store.h"
#include "reports/record/stored.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::fuzz {
namespace {

struct Part {
  std::filesystem::path from;
  Json settings;                      // as in an unsharded run
  std::uint64_t of = 1;               // shards in the whole campaign
  std::vector<std::uint64_t> shards;  // those in this part, sorted
  std::uint64_t chunks = 0;
  std::uint64_t answers_bytes = 0;
  CampaignResult result;
};

// Sorted and in range. Their total is limited, because every missing shard is listed.
std::vector<std::uint64_t> shards_of(const JsonReader& settings) {
  constexpr std::uint64_t max_shards = 1'000'000;
  const std::uint64_t of = count_of(settings["shards"]);
  if (of == 0 || of > max_shards) settings["shards"].fail("is not a valid number of shards");
  std::vector<std::uint64_t> shards;
  if (settings.has("merged"))
    for (const JsonReader& shard : settings["merged"].items()) shards.push_back(count_of(shard));
  else
    shards.push_back(count_of(settings["shard"]));
  const bool ascends =
      std::adjacent_find(shards.begin(), shards.end(), std::greater_equal<>()) == shards.end();
  if (shards.empty() || !ascends || shards.back() >= of)
    settings.fail("names shards that do not exist, or not in ascending order");
  return shards;
}

Part load_part(const std::filesystem::path& directory) {
  const auto file = directory / "state.json";
  const Json json = load_state_json(directory);
  const JsonReader j(json, file.string());
  if (!j["finished"].boolean())
    throw InputError(directory.string(), "is unfinished; resume it first (same command, same --out)");
  Part p;
  p.from = directory;
  const JsonReader settings = j["settings"];
  settings.require_object();
  p.settings = settings.json();
  p.of = count_of(settings["shards"]);
  p.shards = shards_of(settings);
  p.settings["shard"] = 0;
  p.settings["shards"] = 1;
  p.settings.erase("merged");
  p.chunks = count_of(j["next_chunk"]);
  p.result = result_with_evidence(j["result"]);
  if (j.has("answers_bytes")) p.answers_bytes = count_of(j["answers_bytes"]);
  return p;
}

void require_same_campaign(const Part& x, const Part& y) {
  if (x.settings != y.settings || x.of != y.of)
    throw InputError(y.from.string(),
                     fmt::format("belongs to a different campaign than {}: {} of {} shards, not {} of {}",
                                 x.from.string(), y.settings.dump(), y.of, x.settings.dump(), x.of));
}

bool includes(const Part& x, const Part& y) {
  return std::includes(x.shards.begin(), x.shards.end(), y.shards.begin(), y.shards.end());
}

// Keeps one of the parts that hold the same shards; their results must agree.
std::vector<Part> without_repeated(std::vector<Part> parts) {
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Part& x, const Part& y) { return x.shards.size() > y.shards.size(); });
  std::vector<Part> kept;
  for (Part& p : parts) {
    const auto holder = std::find_if(kept.begin(), kept.end(), [&](const Part& k) { return includes(k, p); });
    if (holder != kept.end()) {
      if (holder->shards == p.shards && digest(holder->result) != digest(p.result))
        throw InputError(p.from.string(),
                         "is the same shard as " + holder->from.string() + ", with different results");
      continue;
    }
    for (const Part& k : kept)
      for (const std::uint64_t s : p.shards)
        if (std::binary_search(k.shards.begin(), k.shards.end(), s))
          throw InputError(p.from.string(),
                           fmt::format("shares shard {} with {}, which does not hold all of its shards", s,
                                       k.from.string()));
    kept.push_back(std::move(p));
  }
  std::sort(kept.begin(), kept.end(), [](const Part& x, const Part& y) { return x.shards < y.shards; });
  return kept;
}

// Copies the blocks of all parts in the order of their cases. Returns the bytes written.
std::uint64_t merge_answers(const std::filesystem::path& out, const std::vector<Part>& parts) {
  struct Place {
    const AnswersFile* file;
    AnswersFile::Block block;
  };
  std::vector<AnswersFile> files;
  for (const Part& p : parts)
    if (p.answers_bytes > 0) files.emplace_back(p.from, p.answers_bytes);
  if (files.empty()) return 0;
  std::vector<Place> places;
  for (const AnswersFile& f : files) {
    if (f.header() != files[0].header())
      throw InputError((parts[0].from / answers_file_name).string(),
                       "the parts were answered by different versions of the engines");
    for (const auto& b : f.blocks()) places.push_back({&f, b});
  }
  std::sort(places.begin(), places.end(),
            [](const Place& x, const Place& y) { return x.block.first_index < y.block.first_index; });
  AnswersWriter writer(out, 0);
  writer.start(files[0].header());
  for (const Place& p : places) writer.append(p.file->block(p.block));
  return writer.bytes();
}

}  // namespace

Merged merge_campaigns(const std::filesystem::path& out, std::span<const std::filesystem::path> in) {
  if (in.empty()) throw InputError("merge", "no campaigns given");
  if (std::filesystem::exists(out / "state.json"))
    throw InputError(out.string(), "holds a campaign already; give another directory");
  std::vector<Part> parts;
  for (const auto& directory : in) {
    parts.push_back(load_part(directory));
    require_same_campaign(parts.front(), parts.back());
  }
  parts = without_repeated(std::move(parts));
  Merged m;
  StoredState state;
  state.finished = true;
  for (const Part& p : parts) {
    state.result.merge(p.result);
    state.next_chunk += p.chunks;
    m.shards.insert(m.shards.end(), p.shards.begin(), p.shards.end());
  }
  std::sort(m.shards.begin(), m.shards.end());
  for (std::uint64_t s = 0; s < parts[0].of; ++s)
    if (!std::binary_search(m.shards.begin(), m.shards.end(), s)) m.missing.push_back(s);
  Json settings = parts[0].settings;
  if (!m.missing.empty()) {
    settings["shards"] = parts[0].of;
    settings["merged"] = m.shards;
  }
  make_directory(out);
  const DirectoryLock lock(out, DirectoryLock::For::writing);
  state.answers_bytes = merge_answers(out, parts);
  save_findings(out, state.result);
  save_state(out, settings, state);
  m.result = std::move(state.result);
  return m;
}

}  // namespace touchstone::fuzz
