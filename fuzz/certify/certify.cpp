#include "fuzz/certify/certify.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>
#include <thread>

#include "core/base/hash.h"
#include "core/base/input_error.h"
#include "fuzz/certify/candidate_verdict.h"

namespace touchstone::fuzz {
namespace {

// Most cases per batch, which makes the cost of the pipe small. Batches start at one case, also after a
// failure, so that an engine that hangs on every case is detected early.
constexpr std::uint64_t largest_batch = 32;
// An evidence ends at a part in which a quarter of the answers cost a worker. Up to there, finding other
// faults is worth the crashes.
std::uint64_t most_failures(const EvidenceRow& e) { return std::max<std::uint64_t>(4, e.chunk / 4); }
// How often the time for a question is doubled to find out what it needs.
constexpr int most_doublings = 3;
constexpr double seconds_per_minute = 60;

struct Part {
  EvidenceCount count;
  std::vector<FaultCount> faults;
  std::uint64_t failures = 0;             // crashed, threw, …
  std::optional<std::uint64_t> too_slow;  // a case that was not answered in time
  bool is_last = false;
};

EvidenceCount count_of(const CandidateVerdict& v) {
  EvidenceCount one;
  one.cases = 1;
  one.answered = v.refused || v.timed_out || !v.faults.empty() ? 0 : 1;
  one.refused = v.refused;
  if (v.refused) one.refusal = v.words;
  one.steps = v.steps;
  one.queries = v.queries;
  one.undecided = v.undecided;
  one.pairs_true = v.pairs_true;
  one.pairs_reported = v.pairs_reported;
  one.digest = v.digest;
  return one;
}

void add(EvidenceCount& to, const EvidenceCount& part) {
  to.cases += part.cases;
  to.answered += part.answered;
  to.refused += part.refused;
  if (to.refusal.empty()) to.refusal = part.refusal;
  to.steps += part.steps;
  to.queries += part.queries;
  to.undecided += part.undecided;
  to.pairs_true += part.pairs_true;
  to.pairs_reported += part.pairs_reported;
  to.digest = Hasher().add(to.digest).add(part.digest).value();
}

// Of two faults of one class, keeps the one with the larger share; on a tie, the earlier case.
void add(std::vector<FaultCount>& to, const FaultCount& f) {
  const auto same = std::find_if(to.begin(), to.end(), [&](const FaultCount& x) { return x.what == f.what; });
  if (same == to.end()) {
    to.push_back(f);
    return;
  }
  const std::uint64_t cases = same->cases + f.cases;
  if (f.share > same->share) *same = f;
  same->cases = cases;
}

// The case of an evidence, asked with the margin.
Case certified_case(const EvidenceRow& e, const Draw& d, std::uint64_t index, std::uint64_t planned,
                    std::optional<double> margin) {
  Case c = evidence_case(e, d, index, planned);
  if (!margin) return c;
  c.scene.margin = *margin;
  for (Query& q : c.queries)
    if (q.question == Question::candidates) q.question = Question::candidates_within;
  return c;
}

class PartRun {
 public:
  PartRun(const EvidenceRow& e, const Draw& d, std::uint64_t planned, std::optional<double> margin,
          Engine& engine)
      : e_(e), d_(d), planned_(planned), margin_(margin), engine_(engine) {}

  Part run(std::uint64_t first, const std::atomic<bool>& stop) {
    const std::uint64_t end = std::min(first + e_.chunk, planned_);
    std::uint64_t batch = 1;
    for (std::uint64_t i = first; i < end && !stop && !part_.is_last;) {
      const std::uint64_t n = std::min(batch, end - i), failed_before = part_.failures;
      ask(i, n);
      i += n;
      batch = part_.failures > failed_before ? 1 : std::min(2 * batch, largest_batch);
    }
    return std::move(part_);
  }

 private:
  void ask(std::uint64_t first, std::uint64_t n) {
    std::vector<Case> cases;
    for (std::uint64_t k = 0; k < n; ++k)
      cases.push_back(certified_case(e_, d_, first + k, planned_, margin_));
    const auto observed = engine_.run(cases);
    for (std::size_t k = 0; k < cases.size() && !part_.is_last; ++k)
      judge(first + k, cases[k], observed[k].answers.at(0));
  }
  void judge(std::uint64_t index, const Case& c, const Observation& o) {
    const CandidateVerdict v = judge_with_cause(engine_, c, o, e_.level, e_.invalid);
    add(part_.count, count_of(v));
    if (v.timed_out) part_.too_slow = index;
    if (o.outcome != Outcome::answered && !v.refused && !v.timed_out) ++part_.failures;
    part_.is_last = part_.too_slow || part_.failures >= most_failures(e_);
    for (const CandidateFault& f : v.faults)
      add(part_.faults, FaultCount{e_.level, std::string(e_.name), f.what, 1, index, f.share, f.words});
  }

