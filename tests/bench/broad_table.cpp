#include "tests/bench/broad_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

namespace touchstone::bench {
namespace {

bool ours(const BroadRow& r) { return r.method.starts_with("touchstone:"); }
bool plain(const BroadRow& r) { return r.method.starts_with("plain_"); }
bool sorted_plain(const BroadRow& r) { return plain(r) && r.method.ends_with("_sorted"); }

const BroadRow* best(const std::vector<BroadRow>& rows, const BroadRow& cell,
                     const std::function<bool(const BroadRow&)>& of) {
  const BroadRow* least = nullptr;
  for (const BroadRow& r : rows)
    if (r.scene == cell.scene && r.n == cell.n && of(r) && !r.wrong &&
        (least == nullptr || r.mean_ms() < least->mean_ms()))
      least = &r;
  return least;
}

std::string ratio_to(const BroadRow* other, double ms) {
  return other == nullptr ? "-" : fmt::format("{:.2f}x {}", other->mean_ms() / ms, other->method);
}

std::string slopes(const std::vector<BroadRow>& rows) {
  std::string text;
  for (const BroadRow& a : rows) {
    for (const BroadRow& b : rows)
      if (a.scene == b.scene && a.method == b.method && b.n == 10 * a.n && a.n >= 10000 && !a.wrong &&
          !b.wrong)
        text += fmt::format("{:<10} {:<38} {:>7} to {:>7}  {:.2f}\n", a.scene, a.method, a.n, b.n,
                            std::log10(b.mean_ms() / a.mean_ms()));
  }
  return text.empty() ? text : "growth: slope of log time against log n\n" + text;
}

std::string worked_example(const std::vector<BroadRow>& rows) {
  for (const BroadRow& r : rows)
    if (r.scene == "uniform" && r.n == 1000 && r.method == "touchstone:automatic" && r.pairs > 0) {
      const double all = 0.5 * r.n * (r.n - 1);
      return fmt::format(
          "worked example, n = 1000: {:.0f} exact tests without a broad phase, {} with: {:.0f}x fewer\n", all,
          r.pairs, all / static_cast<double>(r.pairs));
    }
  return {};
}

}  // namespace

double BroadRow::mean_ms() const {
  const std::size_t a_round = frame_ms.size() / static_cast<std::size_t>(std::max(rounds, 1));
  double least = HUGE_VAL;
  for (std::size_t r = 0; a_round > 0 && r + a_round <= frame_ms.size(); r += a_round) {
    double sum = 0;
    for (std::size_t f = 0; f < a_round; ++f) sum += frame_ms[r + f];
    least = std::min(least, sum / static_cast<double>(a_round));
  }
  return least;
}

double BroadRow::quantile_ms(double q) const {
  if (frame_ms.empty()) return 0;
  std::vector<double> v = frame_ms;
  std::sort(v.begin(), v.end());
  return v[static_cast<std::size_t>(q * static_cast<double>(v.size() - 1))];
}

std::string broad_text(const std::vector<BroadRow>& rows) {
  std::string text, cell;
  for (const BroadRow& r : rows) {
    const std::string here = fmt::format("{} {}", r.scene, r.n);
    if (here != cell)
      text += fmt::format("\n{:<38} {:>10} {:>10} {:>10} {:>8} {:>10} {:>9} {:>7}\n", cell = here, "mean ms",
                          "median", "p99", "ns/box", "pairs", "precision", "B/box");
    text += fmt::format(
        "  {:<36} {:>10.4f} {:>10.4f} {:>10.4f} {:>8.1f} {:>10} {:>9} {:>7}  {}{}\n", r.method, r.mean_ms(),
        r.quantile_ms(0.5), r.quantile_ms(0.99), r.mean_ms() * 1e6 / r.n,
        r.answers ? std::to_string(r.pairs) : "-",
        !r.answers ? "-"
        : r.reported == 0 || r.pairs == 0
            ? "1"
            : fmt::format("{:.3f}", static_cast<double>(r.pairs) / static_cast<double>(r.reported)),
        r.bytes == 0 ? "-" : fmt::format("{:.0f}", static_cast<double>(r.bytes) / r.n),
        r.wrong ? "WRONG PAIRS " : "", r.note);
  }
  return text;
}

std::string broad_summary(const std::vector<BroadRow>& rows) {
  std::string text = fmt::format("\n{:<18} {:>9}  {:<18} {:<25} {:<24} {}\n", "automatic", "ms", "plain",
                                 "plain, sorted", "over best fixed", "time / bound");
  double worst = 0, least_plain = HUGE_VAL;
  std::string worst_cell, plain_cell;
  for (const BroadRow& r : rows) {
    if (r.method != "touchstone:automatic") continue;
    const double ms = r.mean_ms();
    const BroadRow* fixed =
        best(rows, r, [](const BroadRow& o) { return ours(o) && o.method != "touchstone:automatic"; });
    const BroadRow* bound = best(rows, r, [](const BroadRow& o) { return !o.answers; });
    const BroadRow* simple = best(rows, r, plain);
    const std::string cell = fmt::format("{} {}", r.scene, r.n);
    if (fixed != nullptr && ms / fixed->mean_ms() > worst) {
      worst = ms / fixed->mean_ms();
      worst_cell = cell;
    }
    if (simple != nullptr && simple->mean_ms() / ms < least_plain) {
      least_plain = simple->mean_ms() / ms;
      plain_cell = cell;
    }
    text += fmt::format(
        "{:<18} {:>9.4f}  {:<18} {:<25} {:<24} {}\n", cell, ms, ratio_to(simple, ms),
        ratio_to(best(rows, r, sorted_plain), ms),
        fixed == nullptr ? "-" : fmt::format("{:.2f} {}", ms / fixed->mean_ms(), fixed->method.substr(11)),
        bound == nullptr ? "-" : fmt::format("{:.2f}", ms / bound->mean_ms()));
  }
  if (!worst_cell.empty())
    text += fmt::format("automatic over the best fixed method, worst cell: {:.2f} at {} (limit 1.10: {})\n",
                        worst, worst_cell, worst <= 1.1 ? "kept" : "exceeded");
  if (!plain_cell.empty())
    text += fmt::format("better plain competitor over automatic, worst cell: {:.2f} at {} (floor 2: {})\n",
                        least_plain, plain_cell, least_plain >= 2 ? "kept" : "missed");
  return text + worked_example(rows) + slopes(rows);
}

std::string broad_csv(const std::vector<BroadRow>& rows) {
  std::string text = "scene,n,method,mean_ms,median_ms,p99_ms,frames,pairs,reported,bytes,wrong_pairs\n";
  for (const BroadRow& r : rows)
    text += fmt::format("{},{},{},{:.6f},{:.6f},{:.6f},{},{},{},{},{}\n", r.scene, r.n, r.method, r.mean_ms(),
                        r.quantile_ms(0.5), r.quantile_ms(0.99), r.frame_ms.size(), r.pairs, r.reported,
                        r.bytes, r.wrong ? 1 : 0);
  return text;
}

std::string broad_json(const std::vector<BroadRow>& rows) {
  nlohmann::json all = nlohmann::json::array();
  for (const BroadRow& r : rows)
    all.push_back({{"scene", r.scene},
                   {"n", r.n},
                   {"method", r.method},
                   {"mean_ms", r.mean_ms()},
                   {"frame_ms", r.frame_ms},
                   {"pairs", r.pairs},
                   {"reported", r.reported},
                   {"bytes", r.bytes},
                   {"wrong_pairs", r.wrong},
                   {"note", r.note}});
  return all.dump(1);
}

}  // namespace touchstone::bench
