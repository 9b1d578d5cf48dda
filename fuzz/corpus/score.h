// What an engine makes of the corpus: the judge's rulings on what the corpus asks (verdict, distance, normal
// with depth, time of impact; corpus/README.md), and its answers as the runners take them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "fuzz/corpus/corpus_json.h"
#include "scenarios/value/engine_card.h"
#include "scenarios/value/judgement.h"
#include "scenarios/value/observation.h"

namespace touchstone::fuzz::corpus {

/// not_judged: the tolerance is wider than any that the case lists, or the referee cannot tell.
enum class Score : std::uint8_t { right, wrong, failed, unsupported, not_judged };
inline constexpr auto score_names =
    std::to_array<std::string_view>({"right", "wrong", "failed", "unsupported", "not judged"});
static_assert(score_names.size() == static_cast<std::size_t>(Score::not_judged) + 1);
constexpr std::string_view to_string(Score s) { return score_names[static_cast<std::size_t>(s)]; }

struct Scored {
  Question question = Question::overlap;
  Score score = Score::unsupported;
  std::string words;            // of a wrong or failed answer
  nlohmann::ordered_json line;  // {"case", "question", "answer", "limits"} or {..., "failed"/"unsupported"}
};

/// One for each question of the case. `observations` are of as_case(c.id, c.scene).
std::vector<Scored> score(const StoredCorpusCase& c, const EngineCard& card,
                          const CaseObservations& observations);

}  // namespace touchstone::fuzz::corpus
