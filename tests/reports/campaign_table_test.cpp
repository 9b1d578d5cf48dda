// The table of a campaign: one row an engine, shipped and tuned settings in one cell.
#include "tests/support/catch.h"

#include <algorithm>
#include <sstream>

#include "reports/text/text.h"
#include "tests/support/characters.h"

using namespace touchstone;
using reports::campaign_table;

namespace {

fuzz::Tally counted_answers(std::uint64_t answers, std::uint64_t wrong, std::uint64_t crashed = 0) {
  fuzz::Tally t;
  t.outcomes[static_cast<std::size_t>(Outcome::answered)] = answers;
  t.outcomes[static_cast<std::size_t>(Outcome::crashed)] = crashed;
  t.wrong = wrong;
  t.right = answers - wrong;
  return t;
}

}  // namespace

TEST_CASE("shipped and tuned settings of an engine share a row", "[table]") {
  fuzz::CampaignResult r;
  r.tallies["mine"][Question::overlap] = counted_answers(1000, 0);
  r.tallies["mine"][Question::contact] = counted_answers(1000, 310);
  r.tallies["mine-tuned"][Question::overlap] = counted_answers(1000, 1);
  r.tallies["mine-tuned"][Question::contact] = counted_answers(999, 0, 1);
  r.tallies["core"][Question::overlap] = counted_answers(20'000, 1);
  r.tallies["core"][Question::distance] = counted_answers(1000, 1000);
  r.tallies["core"][Question::swept_candidates] = {};
  r.tallies["alone-tuned"][Question::contact] = counted_answers(100, 99);
  CHECK(campaign_table(r) ==
        "Wrong and failed answers in %, as shipped/tuned (-: no answers)\n"
        "                 answers overlap    dist contact\n"
        "alone-tuned          100       -       -      99\n"
        "core              21,000     <.1     100       -\n"
        "mine               4,000   0/0.1       -  31/0.1\n");
}

TEST_CASE("the table keeps to 80 columns for long names and large counts", "[table]") {
  fuzz::CampaignResult r;
  constexpr std::uint64_t many = 40'000'000'000, few = 1;
  for (const std::string& name : {std::string("bullet-f32-query"), std::string(200, 'x')})
    for (const std::string& setting : {std::string(), std::string("-tuned")})
      for (std::size_t q = 0; q < question_names.size(); ++q)
        r.tallies[name + setting][static_cast<Question>(q)] =
            counted_answers(many, setting.empty() ? few : many);
  r.tallies["\x1b[2J"][Question::overlap] = counted_answers(1, 0);
  const std::string table = campaign_table(r);
  INFO(table);
  std::istringstream in(table);
  int rows = 0;
  for (std::string line; std::getline(in, line); ++rows) CHECK(touchstone::test::characters(line) <= 80);
  CHECK(rows == 6);
  CHECK(table.find("<.1/100 <.1/100") != std::string::npos);
  CHECK(table.find('\x1b') == std::string::npos);
  CHECK(campaign_table({}).starts_with("Wrong and failed answers in % ("));
}
