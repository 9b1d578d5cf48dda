#include "reports/text/record_text.h"

#include <fmt/format.h>

#include "core/base/hash.h"
#include "reports/text/text.h"
#include "scenarios/text/printable.h"

namespace touchstone::reports {
namespace {

using fuzz::Fingerprint;
using fuzz::FingerprintDifference;

// Of one question, all shapes together.
struct OfQuestion {
  std::string question;
  std::uint64_t asked = 0, answered = 0;
  Hasher hash;
};

std::vector<OfQuestion> by_question(const Fingerprint& f) {
  std::vector<OfQuestion> all;
  for (const Fingerprint::Group& g : f.groups) {
    if (all.empty() || all.back().question != g.question) all.push_back({g.question, 0, 0, {}});
    all.back().asked += g.answers.size();
    all.back().answered += g.answered();
    all.back().hash.add(g.hash());
  }
  return all;
}

std::string name_of(const Fingerprint& f) {
  return printable(fmt::format("{} ({} {})", f.engine, f.library, f.version));
}

}  // namespace

std::string fingerprint_text(const Fingerprint& f) {
  std::string text = fmt::format("{}\n{} cases of set {}\n\n{:<20} {:>9} {:>9}  hash\n", name_of(f),
                                 grouped(f.cases), f.set, "question", "asked", "answered");
  OfQuestion all;
  for (const OfQuestion& q : by_question(f)) {
    text += fmt::format("{:<20} {:>9} {:>9}  {:016x}\n", printable(q.question), grouped(q.asked),
                        grouped(q.answered), q.hash.value());
    all.asked += q.asked;
    all.answered += q.answered;
  }
  return text + fmt::format("{:<20} {:>9} {:>9}  {:016x}\n", "all", grouped(all.asked), grouped(all.answered),
                            f.hash());
}

std::string difference_text(const Fingerprint& a, const Fingerprint& b, const FingerprintDifference& d) {
  std::string text = fmt::format("A: {}\nB: {}\n{} answers of both, {} differ", name_of(a), name_of(b),
                                 grouped(d.both()), grouped(d.differ()));
  text += d.only_one() > 0 ? fmt::format("; {} of one alone\n", grouped(d.only_one())) : "\n";
  if (d.same()) return text;
  text += fmt::format("\n{:<16} {:<24} {:>9} {:>8} {:>8} {:>8}\n", "question", "shapes", "of both", "differ",
                      "only A", "only B");
  for (const FingerprintDifference::Group& g : d.groups)
    if (!g.same())
      text +=
          fmt::format("{:<16} {:<24} {:>9} {:>8} {:>8} {:>8}\n", printable(g.question), printable(g.shapes),
                      grouped(g.both), grouped(g.differ), grouped(g.only_a), grouped(g.only_b));
  return text;
}

}  // namespace touchstone::reports
