#include "cli/judged_by.h"

#include <array>
#include <cmath>

#include "core/base/exact_text.h"
#include "core/base/input_error.h"
#include "fuzz/judge/tau.h"

namespace touchstone::cli {
namespace {

struct Unit {
  std::string_view name;
  double metres;
};
// A unit that ends in another unit's name comes before it.
constexpr std::array units{Unit{"nm", 1e-9}, Unit{"um", 1e-6}, Unit{"mm", 1e-3},
                           Unit{"cm", 1e-2}, Unit{"km", 1e3},  Unit{"m", 1.0}};

class JudgedBy final : public Engine {
 public:
  JudgedBy(EnginePtr engine, double error)
      : engine_(std::move(engine)), card_(engine_->card()), error_(error) {
    card_.source = fuzz::claimed_by_user;
  }
  const EngineCard& card() const override { return card_; }
  std::vector<CaseObservations> run(std::span<const Case> cases) override {
    return claimed(engine_->run(cases), cases);
  }
  std::vector<CaseObservations> run_again(std::span<const Case> cases) override {
    return claimed(engine_->run_again(cases), cases);
  }
  std::string set_aside() const override { return engine_->set_aside(); }
  void resume() override { engine_->resume(); }
  void suspend(const std::string& why) override { engine_->suspend(why); }

 private:
  std::vector<CaseObservations> claimed(std::vector<CaseObservations> all,
                                        std::span<const Case> cases) const {
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t q = 0; q < all[i].answers.size(); ++q)
        if (!is_broad_question(cases[i].queries[q].question)) all[i].answers[q].claimed_tolerance = error_;
    return all;
  }

  EnginePtr engine_;
  EngineCard card_;
  double error_;
};

}  // namespace

double length_from_text(const std::string& text) {
  std::string_view number = text;
  double unit = 1;
  for (const Unit& u : units)
    if (number.ends_with(u.name)) {
      number.remove_suffix(u.name.size());
      unit = u.metres;
      break;
    }
  while (number.ends_with(' ')) number.remove_suffix(1);
  const auto value = double_from_text(number);
  if (!value)
    throw InputError("--error " + text,
                     "is not a length: a number with an optional unit (nm, um, mm, cm, m, km)");
  if (!(*value > 0 && std::isfinite(*value))) throw InputError("--error " + text, "must be more than 0");
  return *value * unit;
}

void add_error(CLI::App& app, std::string& error) {
  app.add_option("--error", error,
                 "judge by this tolerance (0.1mm, or a number in the scene's unit) instead of the claims in "
                 "each engine's documentation");
}

EnginePtr judged_by(EnginePtr engine, const std::string& error) {
  if (error.empty()) return engine;
  return std::make_unique<JudgedBy>(std::move(engine), length_from_text(error));
}

std::vector<EnginePtr> judged_by(std::vector<EnginePtr> engines, const std::string& error) {
  for (EnginePtr& e : engines) e = judged_by(std::move(e), error);
  return engines;
}

}  // namespace touchstone::cli