  const EvidenceRow& e_;
  const Draw& d_;
  std::uint64_t planned_;
  std::optional<double> margin_;
  Engine& engine_;
  Part part_;
};

// The engines of one job live until the certificate is complete.
struct Job {
  std::array<EnginePtr, 2> engines;
  Engine& engine(const Subject& s, BroadLevel level) {
    EnginePtr& e = engines[static_cast<std::size_t>(level)];
    if (!e) e = s.make(level);
    return *e;
  }
};

class Certifier {
  using Clock = std::chrono::steady_clock;

 public:
  Certifier(const Subject& s, const CertifyConfig& c, const CertifyProgress& p, const std::atomic<bool>& stop)
      : subject_(s),
        config_(c),
        progress_(p),
        stop_(stop),
        jobs_(static_cast<std::size_t>(std::max(1, c.jobs))) {}

  std::optional<BroadCertificate> run() {
    check_names();
    out_.subject = subject_.name;
    out_.plugin_hash = subject_.plugin_hash;
    out_.program = config_.program;
    out_.card = jobs_[0].engine(subject_, BroadLevel::boxes).card();
    out_.scope = config_.scope == Scope::quick ? "quick" : "full";
    out_.seed = config_.seed;
    out_.limit = config_.limit;
    out_.levels = config_.levels;
    out_.sweeps = subject_.sweeps && !config_.margin;
    out_.margin = config_.margin;
    out_.without = config_.without;
    out_.first_fault = config_.first_fault;
    draw_ = {
        config_.seed,
        roundoff_of(out_.card, ShapeKind::box) > max_float64_roundoff ? Scalar::float32 : Scalar::float64,
        config_.scope};
    const auto all = all_evidence();
    if (config_.minutes) time_left_ = seconds_per_minute * *config_.minutes;
    auto selected =
        std::count_if(all.begin(), all.end(), [&](const EvidenceRow& e) { return is_selected(e); });
    std::size_t index = 0;
    for (const EvidenceRow& e : all) {
      if (stop_) return std::nullopt;
      if (is_selected(e)) gather(e, index, static_cast<double>(std::max<std::ptrdiff_t>(1, selected--)));
      ++index;
    }
    for (const BroadLevel l : config_.levels) refute_level(l);
    if (stop_) return std::nullopt;
    return std::move(out_);
  }

 private:
  void check_names() const {
    for (const std::string& w : config_.without)
      if (std::none_of(all_evidence().begin(), all_evidence().end(),
                       [&](const EvidenceRow& e) { return e.name == w; }))
        throw InputError("--without " + w, "is not the name of an evidence");
  }
  bool is_selected(const EvidenceRow& e) const {
    const auto has = [](const auto& list, const auto& x) {
      return std::find(list.begin(), list.end(), x) != list.end();
    };
    return has(config_.levels, e.level) && !has(config_.without, std::string(e.name)) &&
           (!e.sweeps || out_.sweeps) && !(config_.first_fault && has_fault(e.level));
  }

  bool has_fault(BroadLevel level) const {
    return std::any_of(out_.faults.begin(), out_.faults.end(),
                       [&](const FaultCount& f) { return f.level == level; });
  }

  /// `sharing`: the evidence that is still to be run, this one included.
  void gather(const EvidenceRow& e, std::size_t index, double sharing) {
    const auto start = Clock::now();
    if (config_.minutes)
      deadline_ = start + std::chrono::duration_cast<Clock::duration>(
                              std::chrono::duration<double>(std::max(0.0, time_left_) / sharing));
    EvidenceCount total;
    total.name = e.name;
    total.line = e.line;
    total.kind = e.kind;
    total.level = e.level;
    total.planned = planned(e);
    total.population = e.population ? e.population(draw_) : 0;
    Part sum = run_parts(e, total, index);
    if (stop_) return;
    total.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    time_left_ -= total.seconds;
    out_.evidence.push_back(total);
    std::stable_sort(sum.faults.begin(), sum.faults.end(),
                     [](const FaultCount& x, const FaultCount& y) { return is_graver(x.what, y.what); });
    out_.faults.insert(out_.faults.end(), sum.faults.begin(), sum.faults.end());
    if (sum.too_slow) out_.too_slow.push_back(too_slow(e, *sum.too_slow, total.planned));
    if (progress_) progress_(total, index, all_evidence().size());
  }

  // Finds the time that a question needs by doubling, unless more time has already proved useless.
  TooSlow too_slow(const EvidenceRow& e, std::uint64_t index, std::uint64_t planned) {
    const Case c = certified_case(e, draw_, index, planned, config_.margin);
    TooSlow t{
        e.level, std::string(e.name),  index, bodies_used(c), c.scene.script.size(), subject_.case_seconds,
        0,       subject_.case_seconds};
    if (!subject_.make_patient || more_time_is_useless_) return t;
    double times = 1;
    for (int k = 0; k < most_doublings && t.sufficient == 0 && !stop_; ++k) {
      times *= 2;
      t.tried = times * subject_.case_seconds;
      const auto o = subject_.make_patient(e.level, times)->run({&c, 1});
      if (o[0].answers.at(0).outcome != Outcome::timed_out) t.sufficient = t.tried;
    }
    more_time_is_useless_ = t.sufficient == 0;
    return t;
  }

