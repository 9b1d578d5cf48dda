// Random pairs of meshes, each judged by the referee: ts_core_mesh_stress [COUNT] [SEED]. Run by hand.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "core/narrow/pair_table.h"
#include "core/tolerance.h"
#include "oracles/referee/referee.h"
#include "tests/core/random_meshes.h"

namespace {

using namespace touchstone;
using namespace touchstone::test;

struct Count {
  long cases = 0, wrong = 0, undecided = 0, meeting = 0, unanswered = 0, fast = 0;
  double worst = 0;  // error in units of τ
};

void judge(const Pair& p, Count& c) {
  const Collider a(p.a), b(p.b);
  const PlacedShape x = a.at(p.pose_a), y = b.at(p.pose_b);
  const double tau = tolerance::core_tau_factor * 0x1p-53 * scale_of(p);
  const auto truth = referee::judge_pair({&p.a, p.pose_a}, {&p.b, p.pose_b});
  const bool meet = truth.verdict == referee::Verdict::overlap;
  ++c.cases;
  c.meeting += meet;
  if (truth.verdict == referee::Verdict::undecided) {
    ++c.undecided;
    return;
  }
  narrow::FastAnswer<double> f;
  narrow::separate_fast<double>(x, y, narrow::filtered::Asked::distance, f);
  c.fast += f.answer.found != narrow::filtered::Found::unsure;
  const OverlapAnswer o = overlap(x, y);
  const DistanceAnswer d = distance(x, y);
  const ContactAnswer k = contact(x, y);
  if (o.outcome != Outcome::answered || d.outcome != Outcome::answered || k.outcome != Outcome::answered) {
    ++c.unanswered;
    return;
  }
  const double gap = std::max(0.0, d.distance);
  double error = meet ? gap : std::max(truth.gap.lo - d.distance, d.distance - truth.gap.hi);
  for (const bool verdict : {o.overlap, k.overlap})
    if (verdict != meet)
      error = std::max(error, meet ? (d.distance < 0 ? -d.distance : tau / 2) : truth.gap.lo);
  error = std::max(error, std::abs((d.witness[1] - d.witness[0]).norm() - std::abs(d.distance)));
  error = std::max(error, referee::distance_to({&p.a, p.pose_a}, d.witness[0], tau).lo);
  error = std::max(error, referee::distance_to({&p.b, p.pose_b}, d.witness[1], tau).lo);
  for (const ContactPoint& point : k.manifold)
    for (const auto& [shape, pose] : {std::pair{&p.a, p.pose_a}, std::pair{&p.b, p.pose_b}})
      error = std::max(error, referee::distance_to({shape, pose}, point.position, tau).lo - k.depth);
  c.worst = std::max(c.worst, error / tau);
  c.wrong += error > tau;
}

}  // namespace

int main(int argc, char** argv) {
  const long count = argc > 1 ? std::atol(argv[1]) : 10000;
  const auto seed = argc > 2 ? static_cast<std::uint64_t>(std::atol(argv[2])) : 1;
  Count sum[mesh_regime_count];
  for (long i = 0; i < count; ++i) {
    Rng r = Rng::stream(seed, static_cast<std::uint64_t>(i));
    const int regime = static_cast<int>(i % mesh_regime_count);
    const long wrong = sum[regime].wrong, unanswered = sum[regime].unanswered;
    judge(random_mesh_pair(r, regime), sum[regime]);
    if (sum[regime].wrong > wrong) std::printf("wrong: case %ld of seed %lu\n", i, seed);
    if (sum[regime].unanswered > unanswered) std::printf("unanswered: case %ld of seed %lu\n", i, seed);
  }
  std::printf("%-12s %8s %8s %8s %8s %10s %8s  worst/tau\n", "regime", "cases", "meeting", "wrong",
              "undecided", "unanswered", "fast");
  long wrong = 0;
  for (int k = 0; k < mesh_regime_count; ++k) {
    const Count& c = sum[k];
    wrong += c.wrong + c.unanswered;
    std::printf("%-12s %8ld %8ld %8ld %8ld %10ld %8ld  %.3g\n",
                mesh_regime_names[static_cast<std::size_t>(k)].data(), c.cases, c.meeting, c.wrong,
                c.undecided, c.unanswered, c.fast, c.worst);
  }
  return wrong > 0;
}
