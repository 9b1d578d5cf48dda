#include "oracles/routes/routes.h"

#include <algorithm>

namespace touchstone::routes {

const Library* library_of(std::string_view engine) {
  static const std::vector<Library> all = libraries();
  const auto has_it = [&](const Library& l) {
    return engine.starts_with(l.prefix) &&
           (engine.size() == l.prefix.size() || engine[l.prefix.size()] == '-');
  };
  const auto found = std::ranges::find_if(all, has_it);
  return found == all.end() ? nullptr : &*found;
}

std::string_view route_of(std::string_view engine, const Pair& p) {
  const Library* library = library_of(engine);
  return library ? library->route(engine, p) : common_route(p);
}

std::string_view documented(std::string_view engine, Question question, std::string_view route, Fault fault) {
  const Library* library = library_of(engine);
  return library && library->documents ? library->documents(engine, question, route, fault) : "";
}

std::string_view documented_of_parting(std::string_view engine) {
  const Library* library = library_of(engine);
  return library ? library->parting : "";
}

}  // namespace touchstone::routes