  // Refutes each class of fault once, with the first evidence whose case shows it again.
  void refute_level(BroadLevel level) {
    std::vector<FaultClass> classes;
    for (const FaultCount& f : out_.faults)
      if (f.level == level && std::find(classes.begin(), classes.end(), f.what) == classes.end())
        classes.push_back(f.what);
    std::stable_sort(classes.begin(), classes.end(), is_graver);
    for (const FaultClass& c : classes)
      if (!stop_) out_.refutations.push_back(refute_class(level, c));
  }
  Refutation refute_class(BroadLevel level, const FaultClass& what) {
    std::optional<Refutation> first;
    for (const FaultCount& f : out_.faults) {
      if (f.level != level || !(f.what == what)) continue;
      const EvidenceRow& e = row_of(f.evidence);
      Refutation r = refute(subject_, e, f, certified_case(e, draw_, f.index, planned(e), config_.margin));
      if (r.is_shown_again || stop_) return r;
      if (!first) first = std::move(r);
    }
    return std::move(*first);
  }
  static const EvidenceRow& row_of(const std::string& name) {
    const auto all = all_evidence();
    return *std::find_if(all.begin(), all.end(), [&](const EvidenceRow& e) { return e.name == name; });
  }
  std::uint64_t planned(const EvidenceRow& e) const {
    const std::uint64_t n = planned_cases(e, draw_);
    return config_.limit > 0 ? std::min(n, config_.limit) : n;
  }

  // Counts parts up to the first that ends the evidence, whichever job finished first.
  Part run_parts(const EvidenceRow& e, EvidenceCount& total, std::size_t index) {
    std::uint64_t parts = (total.planned + e.chunk - 1) / e.chunk;
    if (const auto most = config_.most_cases.find(total.name); most != config_.most_cases.end()) {
      const std::uint64_t again = std::max<std::uint64_t>(1, most->second / e.chunk);
      total.out_of_time = again < parts;
      parts = std::min(parts, again);
    }
    std::vector<Part> done(parts);
    std::atomic<std::uint64_t> next{0}, last{parts};
    std::exception_ptr failure;
    std::mutex guard;
    EvidenceCount so_far = total;
    const auto do_parts = [&](Job& job) {
      for (std::uint64_t p = next++; p < last.load() && !stop_; p = next++) {
        if (p > 0 && config_.minutes && Clock::now() >= deadline_) {
          const std::lock_guard lock(guard);
          last = std::min(last.load(), p);
          total.out_of_time = true;
          return;
        }
        Engine& engine = job.engine(subject_, e.level);
        engine.resume();  // the result must not depend on which parts this job ran before
        done[p] = PartRun(e, draw_, total.planned, config_.margin, engine).run(p * e.chunk, stop_);
        const std::lock_guard lock(guard);
        if (done[p].is_last || (config_.first_fault && !done[p].faults.empty()))
          last = std::min(last.load(), p + 1);
        so_far.cases += done[p].count.cases;
        if (progress_) progress_(so_far, index, all_evidence().size());
      }
    };
    const auto work = [&](Job& job) {
      try {
        do_parts(job);
      } catch (...) {
        const std::lock_guard lock(guard);
        failure = std::current_exception();
        last = 0;
      }
    };
    run_jobs(work);
    if (failure) std::rethrow_exception(failure);
    Part sum;
    for (std::uint64_t p = 0; p < last.load() && !stop_; ++p) {
      // It had ended by itself.
      if (done[p].is_last || (config_.first_fault && !done[p].faults.empty())) total.out_of_time = false;
      add(total, done[p].count);
      for (const FaultCount& f : done[p].faults) add(sum.faults, f);
      if (done[p].too_slow) sum.too_slow = done[p].too_slow;
    }
    return sum;
  }
  template <class Work>
  void run_jobs(const Work& work) {
    std::vector<std::thread> threads;
    for (std::size_t j = 1; j < jobs_.size(); ++j) threads.emplace_back([&, j] { work(jobs_[j]); });
    work(jobs_[0]);
    for (std::thread& t : threads) t.join();
  }

  const Subject& subject_;
  const CertifyConfig& config_;
  const CertifyProgress& progress_;
  const std::atomic<bool>& stop_;
  std::vector<Job> jobs_;
  Draw draw_;
  bool more_time_is_useless_ = false;
  double time_left_ = 0;  // seconds
  Clock::time_point deadline_;
  BroadCertificate out_;
};

}  // namespace

std::optional<BroadCertificate> certify(const Subject& subject, const CertifyConfig& config,
                                        const CertifyProgress& progress, const std::atomic<bool>& stop) {
  return Certifier(subject, config, progress, stop).run();
}

}  // namespace touchstone::fuzz
