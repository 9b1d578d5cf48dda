#include "cli/npm_releases.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "cli/engine_catalog.h"
#include "cli/installed.h"
#include "cli/logged_command.h"
#include "core/base/input_error.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/name_list.h"

namespace touchstone::cli {
namespace {

namespace fs = std::filesystem;
using Numbers = std::vector<std::uint32_t>;

constexpr std::size_t most_numbers = 3, most_digits = 9;

// The numbers between the dots; empty if it is anything else.
Numbers numbers_of(std::string_view text) {
  Numbers all;
  while (all.size() < most_numbers) {
    const std::string_view digits = text.substr(0, text.find('.'));
    std::uint32_t n = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), n);
    const bool is_plain = digits == "0" || (!digits.empty() && digits[0] != '0');
    if (error != std::errc() || end != digits.data() + digits.size() || digits.size() > most_digits ||
        !is_plain)
      return {};
    all.push_back(n);
    if (digits.size() == text.size()) return all;
    text.remove_prefix(digits.size() + 1);
  }
  return {};
}

// npm prints one release as a string, several as an array.
std::vector<std::string> releases_in(const std::string& json, const std::string& place) {
  const auto j = parse_json(json, place);
  std::vector<std::string> all;
  for (const auto& release : j.is_array() ? j : nlohmann::ordered_json::array({j}))
    if (release.is_string() && is_release(release.get<std::string>())) all.push_back(release);
  sort_releases(all);
  return all;
}

// The newest patch of each minor release.
std::vector<std::string> newest_patches(std::span<const std::string> releases) {
  std::vector<std::string> newest;
  Numbers minor;
  for (const std::string& release : releases) {
    Numbers n = numbers_of(release);
    n.pop_back();
    if (n == minor) newest.pop_back();
    minor = std::move(n);
    newest.push_back(release);
  }
  return newest;
}

std::vector<const NpmRow*> rows_named(const std::string& name) {
  std::vector<const NpmRow*> rows;
  std::vector<std::string> known;
  for (const NpmRow& r : npm_catalog()) {
    if (r.name == name || r.name.starts_with(name + "-")) rows.push_back(&r);
    known.emplace_back(r.name);
  }
  if (rows.empty())
    throw InputError("--install " + name,
                     fmt::format("unknown; npm has {}{}", fmt::join(known, ", "), did_you_mean(name, known)));
  return rows;
}

// The release itself, or the newest of the package that begins so.
std::string release_matching(const NpmRow& row, const std::string& release, const std::string& name) {
  if (is_release(release)) return release;
  if (numbers_of(release).empty())
    throw InputError("--install " + name,
                     fmt::format("'{}' is not a release such as 1.1.0, 0.29 or 1", release));
  const std::string newest = newest_matching(published_releases(row.package), release);
  if (newest.empty())
    throw InputError("--install " + name,
                     fmt::format("npm has no release of {} that begins so", row.package));
  return newest;
}

}  // namespace

bool is_release(std::string_view text) { return numbers_of(text).size() == most_numbers; }

void sort_releases(std::vector<std::string>& releases) {
  std::sort(releases.begin(), releases.end(),
            [](const std::string& a, const std::string& b) { return numbers_of(a) < numbers_of(b); });
  releases.erase(std::unique(releases.begin(), releases.end()), releases.end());
}

void require_npm(const std::string& what) {
  for (const char* name : {"node", "npm"})
    if (program_on_path(name).empty())
      throw InputError(what, fmt::format("{} is missing; it is in Debian's packages nodejs and npm, "
                                         "which ./touchstone engines --install installs",
                                         name));
}

std::vector<std::string> published_releases(std::string_view package) {
  require_npm(fmt::format("releases of {}", package));
  const fs::path folder = npm_folder(), log = folder / "view.log";
  create_folder(folder);
  fs::remove(log);
  const Captured found =
      run_captured({"npm", "view", std::string(package), "versions", "--json", "--loglevel=error"}, log);
  if (!found.succeeded)
    throw InputError(fmt::format("releases of {}", package),
                     "npm could not be asked (it needs the network); full log: " + log.string());
  return releases_in(found.out, fmt::format("npm view {} versions", package));
}

std::string newest_matching(std::span<const std::string> releases, std::string_view beginning) {
  const Numbers wanted = numbers_of(beginning);
  const auto matches = [&](const std::string& release) {
    const Numbers n = numbers_of(release);
    return !wanted.empty() && std::equal(wanted.begin(), wanted.end(), n.begin());
  };
  const auto found = std::find_if(releases.rbegin(), releases.rend(), matches);
  return found == releases.rend() ? "" : *found;
}

std::vector<std::string> spread_releases(std::span<const std::string> releases, std::size_t count) {
  std::vector<std::string> among = newest_patches(releases);
  if (among.size() < count) among.assign(releases.begin(), releases.end());
  if (among.size() <= count) return among;
  std::vector<std::string> chosen;
  for (std::size_t i = 0; i < count; ++i)  // with one release, the newest
    chosen.push_back(among[count == 1 ? among.size() - 1 : i * (among.size() - 1) / (count - 1)]);
  return chosen;
}

std::vector<NpmEngine> npm_engines_matching(const std::string& name) {
  const auto at = name.find('@');
  const std::vector<const NpmRow*> rows = rows_named(name.substr(0, at));
  const std::string release =
      at == std::string::npos ? "" : release_matching(*rows.front(), name.substr(at + 1), name);
  std::vector<NpmEngine> engines;
  for (const NpmRow* row : rows) engines.push_back({row, release});
  return engines;
}

}  // namespace touchstone::cli
