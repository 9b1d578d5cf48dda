#include "fuzz/shrink/shrink.h"

#include <algorithm>

#include "fuzz/shrink/reductions.h"

namespace touchstone::fuzz {
namespace {

// Most proposals per batch. The first that shows the finding is taken and those after it are wasted, which is
// expensive where an answer takes a second (a time-out), so batches start at one and double.
constexpr std::size_t largest_batch = 16;

class Shrinker {
 public:
  Shrinker(const Case& c, const StillShows& still, std::size_t max_tries)
      : still_(still), max_tries_(max_tries) {
    result_.smallest = c;
    result_.before = result_.after = measure(c);
  }

  Shrunk run() {
    if (!take_first({result_.smallest})) return result_;
    for (CaseSize start = measure(result_.smallest);;) {
      for (const ListPart& p : list_parts()) drop_from(p);
      for (const Simplification& s : simplifications()) simplify(s);
      round_numbers();
      result_.after = measure(result_.smallest);
      if (result_.after == start || is_exhausted()) break;
      start = result_.after;
    }
    result_.exit = is_exhausted() ? ShrinkExit::out_of_tries : ShrinkExit::smallest;
    return result_;
  }

 private:
  bool is_exhausted() const { return result_.tried >= max_tries_; }

  // Takes the first proposal that shows the finding.
  bool take_first(const std::vector<Case>& proposals) {
    std::size_t batch = 1;
    for (std::size_t first = 0; first < proposals.size() && !is_exhausted();
         first += batch, batch = std::min(2 * batch, largest_batch)) {
      const std::span<const Case> part(proposals.data() + first, std::min(batch, proposals.size() - first));
      const auto shows = still_(part);
      result_.tried += part.size();
      const auto hit = std::find(shows.begin(), shows.end(), true);
      if (hit == shows.end()) continue;
      result_.smallest = part[static_cast<std::size_t>(hit - shows.begin())];
      return true;
    }
    return false;
  }
  bool take_smaller(std::vector<Case> proposals) {
    return take_first(smaller_and_valid(result_.smallest, std::move(proposals)));
  }

  void drop_from(const ListPart& p) {
    for (std::size_t list = 0; list < p.lists(result_.smallest); ++list)
      for (std::size_t chunk = p.count(result_.smallest, list); chunk > 0; chunk /= 2)
        while (!is_exhausted() && take_smaller(without_chunk(p, list, chunk))) {
        }
  }

  std::vector<Case> without_chunk(const ListPart& p, std::size_t list, std::size_t chunk) const {
    std::vector<Case> proposals;
    const std::size_t n = p.count(result_.smallest, list);
    for (std::size_t first = 0; first < n; first += chunk)
      if (auto c = p.drop(result_.smallest, list, first, std::min(chunk, n - first)))
        proposals.push_back(std::move(*c));
    return proposals;
  }

  void simplify(const Simplification& s) {
    for (;;) {
      std::vector<Case> proposals;
      s.propose(result_.smallest, proposals);
      if (is_exhausted() || !take_smaller(std::move(proposals))) return;
    }
  }

  void round_numbers() {
    take_smaller(round_all(result_.smallest));
    for (std::size_t i = 0; i < numbers(result_.smallest).size() && !is_exhausted(); ++i)
      take_smaller(round_one(result_.smallest, i));
  }

  const StillShows& still_;
  const std::size_t max_tries_;
  Shrunk result_;
};

}  // namespace

std::string_view to_string(ShrinkExit e) {
  switch (e) {
    case ShrinkExit::smallest:
      return "smallest";
    case ShrinkExit::out_of_tries:
      return "out of tries";
    case ShrinkExit::not_shown:
      break;
  }
  return "not shown";
}

Shrunk shrink(const Case& c, const StillShows& still, std::size_t max_tries) {
  return Shrinker(c, still, max_tries).run();
}

}  // namespace touchstone::fuzz
