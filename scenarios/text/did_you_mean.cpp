#include "scenarios/text/name_list.h"

#include <algorithm>
#include <vector>

namespace touchstone {
namespace {

constexpr std::size_t most_suggestions = 3, longest_name = 200;

// Restricted Damerau distance: insertions, deletions, substitutions and transpositions of neighbouring
// letters.
std::size_t typing_errors(std::string_view x, std::string_view y) {
  std::vector<std::size_t> before(y.size() + 1), last(y.size() + 1), now(y.size() + 1);
  for (std::size_t j = 0; j <= y.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= x.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= y.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (x[i - 1] != y[j - 1])});
      if (i > 1 && j > 1 && x[i - 1] == y[j - 2] && x[i - 2] == y[j - 1])
        now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(now);
  }
  return last[y.size()];
}

}  // namespace

std::string did_you_mean(std::string_view word, std::span<const std::string> known) {
  if (word.empty() || word.size() > longest_name) return "";
  std::vector<std::pair<std::size_t, std::string_view>> near;
  const std::size_t allowed = word.size() > 4 ? 2 : 1;
  for (const std::string& name : known) {
    const std::size_t errors = typing_errors(word, name);
    const bool beginning = name.starts_with(word) || (name.size() > 2 && word.starts_with(name));
    if (errors <= allowed || beginning) near.emplace_back(errors, name);
  }
  std::sort(near.begin(), near.end());
  std::string text;
  for (std::size_t i = 0; i < std::min(near.size(), most_suggestions); ++i)
    text += (i == 0 ? "; did you mean " : ", ") + std::string(near[i].second);
  return text.empty() ? text : text + "?";
}

}  // namespace touchstone
