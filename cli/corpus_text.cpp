#include "cli/corpus_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "reports/text/text.h"

namespace touchstone::cli {
namespace {

using fuzz::corpus::Score;

constexpr std::size_t columns_a_table = 5, most_mechanisms = 10;

std::string cell(const CorpusCount* c) {
  if (!c || c->attempted() == 0) return "-";
  return fmt::format("{}/{}", c->bad(), c->attempted());
}

const CorpusCount* count_of(const CorpusColumn& c, const std::string& group, const std::string& flag) {
  const auto g = c.flags.find(group);
  if (g == c.flags.end()) return nullptr;
  const auto f = g->second.find(flag);
  return f == g->second.end() ? nullptr : &f->second;
}

std::string row(const std::string& name, const std::vector<CorpusColumn>& columns,
                const std::function<const CorpusCount*(const CorpusColumn&)>& of) {
  std::string line = fmt::format("  {:<20}", name);
  for (const CorpusColumn& c : columns) line += fmt::format("{:>11}", cell(of(c)));
  return line + "\n";
}

std::vector<std::string> flags_of(const std::vector<CorpusColumn>& columns, const std::string& group) {
  std::set<std::string> flags;
  for (const CorpusColumn& c : columns)
    if (const auto g = c.flags.find(group); g != c.flags.end())
      for (const auto& [flag, count] : g->second) flags.insert(flag);
  return {flags.begin(), flags.end()};
}

// The flags of the group with the most wrong answers first.
std::vector<std::string> worst_first(const std::vector<CorpusColumn>& columns, const std::string& group) {
  std::vector<std::string> flags = flags_of(columns, group);
  std::map<std::string, std::uint64_t> bad;
  for (const CorpusColumn& c : columns)
    for (const std::string& flag : flags)
      if (const CorpusCount* n = count_of(c, group, flag)) bad[flag] += n->bad();
  std::stable_sort(flags.begin(), flags.end(),
                   [&](const std::string& a, const std::string& b) { return bad[a] > bad[b]; });
  return flags;
}

std::string group_text(const std::vector<CorpusColumn>& columns, const std::string& group,
                       const std::vector<std::string>& flags) {
  std::string text = group + "\n";
  for (const std::string& flag : flags)
    text += row(flag, columns, [&](const CorpusColumn& c) { return count_of(c, group, flag); });
  return text;
}

std::string table(const std::vector<CorpusColumn>& columns, std::size_t first, bool all) {
  std::string text = fmt::format("{:22}", "");
  for (std::size_t i = 0; i < columns.size(); ++i)
    text += fmt::format("{:>11}", fmt::format("[{}]", first + i));
  text += "\n" + row("all answers", columns, [](const CorpusColumn& c) { return &c.total; });
  for (const char* group : {"question", "degeneracy", "size"})
    text += group_text(columns, group, flags_of(columns, group));
  std::vector<std::string> mechanisms = worst_first(columns, "mechanism");
  const std::size_t shown = all ? mechanisms.size() : std::min(mechanisms.size(), most_mechanisms);
  const std::size_t further = mechanisms.size() - shown;
  mechanisms.resize(shown);
  text += group_text(columns, "mechanism", mechanisms);
  if (further > 0) text += fmt::format("  and {} further mechanisms (--all)\n", further);
  return text;
}

nlohmann::ordered_json count_json(const CorpusCount& c) {
  nlohmann::ordered_json j;
  for (std::size_t i = 0; i < c.of.size(); ++i) j[std::string(fuzz::corpus::score_names[i])] = c.of[i];
  return j;
}

}  // namespace

void add_scores(CorpusColumn& to, const fuzz::corpus::StoredCorpusCase& c,
                const std::vector<fuzz::corpus::Scored>& scores) {
  for (const fuzz::corpus::Scored& s : scores) {
    ++to.total[s.score];
    ++to.flags["question"][std::string(to_string(s.question))][s.score];
    ++to.flags["size"][c.size][s.score];
    ++to.flags["mechanism"][c.mechanism][s.score];
    for (const std::string& d : c.degeneracy) ++to.flags["degeneracy"][d][s.score];
  }
}

std::string corpus_table(const std::vector<CorpusColumn>& columns, bool all) {
  std::string text = "Wrong and failed answers of those attempted (-: none attempted)\n";
  for (std::size_t first = 0; first < columns.size(); first += columns_a_table) {
    const std::vector<CorpusColumn> part(
        columns.begin() + static_cast<std::ptrdiff_t>(first),
        columns.begin() + static_cast<std::ptrdiff_t>(std::min(columns.size(), first + columns_a_table)));
    for (std::size_t i = 0; i < part.size(); ++i) {
      const CorpusCount& t = part[i].total;
      text += fmt::format("[{}] {}: {} right, {} wrong, {} failed", first + i + 1, part[i].engine,
                          reports::grouped(t[Score::right]), reports::grouped(t[Score::wrong]),
                          reports::grouped(t[Score::failed]));
      if (t[Score::unsupported] > 0)
        text += fmt::format(", {} unsupported", reports::grouped(t[Score::unsupported]));
      if (t[Score::not_judged] > 0)
        text += fmt::format(", {} not judged", reports::grouped(t[Score::not_judged]));
      text += "\n";
    }
    text += table(part, first + 1, all);
  }
  return text;
}

nlohmann::ordered_json to_json(const CorpusColumn& c) {
  nlohmann::ordered_json j{{"engine", c.engine}, {"total", count_json(c.total)}};
  for (const auto& [group, flags] : c.flags)
    for (const auto& [flag, count] : flags) j["flags"][group][flag] = count_json(count);
  return j;
}

}  // namespace touchstone::cli
