#include "reports/text/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scenarios/text/printable.h"

namespace touchstone::reports {

using fuzz::CampaignResult;
using fuzz::Finding;
using fuzz::Tally;

std::string grouped(std::uint64_t n) {
  const std::string digits = std::to_string(n);
  std::string s;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) s += ',';
    s += digits[i];
  }
  return s;
}

std::string counted(std::uint64_t n, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", grouped(n), n == 1 ? one : many);
}

std::string clock_text(double seconds) {
  const auto s = static_cast<long long>(std::max(0.0, seconds) + 0.5);
  if (s >= 3600) return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
  return fmt::format("{}:{:02}", s / 60, s % 60);
}

std::string small(double x) { return x == 0 ? "0" : fmt::format("{:.1e}", x); }

std::string nanoseconds(double ns) {
  if (ns == 0) return "-";
  constexpr double kilo = 1e3, mega = 1e6, giga = 1e9;  // prefixes of the SI
  if (ns < kilo) return fmt::format("{:.0f}", ns);
  if (ns < mega) return fmt::format("{:.1f}k", ns / kilo);
  if (ns < giga) return fmt::format("{:.1f}M", ns / mega);
  return fmt::format("{:.1f}G", ns / giga);
}

std::string duration(double ns) {
  constexpr std::array<std::string_view, 4> units{"ns", "µs", "ms", "s"};
  constexpr double step = 1000;
  std::size_t unit = 0;
  // What would be rounded to 1000 is stated in the next unit.
  for (; unit + 1 < units.size() && std::round(ns) >= step; ++unit) ns /= step;
  return ns == std::floor(ns) || unit == 0 ? fmt::format("{:.0f} {}", ns, units[unit])
                                           : fmt::format("{:.1f} {}", ns, units[unit]);
}

std::string wrapped(const std::string& words, std::size_t width, std::size_t indent) {
  const std::string text = printable(words, "\n");
  std::size_t start = std::min(text.find_first_not_of(' '), text.size());
  std::string out, line(start, ' ');  // the first line keeps its own indentation
  bool fresh = true;
  while (start < text.size()) {
    const std::size_t end = std::min(text.find(' ', start), text.size());
    const std::string word = text.substr(start, end - start);
    if (!fresh && line.size() + 1 + word.size() > width) {
      out += line + "\n";
      line = std::string(indent, ' ');
      fresh = true;
    }
    line += (fresh ? "" : " ") + word;
    fresh = false;
    start = end + 1;
  }
  return out + line;
}

std::string labelled(const std::string& label, std::size_t label_width, const std::string& words) {
  constexpr std::size_t terminal_width = 79;
  return wrapped(fmt::format("  {:<{}}{}", label, label_width, words), terminal_width, label_width + 2) +
         "\n";
}

namespace {

// Names short enough for the table's column.
constexpr auto short_names =
    std::to_array<std::string_view>({"overlap", "distance", "contact", "impact", "pairs", "scene", "swept",
                                     "within", "bounded", "near", "ray", "c.margin"});
static_assert(short_names.size() == question_names.size());

// A time that includes the pipe is marked.
std::string time_of(const Tally& t, double share) {
  return nanoseconds(t.time.quantile(share)) + (t.times_include_pipe && t.answered() > 0 ? "p" : "");
}

std::string row(Question q, const Tally& t) {
  if (t.answered() == 0 && t.failed() == 0 && t.not_asked() == 0)
    return fmt::format(" {:<8} {:>7}\n", short_names[static_cast<std::size_t>(q)], "cannot");
  return fmt::format(" {:<8} {:>7} {:>7} {:>6} {:>6} {:>6} {:>6} {:>8} {:>7} {:>8}\n",
                     short_names[static_cast<std::size_t>(q)], t.answered(), t.right, t.wrong, t.missed,
                     t.ghost, t.failed(), small(t.worst_in_l), time_of(t, 0.5),
                     time_of(t, fuzz::tail_quantile));
}

// The answers that the row's counts leave out; empty if there are none.
std::string open_line(const Tally& t) {
  std::vector<std::string> parts;
  if (t.undecided > 0) parts.push_back(fmt::format("{} undecided", grouped(t.undecided)));
  if (t.by_definition > 0)
    parts.push_back(
        fmt::format("{} not judged by definition (depth of a surface)", grouped(t.by_definition)));
  if (const auto n = t.not_judged - t.by_definition; n > 0)
    parts.push_back(fmt::format("{} not judged", grouped(n)));
  if (t.within_wide_claim > 0)
    parts.push_back(
        fmt::format("{} right only within a claimed tolerance above 1e-2 L", grouped(t.within_wide_claim)));
  std::string s;
  for (const std::string& p : parts) s += (s.empty() ? "          " : ", ") + p;
  return s.empty() ? s : wrapped(s, 79, 12) + "\n";
}

struct Group {
  std::uint64_t count = 0;
  std::size_t keys = 0;
  const Finding* example = nullptr;
  double worst = 0;
};

std::string group_lines(const std::string& title, const Group& g) {
  const std::string pairs = g.keys == 1 ? g.example->shapes : fmt::format("{} shape pairs", g.keys);
  const std::string worst = g.worst > 0 ? fmt::format(", worst {} L", small(g.worst)) : "";
  std::string text = fmt::format("  {:<26} {:>6} {}, {}{}\n", title, grouped(g.count),
                                 g.count == 1 ? "time" : "times", pairs, worst);
  text += wrapped(fmt::format("    e.g. {}: {}", g.example->shapes, g.example->words), 78, 6) + "\n";
  return text;
}

}  // namespace

