// A finding that stands for others of its class: its case is reduced and asked in all changed forms.
#pragma once

#include <optional>
#include <vector>

#include "fuzz/causes/classes.h"
#include "fuzz/causes/respond.h"

namespace touchstone::fuzz {

/// A case of a finding, reduced and asked in all changed forms.
struct Examined {
  Case smallest;                   // with volume and plain numbers if such a case shows it (shrink_solid)
  std::optional<Case> defensible;  // fuzz/shrink/defensible.h
  Responses responses;             // of the defensible case, or of the smallest
  Case canonical;                  // of the case shown (fuzz/shrink/canonical.h)
  const Case& shown() const { return defensible ? *defensible : smallest; }
};

struct Representative {
  std::size_t of_class = 0;                // index of its class
  Symptom symptom;                         // of its class; of a contradiction, the fault that explains it
  const Finding* finding = nullptr;        // shown by its engine
  std::vector<const Finding*> stands_for;  // it and those of the class that are most like it; by key
  /// Of a contradiction: the fault that one of the two forms shows by itself (plain_form.h). Then `first`
  /// is about that form, reduced so that it keeps this fault.
  std::optional<Finding> failing;
  Examined first;
  std::optional<Examined>
      second;          // another example of the finding; empty if there is none or it was not asked
  bool asked = false;  // false: its engine is missing, or the time was up

  /// What `first` shows.
  const Finding& shown() const { return failing ? *failing : *finding; }
};

/// At most `most` findings of a class: first those with different faults and kinds of shapes, then the
/// others, each time the most frequent first. Every finding of the class is in exactly one stands_for.
/// Nothing is asked.
std::vector<Representative> representatives_of(const FindingClass& c, std::size_t of_class, std::size_t most);

/// The case of a finding's evidence. Throws InputError when it is damaged.
Case case_of(const Finding& f);

/// Reduces a case of the representative with at most `tries` questions and asks it in all forms; and, if
/// `twice`, another example.
void examine(Representative& r, const EngineKnowledge& knowledge, std::size_t tries, bool twice,
             EnginePool& pool);

}  // namespace touchstone::fuzz
