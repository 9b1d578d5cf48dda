#include "fuzz/certify/certify.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>
#include <thread>

#include "core/base/hash.h"
#include "core/base/input_error.h"
#include "fuzz/certify/candidate_verdict.h"
#include "fuzz/certify/refute.h"

namespace touchstone::fuzz {
namespace {

// Asked at once: pipes cost little then, and an engine that hangs at every case is found out soon.
constexpr std::uint64_t batch = 32;

struct Wrong {
  std::uint64_t index = 0;
  Case c;
  CandidateVerdict verdict;
};

struct Part {
  EvidenceCount count;
  std::optional<Wrong> wrong;
};

void add(EvidenceCount& to, const CandidateVerdict& v) {
  ++to.cases;
  to.answered += v.refused || !v.fault.empty() ? 0 : 1, to.refused += v.refused;
  if (v.refused && to.refusal.empty()) to.refusal = v.words;
  to.steps += v.steps, to.queries += v.queries, to.undecided += v.undecided;
  to.pairs_true += v.pairs_true, to.pairs_reported += v.pairs_reported;
  to.digest = Hasher().add(to.digest).add(v.digest).value();
}

void add(EvidenceCount& to, const EvidenceCount& part) {
  to.cases += part.cases, to.answered += part.answered, to.refused += part.refused;
  if (to.refusal.empty()) to.refusal = part.refusal;
  to.steps += part.steps, to.queries += part.queries, to.undecided += part.undecided;
  to.pairs_true += part.pairs_true, to.pairs_reported += part.pairs_reported;
  to.digest = Hasher().add(to.digest).add(part.digest).value();
}

Part run_part(const EvidenceRow& e, const Draw& d, std::uint64_t planned, std::uint64_t first, Engine& engine,
              const std::atomic<bool>& stop) {
  Part part;
  const std::uint64_t end = std::min(first + e.chunk, planned);
  for (std::uint64_t i = first; i < end && !stop && !part.wrong; i += batch) {
    std::vector<Case> cases;
    for (std::uint64_t k = i; k < std::min(i + batch, end); ++k)
      cases.push_back(evidence_case(e, d, k, planned));
    const auto observed = engine.run(cases);
    for (std::size_t k = 0; k < cases.size() && !part.wrong; ++k) {
      CandidateVerdict v = judge_candidates(cases[k], observed[k].answers.at(0), e.level, e.invalid);
      add(part.count, v);
      if (!v.fault.empty()) part.wrong = Wrong{i + k, std::move(cases[k]), std::move(v)};
    }
  }
  return part;
}

// The engines of one job live as long as the certificate is made.
struct Job {
  std::array<EnginePtr, 2> engines;
  Engine& engine(const Subject& s, Level level) {
    EnginePtr& e = engines[static_cast<std::size_t>(level)];
    if (!e) e = s.make(level);
    return *e;
  }
};

class Certifier {
 public:
  Certifier(const Subject& s, const CertifyConfig& c, const CertifyProgress& p, const std::atomic<bool>& stop)
      : subject_(s),
        config_(c),
        progress_(p),
        stop_(stop),
        jobs_(static_cast<std::size_t>(std::max(1, c.jobs))) {}

  std::optional<BroadCertificate> run() {
    check_names();
    out_.subject = subject_.name, out_.plugin_hash = subject_.plugin_hash, out_.program = config_.program;
    out_.card = jobs_[0].engine(subject_, Level::boxes).card();
    out_.scope = config_.scope == Scope::quick ? "quick" : "full";
    out_.seed = config_.seed, out_.limit = config_.limit, out_.levels = config_.levels;
    out_.sweeps = subject_.sweeps, out_.without = config_.without;
    draw_ = {config_.seed, out_.card.unit_roundoff > 0x1p-50 ? Scalar::float32 : Scalar::float64,
             config_.scope};
    std::size_t index = 0;
    for (const EvidenceRow& e : all_evidence()) {
      if (stop_) return std::nullopt;
      if (is_asked(e)) gather(e, index);
      ++index;
    }
    if (stop_) return std::nullopt;
    return std::move(out_);
  }

 private:
  void check_names() const {
    for (const std::string& w : config_.without)
      if (std::none_of(all_evidence().begin(), all_evidence().end(),
                       [&](const EvidenceRow& e) { return e.name == w; }))
        throw InputError("--without " + w, "there is no such evidence");
  }
  bool is_asked(const EvidenceRow& e) const {
    const auto has = [](const auto& list, const auto& x) {
      return std::find(list.begin(), list.end(), x) != list.end();
    };
    return has(config_.levels, e.level) && !has(config_.without, std::string(e.name)) &&
           (!e.sweeps || subject_.sweeps) && verdict(out_, e.level) != LevelVerdict::refuted;
  }

  void gather(const EvidenceRow& e, std::size_t index) {
    const auto start = std::chrono::steady_clock::now();
    EvidenceCount total;
    total.name = e.name, total.line = e.line, total.kind = e.kind, total.level = e.level;
    total.planned = planned_cases(e, draw_);
    if (config_.limit > 0) total.planned = std::min(total.planned, config_.limit);
    total.population = e.population ? e.population(draw_) : 0;
    const auto wrong = run_parts(e, total, index);
    if (stop_) return;
    total.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    out_.evidence.push_back(total);
    if (wrong) out_.refutations.push_back(refute(subject_, e, wrong->index, wrong->c, wrong->verdict));
    if (progress_) progress_(total, index, all_evidence().size());
  }

  // Parts are counted up to the first that found something wrong, whoever finished first.
  std::optional<Wrong> run_parts(const EvidenceRow& e, EvidenceCount& total, std::size_t index) {
    const std::uint64_t parts = (total.planned + e.chunk - 1) / e.chunk;
    std::vector<Part> done(parts);
    std::atomic<std::uint64_t> next{0}, last{parts};
    std::exception_ptr failure;
    std::mutex guard;
    EvidenceCount so_far = total;
    const auto do_parts = [&](Job& job) {
      for (std::uint64_t p = next++; p < last.load() && !stop_; p = next++) {
        done[p] = run_part(e, draw_, total.planned, p * e.chunk, job.engine(subject_, e.level), stop_);
        const std::lock_guard lock(guard);
        if (done[p].wrong) last = std::min(last.load(), p + 1);
        so_far.cases += done[p].count.cases;
        if (progress_) progress_(so_far, index, all_evidence().size());
      }
    };
    const auto work = [&](Job& job) {
      try {
        do_parts(job);
      } catch (...) {
        const std::lock_guard lock(guard);
        failure = std::current_exception(), last = 0;
      }
    };
    run_jobs(work);
    if (failure) std::rethrow_exception(failure);
    std::optional<Wrong> wrong;
    for (std::uint64_t p = 0; p < last.load() && !stop_; ++p) {
      add(total, done[p].count);
      if (done[p].wrong) wrong = std::move(done[p].wrong);
    }
    return wrong;
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
  BroadCertificate out_;
};

}  // namespace

std::optional<BroadCertificate> certify(const Subject& subject, const CertifyConfig& config,
                                        const CertifyProgress& progress, const std::atomic<bool>& stop) {
  return Certifier(subject, config, progress, stop).run();
}

}  // namespace touchstone::fuzz
