#include "reports/record/primitives.h"

namespace touchstone::fuzz {

void PrimitiveTally::merge(const PrimitiveTally& o) {
  queries += o.queries;
  hits += o.hits;
  missed += o.missed;
  ghost += o.ghost;
  late += o.late;
  failed += o.failed;
  source_wrong += o.source_wrong;
  not_judged += o.not_judged;
  time.merge(o.time);
}

Json to_json(const PrimitiveTallies& tallies) {
  Json rows = Json::array();
  for (const auto& [key, t] : tallies)
    rows.push_back({{"source", key.first},
                    {"kind", key.second},
                    {"queries", t.queries},
                    {"hits", t.hits},
                    {"missed", t.missed},
                    {"ghost", t.ghost},
                    {"late", t.late},
                    {"failed", t.failed},
                    {"not_judged", t.not_judged},
                    {"source_wrong", t.source_wrong},
                    {"median_ns", t.time.quantile(0.5)},
                    {"p99_ns", t.time.quantile(tail_quantile)}});
  return {{"primitives", std::move(rows)}};
}

}  // namespace touchstone::fuzz
