#include "reports/chart/sub_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace touchstone::fuzz {
namespace {

constexpr std::string_view infix = "-steps@";
// Samples of one motion per batch: enough to fill it, few enough that little work is wasted after the first
// overlap.
constexpr int stride = 16;
constexpr int max_steps = 1'000'000;

Case sample(const Case& c, const Query& q, double t) {
  Case s{c.id, c.family, c.scene, {{Question::overlap, q.a, q.b}}};
  for (Body& b : s.scene.bodies) {
    if (b.motion) b.pose = pose_at(b.pose, *b.motion, t);
    b.motion.reset();
  }
  return s;
}

class SubStepped final : public Engine {
 public:
  SubStepped(std::shared_ptr<Engine> inner, int steps)
      : inner_(std::move(inner)), steps_(steps), card_(inner_->card()) {
    card_.settings = fmt::format("overlap by {} at the ends of {} equal steps, the first that is true; {}",
                                 card_.name, steps, card_.settings);
    card_.name += std::string(infix) + std::to_string(steps);
  }
  const EngineCard& card() const override { return card_; }
  std::vector<CaseObservations> run(std::span<const Case> cases) override;
  std::string set_aside() const override { return inner_->set_aside(); }
  void resume() override { inner_->resume(); }
  void suspend(const std::string& why) override { inner_->suspend(why); }

 private:
  struct Open {  // a motion without an answer so far
    std::size_t of_case, query;
    int next = 0;  // next sample
  };
  void ask_next_samples(std::vector<Open>& open, std::span<const Case> cases,
                        std::vector<CaseObservations>& all);

  std::shared_ptr<Engine> inner_;
  int steps_;
  EngineCard card_;
};

// Adds the answer for sample `i`; returns true when the motion is decided.
bool take(Observation& o, const Observation& at, int i, int steps) {
  o.elapsed_ns += at.elapsed_ns;
  o.claimed_tolerance = std::max(o.claimed_tolerance, at.claimed_tolerance);
  o.outcome = at.outcome;
  if (at.outcome == Outcome::answered && !at.overlap) o.outcome = Outcome::unsupported;
  if (o.outcome != Outcome::answered) {
    o.detail = at.detail;
    return true;
  }
  if (*at.overlap) o.toi = static_cast<double>(i) / steps;
  return *at.overlap;
}

void SubStepped::ask_next_samples(std::vector<Open>& open, std::span<const Case> cases,
                                  std::vector<CaseObservations>& all) {
  std::vector<Case> samples;
  for (const Open& m : open)
    for (int i = m.next; i <= std::min(m.next + stride - 1, steps_); ++i)
      samples.push_back(
          sample(cases[m.of_case], cases[m.of_case].queries[m.query], static_cast<double>(i) / steps_));
  const auto answers = inner_->run(samples);
  std::size_t at = 0;
  std::erase_if(open, [&](Open& m) {
    CaseObservations& whole = all[m.of_case];
    bool decided = false;
    const int end = std::min(m.next + stride - 1, steps_);
    for (; m.next <= end; ++m.next, ++at) {
      if (m.next == 0) whole.received = answers[at].received;  // the shapes, and the bodies at their start
      if (!decided) decided = take(whole.answers[m.query], answers[at].answers[0], m.next, steps_);
    }
    return decided || m.next > steps_;
  });
}

std::vector<CaseObservations> SubStepped::run(std::span<const Case> cases) {
  std::vector<CaseObservations> all(cases.size());
  std::vector<Open> open;
  for (std::size_t c = 0; c < cases.size(); ++c) {
    all[c].answers.resize(cases[c].queries.size());
    all[c].received.bodies.resize(cases[c].scene.bodies.size());
    all[c].received.shapes.resize(cases[c].scene.shapes.size());
    for (std::size_t q = 0; q < cases[c].queries.size(); ++q)
      if (cases[c].queries[q].question == Question::time_of_impact)
        open.push_back({c, q});
      else
        all[c].answers[q].detail = "sub-steps only answer time of impact";
  }
  while (!open.empty()) ask_next_samples(open, cases, all);
  return all;
}

}  // namespace

EnginePtr sub_stepped(std::shared_ptr<Engine> inner, int steps) {
  return std::make_unique<SubStepped>(std::move(inner), steps);
}

std::optional<SubStepsName> sub_steps_name(const std::string& name) {
  const auto at = name.rfind(infix);
  if (at == std::string::npos || at == 0) return std::nullopt;
  const char *first = name.data() + at + infix.size(), *last = name.data() + name.size();
  int steps = 0;
  const auto [end, error] = std::from_chars(first, last, steps);
  if (error != std::errc{} || end != last || steps < 1 || steps > max_steps) return std::nullopt;
  return SubStepsName{name.substr(0, at), steps};
}

}  // namespace touchstone::fuzz
