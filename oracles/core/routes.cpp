#include "oracles/routes/routes.h"

namespace touchstone::routes {
namespace {

std::string_view route(std::string_view, const Pair& p) { return common_route(p); }

}  // namespace

Library core_library() { return {"the core", "core", route}; }

}  // namespace touchstone::routes
