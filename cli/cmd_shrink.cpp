// touchstone shrink CASE: finds the smallest case that shows the same finding, and the smallest one that is
// defensible.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/case_argument.h"
#include "cli/command.h"
#include "cli/output.h"
#include "fuzz/shrink/defensible.h"
#include "fuzz/shrink/keeps_finding.h"
#include "fuzz/shrink/shrink_both.h"
#include "reports/text/text.h"

namespace touchstone::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ShrinkOptions {
  FindingArgument finding;
  std::string out;
  std::size_t tries = 20000;
  bool smallest = false;
  bool json = false;
  WorkerLimits limits;
};

std::string describe(const CaseSize& m) {
  return fmt::format("{}, {}, {}", reports::counted(m.bodies, "body", "bodies"),
                     reports::counted(m.steps, "step", "steps"), reports::counted(m.bits, "bit", "bits"));
}

Json to_json(const CaseSize& m) { return {{"bodies", m.bodies}, {"steps", m.steps}, {"bits", m.bits}}; }

// The key that the engine shows in the shrunk case: the one asked for, or that of the same fault with an
// error of another magnitude.
std::string shown_key(const fuzz::Shrunk& r, const AskedFinding& asked) {
  const auto found = fuzz::findings_of({&r.smallest, 1}, asked.engine, fuzz::found_by(asked.key));
  const std::string key = fuzz::key_of_fault(found[0], asked.key);
  return key.empty() ? asked.key : key;
}

StoredCase stored(const fuzz::Shrunk& r, const AskedFinding& asked) {
  StoredCase s;
  s.c = r.smallest;
  s.description = "shows " + shown_key(r, asked);
  s.source = "shrunk from " + (asked.stored.source.empty() ? asked.stored.c.id : asked.stored.source);
  return s;
}

// What is printed and stored, and the other case if there is one.
struct Chosen {
  const fuzz::Shrunk& result;
  const fuzz::Shrunk* other;
  std::size_t tried;
};

Chosen choose(const fuzz::ShrunkPair& both, bool smallest) {
  const fuzz::Shrunk* defensible = both.defensible ? &*both.defensible : nullptr;
  const bool differ = defensible && defensible->smallest != both.minimum.smallest;
  if (!differ) return {both.minimum, nullptr, both.tried()};
  return smallest ? Chosen{both.minimum, defensible, both.tried()}
                  : Chosen{*defensible, &both.minimum, both.tried()};
}

std::string_view kind_of_case(const fuzz::Shrunk& r) {
  return fuzz::is_defensible(r.smallest) ? "defensible" : "smallest";
}

void print_json(const Chosen& chosen, const AskedFinding& asked) {
  const fuzz::Shrunk& r = chosen.result;
  Json j = {{"key", asked.key},
            {"shows", shown_key(r, asked)},
            {"exit", to_string(r.exit)},
            {"tried", chosen.tried},
            {"before", to_json(r.before)},
            {"after", to_json(r.after)},
            {"defensible", fuzz::is_defensible(r.smallest)},
            {"case", stored_case_to_json(stored(r, asked))}};
  if (chosen.other)
    j["other"] = {{"exit", to_string(chosen.other->exit)},
                  {"after", to_json(chosen.other->after)},
                  {"defensible", fuzz::is_defensible(chosen.other->smallest)},
                  {"case", stored_case_to_json(stored(*chosen.other, asked))}};
  fmt::print("{}\n", j.dump(1));
}

void print_text(const ShrinkOptions& o, const Chosen& chosen, const AskedFinding& asked) {
  const fuzz::Shrunk& r = chosen.result;
  const std::string key = shown_key(r, asked);
  fmt::print(stderr, "{}\nbefore: {}\nafter:  {} ({}, {} cases tried)\n", asked.key, describe(r.before),
             describe(r.after), to_string(r.exit), chosen.tried);
  if (key != asked.key) fmt::print(stderr, "the same fault, with an error of another magnitude: {}\n", key);
  if (chosen.other) {
    fmt::print(stderr, "this is the {} case; the {} one has {}{}\n", kind_of_case(r),
               kind_of_case(*chosen.other), describe(chosen.other->after), o.smallest ? "" : " (--smallest)");
  } else if (r.exit != fuzz::ShrinkExit::not_shown && !fuzz::is_defensible(r.smallest)) {
    fmt::print(stderr, "no defensible case was found: bodies with volume, clearly apart or overlapping\n");
  }
  if (o.out.empty())
    fmt::print("{}", to_text(stored(r, asked)));
  else
    fmt::print("{}\n", o.out);
}

// Where the finding itself has no defensible case, one of the same fault with a larger error may be.
fuzz::ShrunkPair shrink(const ShrinkOptions& o, const AskedFinding& asked) {
  fuzz::ShrunkPair both =
      fuzz::shrink_both(asked.stored.c, fuzz::keeps_finding(asked.engine, asked.key), o.tries);
  if (both.defensible || both.minimum.exit == fuzz::ShrinkExit::not_shown) return both;
  fuzz::ShrunkPair of_fault =
      fuzz::shrink_both(asked.stored.c, fuzz::keeps_fault(asked.engine, asked.key), o.tries);
  both.defensible = std::move(of_fault.defensible);
  both.forms_tried += of_fault.forms_tried + of_fault.minimum.tried;
  return both;
}

int run(const ShrinkOptions& o) {
  prepare_output(o.out);
  const AskedFinding asked = ask_for_finding(o.finding, o.limits);
  if (asked.key.empty()) return not_found(asked, o.finding);
  const fuzz::ShrunkPair both = shrink(o, asked);
  const Chosen chosen = choose(both, o.smallest);
  if (!o.out.empty()) save_case(stored(chosen.result, asked), o.out);
  if (o.json)
    print_json(chosen, asked);
  else
    print_text(o, chosen, asked);
  if (chosen.result.exit == fuzz::ShrinkExit::not_shown) {
    fmt::print(stderr, "the finding showed once but not again: the engine's answers are not reproducible\n");
    return exit_failed;
  }
  return exit_clean;
}

}  // namespace

Run declare_shrink(CLI::App& app) {
  auto o = std::make_shared<ShrinkOptions>();
  add_finding_argument(app, o->finding);
  app.add_option("-o,--out", o->out, "file for the shrunk case (default: stdout)");
  app.add_flag("--smallest", o->smallest,
               "the smallest case, even if bodies only touch, are flat or have extreme numbers (default: the "
               "smallest defensible one, if there is one)");
  app.add_option("--tries", o->tries, "maximum number of cases to try")
      ->check(a_count())
      ->capture_default_str();
  add_case_seconds(app, o->limits);
  app.add_flag("--json", o->json, "one JSON document on stdout");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
