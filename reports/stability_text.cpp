#include "reports/stability_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/text.h"

namespace touchstone::reports {
namespace {

using fuzz::LadderResult;

// Rungs are powers of two.
std::string rung(double value) {
  int e = 0;
  if (std::frexp(value, &e) == 0.5 && (value > 4096 || value < 1)) return fmt::format("2^{}", e - 1);
  return fmt::format("{:g}", value);
}

const LadderResult* result_of(const fuzz::Stability& s, const std::string& ladder, const std::string& engine,
                              const std::string& question) {
  for (const LadderResult& r : s.results)
    if (r.ladder == ladder && r.engine == engine && r.question == question) return &r;
  return nullptr;
}

std::string table(const fuzz::Stability& s, const std::string& question) {
  std::vector<std::string> engines, names;
  const auto note = [](std::vector<std::string>& list, const std::string& x) {
    if (std::find(list.begin(), list.end(), x) == list.end()) list.push_back(x);
  };
  for (const LadderResult& r : s.results)
    if (r.question == question) note(engines, r.engine), note(names, r.ladder);
  if (engines.empty()) return "";
  std::string text = fmt::format("{:<23}", question);
  const auto wide = [](const std::string& name) { return std::max<std::size_t>(8, name.size() + 1); };
  for (const auto& l : names) text += fmt::format("{:>{}}", l, wide(l));
  text += "\n";
  for (const auto& e : engines) {
    text += fmt::format("{:<23}", " " + e);
    for (const auto& l : names) {
      const LadderResult* r = result_of(s, l, e, question);
      text += fmt::format("{:>{}}", !r ? "" : !r->fails_at() ? "-" : rung(*r->fails_at()), wide(l));
    }
    text += "\n";
  }
  return text + "\n";
}

}  // namespace

std::string stability_text(const fuzz::Stability& s) {
  std::string text = wrapped(
      fmt::format(
          "The first rung at which an engine gives a wrong answer or none, over {} cases a rung; - never, "
          "blank: it does not answer such.",
          s.per_rung),
      79, 0);
  text += "\n\n";
  for (const char* q : {"overlap", "distance", "contact", "time_of_impact", "candidates"})
    text += table(s, q);
  for (const auto& l : s.ladders) {
    for (const LadderResult& r : s.results)
      if (r.ladder == l.name) {
        text += "  " +
                wrapped(fmt::format("{}: {}, {} to {}{}", l.name, l.line, rung(r.rungs.front().value),
                                    rung(r.rungs.back().value), l.unit.empty() ? "" : " " + l.unit),
                        76, 4) +
                "\n";
        break;
      }
  }
  return text;
}

}  // namespace touchstone::reports
