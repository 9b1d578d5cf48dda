#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "cli/command.h"
#include "cli/output.h"
#include "core/base/input_error.h"
#include "reports/text/result_line.h"
#include "reports/text/text.h"
#include "reports/text/web_page.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/printable.h"

namespace touchstone::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using reports::ResultLine;

struct OpenOptions {
  std::string directory, out;
};

// Beyond these a directory is not one of results.
constexpr std::size_t most_files = 50'000;
constexpr int deepest = 12;
// A page states what it is near its beginning, and so does a record.
constexpr std::size_t telling_bytes = 4096;

struct Result {
  ResultLine line;
  fs::path record, page;  // one may be empty
  std::string command;    // makes the page, if there is none
};

struct Unreadable {
  fs::path file;
  std::string reason;
};

struct Listing {
  std::vector<Result> results;
  std::vector<Unreadable> unreadable;
};

// A campaign's directory. What it keeps as evidence is reached from its pages.
bool is_campaign(const fs::path& directory) {
  return fs::exists(directory / "state.json") || fs::exists(directory / "summary.json");
}
bool is_evidence(const fs::path& directory) {
  const std::string name = directory.filename().string();
  return (name == "findings" || name == "causes") && is_campaign(directory.parent_path());
}

// Regular files, sorted; links are not followed.
std::vector<fs::path> files_in(const fs::path& directory) {
  std::vector<fs::path> files;
  std::error_code ec;
  fs::recursive_directory_iterator at(directory, fs::directory_options::skip_permission_denied, ec), end;
  for (; !ec && at != end; at.increment(ec)) {
    const fs::path& path = at->path();
    if (fs::is_directory(at->symlink_status()) && (at.depth() >= deepest || is_evidence(path)))
      at.disable_recursion_pending();
    if (!fs::is_regular_file(at->symlink_status())) continue;
    files.push_back(path);
    if (files.size() > most_files)
      throw InputError(
          directory.string(),
          fmt::format("holds more than {} files; name the directory of the results", most_files));
  }
  if (ec) throw InputError(directory.string(), "cannot be read: " + ec.message());
  std::sort(files.begin(), files.end());
  return files;
}

bool may_be_record(std::string_view start) {
  return start.find("\"touchstone_") != start.npos || start.find("\"page\"") != start.npos ||
         start.find("\"pair_cases\"") != start.npos;
}

// The document in a file of ours; nullopt if it is none.
std::optional<ordered_json> document_in(const fs::path& file) {
  const std::string ending = file.extension().string();
  if (file.filename() == "state.json" || file.filename() == "finding.json") return std::nullopt;
  if (ending == ".json") {
    const std::string text = read_file(file, campaign_limits.bytes);
    if (!may_be_record(std::string_view(text).substr(0, telling_bytes))) return std::nullopt;
    return parse_json(text, file.string(), campaign_limits);
  }
  if (ending != ".html") return std::nullopt;
  const std::string html = read_file(file, campaign_limits.bytes);
  const std::optional<std::string> data = reports::data_of_page(html, file.string());
  if (!data) return std::nullopt;
  return parse_json(*data, file.string(), campaign_limits);
}

std::string command_for_page(const Result& r) {
  const fs::path directory = r.record.parent_path();
  const auto word = [](const fs::path& p) { return shell_word(printable(p.string())); };
  if (r.line.kind == "campaign")
    return fmt::format("{} report {} -o {}", program_name(), word(directory),
                       word(directory / "report.html"));
  if (r.line.kind == "causes" && is_campaign(directory))
    return fmt::format("{} causes {} --page {}", program_name(), word(directory),
                       word(directory / "causes.html"));
  if (r.line.kind == "case")
    return fmt::format("{} view {} -o {}", program_name(), word(r.record),
                       word(fs::path(r.record).replace_extension(".html")));
  return {};
}

// A record and the page that was made of it are one result.
void add(Listing& listing, std::map<std::string, std::size_t>& known, ResultLine line, const fs::path& file) {
  const auto [at, is_new] = known.emplace(line.kind + " " + line.identity, listing.results.size());
  if (is_new) listing.results.push_back({std::move(line), {}, {}, {}});
  Result& r = listing.results[at->second];
  fs::path& place = file.extension() == ".html" ? r.page : r.record;
  if (place.empty())
    place = file;
  else
    listing.results.push_back({r.line,
                               file.extension() == ".html" ? fs::path() : file,
                               file.extension() == ".html" ? file : fs::path(),
                               {}});
}

// A campaign that has no summary yet.
void add_unfinished(Listing& listing, const fs::path& state) {
  const fs::path directory = state.parent_path();
  if (fs::exists(directory / "summary.json")) return;
  Result r;
  r.line.kind = "campaign";
  r.line.content = "the same command continues it";
  r.line.verdict = "unfinished";
  r.line.mood = reports::Mood::open;
  r.record = state;
  listing.results.push_back(std::move(r));
}

