// Do causes tell the lying engines apart?
//
//   causes_score [--cases 1500] [--seed 1] [--jobs 2] [--only NAME] [--dump FILE]
//
// Every lying engine answers the same campaign. Their findings are put together as if they came from one
// engine: what is known about engines says that all of them share one path, so nothing but the answers can
// tell one lie from another. The score compares the causes with the lies: adjusted Rand index over findings
// (Hubert and Arabie 1985), causes per lie, and how many lies the first 1.5·N causes show, in the order in
// which they are to be read.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "fuzz/ask/evidence.h"
#include "fuzz/campaign/campaign.h"
#include "fuzz/causes/causes.h"
#include "fuzz/causes/rates.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/random/family.h"
#include "tests/mutants/lying_engine.h"

using namespace touchstone;

namespace {

struct Options {
  std::uint64_t cases = 600, seed = 1;
  std::size_t findings = 6;
  int jobs = 2;
  std::string only, dump;
};

const mutants::Mutant* mutant_named(const std::string& name) {
  for (const mutants::Mutant& m : mutants::mutants())
    if (m.name == name) return &m;
  return nullptr;
}

fuzz::EngineKnowledge blind() {
  fuzz::EngineKnowledge k = fuzz::no_knowledge();
  k.path_of = [](const std::string&) { return std::string("liar"); };
  return k;
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
    for (const std::string& name : config.engines)
      all.push_back(mutants::make_lying_engine(*mutant_named(name)));
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

double pairs(double n) { return n * (n - 1) / 2; }

// Hubert and Arabie 1985, eq. 5: 1 for the same partition, 0 for what chance gives.
double adjusted_rand(const std::vector<std::pair<std::size_t, std::string>>& items) {
  std::map<std::pair<std::size_t, std::string>, double> both;
  std::map<std::size_t, double> by_group;
  std::map<std::string, double> by_label;
  for (const auto& item : items) {
    ++both[item];
    ++by_group[item.first];
    ++by_label[item.second];
  }
  double together = 0, groups = 0, labels = 0;
  for (const auto& [k, n] : both) together += pairs(n);
  for (const auto& [k, n] : by_group) groups += pairs(n);
  for (const auto& [k, n] : by_label) labels += pairs(n);
  const double expected = groups * labels / pairs(static_cast<double>(items.size()));
  return (together - expected) / ((groups + labels) / 2 - expected);
}

void print_score(const std::vector<fuzz::Representative>& all, const std::vector<fuzz::Group>& groups) {
  std::vector<std::pair<std::size_t, std::string>> items;
  std::map<std::string, std::set<std::size_t>> groups_of;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const auto* part : {&groups[g].members, &groups[g].consequences})
      for (const std::size_t m : *part) {
        items.emplace_back(g, all[m].finding->engine);
        if (part == &groups[g].members) groups_of[all[m].finding->engine].insert(g);
      }
  std::size_t listed = 0;
  for (const auto& [engine, of] : groups_of) listed += of.size();
  fmt::print("{} findings of {} lies in {} causes\n", items.size(), groups_of.size(), groups.size());
  fmt::print("adjusted Rand index {:.3f}, causes per lie {:.2f}\n", adjusted_rand(items),
             static_cast<double>(listed) / static_cast<double>(groups_of.size()));
}

void dump(const std::string& file, const std::vector<fuzz::FindingClass>& classes,
          const std::vector<fuzz::Representative>& all) {
  fuzz::Json out = fuzz::Json::array();
  for (const auto& r : all) {
    const auto& c = classes[r.of_class];
    fuzz::Json resp = fuzz::Json::object(), err = fuzz::Json::object();
    for (std::size_t i = 0; i < r.first.responses.responses.size(); ++i) {
      resp[r.first.responses.responses[i].intervention] = to_string(r.first.responses.responses[i].response);
      err[r.first.responses.responses[i].intervention] = r.first.responses.errors_in_l[i];
    }
    fuzz::Json also = fuzz::Json::array();
    for (const auto& s : r.first.responses.also)
      also.push_back(fmt::format("{} {}", to_string(s.question), to_string(s.stage)));
    out.push_back({{"class", r.of_class},
                   {"path", c.path},
                   {"route", c.route},
                   {"question", to_string(c.symptom.question)},
                   {"stage", to_string(c.symptom.stage)},
                   {"detail", c.symptom.detail},
                   {"engine", r.finding->engine},
                   {"fault", r.finding->fault},
                   {"shapes", r.finding->shapes},
                   {"magnitude", r.finding->magnitude},
                   {"count", r.finding->count},
                   {"key", r.finding->key()},
                   {"words", r.finding->words},
                   {"asked", r.asked},
                   {"shown", r.first.responses.shown},
                   {"error", r.first.responses.error_in_l},
                   {"also", also},
                   {"response", resp},
                   {"errors", err},
                   {"case", case_to_json(r.first.shown())}});
  }
  std::ofstream(file) << out.dump(1);
}

int run(const Options& o) {
  fuzz::CampaignResult result = campaign_of_all(o);
  keep_most_frequent(result, o.findings);
  fuzz::write_evidence(result);
  fmt::print(stderr, "{} findings\n", result.findings.size());
  fuzz::CausesConfig config;
  config.knowledge = blind();
  config.make = [](const std::string& name) -> EnginePtr {
    const mutants::Mutant* m = mutant_named(name);
    return m ? mutants::make_lying_engine(*m) : nullptr;
  };
  config.jobs = o.jobs;
  config.representatives = result.findings.size();
  config.progress = [](std::size_t done, std::size_t of) {
    if (done % 200 == 0) fmt::print(stderr, "{} of {}\n", done, of);
  };
  const auto classes = fuzz::classes_of(result, config.knowledge);
  const auto all = fuzz::examined(classes, config);
  const fuzz::Noise noise = fuzz::noise_of(classes, all);
  const std::vector<double> rates = fuzz::rates_of(classes, result);
  const auto groups = fuzz::grouped({classes, all, rates, config.knowledge, noise});
  if (!o.dump.empty()) dump(o.dump, classes, all);
  for (const auto& [path, n] : noise)
    fmt::print("noise of {}: {:.3f} of the responses, {:.1f} octaves\n", path, n.share, n.octaves);
  print_score(all, groups);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  CLI::App app{"Whether causes tell the lying engines apart"};
  app.add_option("--cases", o.cases)->capture_default_str();
  app.add_option("--seed", o.seed)->capture_default_str();
  app.add_option("--findings", o.findings)->capture_default_str();
  app.add_option("--jobs", o.jobs)->capture_default_str();
  app.add_option("--only", o.only);
  app.add_option("--dump", o.dump);
  CLI11_PARSE(app, argc, argv);
  return run(o);
}
