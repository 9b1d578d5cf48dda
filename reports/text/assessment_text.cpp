#include <fmt/format.h>

#include <algorithm>

#include "reports/text/record_text.h"
#include "reports/text/text.h"
#include "scenarios/text/printable.h"

namespace touchstone::reports {
namespace {

using namespace fuzz;

constexpr std::size_t text_width = 79;
constexpr double millimetres = 1000;  // of a metre, the unit of robots

std::string in_millimetres(double metres) {
  return metres == 0 ? "0" : fmt::format("{:.3g}", metres * millimetres);
}

std::string count_of(std::uint64_t n) { return n == 0 ? "0" : grouped(n); }

std::string row_of(const AssessedEngine& e) {
  static const Tally none;
  const auto tally = [&](Question q) -> const Tally& {
    const auto it = e.tallies.find(q);
    return it == e.tallies.end() ? none : it->second;
  };
  const Tally &o = tally(Question::overlap), &d = tally(Question::distance);
  const auto silent = [](const Tally& t) { return count_of(t.failed() + t.unsupported() + t.not_asked()); };
  const bool by_distance = o.missed > 0 && e.padding == 0;
  const std::string padding = o.answered() == 0 ? "-"
                              : e.silent > 0    ? "unknown"
                              : by_distance     ? "by dist"
                                                : in_millimetres(e.padding);
  return fmt::format("{:<19}{:>7}{:>7}{:>7}{:>7} {:>6}{:>9}{:>6}{:>8}\n", cut_utf8(printable(e.name), 19),
                     count_of(o.missed), count_of(o.ghost), silent(o),
                     o.answered() ? nanoseconds(o.time.quantile(0.5)) : "-", count_of(d.wrong),
                     d.answered() ? in_millimetres(e.worst_distance_error) : "-", silent(d), padding);
}

std::string heading(const Assessment& a) {
  std::string text =
      fmt::format("{}{}: ", printable(a.robot), a.world.empty() ? "" : " in " + printable(a.world));
  text += a.of_trajectory ? fmt::format("{} of a trajectory. ", counted(a.configurations, "row", "rows"))
                          : fmt::format("{} drawn (seed {}). ",
                                        counted(a.configurations, "configuration", "configurations"), a.seed);
  text += fmt::format(
      "{} can collide in each; {} nearer than {} mm, {} asked, of which {} overlap and {} are apart{}.",
      counted(a.possible, "pair", "pairs"), grouped(a.near_pairs), in_millimetres(a.near), grouped(a.asked),
      grouped(a.overlapping), grouped(a.apart),
      a.undecided > 0 ? fmt::format(" ({} undecided)", grouped(a.undecided)) : "");
  if (a.interrupted) text += " Interrupted before all pairs were asked.";
  return wrapped(text, text_width, 2) + "\n\n";
}

std::string ghost_words(std::uint64_t ghosts) {
  return ghosts == 0 ? "" : fmt::format(", with {}", counted(ghosts, "ghost", "ghosts"));
}

std::string advice_words(const Assessment& a) {
  if (a.overlapping == 0)
    return "Nothing that was asked collides, so this run says nothing about missed collisions. Ask more "
           "configurations (--samples), or others (--trajectory).";
  const std::vector<Advice> list = advice_on(a);
  if (list.empty())
    return "No engine answered every pair without leaving a collision unreported at any padding.";
  const Advice& best = list.front();
  std::string text =
      !best.by_distance
          ? fmt::format("Advice: {} missed no collision without padding{}; {} ns a test.", best.engine,
                        ghost_words(best.ghosts), nanoseconds(best.median_ns))
          : fmt::format(
                "Advice: {} with a padding of {} mm (its overlap test, or a distance of at most that) missed "
                "no collision; the overlap test of every engine that answers all pairs misses some.",
                best.engine, in_millimetres(best.padding));
  const auto faster = std::min_element(
      list.begin(), list.end(), [](const Advice& x, const Advice& y) { return x.median_ns < y.median_ns; });
  if (faster->engine != best.engine)
    text += fmt::format(" {} is faster, {} ns, and needs a padding of {} mm{}.", faster->engine,
                        nanoseconds(faster->median_ns), in_millimetres(faster->padding),
                        ghost_words(faster->ghosts));
  return text + " This holds for what was asked, not for every configuration.";
}

}  // namespace

std::string assessment_text(const Assessment& a) {
  std::string text = heading(a);
  text +=
      fmt::format("{:<19}{:>28} {:>29}\n", "", "overlap test --------------", "distance (mm) ----  padding");
  text += fmt::format("{:<19}{:>7}{:>7}{:>7}{:>7} {:>6}{:>9}{:>6}{:>8}\n", "engine", "missed", "ghosts",
                      "none", "ns", "wrong", "worst", "none", "mm");
  for (const AssessedEngine& e : a.engines) text += row_of(e);
  return text + "\n" + wrapped(advice_words(a), text_width, 2) + "\n";
}

}  // namespace touchstone::reports