Listing listing_of(const fs::path& directory) {
  Listing listing;
  std::map<std::string, std::size_t> known;
  for (const fs::path& file : files_in(directory)) {
    if (file.filename() == "state.json") add_unfinished(listing, file);
    try {
      const std::optional<ordered_json> document = document_in(file);
      if (!document) continue;
      if (std::optional<ResultLine> line = reports::result_line(*document, file.string()))
        add(listing, known, std::move(*line), file);
    } catch (const InputError& e) {
      listing.unreadable.push_back({file, e.what()});
    }
  }
  for (Result& r : listing.results)
    if (r.page.empty() && r.line.verdict != "unfinished") r.command = command_for_page(r);
  return listing;
}

// `directory` is absolute.
fs::path relative_to(const fs::path& directory, const fs::path& file) {
  return fs::absolute(file).lexically_normal().lexically_proximate(directory);
}

// A relative address: every byte that is not plain is escaped, so no name can be an address of another kind.
std::string address_of(const fs::path& file, const fs::path& from) {
  static constexpr std::string_view hex = "0123456789ABCDEF", plain = "-_.~/";
  std::string address = "./";
  for (const char c : relative_to(from, file).generic_string()) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_letter =
        (byte >= '0' && byte <= '9') || (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z');
    if (is_letter || plain.find(c) != plain.npos) {
      address += c;
      continue;
    }
    address += '%';
    address += hex[byte >> 4];
    address += hex[byte & 15];
  }
  return address;
}

ordered_json page_of(const Listing& listing, const OpenOptions& o, const fs::path& root,
                     const fs::path& out) {
  ordered_json results = ordered_json::array(), unreadable = ordered_json::array();
  const auto link = [&](const fs::path& file) -> ordered_json {
    if (file.empty()) return nullptr;
    return {{"name", relative_to(root, file).string()}, {"address", address_of(file, out.parent_path())}};
  };
  for (const Result& r : listing.results)
    results.push_back({{"kind", r.line.kind},
                       {"subject", r.line.subject},
                       {"content", r.line.content},
                       {"verdict", r.line.verdict},
                       {"mood", to_string(r.line.mood)},
                       {"page", link(r.page)},
                       {"record", link(r.record)},
                       {"command", r.command}});
  for (const Unreadable& u : listing.unreadable)
    unreadable.push_back({{"file", link(u.file)}, {"reason", u.reason}});
  return {{"page", "index"},
          {"version", 1},
          {"title", "results in " + printable(o.directory)},
          {"command", fmt::format("{} open {}", program_name(), shell_word(printable(o.directory)))},
          {"results", std::move(results)},
          {"unreadable", std::move(unreadable)}};
}

// An index.html that something else wrote is not replaced unless the user names it.
void require_own_index(const fs::path& out) {
  if (!fs::exists(out)) return;
  const auto data = reports::data_of_page(read_file(out, campaign_limits.bytes), out.string());
  if (!data || data->find("\"page\":\"index\"") == std::string::npos)
    throw InputError(out.string(), "exists and is not a page of this command; -o FILE names another");
}

void print_listing(const Listing& listing) {
  constexpr std::size_t width = 80, indent = 12;
  for (const Result& r : listing.results) {
    const std::string about = r.line.subject.empty() ? "" : r.line.subject + ": ";
    fmt::print("{}\n", reports::wrapped(fmt::format("{:<12}{}{}; {}", r.line.kind, printable(about),
                                                    printable(r.line.content), printable(r.line.verdict)),
                                        width, indent));
  }
  for (const Unreadable& u : listing.unreadable)
    fmt::print(stderr, "touchstone: cannot be read: {}\n", printable(u.reason));
}

int run(const OpenOptions& o) {
  if (!fs::is_directory(o.directory)) throw InputError(o.directory, "is not a directory");
  const fs::path root = fs::absolute(o.directory).lexically_normal();
  const fs::path out = fs::absolute(o.out.empty() ? o.directory + "/index.html" : o.out).lexically_normal();
  prepare_output(out.string());
  if (o.out.empty()) require_own_index(out);
  const Listing listing = listing_of(fs::path(o.directory).lexically_normal());
  if (listing.results.empty() && listing.unreadable.empty())
    throw InputError(o.directory, "holds no results: no campaign, certificate, chart, case or page");
  print_listing(listing);
  const ordered_json page = page_of(listing, o, root, out);
  if (!write_page("index", json_text(page), out)) return exit_failed;
  fmt::print("{}: open it in a browser\n", printable(o.out.empty() ? o.directory + "/index.html" : o.out));
  return listing.results.empty() ? exit_failed : exit_clean;
}

}  // namespace

Run declare_open(CLI::App& app) {
  auto o = std::make_shared<OpenOptions>();
  app.add_option(
         "directory", o->directory,
         "directory with results: campaigns, causes, certificates, charts, assessments, plans, cases, pages")
      ->required();
  app.add_option("-o,--out", o->out, "file for the page (default: index.html in the directory)");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
