// The lies by topic; one file per topic.
#pragma once

#include <vector>

#include "tests/mutants/mutant.h"

namespace touchstone::mutants {

std::vector<Mutant> broad_list_lies();    // the list of pairs
std::vector<Mutant> broad_box_lies();     // the boxes
std::vector<Mutant> broad_script_lies();  // what happened before the query
std::vector<Mutant> overlap_lies();
std::vector<Mutant> distance_lies();
std::vector<Mutant> normal_lies();
std::vector<Mutant> depth_lies();
std::vector<Mutant> manifold_lies();
std::vector<Mutant> impact_lies();
std::vector<Mutant> gradient_lies();
std::vector<Mutant> margin_lies();  // margins, bounds, rays
std::vector<Mutant> margin_contact_lies();
std::vector<Mutant> swept_lies();  // the broad phase of a step
std::vector<Mutant> outcome_lies();
std::vector<Mutant> scene_lies();
std::vector<Mutant> relation_lies();  // visible only in another form of the case
std::vector<Mutant> regime_lies();    // visible only in one regime of the generator
std::vector<Mutant> memory_lies();    // earlier questions
std::vector<Mutant> trigger_lies();   // the same wrong answer in other cases
std::vector<Mutant> symptom_lies();   // the same wrong answer for other reasons
std::vector<Mutant> solid_lies();     // solid meshes
std::vector<Mutant> ground_lies();    // height fields, bodies of several shapes

}  // namespace touchstone::mutants