std::string full_campaign_table(const CampaignResult& r) {
  std::string s = fmt::format(" {:<8} {:>7} {:>7} {:>6} {:>6} {:>6} {:>6} {:>8} {:>7} {:>8}\n", "", "answers",
                              "right", "wrong", "missed", "ghost", "failed", "worst/L", "ns med", "ns p99");
  bool pipe = false;
  for (const auto& [engine, questions] : r.tallies) {
    s += engine + "\n";
    for (const auto& [q, t] : questions) {
      s += row(q, t) + open_line(t);
      pipe |= t.times_include_pipe;
    }
  }
  if (pipe) s += "p: the time includes the pipe; the engine states none of its own\n";
  return s;
}

std::string findings_summary(const CampaignResult& r, std::size_t per_engine) {
  std::map<std::string, std::map<std::string, Group>> engines;
  for (const auto& [key, f] : r.findings) {
    Group& g =
        engines[f.engine][f.question + " " + f.fault + (f.blame == "representation" ? " (rounding)" : "")];
    g.count += f.count;
    ++g.keys;
    g.worst = std::max(g.worst, f.worst_in_l);
    if (!g.example || f.worst_in_l > g.example->worst_in_l) g.example = &f;
  }
  std::string s;
  for (const auto& [engine, groups] : engines) {
    std::vector<std::pair<std::string, Group>> sorted(groups.begin(), groups.end());
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& x, const auto& y) { return x.second.count > y.second.count; });
    s += engine + "\n";
    for (std::size_t i = 0; i < std::min(per_engine, sorted.size()); ++i)
      s += group_lines(sorted[i].first, sorted[i].second);
    if (sorted.size() > per_engine) s += fmt::format("  and {} more kinds\n", sorted.size() - per_engine);
  }
  return s;
}

static std::string slow_lines(const CampaignResult& r) {
  std::string s;
  for (const auto& [engine, questions] : r.tallies)
    for (const auto& [q, t] : questions)
      if (t.slow > 0)
        s += fmt::format("slow: {} of {}'s answers to {} took longer than the time limit\n", grouped(t.slow),
                         engine, to_string(q));
  return s;
}

static std::string slow_line(const CampaignResult& r) {
  std::uint64_t slow = 0;
  std::size_t engines = 0;
  for (const auto& [engine, questions] : r.tallies) {
    std::uint64_t of_engine = 0;
    for (const auto& [q, t] : questions) of_engine += t.slow;
    slow += of_engine;
    engines += of_engine > 0;
  }
  if (slow == 0) return "";
  return fmt::format("slow: {} of {} took longer than the time limit\n", counted(slow, "answer", "answers"),
                     counted(engines, "engine", "engines"));
}

std::string campaign_footer(const CampaignResult& r, bool full) {
  const auto share = [&](std::int64_t ns) {
    return r.total_ns > 0 ? 100.0 * static_cast<double>(ns) / static_cast<double>(r.total_ns) : 0.0;
  };
  const double engines = share(r.engine_ns), judge = share(r.judge_ns);
  std::string s =
      fmt::format("{} cases; {:.0f} % of the pairs touch or overlap; {} undecided by the referee\n",
                  grouped(r.cases), 100 * r.hit_rate(), grouped(r.undecided));
  if (r.not_refereed > 0)
    s += fmt::format("{} cases that no engine answers were not refereed\n", grouped(r.not_refereed));
  if (const std::uint64_t n = r.levels[0] + r.levels[1] + r.levels[2]; full && n > 0)
    s += fmt::format("referee: {} pairs settled by doubles, {} in extended precision, {} exactly\n",
                     grouped(r.levels[0]), grouped(r.levels[1]), grouped(r.levels[2]));
  s += full ? slow_lines(r) : slow_line(r);
  std::uint64_t asked = 0, broken = 0;
  for (const auto& [engine, of_engine] : r.relations)
    for (const auto& [name, n] : of_engine) {
      asked += n.asked;
      broken += n.broken;
    }
  if (asked > 0)
    s += fmt::format("relations: {} derived cases asked, {} contradict the engine's own answers\n",
                     grouped(asked), grouped(broken));
  if (full && r.pair_rate() > 0)
    s += fmt::format("{} pair cases, {} per core-second (excl. motions, crowds, relations)\n",
                     grouped(r.pair_asked), grouped(static_cast<std::uint64_t>(r.pair_rate())));
  for (const auto& [engine, aside] : r.set_aside)
    s += wrapped(fmt::format("{}: {}; from case {} on, {} queries were not asked", engine, aside.why,
                             grouped(aside.first_index), grouped(r.not_asked_of(engine))),
                 78, 2) +
         "\n";
  if (full)
    s += fmt::format("time: engines {:.0f} %, harness {:.0f} % (referee and judge {:.0f} %)\n", engines,
                     100 - engines, judge);
  return s;
}

}  // namespace touchstone::reports
