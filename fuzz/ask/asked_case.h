// A case as it is judged. It is copied and measured once, for all findings that it is an example of.
#pragma once

#include <cstdint>
#include <memory>

#include "reports/record/examples.h"
#include "scenarios/random/numbers.h"

namespace touchstone::fuzz {

class AskedCase {
 public:
  /// Refers to the case.
  AskedCase(const Case& c, std::uint64_t index) : case_(c), index_(index) {}
  const Case& get() const { return case_; }
  std::uint64_t index() const { return index_; }
  Example example(double error_in_l) {
    if (!copy_) {
      copy_ = std::make_shared<const Case>(case_);
      size_ = measure(case_);
    }
    return {index_, error_in_l, size_, copy_};
  }

 private:
  const Case& case_;
  std::uint64_t index_;
  std::shared_ptr<const Case> copy_;
  CaseSize size_;
};

}  // namespace touchstone::fuzz
