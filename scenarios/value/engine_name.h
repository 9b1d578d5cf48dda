// Valid engine names: a name is part of keys and file names, and is shown in terminals.
#pragma once

#include <string_view>

namespace touchstone {

/// At most 64 printable ASCII characters without / and \; the first is a letter or digit.
bool is_engine_name(std::string_view name);

}  // namespace touchstone
