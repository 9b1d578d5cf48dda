#include "scenarios/handmade/ladders/ladder.h"

namespace touchstone::scenarios {

std::vector<Ladder> ladders() {
  std::vector<Ladder> all;
  for (const auto& part :
       {alignment_ladders(), round_ladders(), size_ladders(), degenerate_ladders(), motion_ladders()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace touchstone::scenarios
