// Elements of a file by name, each of which must be unique.
#pragma once

#include <map>
#include <string>

#include "core/base/input_error.h"
#include "scenarios/import/model/model.h"
#include "scenarios/import/xml.h"
#include "scenarios/text/printable.h"

namespace touchstone {

/// Limits on a file; throw InputError at the element.
inline constexpr std::size_t most_links = 4096, most_shapes = 8192;
inline void require_few_links(const Model& m, const XmlElement& e) {
  if (m.links.size() >= most_links)
    e.fail("a model with more than " + std::to_string(most_links) + " links is not read");
}
inline void require_few_shapes(std::size_t count, const XmlElement& e) {
  if (count > most_shapes)
    e.fail("a model with more than " + std::to_string(most_shapes) + " shapes is not read");
}

/// sort_links; errors name the element's file and line.
inline void sort_links_of(Model& m, const XmlElement& e) {
  try {
    sort_links(m);
  } catch (const InputError& error) {
    e.fail(error.what());
  }
}

class NumberByName {
 public:
  /// Throws InputError at `e` when the name is taken.
  void add(const XmlElement& e, const std::string& name, int number) {
    if (!numbers_.emplace(name, number).second) e.fail("the name " + printable(name) + " is taken");
  }
  /// -1 when there is none.
  int find(const std::string& name) const {
    const auto it = numbers_.find(name);
    return it == numbers_.end() ? -1 : it->second;
  }
  /// Throws InputError at `e`; `what` is "link" or "joint".
  int need(const XmlElement& e, const std::string& name, const std::string& what) const {
    const int i = find(name);
    if (i < 0) e.fail("there is no " + what + " " + printable(name));
    return i;
  }

 private:
  std::map<std::string, int> numbers_;
};

}  // namespace touchstone
