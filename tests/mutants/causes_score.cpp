// Do causes tell the lying engines apart?
//
//   causes_score [--cases 400] [--seed 1] [--findings 4] [--jobs 2] [--only NAME] [--list] [--confusion]
//                [--bound] [--dump FILE]
//
// Every lying engine answers the same campaign. Their findings are put together as if they came from one
// engine: what is known about engines says that all of them share one path, so only their answers can tell
// one lie from another. The score compares causes with lies: the adjusted Rand index over findings (Hubert
// and Arabie 1985), causes per lie, and how many lies the first 1.5·N causes show, for N lies, in the order
// in which causes are to be read. Half of the lies, by a hash of their names, is held out from tuning; both
// halves are printed. Every figure is printed twice: before and after the engines are asked about each
// other's cases (told_apart). The second says more than one engine with all lies could tell: every lie has an
// engine of its own, which is right where only the others lie. --bound repeats the score with lies that no
// answer tells apart (equal_lies.h) counted as one.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/base/hash.h"
#include "fuzz/ask/evidence.h"
#include "fuzz/campaign/campaign.h"
#include "fuzz/causes/causes.h"
#include "fuzz/shrink/canonical.h"
#include "scenarios/codec/case_codec.h"
#include "tests/mutants/equal_lies.h"
#include "tests/mutants/lying_engine.h"

using namespace touchstone;
using fuzz::Json;

