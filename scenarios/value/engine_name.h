// What an engine may call itself: a name is part of keys, of the names of files, and of what terminals show.
#pragma once

#include <string_view>

namespace touchstone {

/// At most 64 printable ASCII characters, none of them / or \, the first a letter or digit.
bool is_engine_name(std::string_view name);

}  // namespace touchstone