namespace {

struct Options {
  std::uint64_t cases = 400, seed = 1;
  std::size_t findings = 4;
  int jobs = 2;
  std::string only, dump;
  bool list = false, confusion = false, bound = false;
};

EnginePtr liar(const std::string& name) {
  for (const mutants::Mutant& m : mutants::mutants())
    if (m.name == name) return mutants::make_lying_engine(m);
  return nullptr;
}

fuzz::CampaignResult campaign_of_all(const Options& o) {
  fuzz::CampaignConfig config;
  for (const mutants::Mutant& m : mutants::mutants())
    if (o.only.empty() || m.name.starts_with(o.only)) config.engines.emplace_back(m.name);
  config.subject = config.engines.at(0);
  config.seed = o.seed;
  config.cases = o.cases;
  config.jobs = o.jobs;
  const std::atomic<bool> stop = false;
  const auto engines = [&] {
    std::vector<EnginePtr> all;
    for (const std::string& name : config.engines) all.push_back(liar(name));
    return all;
  };
  return fuzz::run_campaign(config, engines, {}, stop);
}

// Of each engine, only the most frequent findings: examining all takes an hour.
void keep_most_frequent(fuzz::CampaignResult& r, std::size_t most) {
  std::map<std::string, std::vector<std::pair<std::uint64_t, std::string>>> by_engine;
  for (const auto& [key, f] : r.findings) by_engine[f.engine].emplace_back(f.count, key);
  for (auto& [engine, keys] : by_engine) {
    std::sort(keys.rbegin(), keys.rend());
    for (std::size_t i = most; i < keys.size(); ++i) r.findings.erase(keys[i].second);
  }
}

struct Item {
  std::size_t cause = 0;
  std::string lie;
  auto operator<=>(const Item&) const = default;
};

std::vector<Item> items_of(const fuzz::Causes& causes, const fuzz::CampaignResult& result) {
  std::vector<Item> items;
  for (std::size_t i = 0; i < causes.causes.size(); ++i)
    for (const std::string& key : causes.causes[i].keys) items.push_back({i, result.findings.at(key).engine});
  return items;
}

double pairs(double n) { return n * (n - 1) / 2; }

// Hubert and Arabie 1985, eq. 5: 1 for the same partition, 0 for what chance gives.
double adjusted_rand(const std::vector<Item>& items) {
  std::map<Item, double> both;
  std::map<std::size_t, double> by_cause;
  std::map<std::string, double> by_lie;
  for (const Item& item : items) {
    ++both[item];
    ++by_cause[item.cause];
    ++by_lie[item.lie];
  }
  double together = 0, causes = 0, lies = 0;
  for (const auto& [k, n] : both) together += pairs(n);
  for (const auto& [k, n] : by_cause) causes += pairs(n);
  for (const auto& [k, n] : by_lie) lies += pairs(n);
  const double expected = causes * lies / pairs(static_cast<double>(items.size()));
  return (together - expected) / ((causes + lies) / 2 - expected);
}

// Half of the lies is for choosing how to group, the other half is held out.
bool is_held_out(const std::string& lie) { return (Hasher().add(lie).value() >> 32U) % 2 == 1; }

std::vector<Item> half_of(const std::vector<Item>& items, bool held_out) {
  std::vector<Item> half;
  std::ranges::copy_if(items, std::back_inserter(half),
                       [&](const Item& i) { return is_held_out(i.lie) == held_out; });
  return half;
}

double causes_a_lie(const std::vector<Item>& items) {
  std::set<Item> pairs(items.begin(), items.end());
  std::set<std::string> lies;
  for (const Item& item : items) lies.insert(item.lie);
  return static_cast<double>(pairs.size()) / static_cast<double>(lies.size());
}

void print_score(const fuzz::Causes& causes, const std::vector<Item>& items) {
  std::map<std::string, std::set<std::size_t>> causes_of_lie;
  for (const Item& item : items) causes_of_lie[item.lie].insert(item.cause);
  std::size_t read = 0;
  const auto lies = static_cast<double>(causes_of_lie.size());
  constexpr double share_read = 1.5;
  const auto first = static_cast<std::size_t>(std::ceil(share_read * lies));
  for (const auto& [lie, of] : causes_of_lie) {
    read += *of.begin() < first;
  }
  fmt::print("{} findings of {} lies in {} causes\n", items.size(), causes_of_lie.size(),
             causes.causes.size());
  const auto seen = half_of(items, false), held_out = half_of(items, true);
  fmt::print("adjusted Rand index {:.3f}; of the half for tuning {:.3f}, of the half held out {:.3f}\n",
             adjusted_rand(items), adjusted_rand(seen), adjusted_rand(held_out));
  fmt::print("causes per lie {:.2f}; {:.2f}, {:.2f}\n", causes_a_lie(items), causes_a_lie(seen),
             causes_a_lie(held_out));
  fmt::print("the first {} causes show {:.1f} % of the lies\n", first,
             100 * static_cast<double>(read) / lies);
}

void print_bound(const fuzz::Causes& causes, std::vector<Item> items,
                 const std::map<std::string, std::string>& first) {
  std::map<std::string, std::set<std::string>> equal;
  for (const auto& [lie, of] : first) equal[of].insert(lie);
  fmt::print("\nlies that no answer tells apart:\n");
  for (const auto& [of, lies] : equal)
    if (lies.size() > 1) fmt::print("  {}\n", fmt::join(lies, " "));
  for (Item& item : items) item.lie = first.at(item.lie);
  fmt::print("each such group counted as one lie:\n");
  print_score(causes, items);
}

// Where the index is lost: it counts pairs of findings.
void print_confusion(const fuzz::Causes& causes, const std::vector<Item>& items) {
  std::map<std::size_t, std::map<std::string, double>> lies_of_cause;
  std::map<std::string, std::map<std::size_t, double>> causes_of_lie;
  for (const Item& item : items) {
    ++lies_of_cause[item.cause][item.lie];
    ++causes_of_lie[item.lie][item.cause];
  }
  const auto pairs_apart = [](const auto& counts) {
    double n = 0, within = 0;
    for (const auto& [k, count] : counts) {
      n += count;
      within += pairs(count);
    }
    return pairs(n) - within;
  };
  std::vector<std::pair<double, std::string>> merged, split;
  for (const auto& [cause, lies] : lies_of_cause) {
    std::string words;
    for (const auto& [lie, n] : lies) words += fmt::format(" {} ({})", lie, n);
    merged.emplace_back(pairs_apart(lies), fmt::format("{}:{}", causes.causes[cause].id, words));
  }
  for (const auto& [lie, of] : causes_of_lie) {
    std::string words;
    for (const auto& [cause, n] : of) words += fmt::format(" {} ({})", causes.causes[cause].id, n);
    split.emplace_back(pairs_apart(of), fmt::format("{}:{}", lie, words));
  }
  for (auto* list : {&merged, &split}) {
    std::sort(list->rbegin(), list->rend());
    double all = 0;
    for (const auto& [lost, words] : *list) all += lost;
    fmt::print("{:.0f} pairs of findings {}\n", all,
               list == &merged ? "of different lies in one cause" : "of one lie in different causes");
    for (const auto& [lost, words] : *list)
      if (lost > 0) fmt::print("{:6.0f}  {}\n", lost, words);
  }
}

void print_list(const fuzz::Causes& causes) {
  for (const fuzz::Cause& c : causes.causes) {
    fmt::print("{}:", c.id);
    for (const std::string& lie : c.engines) fmt::print(" {}", lie);
    fmt::print("\n    {}\n", c.title);
  }
}

// All that grouping knows, one representative a line: for experiments with other ways to group.
void dump(const std::string& file, const fuzz::CampaignResult& result, const fuzz::CausesConfig& config) {
  const auto classes = fuzz::classes_of(result, config.knowledge, fuzz::Contradictions::apart);
  const auto all = fuzz::examined(classes, config);
  std::ofstream out(file);
  const auto deviation = [](const fuzz::Deviation& d) { return Json::array({d.manner, d.error, d.of}); };
  for (const fuzz::Representative& r : all) {
    const fuzz::FindingClass& c = classes[r.of_class];
    const auto examined = [&](const fuzz::Examined& e) {
      Json responses = Json::array();
      for (std::size_t i = 0; i < e.responses.responses.size(); ++i)
        responses.push_back({e.responses.responses[i].intervention,
                             to_string(e.responses.responses[i].response),
                             deviation(e.responses.deviations[i])});
      Json also = Json::array();
      for (const fuzz::Symptom& s : e.responses.also)
        also.push_back({to_string(s.question), to_string(s.stage)});
      return Json{{"shown", e.responses.shown},
                  {"defensible", e.defensible.has_value()},
                  {"case", case_to_json(e.shown())},
                  {"smallest", case_to_json(e.smallest)},
                  {"canonical", case_to_json(e.canonical)},
                  {"canonical_smallest", case_to_json(fuzz::canonical(e.smallest))},
                  {"error_in_l", e.responses.error_in_l},
                  {"faults", e.responses.faults},
                  {"deviation", deviation(e.responses.deviation)},
                  {"also", also},
                  {"responses", responses}};
    };
    out << Json{{"lie", r.finding->engine},
                {"key", r.finding->key()},
                {"count", r.finding->count},
                {"fault", r.finding->fault},
                {"shapes", r.finding->shapes},
                {"route", c.route},
                {"question", to_string(r.symptom.question)},
                {"stage", to_string(r.symptom.stage)},
                {"detail", r.symptom.detail},
                {"asked", r.asked},
                {"class", r.of_class},
                {"explained", c.explained.size()},
                {"first", examined(r.first)},
                {"second", r.second ? examined(*r.second) : Json()}}
               .dump()
        << "\n";
  }
}

int run(const Options& o) {
  fuzz::CampaignResult result = campaign_of_all(o);
  keep_most_frequent(result, o.findings);
  fuzz::write_evidence(result);
  fuzz::CausesConfig config;
  config.knowledge = fuzz::no_knowledge();
  config.knowledge.path_of = [](const std::string&) { return std::string("liar"); };
  config.make = liar;
  config.jobs = o.jobs;
  config.representatives = result.findings.size();
  if (!o.dump.empty()) {
    dump(o.dump, result, config);
    return 0;
  }
  config.before_cross_asking = [&](const fuzz::Causes& alone) {
    fmt::print("as if all lies were told by one engine:\n");
    print_score(alone, items_of(alone, result));
    fmt::print("with engines asked about each other's cases:\n");
  };
  const fuzz::Causes causes = fuzz::causes_of(result, config);
  if (o.list) print_list(causes);
  if (o.confusion) print_confusion(causes, items_of(causes, result));
  const std::vector<Item> items = items_of(causes, result);
  print_score(causes, items);
  if (o.bound) print_bound(causes, items, mutants::equal_lies(causes, result, config.make));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  CLI::App app{"Whether causes tell the lying engines apart"};
  app.add_option("--cases", o.cases, "cases of the campaign")->capture_default_str();
  app.add_option("--seed", o.seed, "of the campaign")->capture_default_str();
  app.add_option("--findings", o.findings, "findings of each lie, the most frequent")->capture_default_str();
  app.add_option("--jobs", o.jobs, "number of parallel jobs")->capture_default_str();
  app.add_option("--only", o.only, "lies whose names begin so");
  app.add_option("--dump", o.dump,
                 "only write what grouping knows about each finding to this file, as JSON lines");
  app.add_flag("--list", o.list, "print the causes");
  app.add_flag("--bound", o.bound, "print the score with lies that no answer tells apart counted as one too");
  app.add_flag("--confusion", o.confusion,
               "print which lies are merged and which are split, most pairs first");
  CLI11_PARSE(app, argc, argv);
  return run(o);
}
